//! Tests with real programs, compared with what an independent interpreter made of them.
//!
//! Runs where the environment variable `GLIDEPATH_CORPUS` names the directory of the programs and
//! their `EXPECTED.json`; says so and passes where it does not. With `--nocapture` it lists every
//! difference and how much agrees.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use glidepath_gcode::{Connections, Options, Report, Threading, Tool, ToolTable, check};
use glidepath_program::Limits;
use glidepath_testing::corpus;
use serde_json::Value;

/// Programs judged otherwise than by the reference, each with the reason.
const OTHER_VERDICT: [(&str, bool, &str); 3] = [
    (
        "malformed/bom-crlf.nc",
        true,
        "a UTF-8 byte order mark is harmless",
    ),
    (
        "malformed/o-missing-endsub.ngc",
        false,
        "the reference misses the program end only",
    ),
    (
        "malformed/nul-bytes.nc",
        false,
        "the reference loses the block behind the NUL bytes",
    ),
];

/// What the makers of the expectations call no example to follow: a block that is lost, a byte
/// order mark that is refused, a line that is too long for a buffer. Left out of what agrees.
const FAULTS: [&str; 3] = [
    "malformed/bom-crlf.nc",
    "malformed/nul-bytes.nc",
    "malformed/numbers-huge.nc",
];

/// First diagnostics in another line than the reference's, each with the reason.
const OTHER_LINE: [(&str, u32, &str); 4] = [
    (
        "malformed/linuxcnc-bad-ccomp-gouging.ngc",
        6,
        "the move that is too short, not the one after it",
    ),
    (
        "malformed/numbers-huge.nc",
        4,
        "a coordinate of 1e24 is refused already",
    ),
    (
        "malformed/nurbs-bad.ngc",
        6,
        "a weight of zero, before the one below zero",
    ),
    (
        "malformed/o-recursion.ngc",
        2,
        "the call inside the subroutine, not the one of the main program",
    ),
];

/// The program with a thread: it takes the time of the spindle, to which the reference gives that of
/// the last F.
const THREAD: &str = "lathe/g76-thread.ngc";

/// It drills without a word of G98 or G99. The reference begins in G99, and here it is told to.
const MOUNT: &str = "macro/mmount.ngc";

/// A program of the list, in the modes that the reference begins in.
fn text_of(directory: &Path, name: &str) -> Vec<u8> {
    let text = fs::read(directory.join(name)).expect("a program of the list");
    if name == MOUNT {
        return [b"G99\n", &text[..]].concat();
    }
    text
}

/// Figures that differ from the reference, each with the reason.
const OTHER_FIGURES: [(&str, &str, &str); 11] = [
    (
        "lathe/g76-thread.ngc",
        "rapid length",
        "by 2.8 mm, not in the thread: compensation begins there with a move without a length",
    ),
    (
        "macro/mmount.ngc",
        "box Z",
        "what G33.1 taps is an event, no move",
    ),
    (
        "macro/mmount.ngc",
        "box X",
        "by 16 nm: the radii of its arcs drift by 2 µm",
    ),
    (
        "axes/4axis-rotary-xza-51k.ngc",
        "final A",
        "G92 renames the place, it moves nothing",
    ),
    (
        "malformed/tiny-moves.nc",
        "straight feeds",
        "moves of a picometre are merged",
    ),
    (
        "malformed/tiny-moves.nc",
        "feed length",
        "moves of a picometre are merged",
    ),
    (
        "spline/quadratic-g51-text.ngc",
        "final X",
        "G92.1 at its end renames the place, it moves nothing",
    ),
    (
        "spline/quadratic-g51-text.ngc",
        "rapids",
        "G92 renames the place, it moves nothing",
    ),
    (
        "spline/quadratic-g51-text.ngc",
        "rapid length",
        "G92 renames the place, it moves nothing",
    ),
    (
        "tp-regress/machinekit-412.ngc",
        "box A",
        "its box starts at 0 before G92, in shifted A",
    ),
    (
        "tp-regress/tkalcevic-realtime-error.ngc",
        "box A",
        "as in machinekit-412",
    ),
];

