//! The G and M numbers, sorted into their modal groups.
//!
//! A block may have one code of each group. G numbers are kept times ten, so that G59.3 is 593.

use glidepath_geometry::Plane;
use glidepath_motion::PathMode;

use crate::diagnostic::{Code, Fault, Outcome, Span};

/// Motion modes (group 1).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// G0.
    Rapid,
    /// G1.
    Linear,
    /// G2.
    ArcClockwise,
    /// G3.
    ArcCounterclockwise,
}

/// Codes that act once (group 0).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Once {
    /// G4.
    Dwell,
    /// G10.
    SetData,
    /// G28, G30: go by way of the given point to the reference position of that index.
    GoToReference(usize),
    /// G28.1, G30.1.
    SetReference(usize),
    /// G52.
    LocalOffset,
    /// G53.
    MachineCoordinates,
    /// G92.
    SetOffset,
    /// G92.1.
    ClearOffset,
    /// G92.2.
    SuspendOffset,
    /// G92.3.
    RestoreOffset,
}

impl Once {
    /// True if the code takes the axis words of its block for itself.
    pub(crate) const fn takes_axes(self) -> bool {
        matches!(
            self,
            Self::SetData | Self::GoToReference(_) | Self::LocalOffset | Self::SetOffset
        )
    }
}

/// Meaning of axis words (group 3) or of I, J, K (group 4).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Distance {
    /// G90, G90.1.
    Absolute,
    /// G91, G91.1.
    Incremental,
}

/// Meaning of F (group 5).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FeedMode {
    /// G93: one over the minutes the move takes.
    InverseTime,
    /// G94: per minute.
    PerMinute,
}

/// Length units (group 6).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Units {
    /// G20.
    Inch,
    /// G21.
    Millimetre,
}

impl Units {
    /// Millimetres in one unit.
    #[must_use]
    pub const fn mm(self) -> f64 {
        match self {
            Self::Inch => 25.4,
            Self::Millimetre => 1.0,
        }
    }
}

/// How M codes stop (group 4 of the M codes).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stop {
    /// M0 or M60.
    Program(u32),
    /// M1.
    Optional,
    /// M2 or M30.
    End,
}

/// A code and where it stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Coded<T> {
    pub(crate) code: T,
    pub(crate) span: Span,
}

/// The codes of one block, by modal group.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Codes {
    pub(crate) once: Option<Coded<Once>>,
    /// `None` inside is G80.
    pub(crate) motion: Option<Coded<Option<Motion>>>,
    pub(crate) plane: Option<Coded<Plane>>,
    pub(crate) distance: Option<Coded<Distance>>,
    pub(crate) arc_distance: Option<Coded<Distance>>,
    pub(crate) feed_mode: Option<Coded<FeedMode>>,
    pub(crate) units: Option<Coded<Units>>,
    pub(crate) cutter_comp: Option<Coded<()>>,
    pub(crate) tool_length: Option<Coded<()>>,
    pub(crate) retract: Option<Coded<()>>,
    pub(crate) spindle_mode: Option<Coded<()>>,
    pub(crate) diameter: Option<Coded<()>>,
    /// Index of the coordinate system, from 0 for G54.
    pub(crate) system: Option<Coded<usize>>,
    /// The tolerance of G64 comes from its P word.
    pub(crate) path_mode: Option<Coded<PathMode>>,
    pub(crate) tool_change: Option<Coded<u32>>,
    pub(crate) spindle: Option<Coded<u32>>,
    pub(crate) coolant: Option<Coded<u32>>,
    pub(crate) overrides: Option<Coded<u32>>,
    pub(crate) stop: Option<Coded<Stop>>,
}

impl Codes {
    /// Adds a G word; `value` is its number.
    pub(crate) fn add_g(&mut self, value: f64, span: Span) -> Outcome<()> {
        let tenths = code_number(value * 10.0).ok_or_else(|| unknown_g(value, span))?;
        match tenths {
            0 => self.set_motion(Some(Motion::Rapid), span),
            10 => self.set_motion(Some(Motion::Linear), span),
            20 => self.set_motion(Some(Motion::ArcClockwise), span),
            30 => self.set_motion(Some(Motion::ArcCounterclockwise), span),
            800 => self.set_motion(None, span),
            40 | 100 | 280 | 281 | 300 | 301 | 520 | 530 | 920..=923 => {
                set(&mut self.once, once(tenths), span)
            }
            170 => set(&mut self.plane, Plane::Xy, span),
            180 => set(&mut self.plane, Plane::Zx, span),
            190 => set(&mut self.plane, Plane::Yz, span),
            171 => set(&mut self.plane, Plane::Uv, span),
            181 => set(&mut self.plane, Plane::Wu, span),
            191 => set(&mut self.plane, Plane::Vw, span),
            200 => set(&mut self.units, Units::Inch, span),
            210 => set(&mut self.units, Units::Millimetre, span),
            400 => set(&mut self.cutter_comp, (), span),
            490 => set(&mut self.tool_length, (), span),
            540 | 550 | 560 | 570 | 580 | 590 | 591..=593 => {
                set(&mut self.system, system_index(tenths), span)
            }
            610 => set(&mut self.path_mode, PathMode::ExactPath, span),
            611 => set(&mut self.path_mode, PathMode::ExactStop, span),
            640 => set(
                &mut self.path_mode,
                PathMode::Continuous { tolerance_mm: None },
                span,
            ),
            80 => set(&mut self.diameter, (), span),
            900 => set(&mut self.distance, Distance::Absolute, span),
            910 => set(&mut self.distance, Distance::Incremental, span),
            901 => set(&mut self.arc_distance, Distance::Absolute, span),
            911 => set(&mut self.arc_distance, Distance::Incremental, span),
            930 => set(&mut self.feed_mode, FeedMode::InverseTime, span),
            940 => set(&mut self.feed_mode, FeedMode::PerMinute, span),
            970 => set(&mut self.spindle_mode, (), span),
            980 | 990 => set(&mut self.retract, (), span),
            _ => Err(refused_g(tenths, value, span)),
        }
    }

