//! What has to come of a program: the lines of its text that begin with `>>`.
//!
//! | line | says of the program's line before it |
//! |---|---|
//! | `rapid X1 Y2` | a rapid that ends there |
//! | `F300 X1 Y2`, `X1 Y2` | a move at that feed (mm/min) or at any, that ends there |
//! | `F300 mid X1 Y2` | the middle of a move is there |
//! | `dwell 0.5` | a dwell of so many seconds |
//! | `none` | it moves nothing |
//! | `refused TEXT` | the program is refused there first; TEXT is in what is said, `*` is anything |
//! | `at G54 T1` | from here on places count from the zero of G54, with tool 1's length along Z |
//! | `at tcp G54 T1` | the same; the length is along the tool, as A and C hold it |
//! | `at joints G54 T1` | the same; places are those of the linear axes of the machine |
//!
//! Several of them under a line are moves in this order, with others between them.

use glidepath_geometry::{Axis, AxisVector};

use crate::shop_programs::machines;

/// Letters of axes, in their order; the extruder is U.
pub(super) const LETTERS: [char; 9] = ['X', 'Y', 'Z', 'A', 'B', 'C', 'U', 'V', 'W'];

/// What places count from.
#[derive(Debug, Clone, Copy)]
pub(super) enum Frame {
    /// The axes as items have them.
    Axes {
        zero: AxisVector,
        /// Length of the tool along itself, where it leans.
        along_tool_mm: f64,
    },
    /// The linear axes of a machine with five.
    Joints { zero: AxisVector },
}

impl Frame {
    /// What the frame adds to a place at these angles.
    pub(super) fn shift(&self, at: &AxisVector) -> AxisVector {
        match self {
            Self::Joints { zero } => *zero,
            Self::Axes {
                zero,
                along_tool_mm,
            } => {
                // The tool on the work, where A tilts the table and C turns it: Rz(-C) Rx(-A) z.
                let (sa, ca) = at[Axis::A.index()].to_radians().sin_cos();
                let (sc, cc) = at[Axis::C.index()].to_radians().sin_cos();
                let mut shift = *zero;
                shift[0] += along_tool_mm * sa * sc;
                shift[1] += along_tool_mm * sa * cc;
                shift[2] += along_tool_mm * ca;
                shift
            }
        }
    }
}

/// A move or a dwell.
#[derive(Debug)]
pub(super) struct Claim {
    pub(super) text: String,
    pub(super) frame: Frame,
    /// `None`: any; `Some(None)`: a rapid; else mm/min.
    pub(super) feed: Option<Option<f64>>,
    pub(super) is_middle: bool,
    pub(super) dwell_s: Option<f64>,
    /// Index of the axis, and its place.
    pub(super) words: Vec<(usize, f64)>,
}

#[derive(Debug)]
pub(super) enum Expected {
    Claim(Claim),
    Nothing,
    Refused(String),
}

#[derive(Debug)]
pub(super) struct ShopProgram {
    pub(super) name: String,
    pub(super) dialect: String,
    pub(super) machine: String,
    pub(super) text: String,
    /// Lines from 1.
    pub(super) expected: Vec<(u32, Expected)>,
}

/// The programs of a file.
pub(super) fn programs(text: &str) -> Vec<ShopProgram> {
    let (mut all, mut line): (Vec<ShopProgram>, u32) = (Vec::new(), 0);
    let mut frame = machine_frame();
    for row in text.lines() {
        if let Some(head) = row.strip_prefix("=== ") {
            let words: Vec<&str> = head.split(' ').collect();
            let [name, dialect, machine] = words[..] else {
                panic!("a head has a name, a dialect and a machine: {row}");
            };
            (line, frame) = (0, machine_frame());
            all.push(ShopProgram {
                name: name.to_owned(),
                dialect: dialect.to_owned(),
                machine: machine.to_owned(),
                text: String::new(),
                expected: Vec::new(),
            });
            continue;
        }
        let program = all.last_mut().expect("a head before the first program");
        let Some(said) = row.strip_prefix(">> ") else {
            line += 1;
            program.text += row;
            program.text.push('\n');
            continue;
        };
        if let Some(said) = said.strip_prefix("at ") {
            frame = read_frame(said, &program.machine);
        } else {
            program.expected.push((line, read(said, frame)));
        }
    }
    all
}

fn machine_frame() -> Frame {
    Frame::Axes {
        zero: AxisVector::zeros(),
        along_tool_mm: 0.0,
    }
}

fn read_frame(said: &str, machine: &str) -> Frame {
    let mut words: Vec<&str> = said.split(' ').collect();
    let kind = match words[0] {
        "tcp" | "joints" => words.remove(0),
        _ => "",
    };
    let mut zero = machines::zero(words[0], machine);
    let mut along_tool_mm = 0.0;
    if let Some(tool) = words.get(1) {
        let (letter, number) = tool.split_at(1);
        let number: u32 = number.parse().expect("the number of a tool");
        let offset = if number == 0 {
            AxisVector::zeros()
        } else {
            machines::tool(number, letter == "L").offset
        };
        if kind == "tcp" {
            along_tool_mm = offset[2];
        } else {
            zero += offset;
        }
    }
    if kind == "joints" {
        Frame::Joints { zero }
    } else {
        Frame::Axes {
            zero,
            along_tool_mm,
        }
    }
}

fn read(said: &str, frame: Frame) -> Expected {
    if said == "none" {
        return Expected::Nothing;
    }
    if let Some(text) = said.strip_prefix("refused ") {
        return Expected::Refused(text.to_owned());
    }
    let mut claim = Claim {
        text: said.to_owned(),
        frame,
        feed: None,
        is_middle: false,
        dwell_s: None,
        words: Vec::new(),
    };
    if let Some(seconds) = said.strip_prefix("dwell ") {
        claim.dwell_s = Some(seconds.parse().expect("seconds"));
        return Expected::Claim(claim);
    }
    for word in said.split(' ') {
        match word {
            "rapid" => claim.feed = Some(None),
            "mid" => claim.is_middle = true,
            _ => {
                let letter = word.chars().next().expect("a word");
                let value: f64 = word[1..].parse().unwrap_or_else(|_| panic!("{said}"));
                match letter {
                    'F' => claim.feed = Some(Some(value)),
                    'E' => claim.words.push((6, value)),
                    _ => {
                        let axis = LETTERS.iter().position(|known| *known == letter);
                        claim.words.push((axis.expect("an axis"), value));
                    }
                }
            }
        }
    }
    Expected::Claim(claim)
}