/// As the reference was made: tools 1 to 99 without length, of that diameter; inputs, outputs and
/// the probe simulated.
fn options(diameter_mm: f64) -> Options {
    let mut tools = ToolTable::new();
    for number in 1..=99 {
        let tool = Tool {
            diameter_mm,
            ..Tool::default()
        };
        tools.set(number, tool);
    }
    Options {
        tools: Some(Arc::new(tools)),
        connections: Connections::Simulated,
        orients: true,
        threading: Some(Threading::new(
            Limits::uniform(200.0, 2_000.0, 40_000.0),
            0.004,
        )),
        // The curves there are a few hundredths of a millimetre long.
        spline_tolerance_mm: 1e-5,
        ..Options::default()
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(0.0)
}

/// Every difference between the report and the expectation, and how many figures were compared.
fn differences(report: &Report, expected: &Value) -> (u32, Vec<String>) {
    let (mut all, mut figures) = (Vec::new(), 0);
    let totals = &report.totals;
    let (counts, zero) = (&expected["counts"], &expected["zero_length_moves"]);
    let moving = |name: &str| counts[name].as_i64().unwrap_or(0) - zero[name].as_i64().unwrap_or(0);
    let probes = counts["probes"].as_i64().unwrap_or(0);
    // Of splines the reference knows chords: how many is its own affair, and lengths and boxes have
    // few digits.
    let splines = counts["splines"].as_i64().unwrap_or(0) > 0;
    let (length, corner_mm) = if splines { (2e-4, 0.02) } else { (1e-6, 1e-5) };
    for (what, ours, theirs) in [
        (
            "straight feeds",
            totals.straight_feeds,
            moving("straight_feeds") + probes,
        ),
        ("arcs", totals.arcs, counts["arcs"].as_i64().unwrap_or(0)),
        ("rapids", totals.rapids, moving("traverses")),
        (
            "dwells",
            totals.dwells,
            counts["dwells"].as_i64().unwrap_or(0),
        ),
    ] {
        figures += 1;
        if i64::from(ours) != theirs && !(splines && what == "straight feeds") {
            all.push(format!("{what}: {ours}, expected {theirs}"));
        }
    }
    for (what, ours, key) in [
        ("feed length", totals.feed_length_mm, "feed_length_mm"),
        ("rapid length", totals.rapid_length_mm, "rapid_length_mm"),
        ("feed time", totals.feed_time_s, "feed_time_s"),
    ] {
        if what == "feed time" && expected["file"] == THREAD {
            continue;
        }
        let theirs = number(&expected[key]);
        figures += u32::from(expected[key].is_number());
        if expected[key].is_number() && (ours - theirs).abs() > length * theirs.abs().max(1.0) {
            all.push(format!("{what}: {ours}, expected {theirs}"));
        }
    }
    for (axis, letter) in "XYZABCUVW".chars().enumerate() {
        let theirs = number(&expected["final_mm_deg"][letter.to_string()]);
        let ours = report.final_position[axis];
        figures += 1;
        if (ours - theirs).abs() > 1e-6 {
            all.push(format!("final {letter}: {ours}, expected {theirs}"));
        }
        if let (Some(theirs), Some((low, high))) = (
            expected["box_all_moves"][letter.to_string()].as_array(),
            totals.bounding_box,
        ) {
            for (ours, theirs) in [(low[axis], &theirs[0]), (high[axis], &theirs[1])] {
                figures += 1;
                if (ours - number(theirs)).abs() > corner_mm {
                    all.push(format!("box {letter}: {ours}, expected {theirs}"));
                }
            }
        }
    }
    (figures, all)
}

/// How much of what was compared agrees.
#[derive(Debug, Default)]
struct Agreement {
    programs: u32,
    /// Programs that agree in everything.
    alike: u32,
    /// Verdicts, places of errors, lengths, times, counts, ends, corners.
    figures: u32,
    differing: u32,
}

impl Agreement {
    fn count(&mut self, figures: u32, differing: usize) {
        let differing = u32::try_from(differing).unwrap_or(u32::MAX);
        self.programs += 1;
        self.alike += u32::from(differing == 0);
        self.figures += figures;
        self.differing += differing;
    }
}

/// What came of one program.
#[derive(Debug, Default)]
struct Judged {
    /// How many figures were compared.
    figures: u32,
    /// Those that differ.
    found: Vec<String>,
    /// Those that may not.
    failures: Vec<String>,
}

fn judge(name: &str, report: &Report, expected: &Value) -> Judged {
    let mut judged = Judged {
        figures: 1,
        ..Judged::default()
    };
    let Judged {
        figures,
        found,
        failures,
    } = &mut judged;
    let other = OTHER_VERDICT.iter().find(|(file, ..)| *file == name);
    // A program that lacks its end alone may be judged either way.
    let theirs = expected["accepted"] == true;
    let accepted = theirs || expected["missing_program_end"] == true;
    let verdict = other.map_or(accepted, |(_, verdict, _)| *verdict);
    if verdict != theirs && verdict != accepted {
        found.push(format!("accepted is {verdict}, expected {accepted}"));
    }
    if report.is_accepted() != verdict {
        let first = report.diagnostics.first();
        failures.push(format!("{name}: accepted is not {verdict}; {first:?}"));
    } else if !verdict && other.is_none() {
        let ours = report.diagnostics.first().map(|d| u64::from(d.line));
        let theirs = expected["error_line"].as_u64();
        let other = OTHER_LINE.iter().find(|(file, ..)| *file == name);
        let wanted = other.map_or(theirs, |(_, line, _)| Some(u64::from(*line)));
        *figures += u32::from(theirs.is_some());
        if other.is_some() {
            found.push(format!("diagnostic in {wanted:?}, expected {theirs:?}"));
        }
        if wanted.is_some() && ours != wanted {
            failures.push(format!(
                "{name}: first diagnostic in {ours:?}, expected {wanted:?}"
            ));
        }
    } else if verdict && other.is_none() {
        let (compared, differing) = differences(report, expected);
        let known = |difference: &&String| {
            OTHER_FIGURES
                .iter()
                .any(|(file, what, _)| *file == name && difference.starts_with(what))
        };
        let unknown = differing.iter().filter(|difference| !known(difference));
        failures.extend(unknown.map(|difference| format!("{name}: {difference}")));
        *figures += compared;
        *found = differing;
    }
    judged
}

#[test]
fn programs_go_where_the_reference_goes() {
    let Some(directory) = corpus() else { return };
    let text = fs::read_to_string(directory.join("EXPECTED.json")).expect("the expectations");
    let expectations: Value = serde_json::from_str(&text).expect("JSON");
    let (mut agreement, mut failures) = (Agreement::default(), Vec::new());
    for expected in expectations["programs"].as_array().expect("a list") {
        let name = expected["file"].as_str().expect("a file name");
        let bytes = text_of(&directory, name);
        if expected["linuxcnc_applicable"] == false {
            continue;
        }
        let report = check(bytes.as_slice(), options(0.0));
        let judged = judge(name, &report, expected);
        for difference in &judged.found {
            println!("{name}: {difference}");
        }
        failures.extend(judged.failures);
        if !FAULTS.contains(&name) {
            agreement.count(judged.figures, judged.found.len());
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    println!("{agreement:?}");
    let Agreement {
        programs,
        figures,
        differing,
        ..
    } = agreement;
    assert!(programs >= 84, "only {programs} programs compared");
    assert!(100 * differing <= figures, "{differing} of {figures}");
}

/// Programs with cutter radius compensation, once more with a tool that has a radius.
#[test]
fn compensated_programs_go_where_the_reference_goes() {
    let Some(directory) = corpus() else { return };
    let text = fs::read_to_string(directory.join("EXPECTED.json")).expect("the expectations");
    let expectations: Value = serde_json::from_str(&text).expect("JSON");
    let mut compared = 0;
    for program in expectations["programs"].as_array().expect("a list") {
        let name = program["file"].as_str().expect("a file name");
        let expected = &program["with_tools_of_1mm_diameter"];
        // In the thread's, compensation begins with a move without a length, which is none here.
        let skipped = OTHER_VERDICT.iter().any(|(file, ..)| *file == name) || name == THREAD;
        if program["linuxcnc_applicable"] == false || expected.is_null() || skipped {
            continue;
        }
        let bytes = text_of(&directory, name);
        let report = check(bytes.as_slice(), options(1.0));
        let accepted = expected["accepted"] == true || program["missing_program_end"] == true;
        assert_eq!(
            report.is_accepted(),
            accepted,
            "{name}: {:?}",
            report.diagnostics
        );
        let totals = &report.totals;
        assert_eq!(i64::from(totals.arcs), expected["arcs"], "{name}");
        assert_eq!(
            i64::from(totals.straight_feeds),
            expected["straight_feeds"],
            "{name}"
        );
        for (ours, key) in [
            (totals.feed_length_mm, "feed_length_mm"),
            (totals.rapid_length_mm, "rapid_length_mm"),
        ] {
            let theirs = number(&expected[key]);
            // Their sums are of coordinates with four decimals of an inch. The mount's circles are
            // gone round again and again, so what is rounded of them adds up.
            let moves = f64::from(totals.straight_feeds + totals.arcs);
            let errors = if name == MOUNT { moves } else { moves.sqrt() };
            let rounding = 0.5e-4 * 25.4 * errors;
            assert!(
                (ours - theirs).abs() <= rounding,
                "{name} {key}: {ours} {theirs}"
            );
        }
        compared += 1;
    }
    assert!(compared >= 2, "only {compared} programs compared");
}