    /// G80 may stand beside another motion code, as in the first line of many programs; that
    /// code then is the mode.
    fn set_motion(&mut self, motion: Option<Motion>, span: Span) -> Outcome<()> {
        match (self.motion, motion) {
            (Some(Coded { code: Some(_), .. }), None) => Ok(()),
            (Some(Coded { code: None, .. }), Some(_)) => {
                self.motion = Some(Coded { code: motion, span });
                Ok(())
            }
            _ => set(&mut self.motion, motion, span),
        }
    }

    /// Adds an M word.
    pub(crate) fn add_m(&mut self, value: f64, span: Span) -> Outcome<()> {
        let Some(number) = code_number(value) else {
            return Err(unknown_m(value, span));
        };
        match number {
            0 | 60 => set(&mut self.stop, Stop::Program(number), span),
            1 => set(&mut self.stop, Stop::Optional, span),
            2 | 30 => set(&mut self.stop, Stop::End, span),
            3..=5 => set(&mut self.spindle, number, span),
            6 => set(&mut self.tool_change, number, span),
            7..=9 => set(&mut self.coolant, number, span),
            48 | 49 => set(&mut self.overrides, number, span),
            19 | 50..=53 | 61..=68 | 70..=73 | 98 | 99 => Err(Fault::new(
                Code::NotSupported,
                span,
                format!("M{number} is not supported"),
            )
            .because("skipping it could change what the machine does")),
            _ => Err(unknown_m(value, span)),
        }
    }
}

const fn once(tenths: u32) -> Once {
    match tenths {
        40 => Once::Dwell,
        100 => Once::SetData,
        280 => Once::GoToReference(0),
        281 => Once::SetReference(0),
        300 => Once::GoToReference(1),
        301 => Once::SetReference(1),
        520 => Once::LocalOffset,
        530 => Once::MachineCoordinates,
        920 => Once::SetOffset,
        921 => Once::ClearOffset,
        922 => Once::SuspendOffset,
        _ => Once::RestoreOffset,
    }
}

/// Index of G54 … G59, G59.1 … G59.3.
const fn system_index(tenths: u32) -> usize {
    match tenths {
        540 => 0,
        550 => 1,
        560 => 2,
        570 => 3,
        580 => 4,
        590 => 5,
        591 => 6,
        592 => 7,
        _ => 8,
    }
}

/// The whole number a code's value stands for; a computed value may be off by rounding.
fn code_number(value: f64) -> Option<u32> {
    let nearest = value.round();
    let whole = (value - nearest).abs() < 1e-4 && (0.0..10_000.0).contains(&nearest);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "range checked"
    )]
    whole.then_some(nearest as u32)
}

fn set<T>(slot: &mut Option<Coded<T>>, code: T, span: Span) -> Outcome<()> {
    if let Some(first) = slot {
        let column = first.span.start + 1;
        let message = format!("a second code of the modal group of the one at column {column}");
        return Err(Fault::new(Code::ModalGroupConflict, span, message)
            .because("codes of one modal group exclude each other, so a block has one at most")
            .help("remove one of them, or write two blocks"));
    }
    *slot = Some(Coded { code, span });
    Ok(())
}

#[cold]
fn unknown_g(value: f64, span: Span) -> Box<Fault> {
    Fault::new(Code::UnknownGCode, span, format!("there is no G{value}"))
        .because("skipping it could change what the machine does")
        .help("remove it, or put it into a comment")
}

#[cold]
fn unknown_m(value: f64, span: Span) -> Box<Fault> {
    Fault::new(Code::UnknownMCode, span, format!("there is no M{value}"))
        .because("an unknown M code could have been meant to stop something")
        .help("remove it, or put it into a comment")
}

/// Codes that exist and are not supported, each with what it is.
#[cold]
fn refused_g(tenths: u32, value: f64, span: Span) -> Box<Fault> {
    let what = match tenths {
        50..=53 | 62 | 63 => "spline",
        70 => "lathe diameter mode",
        330 | 331 | 760 => "spindle-synchronised motion",
        382..=385 => "probing",
        410..=429 => "cutter radius compensation",
        430..=439 => "tool length offset",
        730 | 740 | 810..=890 => "canned cycle",
        950 => "feed per revolution",
        960 => "constant surface speed",
        _ => return unknown_g(value, span),
    };
    let message = format!("G{value} ({what}) is not supported");
    let help = match what {
        "lathe diameter mode" => "write X as a radius and remove G7",
        "cutter radius compensation" => "let the CAM system compensate, and remove G41 and G42",
        "tool length offset" => "let the CAM system or a work offset account for it",
        "canned cycle" => "write the moves out as G0 and G1",
        "feed per revolution" => "use feed per minute (G94)",
        _ => "remove it",
    };
    Fault::new(Code::NotSupported, span, message)
        .because("skipping it would make another motion than the program's")
        .help(help)
}
