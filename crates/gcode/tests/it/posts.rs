//! Tests with one part, written as the posts of CAM systems write it for each control: every text
//! is read, and is the same motion. The right values come from the part, not from any text.
//!
//! A part is a tool (its length), a work offset, holes and contours. Texts have the headers, tool
//! changes, safe moves and ends that posts write: those of an Autodesk-like post for FANUC, Haas and
//! SINUMERIK, of an NX-like one for SINUMERIK, of FreeCAD and Vectric for LinuxCNC, of a shop's macro
//! program, and of a lathe's post for system A.

use std::fmt::Write;
use std::sync::Arc;

use glidepath_gcode::{Connections, Dialect, Machine, Options, Program, Tool, ToolTable, check};
use glidepath_geometry::Axis;
use glidepath_program::{ItemKind, Rate};

use crate::support::listed;

/// Lengths of tools 1 to 4, mm.
const LENGTHS: [f64; 4] = [80.0, 62.5, 101.25, 55.0];
/// Parts that are made.
const PARTS: u64 = 30;

/// A move of a contour, in the plane.
#[derive(Clone, Copy)]
enum Cut {
    Line([f64; 2]),
    /// End, centre, and whether it goes clockwise.
    Arc([f64; 2], [f64; 2], bool),
}

struct Part {
    tool: usize,
    zero: [f64; 3],
    holes: Vec<[f64; 2]>,
    depth: f64,
    start: [f64; 2],
    cuts: Vec<Cut>,
}

/// Numbers that depend on the seed alone.
struct Seeded(u64);

impl Seeded {
    /// A number between two, in hundredths.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let share =
            f64::from(u32::try_from(self.0 >> 40).expect("24 bits")) / f64::from(1_u32 << 24);
        ((low + share * (high - low)) * 100.0).round() / 100.0
    }
}

impl Part {
    fn new(seed: u64) -> Self {
        let mut random = Seeded(seed);
        for _ in 0..4 {
            random.between(0.0, 1.0);
        }
        let point =
            |random: &mut Seeded| [random.between(-60.0, 60.0), random.between(-60.0, 60.0)];
        let start = point(&mut random);
        let (mut at, mut cuts) = (start, Vec::new());
        for index in 0..6 {
            let to = point(&mut random);
            if index % 2 == 0 {
                cuts.push(Cut::Line(to));
                at = to;
                continue;
            }
            // A half circle about the middle of both: its radius is exact enough in any format.
            let center = [(at[0] + to[0]) / 2.0, (at[1] + to[1]) / 2.0];
            cuts.push(Cut::Arc(to, center, index % 4 == 1));
            at = to;
        }
        Self {
            tool: usize::try_from(seed % 4).expect("small"),
            zero: [
                random.between(-50.0, 50.0),
                random.between(-50.0, 50.0),
                -20.0,
            ],
            holes: (0..3).map(|_| point(&mut random)).collect(),
            depth: random.between(-15.0, -2.0),
            start,
            cuts,
        }
    }

    fn length(&self) -> f64 {
        LENGTHS[self.tool]
    }

    /// Machine coordinates of a place of the part.
    fn at(&self, place: [f64; 2], z: f64) -> [f64; 3] {
        [
            place[0] + self.zero[0],
            place[1] + self.zero[1],
            z + self.zero[2] + self.length(),
        ]
    }

    /// Ends of the moves at feed, machine coordinates, and the length of each.
    fn right(&self) -> Vec<([f64; 3], f64)> {
        let mut moves: Vec<([f64; 3], f64)> = self
            .holes
            .iter()
            .map(|hole| (self.at(*hole, self.depth), 2.0 - self.depth))
            .collect();
        moves.push((self.at(self.start, self.depth), 2.0 - self.depth));
        let mut at = self.start;
        for cut in &self.cuts {
            let (to, length) = match *cut {
                Cut::Line(to) => (to, (to[0] - at[0]).hypot(to[1] - at[1])),
                Cut::Arc(to, center, _) => {
                    let radius = (at[0] - center[0]).hypot(at[1] - center[1]);
                    (to, std::f64::consts::PI * radius)
                }
            };
            moves.push((self.at(to, self.depth), length));
            at = to;
        }
        moves
    }

