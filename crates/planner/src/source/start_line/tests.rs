//! Tests of programs that are begun in their middle: what they restore, and what follows.

use super::*;
use crate::source::program::ProgramSource;
use glidepath_gcode::Options;
use glidepath_link::{Coolant, SpindleState};

const TEXT: &str = "G21 G90 S500\nM3\nG0 Z5\no100 repeat [3]\nG91 G1 X1 F600\nG90 G1 Z-1\n\
                    G0 Z5\no100 endrepeat\nM8\nG1 Y7\nM9 M5\nG0 X0\nM2\n";

fn source() -> ProgramSource<&'static [u8]> {
    ProgramSource::new(TEXT.as_bytes(), Options::default())
}

fn items(source: &mut impl ItemSource) -> Vec<Item> {
    let mut items = Vec::new();
    while let Supply::Item(item) = source.next_item() {
        items.push(item);
    }
    items
}

/// All items of a program from a line on, those before its first block too.
fn way(found: LineStart<ProgramSource<&'static [u8]>>, approach: &Approach) -> Vec<Item> {
    let mut rest = found.approached(approach);
    let mut way = Vec::from(rest.take_aside());
    way.extend(items(&mut rest));
    way
}

fn approach(position: AxisVector) -> Approach {
    Approach {
        position,
        now: Auxiliary::default(),
        tool_axis: Axis::Z,
        top: Some(50.0),
    }
}

#[test]
fn from_every_line_at_every_pass_it_is_the_tail_of_the_program() {
    let all = items(&mut source());
    let mut begun = 0;
    for (index, item) in all.iter().enumerate() {
        let same = |other: &&Item| other.line == item.line;
        if index > 0 && all[index - 1].line == item.line {
            continue;
        }
        let pass = all[..=index].iter().filter(same).count();
        let pass = u32::try_from(pass).unwrap();
        let start = StartLine {
            line: item.line,
            pass,
        };
        let found = LineStart::find(source(), start, &approach(AxisVector::zeros())).unwrap();
        if let ItemKind::Move { segment, .. } = item.kind {
            assert_eq!(found.begins_at(), segment.start(), "line {}", item.line);
        }
        let mut rest = found.approached(&approach(AxisVector::repeat(3.0)));
        let rest = items(&mut rest);
        assert_eq!(rest[rest.len() - (all.len() - index)..], all[index..]);
        begun += 1;
    }
    assert!(begun > 12, "{begun}");
}

#[test]
fn the_way_goes_up_restores_and_comes_down() {
    let start = StartLine { line: 10, pass: 1 };
    let found = LineStart::find(source(), start, &approach(AxisVector::zeros())).unwrap();
    assert_eq!(found.expected().spindle(), Ok(SpindleState::Clockwise));
    assert!(found.expected().coolant().contains(Coolant::FLOOD));
    let mut position = AxisVector::repeat(0.0);
    position[0] = -20.0;
    let way = way(found, &approach(position));
    let kinds: Vec<String> = way[..8]
        .iter()
        .map(|item| match item.kind {
            ItemKind::Move { segment, rate, .. } => {
                let end = segment.end();
                let how = if rate.is_rapid() { "G0" } else { "G1" };
                format!("{how} {} {} {}", end[0], end[1], end[2])
            }
            ItemKind::Event(event) => format!("{event:?}"),
            ItemKind::Dwell(_) => "G4".to_owned(),
        })
        .collect();
    let expected = [
        "G0 -20 0 50",
        "SpindleSpeed(500.0)",
        "MCode(3)",
        "MCode(8)",
        "G0 3 0 50",
        "Await(3)",
        "Await(8)",
        "G1 3 0 5",
    ];
    assert_eq!(kinds, expected);
}

#[test]
fn the_way_down_is_at_the_feed_ahead_and_else_at_the_one_before() {
    let down_v = |text: &'static str, line: u32| {
        let source = ProgramSource::new(text.as_bytes(), Options::default());
        let start = StartLine { line, pass: 1 };
        let mut found = LineStart::find(source, start, &approach(AxisVector::zeros())).unwrap();
        found.way_down_v()
    };
    let text = "G21 G90\nG1 X1 F600\nG1 X2 F2400\nG0 X3\nM5 M9\nM2\n";
    let down = [2, 3, 5].map(|line| down_v(text, line).to_bits());
    assert_eq!(down, [10.0_f64, 40.0, 40.0].map(f64::to_bits));
    let slow_v = down_v("G21 G90\nG0 X3\nM5 M9\nM2\n", 3);
    assert_eq!(slow_v.to_bits(), SLOW_V.to_bits());
}

#[test]
fn what_the_program_does_not_name_stays_as_it_is() {
    let mut approach = approach(AxisVector::zeros());
    for event in [
        Event::SelectTool(7),
        Event::MCode(6),
        Event::SpindleSpeed(900.0),
        Event::MCode(4),
        Event::MCode(8),
    ] {
        approach.now.take(event);
    }
    let text = "G21 G90\nG1 X1 F600\nM9\nX2\nM2\n";
    let source = ProgramSource::new(text.as_bytes(), Options::default());
    let start = StartLine { line: 4, pass: 1 };
    let found = LineStart::find(source, start, &approach).unwrap();
    let rest = way(found, &approach);
    let events = rest.iter().filter_map(|item| match item.kind {
        ItemKind::Event(event) => Some(event),
        _ => None,
    });
    let expected = [Event::MCode(9), Event::Await(9)];
    assert_eq!(events.collect::<Vec<_>>(), expected);
}

#[test]
fn the_feed_follows_its_input_where_the_program_has_it_so() {
    let approach = approach(AxisVector::zeros());
    let text = "G21 G90\nM52 P1\nG1 X1 F600\nM52 P0\nX2\nM52\nX3\nM2\n";
    for (line, expected) in [(3, Some(1.0)), (5, Some(0.0)), (7, Some(1.0))] {
        let options = Options {
            adaptive_feed: glidepath_gcode::AdaptiveFeed::Switched,
            ..Options::default()
        };
        let source = ProgramSource::new(text.as_bytes(), options);
        let start = StartLine { line, pass: 1 };
        let found = LineStart::find(source, start, &approach).unwrap();
        let rest = way(found, &approach);
        let switch = rest
            .windows(2)
            .find_map(|pair| match (pair[0].kind, pair[1].kind) {
                (
                    ItemKind::Event(Event::CodeWord { value, .. }),
                    ItemKind::Event(Event::MCode(ADAPTIVE_FEED)),
                ) => Some(value),
                _ => None,
            });
        assert_eq!(switch, expected, "line {line}");
    }
}

#[test]
fn a_line_that_does_nothing_is_refused() {
    let start = StartLine { line: 8, pass: 1 };
    let refused = LineStart::find(source(), start, &approach(AxisVector::zeros())).unwrap_err();
    assert!(
        refused.to_string().contains("line 9 is the next"),
        "{refused}"
    );
    let start = StartLine { line: 5, pass: 4 };
    LineStart::find(source(), start, &approach(AxisVector::zeros())).unwrap_err();
}
