//! Tests of curve files: what they give, and what is wrong with wrong ones.

#![allow(clippy::unwrap_used, reason = "a test")]

use glidepath_curve::{ChordRule, CurveFile, NurbsFile};
use nalgebra::Vector3;

const PARAMETRIC: &str = "\
kind = \"parametric\"
x = \"20*(1 + cos(t))\"
y = \"20*sin(t)\"
z = \"40*sin(t/2)\"
from = 0
to = \"4*pi\"
feed = 3000.0
laps = 10
";

const IMPLICIT: &str = "\
kind = \"implicit\"
f = \"x^2 + y^2 + z^2 - 1600\"
g = \"(x - 20)^2 + y^2 - 400\"
start = [20.0, 20.0, 28.2843]
direction = [-1.0, 0.0, 0.0]
end = \"closed\"
tolerance = 0.05
chord = 0.4
laps = 10
";

fn diagnostic(text: &str) -> (String, String, String) {
    let diagnostics = CurveFile::parse(text).unwrap_err();
    let first = &diagnostics[0];
    let at = text.get(first.at.clone()).unwrap_or("?");
    (first.message.clone(), at.to_owned(), first.help.clone())
}

#[test]
fn both_kinds_give_the_same_laps() {
    let rule = ChordRule {
        longest_mm: 0.4,
        error_mm: 1e-3,
    };
    let mut laps = Vec::new();
    for text in [PARAMETRIC, IMPLICIT] {
        let file = CurveFile::parse(text).unwrap();
        let mut chords = file.chords(rule).unwrap();
        let start = *chords.point();
        let (mut length, mut back, mut last) = (0.0, 0, start);
        while let Some(chord) = chords.next_chord().unwrap() {
            assert!((chord.point - last).norm() <= 0.4 + 1e-9);
            length += chord.chord_mm;
            last = chord.point;
            back += u32::from((last - start).norm() < 1e-9);
        }
        // Once a lap; the parametric curve starts on its node and meets it in the middle of a lap
        // too.
        assert!(back >= 10, "{back}");
        assert!((last - start).norm() < 1e-9);
        laps.push(length);
    }
    assert!(
        (laps[0] - laps[1]).abs() < 0.1 && (laps[0] - 3056.1).abs() < 0.2,
        "{laps:?}"
    );
}

#[test]
fn findings_have_a_place_and_a_remedy() {
    let (message, at, _) = diagnostic(&PARAMETRIC.replace("sin(t/2)", "sin(u/2)"));
    assert_eq!((message.as_str(), at.as_str()), ("`u` is not known", "u"));
    let (message, at, _) = diagnostic(&PARAMETRIC.replace("feed = 3000.0", "feed = -1.0"));
    assert_eq!(at, "-1.0");
    assert!(message.contains("feed"));
    let (message, _, _) = diagnostic(&PARAMETRIC.replace("to = \"4*pi\"\n", ""));
    assert_eq!(message, "the key `to` is missing");
    let (_, at, _) = diagnostic(&PARAMETRIC.replace("4*pi", "pi"));
    assert_eq!(at, "10");
    let (_, at, _) = diagnostic(&PARAMETRIC.replace("4*pi", "4*py"));
    assert_eq!(at, "py");
    let (message, _, _) = diagnostic(&PARAMETRIC.replace("feed", "fead"));
    assert!(message.contains("fead"), "{message}");
    let (message, at, _) = diagnostic(&PARAMETRIC.replace("\"parametric\"", "\"spiral\""));
    assert!(message.contains("spiral") && at == "\"spiral\"");
    let (message, _, _) =
        diagnostic(&IMPLICIT.replace("kind = \"implicit\"", "kind = \"parametric\""));
    assert!(message.contains('f'), "{message}");
    let (message, at, help) = diagnostic(&IMPLICIT.replace("\"closed\"", "\"close\""));
    assert!(message.contains("end") && at == "\"close\"" && help.contains("closed"));
    let (_, at, _) = diagnostic(&IMPLICIT.replace("\"closed\"", "100.0"));
    assert_eq!(at, "10");
    assert_eq!(
        CurveFile::parse(&PARAMETRIC.replace("20*", "20 "))
            .unwrap_err()
            .len(),
        2
    );
}

