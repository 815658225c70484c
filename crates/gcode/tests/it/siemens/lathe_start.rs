//! Tests of where programs of SINUMERIK's lathes begin: in G18, and with X as the configuration says.

use glidepath_gcode::{Dialect, LatheX, Machine, Options, Program, SiemensParameters, check};
use glidepath_geometry::{Axis, Segment};
use glidepath_program::ItemKind;

use super::options;

fn lathe(lathe_x: LatheX) -> Options {
    Options {
        machine: Machine::new(&[Axis::X, Axis::Z]),
        siemens: SiemensParameters {
            lathe_x,
            ..SiemensParameters::default()
        },
        ..options()
    }
}

/// X and Z of the ends of the moves, and the program behind them.
fn read(text: &str, options: Options) -> (Vec<[f64; 2]>, Program<&[u8]>) {
    let mut program = Program::new(text.as_bytes(), options);
    let mut ends = Vec::new();
    for item in program.by_ref() {
        let item = item.unwrap_or_else(|d| panic!("{text}\n{d}"));
        if let ItemKind::Move { segment, .. } = item.kind {
            ends.push([0, 2].map(|axis| (segment.end()[axis] * 1e6).round() / 1e6 + 0.0));
        }
    }
    (ends, program)
}

fn xs(text: &str, lathe_x: LatheX) -> Vec<f64> {
    let (ends, _) = read(text, lathe(lathe_x));
    ends.into_iter().map(|[x, _]| x).collect()
}

#[test]
fn a_lathe_begins_in_g18() {
    let text = "G0 X20 Z-10\nG3 X30 Z-15 CR=5";
    let (ends, _) = read(text, lathe(LatheX::Diameter));
    assert_eq!(ends, [[10.0, -10.0], [15.0, -15.0]]);
    let (ends, _) = read("G0 X20 Z-10\nG3 X30 Z-20 CR=10", lathe(LatheX::Unsaid));
    assert_eq!(ends, [[20.0, -10.0], [30.0, -20.0]]);
    // A quarter of a circle about X 10, Z -15, whose radius is no diameter.
    let arc = Program::new(text.as_bytes(), lathe(LatheX::Diameter))
        .filter_map(Result::ok)
        .find_map(|item| match item.kind {
            ItemKind::Move {
                segment: Segment::Arc(arc),
                ..
            } => Some(arc),
            _ => None,
        })
        .expect("an arc");
    assert!((arc.sweep_rad.abs() - std::f64::consts::FRAC_PI_2).abs() < 1e-9);
}

#[test]
fn an_x_that_nothing_says_is_told() {
    let lacks = |text: &str, options: Options| check(text.as_bytes(), options).lacks.diameter;
    let text = "G0 X20 Z2\nM30\n";
    assert!(lacks(text, lathe(LatheX::Unsaid)));
    for said in [LatheX::Diameter, LatheX::Radius, LatheX::DiameterInG90] {
        assert!(!lacks(text, lathe(said)), "{said:?}");
    }
    for word in ["DIAMON", "DIAMOF", "DIAM90"] {
        let text = format!("{word}\n{text}");
        assert!(!lacks(&text, lathe(LatheX::Unsaid)), "{text}");
    }
    assert!(!lacks(text, options()), "a mill has no diameters");
}

#[test]
fn the_configuration_says_what_x_is_and_the_program_goes_on_to_say_it() {
    let text = "G0 X20 Z0\nG91 X10\nG90 DIAMOF X22\nDIAMON X20\nDIAM90 X30\nG91 X1";
    let behind = [22.0, 10.0, 15.0, 16.0];
    for (lathe_x, first) in [
        (LatheX::Diameter, [10.0, 15.0]),
        (LatheX::Radius, [20.0, 30.0]),
        (LatheX::DiameterInG90, [10.0, 20.0]),
    ] {
        assert_eq!(
            xs(text, lathe_x),
            [&first[..], &behind].concat(),
            "{lathe_x:?}"
        );
    }
}

