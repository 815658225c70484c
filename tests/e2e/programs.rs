//! The programs that several tests execute.

/// About two seconds of motion: lines, corners, an arc, a dwell, an event.
pub(crate) const PROGRAM: &str = "\
G21 G90 G64 P0.02 F6000
G0 X10 Y10 Z1
G1 X40
G3 X50 Y20 I0 J10
G1 Y40 Z0
G4 P0.05
S1000 M3
G1 X30 Y35
X10 Y40
X0 Y0 Z0
M2
";

/// Back and forth for as long as any test needs.
pub(crate) fn long_program() -> String {
    let mut text = "G21 G90 F3000\n".to_owned();
    for _ in 0..200 {
        text.push_str("G1 X50 Y10\nX0 Y0\n");
    }
    text
}

/// A run whose setpoints are kept, and told of in an object.
pub(crate) fn recorded<'a>(program: &'a str, csv: &'a str) -> [&'a str; 6] {
    [
        "run",
        program,
        "--best-effort",
        "--setpoints",
        csv,
        "--json",
    ]
}
