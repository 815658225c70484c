//! The contour at a distance against brute force, and what must hold for passes along any profile.

use proptest::prelude::*;

use crate::execute::compensation::element::{Element, Point};
use crate::execute::lathe_cycle::offset::offset;
use crate::execute::lathe_cycle::pass_axes::{ContourPiece, PassAxes, pieces};
use crate::execute::lathe_cycle::passes::{PassMove, Roughing, finish, lift, rough};
use crate::execute::motion::speed::Pace;
use crate::syntax::modes::Pockets;

/// Distances are compared to this: samples of a profile are at most twice as far apart.
const SAMPLE_MM: f64 = 0.03;

/// Lines and half circles at most, on the way to smaller *a*; never below *b* = 0.
fn profile() -> impl Strategy<Value = Vec<Element>> {
    let element = (
        0..4_u8,
        0.3..6.0_f64,
        -4.0..5.0_f64,
        1.05..3.0_f64,
        any::<bool>(),
    );
    prop::collection::vec(element, 1..8).prop_map(|elements| {
        let mut at = [2.0, 3.0];
        let mut profile = Vec::new();
        for (kind, along, depth, share, left) in elements {
            let start = at;
            match kind {
                0 => at[1] = (at[1] + depth).max(0.5),
                1 => at[0] -= along,
                _ => at = [at[0] - along, (at[1] + depth).max(0.5)],
            }
            let chord = [at[0] - start[0], at[1] - start[1]];
            let length = chord[0].hypot(chord[1]);
            if length < 1e-3 {
                at = start;
                continue;
            }
            let arc = (kind == 3).then(|| {
                // Large enough not to turn back along a.
                let radius = share * (length * length / (2.0 * along)).max(0.5 * length);
                let rise = (radius * radius - 0.25 * length * length).sqrt() / length;
                let side = if left { 1.0 } else { -1.0 };
                let center = [
                    0.5 * (start[0] + at[0]) - side * rise * chord[1],
                    0.5 * (start[1] + at[1]) + side * rise * chord[0],
                ];
                (center, side * 2.0 * (0.5 * length / radius).asin())
            });
            profile.push(Element {
                start,
                end: at,
                arc,
            });
        }
        profile
    })
}

/// Points along elements, at most [`SAMPLE_MM`] apart.
fn samples(profile: &[Element]) -> Vec<Point> {
    let mut points = Vec::new();
    for element in profile {
        let (start, end) = (element.start, element.end);
        let turn = element.arc.map_or(0.0, |(_, sweep)| sweep.abs());
        let length = (end[0] - start[0]).hypot(end[1] - start[1]) * (1.0 + turn);
        let count = (length / SAMPLE_MM).ceil().max(1.0);
        let mut i = 0.0;
        while i <= count {
            let t = i / count;
            points.push(match element.arc {
                None => [
                    start[0] + t * (end[0] - start[0]),
                    start[1] + t * (end[1] - start[1]),
                ],
                Some((center, sweep)) => {
                    let (sin, cos) = (t * sweep).sin_cos();
                    let by = [start[0] - center[0], start[1] - center[1]];
                    [
                        center[0] + by[0] * cos - by[1] * sin,
                        center[1] + by[0] * sin + by[1] * cos,
                    ]
                }
            });
            i += 1.0;
        }
    }
    points
}

/// Points along the moves of a tool, from its start.
fn trace(moves: &[PassMove], start: Point) -> Vec<Point> {
    let mut at = start;
    let elements: Vec<Element> = moves
        .iter()
        .map(|pass_move| {
            let (end, arc) = match *pass_move {
                PassMove::Rapid(end) | PassMove::Feed(end) => (end, None),
                PassMove::Arc(end, center, _) => {
                    let (a, b) = (
                        [at[0] - center[0], at[1] - center[1]],
                        [end[0] - center[0], end[1] - center[1]],
                    );
                    let sweep = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
                    (end, Some((center, sweep)))
                }
            };
            let element = Element {
                start: at,
                end,
                arc,
            };
            at = end;
            element
        })
        .collect();
    samples(&elements)
}

