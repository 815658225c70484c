//! Tests of every code of every other dialect: what is read, and that nothing is read in LinuxCNC's
//! meaning that its control does not have.

use glidepath_gcode::language::{Treatment, words};
use glidepath_gcode::{Dialect, Machine, Options, check};
use glidepath_geometry::Axis;

/// Words that only a machine with five axes has, and one that is of M29 alone.
const NEEDS_FIVE_AXES: [&str; 9] = [
    "G43.4", "G43.5", "G234", "G68.2", "G53.1", "G254", "TRAORI", "CYCLE800", "M29",
];

/// True for G110 to G129 of Haas and G510 to G599 of SINUMERIK.
fn is_system(name: &str) -> bool {
    let number = name
        .strip_prefix('G')
        .and_then(|digits| digits.parse().ok());
    matches!(number, Some(110..=129 | 510..=599))
}

/// The codes of the first finding, of a line alone.
fn code(dialect: Dialect, text: &str) -> Option<&'static str> {
    let options = Options {
        dialect,
        machine: Machine::new(&[Axis::X, Axis::Y, Axis::Z]),
        ..Options::default()
    };
    let report = check(text.as_bytes(), options);
    report.diagnostics.first().map(|found| found.code.as_str())
}

/// The numbers, times ten, whose code is not refused as unknown or as not made; `letter` is G or M.
fn read(dialect: Dialect, letter: char, most: u32) -> Vec<u32> {
    (0..=most)
        .filter(|tenths| {
            let (whole, tenth) = (tenths / 10, tenths % 10);
            let text = match tenth {
                0 => format!("{letter}{whole}\n"),
                tenth => format!("{letter}{whole}.{tenth}\n"),
            };
            let refused = ["unknown-g-code", "unknown-m-code", "not-supported"];
            !code(dialect, &text).is_some_and(|code| refused.contains(&code))
        })
        .collect()
}

#[test]
fn no_g_code_is_read_that_the_control_does_not_have() {
    // What LinuxCNC has and these have not, or have with another meaning.
    let only_linuxcnc = [
        52, 53, 61, 70, 71, 72, 171, 181, 191, 281, 301, 331, 382, 383, 384, 385, 411, 421, 431,
        432, 591, 592, 593, 611, 700, 711, 712, 721, 722, 901, 911, 922, 923,
    ];
    for dialect in [Dialect::Fanuc, Dialect::Siemens, Dialect::Marlin] {
        let read = read(dialect, 'G', 3_000);
        let wrong: Vec<_> = only_linuxcnc
            .iter()
            .filter(|code| read.contains(code))
            // Inches of SINUMERIK, holes on a circle of Haas.
            .filter(|code| **code != 700 || dialect == Dialect::Marlin)
            .collect();
        assert!(wrong.is_empty(), "{dialect}: {wrong:?}");
    }
    let marlin = read(Dialect::Marlin, 'G', 3_000);
    assert_eq!(
        marlin,
        [
            0, 10, 20, 30, 40, 50, 170, 180, 190, 200, 210, 280, 600, 610, 900, 910, 920
        ]
    );
    let siemens = read(Dialect::Siemens, 'G', 3_000);
    for code in [
        80, 100, 200, 210, 280, 430, 490, 520, 591, 730, 810, 920, 980,
    ] {
        assert!(!siemens.contains(&code), "G{}", code / 10);
    }
}

/// Every word of the tables does what its table says: what is refused is refused as not made, and
/// what is read is known.
#[test]
fn words_do_what_their_tables_say() {
    for dialect in [Dialect::Fanuc, Dialect::Siemens, Dialect::Marlin] {
        let all = words(dialect);
        assert!(all.len() > 40, "{dialect}");
        for word in all {
            // A name may want a value.
            let texts = [format!("{}\n", word.name), format!("{}=1\n", word.name)];
            let codes = texts.map(|text| code(dialect, &text));
            let is_unknown = |code: Option<&str>| {
                matches!(
                    code,
                    Some(
                        "not-supported"
                            | "unknown-g-code"
                            | "unknown-m-code"
                            | "unknown-subroutine"
                    )
                )
            };
            if ["M97", "M98", "M99"].contains(&word.name.as_str()) {
                // Calls in lines of their own.
                continue;
            }
            match word.treatment {
                Treatment::Refused(what, help) => {
                    assert!(
                        !what.is_empty() && !help.is_empty(),
                        "{dialect} {}",
                        word.name
                    );
                    assert!(is_unknown(codes[0]), "{dialect} {}: {codes:?}", word.name);
                }
                // Work offsets that the program has to set first.
                _ if is_system(&word.name) => {}
                // On this machine.
                _ if NEEDS_FIVE_AXES.contains(&word.name.as_str()) => {}
                _ => {
                    let is_read = !codes.iter().all(|code| is_unknown(*code));
                    assert!(is_read, "{dialect} {}: {codes:?}", word.name);
                }
            }
        }
    }
}

