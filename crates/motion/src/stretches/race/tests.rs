//! Races in which each way is slowed down in turn.

use super::state::Race;
use glidepath_geometry::AxisVector;
use glidepath_geometry::{Segment, tolerance_norm};
use glidepath_program::{Effort, ItemKind, Limits, PathMode, Rate, Smoothing};
use glidepath_program::{Frame, Item, Override, Settings};

const FEED_V: f64 = 40.0;

fn settings() -> Settings {
    Settings {
        limits: Limits::uniform(200.0, 2000.0, 40_000.0),
        tolerance_mm: 0.02,
        smoothing: Smoothing::Auto,
        period_t: 0.004,
        effort: Effort::Optimal,
    }
}

/// Lines to and fro, each of them 12 mm.
fn vertices(lines: u32) -> Vec<AxisVector> {
    (0..=lines)
        .map(|k| {
            let mut at = AxisVector::zeros();
            at[0] = 12.0 * f64::from(k.div_ceil(2));
            at[1] = 12.0 * f64::from((k / 2) % 2);
            at
        })
        .collect()
}

/// The lines for one way, slow where that is wanted.
fn items(vertices: &[AxisVector], is_slow: impl Fn(u32) -> bool) -> Vec<Item> {
    (1..)
        .zip(vertices.windows(2))
        .map(|(block, ends)| Item {
            block,
            line: block,
            kind: ItemKind::Move {
                segment: Segment::line(ends[0], ends[1]),
                rate: Rate::Feed(if is_slow(block) { 0.7 } else { 1.0 } * FEED_V),
                mode: PathMode::Continuous { tolerance_mm: None },
            },
        })
        .collect()
}

fn frames_of(next: impl FnMut() -> Option<Frame>) -> Vec<Frame> {
    core::iter::from_fn(next).collect()
}

/// The race of both ways, and each of them by itself, each along items of its own.
fn race(vertices: &[AxisVector], ways: [&[Item]; 2]) -> (Vec<Frame>, [usize; 2]) {
    let mut race = Race::new(settings(), vertices[0], Override::NONE);
    for item in items(vertices, |_| false) {
        race.program.push(&item);
    }
    let mut alone = race.ways.clone();
    for (way, items) in ways.into_iter().enumerate() {
        for item in items {
            race.ways[way].push(item).unwrap();
            alone[way].push(item).unwrap();
        }
        alone[way].finish();
    }
    race.finish();
    let frames = frames_of(|| race.pop_frame().unwrap());
    assert!(race.length_s().is_some(), "it ends");
    let counts = alone.each_mut().map(|way| {
        assert!(way.plan_to(usize::MAX, &race.program, &race.log));
        way.end() - 1
    });
    (frames, counts)
}

fn assert_is_a_motion(vertices: &[AxisVector], frames: &[Frame]) {
    let settings = settings();
    let t = settings.period_t;
    let rest = |at: usize| core::iter::repeat_n(vertices[at], 3);
    let moving = frames.iter().map(|frame| frame.position);
    let all: Vec<_> = rest(0)
        .chain(moving)
        .chain(rest(vertices.len() - 1))
        .collect();
    for p in all.windows(4) {
        let differences = [
            (p[1] - p[0], 200.0 * t),
            (p[2] - p[1] * 2.0 + p[0], 2000.0 * t * t),
            (p[3] - p[2] * 3.0 + p[1] * 3.0 - p[0], 40_000.0 * t * t * t),
        ];
        for (difference, most) in differences {
            assert!(
                difference.amax() <= most * (1.0 + 1e-6) + 1e-12,
                "{difference} {most}"
            );
        }
    }
    for frame in frames {
        let line = frame.block as usize;
        let near = (line.saturating_sub(2)..(line + 1).min(vertices.len() - 1)).any(|k| {
            let (from, to) = (vertices[k], vertices[k + 1]);
            let along = (to - from) / (to - from).norm();
            let s = (frame.position - from)
                .dot(&along)
                .clamp(0.0, (to - from).norm());
            tolerance_norm(&(frame.position - from - along * s)) <= settings.tolerance_mm
        });
        assert!(near, "{frame:?}");
    }
    for pair in frames.windows(2) {
        assert!(pair[0].block <= pair[1].block && pair[0].path_s <= pair[1].path_s);
    }
}

#[test]
fn the_faster_way_is_driven_from_place_to_place() {
    let vertices = vertices(24);
    let tube = items(&vertices, |block| (block / 6) % 2 == 0);
    let path = items(&vertices, |block| (block / 6) % 2 == 1);
    let (frames, [in_tube, on_path]) = race(&vertices, [&tube, &path]);
    assert_is_a_motion(&vertices, &frames);
    let saved = in_tube.min(on_path) - frames.len();
    // A half of all is driven at 0.7 of the feed by either way, which costs 77 periods for six lines.
    assert!(saved > 100, "{} of {in_tube} and {on_path}", frames.len());
}

#[test]
fn it_is_not_slower_than_along_the_path() {
    let vertices = vertices(16);
    let usual = items(&vertices, |_| false);
    for from in [0, 5, 11] {
        let tube = items(&vertices, |block| block > from);
        let (frames, [_, on_path]) = race(&vertices, [&tube, &usual]);
        assert_is_a_motion(&vertices, &frames);
        assert!(frames.len() <= on_path + 1, "{} of {on_path}", frames.len());
    }
}