/// How far a point is above a profile and away from it; negative if it is below.
fn clearance(point: Point, profile: &[Point]) -> f64 {
    let distance = |p: &Point| (p[0] - point[0]).hypot(p[1] - point[1]);
    let nearest = profile.iter().map(distance).fold(f64::INFINITY, f64::min);
    let is_below = profile.windows(2).any(|pair| {
        let (a, b) = (pair[0], pair[1]);
        let within = point[0] <= a[0].max(b[0]) && point[0] >= a[0].min(b[0]);
        within && a[1].min(b[1]) > point[1] + SAMPLE_MM
    });
    if is_below { -nearest } else { nearest }
}

fn in_frame(profile: &[Element], start: Point) -> (PassAxes, Vec<ContourPiece>) {
    let axes = PassAxes::new(false, profile, start).expect("a profile");
    let pieces = pieces(&axes, profile).expect("it leads one way");
    (axes, pieces)
}

fn increments() -> impl Strategy<Value = Roughing> {
    let pockets = prop_oneof![
        Just(Pockets::Cut),
        Just(Pockets::LeftOut),
        Just(Pockets::Only)
    ];
    (pockets, 0.2..2.0_f64, 0.0..1.5_f64).prop_map(|(pockets, increment_mm, retract_mm)| Roughing {
        pockets,
        increment_mm,
        retract_mm,
        first_level: 0.0,
        infeed: Pace::Rapid,
    })
}

/// Where the stock still reaches up to, at some values of *a*, after what the tool has cut away.
struct Stock {
    tops: Vec<(f64, f64)>,
}

impl Stock {
    const STEP_MM: f64 = 0.02;

    fn new(low: f64, high: f64, top: f64) -> Self {
        let mut tops = Vec::new();
        let mut a = low;
        while a <= high {
            tops.push((a, top));
            a += Self::STEP_MM;
        }
        Self { tops }
    }