    /// The contour in G1, G2 and G3 with I and J, a point in every number.
    fn contour(&self, feed: &str) -> String {
        let mut text = String::new();
        let mut at = self.start;
        for cut in &self.cuts {
            let _ = match *cut {
                Cut::Line(to) => writeln!(text, "G1 X{:.3} Y{:.3} {feed}", to[0], to[1]),
                Cut::Arc(to, center, clockwise) => {
                    let code = if clockwise { "G2" } else { "G3" };
                    let (i, j) = (center[0] - at[0], center[1] - at[1]);
                    writeln!(
                        text,
                        "{code} X{:.3} Y{:.3} I{i:.4} J{j:.4} {feed}",
                        to[0], to[1]
                    )
                }
            };
            at = match *cut {
                Cut::Line(to) | Cut::Arc(to, ..) => to,
            };
        }
        text
    }

    /// FANUC, as an Autodesk-like post writes it; Haas where it is.
    fn fanuc(&self, haas: bool) -> String {
        let (tool, [x, y, z]) = (self.tool + 1, self.zero);
        let mut text = format!(
            "%\nO01001 (PART - (REV B))\n(T{tool} D=6. CR=0. - ZMIN={:.3} - FLAT END MILL)\nG90 G94 G17 G49 G40 G80\nG21\n",
            self.depth
        );
        text += if haas {
            "G53 G0 Z0.\n(2D CONTOUR1)\n"
        } else {
            "G28 G91 Z0.\nG90\n(2D CONTOUR1)\n"
        };
        text += &format!("T{tool} M6\nG10 L2 P1 X{x:.3} Y{y:.3} Z{z:.3}\nS5000 M3\nG54\nM8\n");
        let [hx, hy] = self.holes[0];
        text += &format!("G0 X{hx:.3} Y{hy:.3}\nG43 Z15. H{tool:02}\n");
        text += if haas { "G187 P2\n" } else { "G05.1 Q1\n" };
        text += &format!("G98 G81 X{hx:.3} Y{hy:.3} Z{:.3} R2. F300.\n", self.depth);
        for [x, y] in &self.holes[1..] {
            text += &format!("X{x:.3} Y{y:.3}\n");
        }
        let [sx, sy] = self.start;
        text += &format!(
            "G80\nG0 X{sx:.3} Y{sy:.3}\nZ2.\nG1 Z{:.3} F100.\n",
            self.depth
        );
        text += &self.contour("F600.");
        text += "G0 Z15.\n";
        text += if haas {
            "G187\nM9\nM5\nG53 G0 Z0.\nM30\n%\n"
        } else {
            "G05.1 Q0\nM9\nM5\nG28 G91 Z0.\nG28 X0. Y0.\nG90\nM30\n%\n"
        };
        text
    }

    /// A shop's program: holes in a table of variables, a macro for each, the contour in a subprogram.
    fn macros(&self) -> String {
        let (tool, [x, y, z]) = (self.tool + 1, self.zero);
        let mut text = format!(
            "%\nO2000\nG21 G17 G90 G40 G80 G49\nT{tool} M6\n#5221={x:.3}\n#5222={y:.3}\n#5223={z:.3}\nG54 G0 G43 H{tool} Z15. M3 S2000\n"
        );
        for (index, [x, y]) in self.holes.iter().enumerate() {
            text += &format!("#{}={x:.3}\n#{}={y:.3}\n", 100 + 2 * index, 101 + 2 * index);
        }
        text += &format!(
            "#20=0\nWHILE[#20LT3]DO1\nG65 P9010 X#[100+2*#20] Y#[101+2*#20] Z{:.3} R2. F300.\n#20=#20+1\nEND1\n",
            self.depth
        );
        let [sx, sy] = self.start;
        text += &format!(
            "G0 X{sx:.3} Y{sy:.3}\nZ2.\nG1 Z{:.3} F100.\nM98 P9020\nG0 Z15.\nG49 M5\nM30\n",
            self.depth
        );
        text +=
            "O9010 (HOLE)\nIF[#26EQ#0]GOTO9\nG0 X#24 Y#25\nZ#18\nG1 Z#26 F#9\nG0 Z15.\nN9 M99\n";
        text += &format!("O9020\n{}M99\n%\n", self.contour("F600."));
        text
    }

