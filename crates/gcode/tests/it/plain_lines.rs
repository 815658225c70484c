//! Tests of plain lines, which are read and executed in a way of their own: with the same outcome
//! as any other line. An empty comment makes a line one that is read as any other, and an assignment
//! that nothing reads one that is executed so, too.

use std::io::BufReader;
use std::path::{Path, PathBuf};

use glidepath_gcode::{
    AxisTravel, Connections, Diagnostic, LoopLimits, Machine, Options, Program, Report, check,
    diagnostics,
};
use glidepath_geometry::Axis;
use glidepath_program::Item;
use glidepath_testing::corpus;
use proptest::prelude::*;

/// A machine with some axes, some of them limited.
fn options() -> Options {
    let travel = AxisTravel {
        min: -100.0,
        max: 100.0,
    };
    let axes = [Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::U];
    Options {
        machine: Machine::new(&axes)
            .with_travel(Axis::X, travel)
            .with_travel(Axis::Z, travel),
        connections: Connections::Simulated,
        ..Options::default()
    }
}

/// The same program with something behind every line of letters and numbers of which this is said.
fn with_behind(text: &str, behind: &str, is_wanted: fn(&str) -> bool) -> String {
    let is_plain = |line: &str| {
        line.bytes()
            .all(|b| b.is_ascii_alphanumeric() || b" \t.+-".contains(&b))
    };
    text.split_inclusive('\n')
        .map(|line| {
            let body = line.trim_end_matches(['\r', '\n']);
            let is_changed = is_plain(body) && is_wanted(body);
            let behind = if is_changed { behind } else { "" };
            format!("{body}{behind}{}", &line[body.len()..])
        })
        .collect()
}

/// The same program without a line that is read as a plain one.
fn commented(text: &str) -> String {
    with_behind(text, "()", |_| true)
}

/// The same program without a line that is executed as a plain one.
fn assigning(text: &str) -> String {
    with_behind(text, "#31=0", |line| {
        let is_word = |b: u8| b.is_ascii_alphabetic() && b != b'N';
        // Behind a letter alone it would be the letter's value, and a line with an O word takes none.
        line.trim_end()
            .ends_with(|c: char| c.is_ascii_digit() || c == '.')
            && line.bytes().any(|b| is_word(b.to_ascii_uppercase()))
            && !line.contains(['O', 'o'])
    })
}

/// A diagnostic without the text it is in: line, column, length, what it says.
type Place = (u32, u32, u32, String);

fn place(diagnostic: &Diagnostic) -> Place {
    let Diagnostic {
        line,
        column,
        length,
        ..
    } = *diagnostic;
    (
        line,
        column,
        length,
        format!("{} {}", diagnostic.code, diagnostic.message),
    )
}

fn items(text: &[u8]) -> (Vec<Item>, Option<Place>) {
    let (mut items, mut end) = (Vec::new(), None);
    for item in Program::new(text, options()) {
        match item {
            Ok(item) => items.push(item),
            Err(diagnostic) => end = Some(place(&diagnostic)),
        }
    }
    (items, end)
}

/// Compares a program with the same one without a plain line.
fn compare(text: &str) {
    compare_with(text, &commented(text));
    compare_with(text, &assigning(text));
    let plain = check(text.as_bytes(), options());
    let found = diagnostics(text.as_bytes(), options());
    assert_eq!(
        (found.diagnostics, found.more),
        (plain.diagnostics, plain.more)
    );
}

fn compare_with(text: &str, other: &str) {
    // Bit for bit, as far as the shortest text that reads back tells.
    assert_eq!(
        format!("{:?}", items(text.as_bytes())),
        format!("{:?}", items(other.as_bytes()))
    );
    let [plain, general] = [text, other].map(|text| check(text.as_bytes(), options()));
    let places = |found: &[Diagnostic]| found.iter().map(place).collect::<Vec<_>>();
    assert_eq!(places(&plain.diagnostics), places(&general.diagnostics));
    let rest = |report: &Report| {
        format!(
            "{} {:?} {:?} {:?} {:?} {:?}",
            report.more,
            report.given_up_at,
            report.totals,
            report.part,
            report.survey,
            report.final_position
        )
    };
    assert_eq!(rest(&plain), rest(&general));
}