    /// Cuts along a straight move; the deepest cut into what was there.
    fn cut(&mut self, from: Point, to: Point) -> f64 {
        let (low, high) = (from[0].min(to[0]), from[0].max(to[0]));
        let mut deepest = 0.0_f64;
        for (a, top) in &mut self.tops {
            if *a < low || *a > high {
                continue;
            }
            let share = if high > low {
                (*a - from[0]) / (to[0] - from[0])
            } else {
                1.0
            };
            let b = from[1] + share * (to[1] - from[1]);
            deepest = deepest.max(*top - b);
            *top = top.min(b);
        }
        deepest
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, ..ProptestConfig::default() })]

    #[test]
    fn a_contour_at_a_distance_is_where_brute_force_finds_it(
        profile in profile().prop_filter("not empty", |p| !p.is_empty()),
        distance in 0.05..1.5_f64,
    ) {
        let (_, pieces) = in_frame(&profile, [4.0, 40.0]);
        let Some(contour) = offset(&pieces, distance) else { return Ok(()) };
        let points = samples(&profile);
        let begin = contour[0].start;
        let along = finish(&contour, begin, Pace::Rapid);
        for point in trace(&along[1..], begin) {
            let clear = clearance(point, &points);
            prop_assert!(clear > distance - SAMPLE_MM, "{clear} at {point:?}");
            // Nowhere farther than it has to be, but for the walls that close steps.
            prop_assert!(clear < distance + SAMPLE_MM, "{clear} at {point:?}");
        }
        for pair in contour.windows(2) {
            prop_assert!((pair[0].end[0] - pair[1].start[0]).abs() < 1e-6);
            prop_assert!((pair[0].end[1] - pair[1].start[1]).abs() < 1e-6);
        }
    }

    #[test]
    fn finishing_comes_and_goes_clear_of_the_profile(
        profile in profile().prop_filter("not empty", |p| !p.is_empty()),
        distance in 0.0..0.8_f64,
        start in (-10.0..6.0_f64, 2.0..20.0_f64),
    ) {
        let start = [start.0, start.1 + 3.0];
        let (axes, pieces) = in_frame(&profile, start);
        let Some(contour) = offset(&pieces, distance) else { return Ok(()) };
        let (start, begin) = (axes.inside(start), contour[0].start);
        let top = profile.iter().flat_map(|e| [e.start[1], e.end[1]]).fold(0.0, f64::max);
        // From above hills the way beside the contour is not free, whatever the tool does.
        prop_assume!(start[0] >= begin[0] || start[1] > top + 12.0);
        let mut moves = finish(&contour, start, Pace::Rapid);
        moves.extend(lift(&contour, start));
        moves.push(PassMove::Rapid(start));
        let points = samples(&profile);
        for point in trace(&moves, start) {
            let clear = clearance(point, &points);
            let before = point[0] > begin[0] + 1e-6;
            let least = if before { 0.0 } else { distance };
            prop_assert!(clear > least - SAMPLE_MM, "{clear} at {point:?}");
        }
    }

    #[test]
    fn roughing_keeps_clear_of_the_profile_and_cuts_no_deeper_than_asked(
        profile in profile().prop_filter("not empty", |p| !p.is_empty()),
        distance in 0.0..0.8_f64,
        words in increments(),
    ) {
        let top = profile.iter().flat_map(|e| [e.start[1], e.end[1]]).fold(0.0, f64::max) + 12.0;
        let start = [4.0, top];
        let (axes, pieces) = in_frame(&profile, start);
        let Some(contour) = offset(&pieces, distance) else { return Ok(()) };
        let start = axes.inside(start);
        let moves = rough(&contour, start, words).expect("passes");
        let points = samples(&profile);
        for point in trace(&moves, start) {
            let clear = clearance(point, &points);
            // The way to the contour passes the first point of the profile as near as the start has
            // it.
            let before = point[0] > contour[0].start[0] + 1e-6;
            let least = if before { 0.0 } else { distance };
            prop_assert!(clear > least - SAMPLE_MM, "{clear} at {point:?}");
        }
        let end = match moves.last().expect("moves") {
            PassMove::Rapid(end) | PassMove::Feed(end) | PassMove::Arc(end, ..) => *end,
        };
        let last = contour.last().expect("a contour").end;
        prop_assert!((end[0] - last[0]).abs() < 1e-6, "the end of the contour");
        prop_assert!((end[1] - last[1].max(top)).abs() < 1e-6, "the level of the start");
        if words.pockets == Pockets::Cut {
            let mut stock = Stock::new(last[0] + 0.05, contour[0].start[0], top);
            let mut at = start;
            for pass_move in &moves {
                let (PassMove::Rapid(next) | PassMove::Feed(next) | PassMove::Arc(next, ..)) = *pass_move;
                let level = (next[1] - at[1]).abs() < 1e-9;
                if let (PassMove::Feed(_), true) = (pass_move, level) {
                    let depth = stock.cut(at, next);
                    prop_assert!(depth < words.increment_mm + 1e-6, "{depth} to {next:?}");
                } else if let PassMove::Rapid(_) = pass_move {
                    // Rapid moves cut nothing.
                    prop_assert!(stock.cut(at, next) < 0.05 || next[0] >= contour[0].start[0] - 0.05, "{at:?} {next:?}");
                } else {
                    stock.cut(at, next);
                }
                at = next;
            }
        }
    }
}

#[test]
fn the_finishing_path_is_the_profile_shifted() {
    // A shaft with a step: radius 5 for 10, then 8, faced in between.
    let line = |start: Point, end: Point| Element {
        start,
        end,
        arc: None,
    };
    let profile = [
        line([0.0, 5.0], [-10.0, 5.0]),
        line([-10.0, 5.0], [-10.0, 8.0]),
        line([-10.0, 8.0], [-20.0, 8.0]),
    ];
    let (_, pieces) = in_frame(&profile, [2.0, 12.0]);
    let start = [2.0, 12.0];
    let plain = finish(&offset(&pieces, 0.0).expect("itself"), start, Pace::Rapid);
    assert_eq!(
        plain,
        [
            PassMove::Rapid([0.0, 5.0]),
            PassMove::Feed([-10.0, 5.0]),
            PassMove::Feed([-10.0, 8.0]),
            PassMove::Feed([-20.0, 8.0]),
        ]
    );
    let shifted = finish(&offset(&pieces, 0.5).expect("room"), start, Pace::Rapid);
    assert_eq!(
        shifted,
        [
            PassMove::Rapid([0.0, 5.5]),
            PassMove::Feed([-9.5, 5.5]),
            PassMove::Feed([-9.5, 8.0]),
            PassMove::Arc([-10.0, 8.5], [-10.0, 8.0], true),
            PassMove::Feed([-20.0, 8.5]),
        ]
    );
}