    /// SINUMERIK, as an Autodesk-like post writes it.
    fn siemens(&self) -> String {
        let (tool, [x, y, z]) = (self.tool + 1, self.zero);
        let mut text = format!(
            "%_N_1001_MPF\n; PART\nN10 G90 G94\nN11 G71\nN12 G64\nN13 G17\nN14 G0 SUPA Z0 D0\nWORKPIECE(,\"\",,\"BOX\",112,0,-51,,50,25,-50,-25)\nN15 MSG(\"DRILL; (1)\")\nN16 T={tool}\nN17 M6\nN18 S5000 M3\nN19 G54\nN20 TRANS X{x:.3} Y{y:.3} Z{z:.3}\nN21 CYCLE800()\nN22 M8\n"
        );
        let [hx, hy] = self.holes[0];
        text += &format!(
            "N23 G0 X{hx:.3} Y{hy:.3}\nN24 G0 Z15 D1\nN25 F300\nN26 MCALL CYCLE81(15,0,2,{:.3},,0,0,10)\n",
            self.depth
        );
        for [x, y] in &self.holes {
            text += &format!("X{x:.3} Y{y:.3}\n");
        }
        let [sx, sy] = self.start;
        text += &format!(
            "MCALL\nCYCLE832(0.01,1,1)\nG0 X{sx:.3} Y{sy:.3}\nZ2\nG1 Z{:.3} F100\n",
            self.depth
        );
        let mut at = self.start;
        for cut in &self.cuts {
            match *cut {
                Cut::Line(to) => {
                    text += &format!("G1 X{:.3} Y{:.3} F600\n", to[0], to[1]);
                    at = to;
                }
                Cut::Arc(to, center, clockwise) => {
                    let code = if clockwise { "G2" } else { "G3" };
                    // Every other arc by its absolute centre.
                    if clockwise {
                        text += &format!(
                            "{code} X{:.3} Y{:.3} I=AC({:.4}) J=AC({:.4})\n",
                            to[0], to[1], center[0], center[1]
                        );
                    } else {
                        text += &format!(
                            "{code} X{:.3} Y{:.3} I{:.4} J{:.4}\n",
                            to[0],
                            to[1],
                            center[0] - at[0],
                            center[1] - at[1]
                        );
                    }
                    at = to;
                }
            }
        }
        text += "CYCLE832()\nG0 Z15\nM9\nM5\nTRANS\nG0 SUPA Z0 D0\nG0 SUPA X0 Y0\nM30\n";
        text
    }

    /// SINUMERIK, as an NX-like post writes it: modes first, variables, a subprogram behind it.
    fn siemens_by_variables(&self) -> String {
        let (tool, [x, y, z]) = (self.tool + 1, self.zero);
        let mut text = format!(
            ";Start of Program\n;PART NAME : part.prt\nDEF REAL _X_HOME, _Y_HOME, _Z_HOME\nDEF REAL HX[3], HY[3]\nDEF INT NN\nN10 G40 G17 G710 G94 G90 G60 G601 FNORM\nN20 TRAFOOF\nN30 _X_HOME=0. _Y_HOME=0. _Z_HOME=0.\nN40 G0 SUPA Z=_Z_HOME D0\nN50 T{tool}\nN60 M6\nN70 G500 D1\nN80 TRANS X{x:.3} Y{y:.3}\nN90 ATRANS Z{z:.3}\nCOMPOF\nSOFT FFWON G64\nS3000 M3 M8\n"
        );
        let list = |axis: usize| {
            let all: Vec<String> = self
                .holes
                .iter()
                .map(|hole| format!("{:.3}", hole[axis]))
                .collect();
            all.join(",")
        };
        text += &format!(
            "HX=SET({})\nHY=SET({})\nR1={:.3}\nG0 Z15\nFOR NN=0 TO 2\nG0 X=HX[NN] Y=HY[NN]\nL90 P1\nENDFOR\n",
            list(0),
            list(1),
            self.depth
        );
        let [sx, sy] = self.start;
        text += &format!(
            "G0 X{sx:.3} Y{sy:.3}\nZ2\nG1 Z=R1 F100\n{}G0 Z15\nM5 M9\nM30\n",
            self.contour("F600")
        );
        text += "%_N_L90_SPF\nG0 Z2\nG1 Z=R1 F300\nG0 Z15\nM17\n";
        text
    }