#[test]
fn the_next_program_begins_as_the_first_one() {
    let goes_on = |first: &str, lathe_x: LatheX, dialect: Dialect, text: &str| {
        let (_, program) = read(first, lathe(lathe_x));
        let next = Options {
            in_force: Some(program.in_force()),
            dialect,
            ..lathe(lathe_x)
        };
        read(text, next).0
    };
    let arc = "G0 X20 Z-10\nG3 X30 Z-15 CR=5";
    let diameters = [[10.0, -10.0], [15.0, -15.0]];
    for end in ["M30", "M2"] {
        for first in ["DIAMOF", "DIAM90 G91", "G17", "DIAMON"] {
            let first = format!("{first}\n{end}");
            let ends = goes_on(&first, LatheX::Diameter, Dialect::Siemens, arc);
            assert_eq!(ends, diameters, "{first}");
        }
    }
    // One that was stopped leaves no radii either.
    let ends = goes_on("DIAMOF\nG0 X1", LatheX::Diameter, Dialect::Siemens, arc);
    assert_eq!(ends, diameters);
    let text = "G0 X20 Z-10\nG91 X10";
    let ends = goes_on("DIAMON\nM30", LatheX::DiameterInG90, Dialect::Siemens, text);
    assert_eq!(ends, [[10.0, -10.0], [20.0, -10.0]]);
    // LinuxCNC's language has its own, G17 and radii, also behind such a program.
    let linuxcnc = "G0 X20 Z-10\nG18 G3 X30 Z-20 I0 K-10 F100";
    let ends = goes_on("G0 X5\nM30", LatheX::Diameter, Dialect::LinuxCnc, linuxcnc);
    assert_eq!(ends, [[20.0, -10.0], [30.0, -20.0]]);
    let (_, program) = read("G0 X5\nM30", lathe(LatheX::Diameter));
    let next = Options {
        in_force: Some(program.in_force()),
        dialect: Dialect::LinuxCnc,
        ..lathe(LatheX::Diameter)
    };
    let mut refused = Program::new(&b"G0 X20 Z-10\nG3 X30 Z-20 I0 K-10 F100"[..], next);
    assert!(refused.any(|item| item.is_err()), "it is in G17");
    // And the other way round.
    let before = Options {
        dialect: Dialect::LinuxCnc,
        ..lathe(LatheX::Radius)
    };
    let (_, program) = read("G17 G8\nG0 X1\nM2", before);
    let next = Options {
        in_force: Some(program.in_force()),
        ..lathe(LatheX::Radius)
    };
    let text = "G0 X20 Z-10\nG3 X30 Z-20 CR=10";
    assert_eq!(read(text, next).0, [[20.0, -10.0], [30.0, -20.0]]);
}

#[test]
fn what_was_typed_stays_in_force_for_the_next_line() {
    let after = |typed: &str, text: &str| {
        let text_of = format!("{typed}\n");
        let mut program = Program::new(text_of.as_bytes(), lathe(LatheX::Unsaid)).typed();
        assert!(program.by_ref().all(|item| item.is_ok()), "{typed}");
        let next = Options {
            in_force: Some(program.in_force()),
            ..lathe(LatheX::Unsaid)
        };
        let (ends, _) = read(text, next);
        ends.into_iter().map(|[x, _]| x).collect::<Vec<_>>()
    };
    assert_eq!(after("DIAMON", "G0 X20"), [10.0]);
    assert_eq!(after("DIAM90", "G0 X20\nG91 X5"), [10.0, 15.0]);
    assert_eq!(after("DIAMOF", "G0 X20"), [20.0]);
    assert_eq!(after("DIAMON\nM30", "G0 X20"), [20.0]);
}

fn near(text: &str, expected: [f64; 2]) {
    let (ends, _) = read(text, lathe(LatheX::Diameter));
    let end = ends.last().expect("a move");
    let off = (end[0] - expected[0]).hypot(end[1] - expected[1]);
    assert!(off < 1e-3, "{text}: {end:?}");
}

/// The control's manual has both as the same arc ("Example 2: Turning", arcs by their angle).
#[test]
fn a_centre_at_a_place_is_at_a_diameter() {
    let by = |centre: &str| format!("G0 X40 Z-25\nG3 AR=135.944 {centre} F100");
    let (ends, _) = read(&by("I-3.335 K-29.25"), lathe(LatheX::Diameter));
    let end = ends[1];
    assert!((end[0] - 34.61).abs() < 0.01, "{end:?}");
    near(&by("I=AC(33.33) K=AC(-54.25)"), end);
    near(&format!("DIAM90\n{}", by("I=AC(33.33) K=AC(-54.25)")), end);
    near(&format!("DIAM90\n{}", by("I=IC(-3.335) K=IC(-29.25)")), end);
    let radii = "DIAMOF\nG0 X20 Z-25\nG3 AR=135.944 I=AC(16.665) K=AC(-54.25) F100";
    near(radii, end);
}

/// An arc of 2.5 mm over a chord of 20.
#[test]
fn a_point_on_the_way_is_at_a_diameter() {
    let radius_mm: f64 = 20.0 * 20.0 / (8.0 * 2.5) + 2.5 / 2.0;
    let expected = 2.0 * radius_mm * (10.0 / radius_mm).asin();
    for via in ["K1=40 I1=45", "K1=AC(40) I1=AC(45)", "K1=IC(10) I1=IC(2.5)"] {
        let text = format!("G0 Z30 X40\nG95 M3 S100 F0.1\nCIP Z50 X40 {via}");
        let items = Program::new(text.as_bytes(), lathe(LatheX::Diameter));
        let lengths =
            items.filter_map(
                |item| match item.unwrap_or_else(|d| panic!("{text}\n{d}")).kind {
                    ItemKind::Move { segment, .. } => Some(segment.length()),
                    _ => None,
                },
            );
        let found: f64 = lengths.skip(1).sum();
        assert!(
            (found - expected).abs() < 1e-3,
            "{via}: {found}, {expected}"
        );
    }
}

#[test]
fn a_pole_is_at_a_diameter() {
    near(
        "G0 X50 Z-15\nG111 X50 Z-25\nG1 RP=10 AP=90 F100",
        [35.0, -25.0],
    );
    let found = check("G0 X50 Z-15\nG110 X2\n".as_bytes(), lathe(LatheX::Diameter));
    assert_eq!(
        crate::support::listed(&found),
        ["2:6 polar"],
        "a radius or a diameter"
    );
}