#[test]
fn m_codes_of_the_builder_are_refused() {
    for dialect in [Dialect::Fanuc, Dialect::Siemens, Dialect::Marlin] {
        for number in [48, 49, 50, 53, 61, 62, 64, 66, 68, 70, 72] {
            let found = code(dialect, &format!("M{number} P0\n"));
            assert!(found.is_some(), "M{number} in {dialect}");
        }
    }
    for number in [10, 20, 51, 88, 428] {
        let found = code(Dialect::Fanuc, &format!("M{number}\n"));
        assert!(
            matches!(found, Some("unknown-m-code" | "not-supported")),
            "M{number}"
        );
    }
}

#[test]
fn addresses_and_variables_are_those_of_the_control() {
    for (dialect, text) in [
        (Dialect::Fanuc, "G0 @5 ^30"),
        (Dialect::Fanuc, "#<name>=1"),
        (Dialect::Fanuc, "G64 P0.1"),
        (Dialect::Fanuc, "G2 X1 I1 P2 F100"),
        (Dialect::Fanuc, "G96 S100 D2000"),
        (Dialect::Fanuc, "G5.1 X1 Y1 I1 J1 F100"),
        (Dialect::Fanuc, "G8"),
        (Dialect::Marlin, "#1=2"),
        (Dialect::Marlin, "G0 @5 ^30"),
        (Dialect::Siemens, "#1=2"),
        (Dialect::Siemens, "G0 X1 (a comment)"),
        (Dialect::Siemens, "G64 P0.1"),
        (Dialect::Siemens, "G2 X1 Y1 R5 F100"),
        (Dialect::Siemens, "G4 P1"),
    ] {
        assert!(code(dialect, text).is_some(), "{dialect}: {text}");
    }
}

#[test]
fn texts_of_another_kind_are_one_finding() {
    let text = "0 BEGIN PGM TEST MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n2 TOOL CALL 1 Z S2000\n";
    for dialect in [Dialect::LinuxCnc, Dialect::Fanuc, Dialect::Siemens] {
        let options = Options {
            dialect,
            ..Options::default()
        };
        let report = check(text.as_bytes(), options);
        assert_eq!(report.diagnostics.len(), 1);
        assert!(report.diagnostics[0].message.contains("HEIDENHAIN"));
    }
}

#[test]
fn a_diagnostic_does_not_breed_others() {
    let found = |dialect, text: &str| {
        let travel = glidepath_gcode::AxisTravel {
            min: -100.0,
            max: 100.0,
        };
        let options = Options {
            dialect,
            machine: Machine::new(&[Axis::Y, Axis::Z]).with_travel(Axis::X, travel),
            ..Options::default()
        };
        let report = check(text.as_bytes(), options);
        report
            .diagnostics
            .iter()
            .map(|found| found.line)
            .collect::<Vec<_>>()
    };
    // Beyond the travel: the mode and the feed stay, and so does the place.
    assert_eq!(
        found(Dialect::LinuxCnc, "G1 X200 F100\nY5\nX50\nG2 X60 Y5 I5"),
        [1]
    );
    // A word that is not read leaves what stands in front of it; what stands behind is not known.
    assert_eq!(found(Dialect::LinuxCnc, "G1 F100 X1.2.3\nY5\nX50"), [1]);
    assert_eq!(
        found(
            Dialect::Siemens,
            "SOMETHING=3 G1 X5 F100\nY5\nG3 X0 Y5 I=AC(2)"
        ),
        [1]
    );
    assert_eq!(found(Dialect::Fanuc, "G90.1 G3 F100\nG1 X5\nX6"), [1]);
    // The words of a series of holes stand in its first block, whether that one is right or not.
    for first in [
        "G83 X5 Z6 R2 Q1 F100",
        "G83 X200 Z-6 R2 Q1 F100",
        "G83 X5 Z-6 R2 F100",
        "G83 X5 Z-6 R2 Q1 F1.2.3",
    ] {
        let text = format!("G90 G0 Z20\n{first}\nX10\nX20\nG80\nG1 F100 X1\nM2");
        assert_eq!(found(Dialect::LinuxCnc, &text), [2], "{first}");
    }
    let two = "G90 G0 Z20\nG83 X5 Z6 R2 Q1 F100\nX10\nG80\nG81 X5 Z-6\nX6\nM2";
    assert_eq!(found(Dialect::LinuxCnc, two), [2, 5]);
    // What is wrong by itself is told.
    assert_eq!(found(Dialect::LinuxCnc, "G1 X200 F100\nG2 X50 Y5"), [1, 2]);
}