#[test]
fn ends_may_be_points_or_lengths() {
    let rule = ChordRule {
        longest_mm: 0.4,
        error_mm: 1e-3,
    };
    let text = IMPLICIT.replace("laps = 10\n", "");
    for (end, want) in [
        ("[0.0, 0.0, 40.0]", Some(Vector3::new(0.0, 0.0, 40.0))),
        ("25.0", None),
    ] {
        let file = CurveFile::parse(&text.replace("\"closed\"", end)).unwrap();
        let mut chords = file.chords(rule).unwrap();
        let mut length = 0.0;
        while let Some(chord) = chords.next_chord().unwrap() {
            length += chord.chord_mm;
        }
        match want {
            Some(point) => assert!((chords.point() - point).norm() < 1e-6),
            None => assert!((length - 25.0).abs() < 1e-3),
        }
    }
}

const ARCH: &str = "kind = \"nurbs\"\nfeed = 3000.0\ndegree = 2\nknots = [0, 0, 0, 1, 1, 1]\n\
                    control_points = [[0.0, 0.0], [5.0, 10.0], [10.0, 0.0]]\n";

/// Nobody has to know with what the files are read.
#[test]
fn wrong_types_are_told_in_words_for_people() {
    let nurbs = |text: &str| NurbsFile::parse(text).unwrap_err().message;
    let formulas = |text: &str| diagnostic(text).0;
    let told = [
        formulas(&PARAMETRIC.replace("3000.0", "\"fast\"")),
        formulas(&PARAMETRIC.replace("from = 0", "from = true")),
        formulas(&PARAMETRIC.replace("\"20*sin(t)\"", "20")),
        formulas(&PARAMETRIC.replace("laps = 10", "laps = 1.5")),
        formulas(&PARAMETRIC.replace("\"parametric\"", "1")),
        formulas(&PARAMETRIC.replace("kind = \"parametric\"\n", "")),
        formulas(&PARAMETRIC.replace("feed", "fead")),
        formulas(&IMPLICIT.replace("[20.0, 20.0, 28.2843]", "[20.0, 20.0]")),
        formulas(&IMPLICIT.replace("[-1.0, 0.0, 0.0]", "-1.0")),
        formulas(&IMPLICIT.replace("\"closed\"", "true")),
        nurbs(&ARCH.replace("3000.0", "\"fast\"")),
        nurbs(&ARCH.replace("degree = 2", "degree = -1")),
        nurbs(&ARCH.replace("degree = 2", "degree = 2.5")),
        nurbs(&ARCH.replace("[0.0, 0.0]", "\"origin\"")),
        nurbs(&ARCH.replace("knots = [0, 0, 0, 1, 1, 1]\n", "")),
        nurbs(&ARCH.replace("\"nurbs\"", "\"nurb\"")),
        nurbs("{\"kind\": \"nurbs\", \"degree\": \"two\"}"),
    ];
    assert_eq!(
        told,
        [
            "this is text, not a number",
            "this is neither a number nor a formula in quotes",
            "this is a whole number, not text in quotes",
            "this is a number with a decimal point, not a whole number of its range",
            "this is a whole number, not text in quotes",
            "the key `kind` is missing",
            "unknown key `fead`",
            "this is a list of 2, not a list of three numbers",
            "this is a number with a decimal point, not a list of three numbers",
            "this is neither \"closed\", nor a point, nor a length",
            "this is text, not a number",
            "this is a negative number, not a whole number of its range",
            "this is a number with a decimal point, not a whole number of its range",
            "this is text, not a list",
            "the key `knots` is missing",
            "\"nurb\" is not known",
            "this is text, not a whole number of its range",
        ]
    );
}

/// What comes through a pipe has no name that tells what it is.
#[test]
fn curve_files_are_known_by_their_beginning() {
    let json = "{\"kind\": \"nurbs\"}";
    let arch = ARCH.replace("kind = \"nurbs\"\n", "");
    for text in [PARAMETRIC, IMPLICIT, ARCH, json, &arch] {
        assert!(CurveFile::begins(text), "{text}");
        let text = format!("# a curve\n\n  {text}");
        assert!(CurveFile::begins(&text), "{text}");
    }
    for text in [
        "",
        "%\nG21 G90\n",
        "#1 = 0\n#2 = 5\nG1 X1\n",
        "; kind = \"nurbs\"\nG21\n",
        "(name = x)\n",
        "FEED = 100\nG1 X10\n",
        "DEF REAL FROM\nFROM = 1\n",
        "R1 = 5\nX = R1\n",
        "o<kind> sub\n",
    ] {
        assert!(!CurveFile::begins(text), "{text}");
    }
}
