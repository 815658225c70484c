//! Tests of G33 and G76: what is made of them, and what is refused.

use crate::{Options, Program, Threading, check};
use glidepath_program::{Event, Item, ItemKind, Limits, PHASE_STEPS};

fn options() -> Options {
    Options {
        threading: Some(Threading::new(
            Limits::uniform(200.0, 2_000.0, 40_000.0),
            0.004,
        )),
        ..Options::default()
    }
}

fn items(text: &str) -> Vec<Item> {
    let program = Program::new(text.as_bytes(), options());
    program.collect::<Result<_, _>>().unwrap()
}

fn refusal(text: &str, options: Options) -> String {
    let report = check(text.as_bytes(), options);
    let first = report.diagnostics.first().unwrap();
    format!("{}:{} {}", first.line, first.column, first.message)
}

/// The pitches of the passes and the phases they begin at.
fn begun(items: &[Item]) -> Vec<(f64, u32)> {
    let begun = |item: &Item| match item.kind {
        ItemKind::Event(Event::Synchronise { pitch_mm, phase }) => Some((pitch_mm, phase)),
        _ => None,
    };
    items.iter().filter_map(begun).collect()
}

/// X, Z and whether it is cut, of the end of every move.
fn ends(items: &[Item]) -> Vec<(f64, f64, bool)> {
    let micrometres = |mm: f64| (mm * 1e3).round() / 1e3;
    let end = |item: &Item| match &item.kind {
        ItemKind::Move { segment, rate, .. } => {
            let end = segment.end();
            Some((
                micrometres(end[0]),
                micrometres(end[2]),
                rate.is_synchronised(),
            ))
        }
        _ => None,
    };
    items.iter().filter_map(end).collect()
}

#[test]
fn a_pass_is_announced_and_planned_for_a_tenth_more_than_the_speed() {
    let items = items("S600 M3\nG33 Z-20 K1.5\nG0 X2\nZ0\nX0\nG33 X0.5 Z-20 K1.5 Q120\n");
    assert_eq!(begun(&items), [(1.5, 0), (1.5, PHASE_STEPS / 3)]);
    let ItemKind::Move { rate, .. } = items[3].kind else {
        panic!("{:?}", items[3]);
    };
    assert!(rate.is_synchronised() && (rate.feed_v().unwrap() - 16.5).abs() < 1e-12);
}

#[test]
fn inches_are_inches() {
    let items = items("G20 S600 M3\nG33 Z-1 K0.05\n");
    assert_eq!(begun(&items), [(0.05 * 25.4, 0)]);
}

