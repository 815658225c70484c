//! Tests of numbers without a decimal point that count least increments. Values are computed by hand.

use glidepath_gcode::{
    Dialect, FanucControl, FanucParameters, Machine, Options, PointInput, Program, check,
};
use glidepath_geometry::Axis;
use glidepath_program::ItemKind;

use crate::support::listed;

fn mill() -> Options {
    Options {
        dialect: Dialect::Fanuc,
        machine: Machine::new(&[Axis::X, Axis::Y, Axis::Z, Axis::A]),
        fanuc: FanucParameters {
            point: PointInput::Increment,
            ..FanucParameters::default()
        },
        ..Options::default()
    }
}

fn lathe() -> Options {
    let mut options = mill();
    options.machine = Machine::new(&[Axis::X, Axis::Z]);
    options.fanuc.control = Some(FanucControl::LatheA);
    options
}

/// Ends of moves on an X, Y, Z, A machine, to a micrometre.
fn ends(text: &str, options: Options) -> Vec<[f64; 4]> {
    Program::new(text.as_bytes(), options)
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, .. } => {
                let end = segment.end();
                Some([0, 1, 2, 3].map(|axis| (end[axis] * 1e3).round() / 1e3 + 0.0))
            }
            _ => None,
        })
        .collect()
}

fn last(text: &str) -> [f64; 4] {
    *ends(text, mill()).last().expect("a move")
}

#[track_caller]
fn finds(text: &str, options: Options, expected: &[&str]) {
    let report = check(text.as_bytes(), options);
    assert_eq!(listed(&report), expected, "{text}");
}

#[test]
fn lengths_count_in_the_units_of_their_block() {
    for text in [
        "G20 G0 X10000",
        "G0 X10000 G20",
        "G20\nG0 X10000",
        "G20 G92 X-10000\nG0 X0",
        "G20 G10 L2 P1 X10000\nG0 X0",
        "G20 G52 X10000\nG0 X0",
    ] {
        assert_eq!(last(text)[0], 25.4, "{text}");
    }
    assert_eq!(last("G20\nG21 G0 X10000")[0], 10.0);
    assert_eq!(
        ends("G20\nG0 X10000 Y10000\nG21 G91 G28 X5000", mill())[1][0],
        30.4
    );
    // The corner is where X is 10 mm, 2 mm are broken.
    for text in [
        "G20\nG21 G1 X10000 ,C2000 F600\nY10000",
        "G20\nG1 X10000 ,C2000 F600 G21\nY10000",
    ] {
        assert_eq!(ends(text, mill())[0][0], 8.0, "{text}");
    }
}

#[test]
fn angles_and_dwells_count_thousandths_in_inches_too() {
    assert_eq!(last("G20 G0 A90000")[3], 90.0);
    assert_eq!(last("G0 A90000")[3], 90.0);
    assert_eq!(last("G20\nG91 G0 A-45000\nA-45.")[3], -90.0);
    let inch = 25.4;
    let turned = [0.0, inch, 0.0, 0.0];
    assert_eq!(last("G20\nG68 X0 Y0 R90000\nG0 X10000 Y0"), turned);
    assert_eq!(last("G20\nG16 G0 X10000 Y90000"), turned);
    assert_eq!(last("G16 G0 X25400 Y90000"), turned);
    let dwell = |text: &str| {
        Program::new(text.as_bytes(), mill())
            .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
            .find_map(|item| match item.kind {
                ItemKind::Dwell(seconds) => Some((seconds * 1e6).round() / 1e6),
                _ => None,
            })
    };
    for text in ["G4 X1500", "G20\nG4 X1500", "G20 G4 X1.5", "G20\nG4 P1500"] {
        assert_eq!(dwell(text), Some(1.5), "{text}");
    }
}