/// Plain lines, and now and then one that changes what they mean.
fn line() -> impl Strategy<Value = String> {
    let plain = "(N[0-9]{1,4} )?(G0?[0-3] ?)?([XYZ]-?[0-9]{1,2}(\\.[0-9]{0,5})? ?){0,2}([AUIJKRF]-?[0-9]{1,2}\\.[0-9] ?)?";
    let other = prop::sample::select(vec![
        "G20",
        "G21",
        "G90",
        "G91",
        "G93",
        "G94",
        "G95",
        "G7",
        "G8",
        "G18",
        "G17",
        "G53 G0 X1",
        "G10 L2 P1 X1 Y2 R30",
        "G10 L2 P1 X3 R0",
        "G92 X5",
        "G92.1",
        "G55",
        "G54",
        "G41.1 D1",
        "G40",
        "G80",
        "G81 Z-1 R2",
        "G96 S100 D1000",
        "G97 S100",
        "G61",
        "G64 P0.1",
        "G5 I1 J1 P1 Q1 X5",
        "G43.1 Z3",
        "G49",
        "M2",
        "M70",
        "M72",
        "O1 sub",
        "O1 endsub",
        "O1 call",
        "#1=5",
        "X#1",
        "G38.2 X3 F10",
        "G4 P1",
        "F0",
        "S5 X1",
        "T1",
        "G0 E5",
        "X1 X2",
        "(c)",
    ]);
    prop_oneof![8 => plain, 1 => other.prop_map(str::to_owned)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]
    #[test]
    fn a_program_is_the_same_with_and_without_plain_lines(
        lines in prop::collection::vec(line(), 1..30), end in "\n|\r\n|\r"
    ) {
        // A lone CR is no line end to `commented`.
        let text = lines.join(if end == "\r" { "\n" } else { &end });
        compare(&format!("F100\n{text}"));
        let joined = lines.join(&end);
        let expected = items(text.as_bytes());
        prop_assert_eq!(format!("{:?}", items(joined.as_bytes())), format!("{expected:?}"));
    }

    #[test]
    fn how_much_is_read_at_a_time_does_not_matter(
        lines in prop::collection::vec(line(), 1..12), size in 1_usize..40, end in "\n|\r\n|\r"
    ) {
        let text = format!("F100{end}{}", lines.join(&end));
        let whole = check(text.as_bytes(), options());
        let parts = check(BufReader::with_capacity(size, text.as_bytes()), options());
        prop_assert_eq!(whole, parts);
    }
}

#[test]
fn moves_that_are_only_judged_are_moves_of_a_loop() {
    let text = "F100\n#1=0\nO1 while [#1 LT 9]\n#1=[#1+1]\nG1 X1\nG1 X0\nO1 endwhile\nO2 while [1]\nG4 P0\nO2 endwhile\n";
    let loops = LoopLimits {
        idle_lines: 10,
        checked_lines: 1000,
        ..LoopLimits::default()
    };
    let options = Options { loops, ..options() };
    let report = check(text.as_bytes(), options.clone());
    assert!(report.is_accepted() && !report.is_complete());
    let found = diagnostics(text.as_bytes(), options);
    assert_eq!(found.diagnostics, []);
    // The loop without end begins in line 8.
    assert!(matches!(report.given_up_at, Some(8..=10)));
    assert_eq!(found.given_up_at, report.given_up_at);
}

/// Every file below a folder.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            files(&path, found);
        } else {
            found.push(path);
        }
    }
}

/// Reads the folder of programs that `GLIDEPATH_CORPUS` names, and is skipped without.
#[test]
fn programs_of_others_are_the_same_with_and_without_plain_lines() {
    let Some(corpus) = corpus() else {
        return;
    };
    let mut found = Vec::new();
    files(&corpus, &mut found);
    found.sort();
    let mut compared = 0;
    for path in found {
        let Ok(text) = std::fs::read_to_string(&path) else {
            continue;
        };
        // The beginning of a long one says as much.
        let beginning: String = text.split_inclusive('\n').take(3000).collect();
        compare(&beginning);
        compared += 1;
    }
    println!("{compared} programs");
    assert!(compared > 100);
}