    /// LinuxCNC, as FreeCAD's post writes it.
    fn linuxcnc(&self) -> String {
        let (tool, [x, y, z]) = (self.tool + 1, self.zero);
        let mut text = format!(
            "(Exported by FreeCAD)\n(Post Processor: linuxcnc_post)\n(begin preamble)\nG17 G54 G40 G49 G80 G90\nG21\nG10 L2 P1 X{x:.3} Y{y:.3} Z{z:.3}\n(begin toolchange)\nM5\nM6 T{tool}\nG43 H{tool}\nM3 S5000\n"
        );
        let [hx, hy] = self.holes[0];
        text += &format!("G0 Z15.000\nG0 X{hx:.3} Y{hy:.3}\nG98\n");
        for [x, y] in &self.holes {
            text += &format!("G81 F300.000 R2.000 X{x:.3} Y{y:.3} Z{:.3}\n", self.depth);
        }
        let [sx, sy] = self.start;
        text += &format!(
            "G80\nG0 X{sx:.3} Y{sy:.3}\nG0 Z2.000\nG1 F100.000 Z{:.3}\n{}G0 Z15.000\nM5\nG17 G54 G90 G80 G40\nM2\n",
            self.depth,
            self.contour("F600.000")
        );
        text
    }

    /// LinuxCNC, as a Vectric-like post writes it: no tool table, so no G43.
    fn vectric(&self) -> String {
        let [x, y, z] = self.zero;
        let z = z + self.length();
        let mut text = format!(
            "( part )\n( File created: 1 )\nG00G21G17G90G40G49G80\nG52X{x:.3}Y{y:.3}Z{z:.3}\nG71G91.1\n"
        );
        // Vectric writes G71 for millimetres, which is a lathe cycle here: its LinuxCNC posts do not.
        text = text.replace("G71G91.1", "G91.1");
        text += "T1M06\nG00Z15.000S12000M03\nG94\n";
        for [x, y] in &self.holes {
            text += &format!(
                "X{x:.3}Y{y:.3}\nZ2.000\nG1Z{:.3}F300.0\nG00Z15.000\n",
                self.depth
            );
        }
        let [sx, sy] = self.start;
        text += &format!(
            "X{sx:.3}Y{sy:.3}F600.0\nZ2.000\nG1Z{:.3}F100.0\n{}G00Z15.000\nM09\nM30\n",
            self.depth,
            self.contour("F600.0")
        );
        text
    }
}

fn options(dialect: Dialect, with_tools: bool) -> Options {
    let mut tools = ToolTable::new();
    for (index, length) in LENGTHS.into_iter().enumerate() {
        let mut tool = Tool {
            diameter_mm: 6.0,
            ..Tool::default()
        };
        tool.offset[2] = length;
        tools.set(u32::try_from(index + 1).expect("small"), tool);
    }
    Options {
        dialect,
        connections: Connections::Simulated,
        tools: with_tools.then(|| Arc::new(tools)),
        machine: Machine::new(&[Axis::X, Axis::Y, Axis::Z]),
        ..Options::default()
    }
}

/// Ends and lengths of the moves at feed.
fn made(text: &str, options: Options) -> Vec<([f64; 3], f64)> {
    Program::new(text.as_bytes(), options)
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, rate, .. } if rate != Rate::Rapid => {
                let end = segment.end();
                Some(([end[0], end[1], end[2]], segment.length()))
            }
            _ => None,
        })
        .collect()
}