#[test]
fn the_angle_of_a_line_counts_thousandths() {
    assert_eq!(last("G1 X10000 ,A45000 F600"), [10.0, 10.0, 0.0, 0.0]);
    assert_eq!(last("G1 X10000 ,A45. F600"), [10.0, 10.0, 0.0, 0.0]);
    assert_eq!(last("G20 G1 X10000 ,A45000 F60."), [25.4, 25.4, 0.0, 0.0]);
    // X is a diameter: 10 mm outwards at 135 degrees are 10 mm along Z.
    for word in [",A135000", "A135000", ",A135."] {
        let text = format!("G98 G0 X0 Z0\nG1 X20000 {word} F600");
        let ends = ends(&text, lathe());
        assert_eq!(ends.last(), Some(&[10.0, 0.0, -10.0, 0.0]), "{word}");
    }
    // C of a chamfer is a length.
    let ends = ends("G20\nG98 G0 X0 Z0\nG1 X20000 C1000 F60.\nZ-10000", lathe());
    assert_eq!(ends[0], [22.86, 0.0, 0.0, 0.0]);
}

#[test]
fn a_feed_without_a_point_is_plain_in_millimetres_per_minute_alone() {
    finds("G1 X10000 F2000", mill(), &[]);
    finds("G93 G1 X10000 F2000", mill(), &["1:15 ambiguous-word"]);
    finds("G93 G1 X10000 F2.", mill(), &[]);
    finds("G20\nG1 X10000 F1000", mill(), &["2:11 ambiguous-word"]);
    finds("G20 G1 X10000 F1000", mill(), &["1:15 ambiguous-word"]);
    finds("G20 G1 X10000 F10.", mill(), &[]);
    finds("G20\nG21 G1 X10000 F100", mill(), &[]);
    let head = "G97 S600 M3\n";
    finds(
        &format!("{head}G99 G1 Z-10000 F20"),
        lathe(),
        &["2:16 ambiguous-word"],
    );
    finds(&format!("{head}G98 G1 Z-10000 F20"), lathe(), &[]);
    finds(&format!("{head}G99 G1 Z-10000 F.2"), lathe(), &[]);
}

#[test]
fn r_of_repeated_passes_is_their_number() {
    let text = |passes: &str| {
        format!(
            "G98 G97 S600 M3\nG0 X62000 Z10000\nG73 U6000 W3000 {passes}\nG73 P10 Q20 U400 W100 F200\nN10 G0 X20000 Z2000\nG1 Z-20000 F100\nN20 X50000"
        )
    };
    assert_eq!(ends(&text("R3"), lathe()), ends(&text("R3."), lathe()));
}

/// Arguments of a macro without a point count the least increments of their letters: angles in inches, too.
#[test]
fn arguments_count_as_their_letters_do() {
    let called = |units: &str, arguments: &str, move_by: &str| {
        let text = format!("{units}\nG65 P9001 {arguments}\nM30\nO9001\nG21 G0 {move_by}\nM99");
        last(&text)
    };
    assert_eq!(
        called("G21", "X5000 A5000", "X#24 A#1"),
        [5.0, 0.0, 0.0, 5.0]
    );
    assert_eq!(
        called("G20", "X50000 A5000", "X#24 A#1"),
        [5.0, 0.0, 0.0, 5.0]
    );
    assert_eq!(
        called("G21", "F120 S300 D7", "X#9 Y#19 Z#7"),
        [120.0, 300.0, 7.0, 0.0]
    );
    finds(
        "G20\nG65 P9001 F120\nM30\nO9001\nM99",
        mill(),
        &["2:11 ambiguous-word"],
    );
    let calculator = Options {
        fanuc: FanucParameters {
            point: PointInput::Calculator,
            ..mill().fanuc
        },
        ..mill()
    };
    let text = "G20\nG65 P9001 X50 A5 F120\nM30\nO9001\nG21 G0 X#24 Y#9 A#1\nM99";
    assert_eq!(
        ends(text, calculator).last(),
        Some(&[50.0, 120.0, 0.0, 5.0])
    );
}
