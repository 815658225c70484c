//! Lines and arcs in the plane, and their offsets.

use core::f64::consts::TAU;

/// A point or direction in the plane, mm.
pub(crate) type Point = [f64; 2];

/// How far beyond its ends an element may be met, as a fraction of it.
const OVER: f64 = 1e-9;

/// A line, or an arc about a centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Element {
    pub(crate) start: Point,
    pub(crate) end: Point,
    /// Centre and signed sweep in radians, for an arc.
    pub(crate) arc: Option<(Point, f64)>,
}

pub(crate) fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn along(a: Point, direction: Point, length: f64) -> Point {
    [a[0] + direction[0] * length, a[1] + direction[1] * length]
}

pub(super) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Angle from one direction to another, rad, positive to the left.
pub(crate) fn turn(from: Point, to: Point) -> f64 {
    cross(from, to).atan2(dot(from, to))
}

pub(crate) fn distance(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Direction from `a` to `b`, of length one; zero if they are one point.
pub(crate) fn direction(a: Point, b: Point) -> Point {
    let length = distance(a, b);
    if length > 0.0 {
        [(b[0] - a[0]) / length, (b[1] - a[1]) / length]
    } else {
        [0.0, 0.0]
    }
}

/// Turned a quarter to the left.
pub(super) const fn left_of(a: Point) -> Point {
    [-a[1], a[0]]
}

impl Element {
    /// Direction of motion at a point of it.
    fn tangent(&self, at: Point) -> Point {
        match self.arc {
            None => direction(self.start, self.end),
            Some((center, sweep)) => {
                let left = left_of(direction(center, at));
                [left[0] * sweep.signum(), left[1] * sweep.signum()]
            }
        }
    }

    /// Length, mm.
    pub(super) fn length(&self) -> f64 {
        match self.arc {
            None => distance(self.start, self.end),
            Some((center, sweep)) => distance(self.start, center) * sweep.abs(),
        }
    }

    pub(crate) fn start_tangent(&self) -> Point {
        self.tangent(self.start)
    }

    pub(crate) fn end_tangent(&self) -> Point {
        self.tangent(self.end)
    }

    /// One over the radius at the given end, positive for a turn to the left.
    pub(super) fn curvature(&self, at: Point) -> f64 {
        match self.arc {
            None => 0.0,
            Some((center, sweep)) => sweep.signum() / distance(center, at).max(f64::MIN_POSITIVE),
        }
    }

    /// The element at a distance to the left (negative: right); `None` if an arc is too small.
    pub(crate) fn offset(&self, left: f64) -> Option<Self> {
        if let Some((center, sweep)) = self.arc {
            let inward = left * sweep.signum();
            let smallest = distance(self.start, center).min(distance(self.end, center));
            if smallest <= inward {
                return None;
            }
        }
        let moved = |at: Point| along(at, left_of(self.tangent(at)), left);
        Some(Self {
            start: moved(self.start),
            end: moved(self.end),
            arc: self.arc,
        })
    }

    /// Where a point of it lies, as a fraction of the way. Of an arc of several turns, the place
    /// nearest to `1.0` for `from_end`, else nearest to `0.0`.
    fn fraction(&self, at: Point, from_end: bool) -> f64 {
        match self.arc {
            None => {
                let way = minus(self.end, self.start);
                dot(minus(at, self.start), way) / dot(way, way).max(f64::MIN_POSITIVE)
            }
            Some((center, sweep)) => {
                let base = if from_end { self.end } else { self.start };
                let (a, b) = (minus(base, center), minus(at, center));
                let turn = turn(a, b) * sweep.signum();
                // From the base: forward from the start, backward from the end.
                let turn = if from_end { -turn } else { turn };
                let slack = OVER * sweep.abs();
                let turn = if turn < -slack { turn + TAU } else { turn };
                let part = turn / sweep.abs();
                if from_end { 1.0 - part } else { part }
            }
        }
    }

    /// Ends it earlier.
    pub(crate) fn end_at(&mut self, at: Point) {
        let kept = self.fraction(at, true);
        self.end = at;
        if let Some((_, sweep)) = &mut self.arc {
            *sweep *= kept;
        }
    }

    /// Starts it later.
    pub(crate) fn start_at(&mut self, at: Point) {
        let left_out = self.fraction(at, false);
        self.start = at;
        if let Some((_, sweep)) = &mut self.arc {
            *sweep *= 1.0 - left_out;
        }
    }

    /// Starts it at a point next to its start, before it or after it.
    pub(super) fn start_beside(&mut self, at: Point) {
        if let Some((center, sweep)) = &mut self.arc {
            *sweep -= turn(minus(self.start, *center), minus(at, *center));
        }
        self.start = at;
    }
}

/// Where the tool turns round a convex corner in straight lines: the end of one side and the beginning of the
/// next one, each with its tangent, are moved along these, to one point where the corner is no sharper than a
/// right angle, else by the radius each.
pub(super) fn corner_points(
    (end, before): (Point, Point),
    (start, after): (Point, Point),
    radius: f64,
) -> [Point; 2] {
    let bend = turn(before, after).abs();
    let on = if bend <= core::f64::consts::FRAC_PI_2 {
        radius * (0.5 * bend).tan()
    } else {
        radius
    };
    [along(end, before, on), along(start, after, -on)]
}

/// Points common to the lines and circles two elements lie on.
fn common(a: &Element, b: &Element) -> [Option<Point>; 2] {
    match (a.arc, b.arc) {
        (None, None) => [lines(a, b), None],
        (None, Some((center, _))) => line_circle(a, center, distance(b.start, center)),
        (Some((center, _)), None) => line_circle(b, center, distance(a.end, center)),
        (Some((c1, _)), Some((c2, _))) => {
            circles(c1, distance(a.end, c1), c2, distance(b.start, c2))
        }
    }
}

/// Where two lines meet, both as long as need be.
pub(crate) fn lines(a: &Element, b: &Element) -> Option<Point> {
    let (u, v) = (a.end_tangent(), b.start_tangent());
    let across = cross(u, v);
    (across.abs() > 1e-12).then(|| along(a.end, u, cross(minus(b.start, a.end), v) / across))
}

fn line_circle(line: &Element, center: Point, radius: f64) -> [Option<Point>; 2] {
    let u = line.end_tangent();
    let foot = along(line.start, u, dot(minus(center, line.start), u));
    let height = distance(foot, center);
    let half = radius * radius - height * height;
    if half < 0.0 {
        return [None, None];
    }
    let half = half.sqrt();
    [Some(along(foot, u, half)), Some(along(foot, u, -half))]
}

fn circles(c1: Point, r1: f64, c2: Point, r2: f64) -> [Option<Point>; 2] {
    let between = distance(c1, c2);
    if between <= 1e-12 {
        return [None, None];
    }
    let toward = direction(c1, c2);
    let foot = (r1 * r1 - r2 * r2 + between * between) / (2.0 * between);
    let height = r1 * r1 - foot * foot;
    if height < 0.0 {
        return [None, None];
    }
    let middle = along(c1, toward, foot);
    let up = left_of(toward);
    let height = height.sqrt();
    [
        Some(along(middle, up, height)),
        Some(along(middle, up, -height)),
    ]
}

/// Where two offset elements meet before the corner between them: on both, and as near to the end
/// of the first as possible.
pub(crate) fn meet(a: &Element, b: &Element) -> Option<Point> {
    let within = |fraction: f64| (-OVER..=1.0 + OVER).contains(&fraction);
    common(a, b)
        .into_iter()
        .flatten()
        .filter(|at| within(a.fraction(*at, true)) && within(b.fraction(*at, false)))
        .max_by(|p, q| a.fraction(*p, true).total_cmp(&a.fraction(*q, true)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::{FRAC_PI_2, PI};

    fn line(start: Point, end: Point) -> Element {
        Element {
            start,
            end,
            arc: None,
        }
    }

    fn near(a: Point, b: Point) -> bool {
        distance(a, b) < 1e-12
    }

    #[test]
    fn offsets_keep_their_distance() {
        let east = line([0.0, 0.0], [10.0, 0.0]);
        assert_eq!(east.offset(2.0), Some(line([0.0, 2.0], [10.0, 2.0])));
        let turn = Element {
            start: [5.0, 0.0],
            end: [0.0, 5.0],
            arc: Some(([0.0, 0.0], FRAC_PI_2)),
        };
        let inside = turn.offset(2.0).expect("it fits");
        assert!(near(inside.start, [3.0, 0.0]) && near(inside.end, [0.0, 3.0]));
        let outside = turn.offset(-2.0).expect("it fits");
        assert!(near(outside.end, [0.0, 7.0]));
        assert!(turn.offset(5.0).is_none());
    }

    #[test]
    fn elements_meet_before_the_corner() {
        let east = line([0.0, 1.0], [10.0, 1.0]);
        let north = line([9.0, 0.0], [9.0, 10.0]);
        assert!(meet(&east, &north).is_some_and(|at| near(at, [9.0, 1.0])));
        assert!(meet(&line([0.0, 1.0], [8.0, 1.0]), &north).is_none());
        let arc = Element {
            start: [9.0, 0.0],
            end: [4.0, 5.0],
            arc: Some(([4.0, 0.0], FRAC_PI_2)),
        };
        let met = meet(&east, &arc).expect("it does");
        assert!(near(met, [4.0 + 24.0_f64.sqrt(), 1.0]));
    }

    #[test]
    fn an_arc_begins_a_little_earlier_or_later_and_ends_where_it_did() {
        for sweep in [FRAC_PI_2, -1.5 * PI, 2.5 * PI] {
            for turned in [-1e-3_f64, 1e-3] {
                let mut arc = Element {
                    start: [5.0, 0.0],
                    end: [0.0, 5.0],
                    arc: Some(([0.0, 0.0], sweep)),
                };
                arc.start_beside([5.001 * turned.cos(), 5.001 * turned.sin()]);
                let swept = arc.arc.expect("an arc").1;
                assert!((swept - (sweep - turned)).abs() < 1e-12, "{sweep} {turned}");
            }
        }
    }

    #[test]
    fn an_arc_is_trimmed_at_either_end() {
        let half = Element {
            start: [1.0, 0.0],
            end: [-1.0, 0.0],
            arc: Some(([0.0, 0.0], PI)),
        };
        let mut later = half;
        later.start_at([0.0, 1.0]);
        assert!((later.arc.expect("an arc").1 - FRAC_PI_2).abs() < 1e-12);
        let mut turns = Element {
            arc: Some(([0.0, 0.0], -3.0 * PI)),
            ..half
        };
        turns.end_at([0.0, 1.0]);
        // Clockwise from (1, 0), one turn and a half to (-1, 0): the last time through (0, 1) is
        // after a turn and a quarter... of the other way round: three quarters.
        let swept = turns.arc.expect("an arc").1;
        assert!((swept + 1.5 * PI).abs() < 1e-12, "{swept}");
    }
}