#[test]
fn what_cannot_be_cut_is_refused_where_it_stands() {
    let cases = [
        ("S600 M3\nG33 Z-20\n", "2:1 G33 without K"),
        (
            "S600 M3\nG33 Z-20 K0\n",
            "2:10 the pitch K0 is not above zero",
        ),
        ("S600 M3\nG33 Z-20 K1 F100\n", "2:13 G33 with F"),
        (
            "S600\nG33 Z-20 K1\n",
            "2:1 a thread with the spindle at rest",
        ),
        (
            "M3\nG33 Z-20 K1\n",
            "2:1 a thread with a spindle without a speed",
        ),
        (
            "G96 S100 D2000 M3\nG33 Z-20 K1\n",
            "2:1 a thread with a spindle whose speed follows the tool (G96)",
        ),
        (
            "S3000 M3\nG33 Z-50 K4\n",
            "2:1 a pitch of 4.000 mm at S3000 takes 13200 mm/min",
        ),
        (
            "S900 M3\nG33 Z-1 K1.5\n",
            "2:1 a thread of 1.000 mm is too short at S900",
        ),
        (
            "S600 M3\nG33 Z-20 K1\nG33 Z-30 K1\n",
            "3:1 a thread that goes on from another one",
        ),
        (
            "S600 M3\nG33 Z-20 K1 Q400\n",
            "2:13 a thread cannot begin at 400 degrees",
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(refusal(text, options()), expected, "{text}");
    }
    let without = refusal("S600 M3\nG33 Z-20 K1\n", Options::default());
    assert_eq!(without, "2:1 the angle of the spindle is not known");
}

#[test]
fn the_passes_of_a_cycle_are_those_of_linuxcnc() {
    let text = "G18 S600 M3\nG0 X10 Z2\nG76 P1 Z-20 I-1 J0.3 K0.6 R1 Q0 H1\n";
    let passes: Vec<_> = ends(&items(text)).into_iter().skip(1).collect();
    let pass = |x: f64| {
        let out = ((x + 1.6) * 1e3).round() / 1e3;
        [
            (out, 2.0, false),
            (x, 2.0, false),
            (x, -20.0, true),
            (out, -20.0, false),
        ]
    };
    // 0.3 below the peak, then twice at the full depth: once more for the spring pass.
    let mut expected = Vec::new();
    for x in [8.7, 8.4, 8.4] {
        expected.extend(pass(x));
    }
    assert_eq!(passes, expected);
}

#[test]
fn degression_makes_more_passes_and_the_slide_shifts_them() {
    for (degression, passes) in [(1.0, 5), (1.5, 10), (2.0, 22)] {
        let text = format!("G18 S600 M3\nG0 X10\nG76 P1 Z-20 I-1 J0.2 K0.92 R{degression}\n");
        assert_eq!(begun(&items(&text)).len(), passes, "{degression}");
    }
    let text = "G18 S600 M3\nG0 X10\nG76 P1 Z-20 I-1 J0.5 K1 Q30\n";
    let cuts: Vec<_> = ends(&items(text)).into_iter().filter(|end| end.2).collect();
    let tan = 30.0_f64.to_radians().tan();
    let shifted = |mm: f64| ((-20.0 + (1.0 - mm) * tan) * 1e3).round() / 1e3;
    assert_eq!(cuts, [(8.5, shifted(0.5), true), (8.0, -20.0, true)]);
}

#[test]
fn ways_in_and_out_rise_to_the_peak_at_the_same_way_along_z() {
    let text = "G18 S600 M3\nG0 X10\nG76 P1 Z-20 I-1 J0.9 K1 L3 E2\n";
    let items = items(text);
    let along = 5.0_f64.sqrt() / 2.0;
    assert!((begun(&items)[0].0 - along).abs() < 1e-12);
    let cuts: Vec<_> = ends(&items).into_iter().filter(|end| end.2).collect();
    assert_eq!(
        cuts[..3],
        [(8.1, -2.0, true), (8.1, -18.0, true), (9.1, -20.0, true)]
    );
    // Inside, and the other way along Z.
    let text = "G18 S600 M3\nG0 X10\nG76 P1 Z20 I1 J0.9 K1 L2 E2\n";
    let cuts: Vec<_> = ends(&self::items(text))
        .into_iter()
        .filter(|end| end.2)
        .collect();
    assert_eq!(cuts[..2], [(11.9, 18.0, true), (10.9, 20.0, true)]);
}

#[test]
fn words_of_a_cycle_out_of_range_are_refused() {
    let cycle = |words: &str| format!("G18 S600 M3\nG0 X10\nG76 {words}\n");
    let cases = [
        ("P1 Z-20 I-1 J0.3", "3:1 G76 without K"),
        ("P1 Z-20 I-1 J0.3 K0.3", "3:22 K of G76 is out of range"),
        ("P1 Z-20 I-1 J0.3 K1 R0.5", "3:25 R of G76 is out of range"),
        (
            "P1 Z-20 I-1 J0.3 K1 E11 L3",
            "3:25 E of G76 is out of range",
        ),
        ("P1 X3 Z-20 I-1 J0.3 K1", "3:8 G76 with X"),
        (
            "P1 Z-20 I-1 J0.001 K1 R2",
            "3:1 a thread of more than 1000 passes",
        ),
    ];
    for (words, expected) in cases {
        assert_eq!(refusal(&cycle(words), options()), expected, "{words}");
    }
}