/// The seven texts of a part, each with its dialect and whether its tools have lengths.
fn texts(part: &Part) -> [(&'static str, Dialect, bool, String); 7] {
    [
        ("fanuc", Dialect::Fanuc, true, part.fanuc(false)),
        ("haas", Dialect::Fanuc, true, part.fanuc(true)),
        ("macros", Dialect::Fanuc, true, part.macros()),
        ("siemens", Dialect::Siemens, true, part.siemens()),
        (
            "siemens-variables",
            Dialect::Siemens,
            true,
            part.siemens_by_variables(),
        ),
        ("linuxcnc", Dialect::LinuxCnc, true, part.linuxcnc()),
        ("vectric", Dialect::LinuxCnc, false, part.vectric()),
    ]
}

#[test]
fn every_post_writes_the_same_part() {
    for seed in 0..PARTS {
        let part = Part::new(seed);
        let right = part.right();
        for (post, dialect, with_tools, text) in texts(&part) {
            let told = Dialect::detect(text.as_bytes(), &Machine::unlimited()).dialect;
            let is_sure = told == dialect || told == Dialect::LinuxCnc;
            assert!(is_sure, "{post} is taken for {told}");
            let report = check(text.as_bytes(), options(dialect, with_tools));
            assert!(
                report.diagnostics.is_empty(),
                "{post}:\n{text}\n{:?}",
                report.diagnostics
            );
            let made = made(&text, options(dialect, with_tools));
            assert_eq!(made.len(), right.len(), "{post}:\n{text}");
            for ((end, length), (right_end, right_length)) in made.iter().zip(&right) {
                let far = (0..3)
                    .map(|i| (end[i] - right_end[i]).abs())
                    .fold(0.0, f64::max);
                assert!(far < 1e-6, "{post}: {end:?}, right {right_end:?}\n{text}");
                assert!(
                    (length - right_length).abs() < 2e-3,
                    "{post}: {length} {right_length}\n{text}"
                );
            }
        }
    }
}

/// A shaft, as a lathe's post writes it for FANUC's system A and for Haas: diameters, T0101, G50 S, G71 in
/// two blocks and in one. The finished profile is the same.
#[test]
fn lathe_posts_write_the_same_shaft() {
    let profile = "N10 G0 X20.\nN20 G1 Z-20. F0.15\nN30 X30. Z-30.\nN40 Z-45.\nN50 X44.\n";
    let head = "%\nO1001\n(SHAFT)\nG28 U0.\nG28 W0.\nG50 S3000\nT0101\nG99\nG97 S800 M3\nG54\nM8\nG0 X46. Z2.\nG96 S180\n";
    let tail = "G70 P10 Q50\nG97 S800\nM9\nG28 U0. W0.\nM5\nM30\n%\n";
    let two = format!("{head}G71 U2. R0.5\nG71 P10 Q50 U0.4 W0.1 F0.25\n{profile}{tail}");
    let one = format!("{head}G71 P10 Q50 U0.4 W0.1 D2. F0.25\n{profile}{tail}");
    let mut tools = ToolTable::new();
    tools.set(1, Tool::default());
    let options = Options {
        dialect: Dialect::Fanuc,
        connections: Connections::Simulated,
        tools: Some(Arc::new(tools)),
        machine: Machine::new(&[Axis::X, Axis::Z]),
        ..Options::default()
    };
    for text in [two, one] {
        let report = check(text.as_bytes(), options.clone());
        assert!(
            report.diagnostics.is_empty(),
            "{text}\n{:?}",
            report.diagnostics
        );
        let ends: Vec<[f64; 2]> = made(&text, options.clone())
            .into_iter()
            .map(|([x, _, z], _)| [x, z])
            .collect();
        let finish = [[10.0, -20.0], [15.0, -30.0], [15.0, -45.0], [22.0, -45.0]];
        let near = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-6;
        // On the way of a move the speed of the spindle changes, and its feed with it.
        let mut left = ends.iter();
        let found = finish.iter().all(|place| left.any(|end| near(end, place)));
        assert!(found, "{text}\n{ends:?}");
    }
}

/// What Vectric's posts for Mach2 and Mach3 begin with.
#[test]
fn g70_and_g71_beside_g91_1_are_units_that_are_in_force() {
    let program = |first: &str, second: &str| {
        format!(
            "{first}\n{second}\nT1M06\nG00Z5.0000\nX1.0Y1.0\nG2X3.0Y1.0I1.0J0.0F100.0\nG1X5.\nM30\n"
        )
    };
    let options = Options {
        connections: Connections::Simulated,
        ..Options::default()
    };
    let found = |text: &str| listed(&check(text.as_bytes(), options.clone()));
    let none = Vec::<String>::new();
    let (mm, inch) = ("G00G21G17G90G40G49G80", "G00G20G17G90G40G49G80");
    assert_eq!(found(&program(mm, "G71G91.1")), none);
    assert_eq!(found(&program(inch, "G70G91.1")), none);
    assert_eq!(found(&program(inch, "N20 G91.1 G70")), none);
    assert_eq!(found(&program(mm, "G70G91.1")), ["2:1 ambiguous-word"]);
    assert_eq!(found(&program(inch, "G71G91.1")), ["2:1 ambiguous-word"]);
    // Alone, and with words of a cycle, they are a lathe's.
    assert_eq!(found("G21\nG71\nM30")[0], "2:1 missing-word");
    assert_ne!(found("G21\nG71 G91.1 Q100 D1\nM30"), none);
}
