//! The contour at a distance from a profile.
//!
//! What must not be touched is everything below the profile, and every point nearer to it than the
//! distance. As the profile is a function of *a*, what must not be touched is one too: the highest
//! of the lines parallel to its lines, of the arcs about the centres of its arcs, and of the arcs
//! about the corners between them.
//!
//! ```text
//!     ╭──────────╮  ← arc about the corner
//!     │ ┌──────┐ │
//!     │ │      │ ╰──────────  ← parallel
//!     │ │      └────────────    profile
//! ```
//!
//! That highest function is found by halves: those of two halves of the candidates are laid over
//! each other, and where they cross the higher one changes. Candidates that lie below others along
//! all of their way (in narrow valleys, around short pieces) leave no trace, so there is nothing to
//! trim, and the result cannot come too near to the profile.

use crate::execute::compensation::element::Point;
use crate::execute::lathe_cycle::pass_axes::{ContourPiece, PieceShape};

/// Stretches along *a* shorter than this are rounding, mm.
const SHORT_MM: f64 = 1e-9;
/// Steps in *b* up to this are rounding, mm.
const STEP_MM: f64 = 1e-7;

/// A candidate between two values of *a*.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Candidate {
    low: f64,
    high: f64,
    shape: PieceShape,
}

/// The contour at a distance ≥ 0 from a profile; `None` if nothing is left of it.
pub(crate) fn offset(profile: &[ContourPiece], distance_mm: f64) -> Option<Vec<ContourPiece>> {
    if distance_mm <= 0.0 {
        return Some(profile.to_vec());
    }
    let (first, last) = (profile.first()?, profile.last()?);
    let from = beside(first, first.start, distance_mm);
    let to = beside(last, last.end, distance_mm);
    let (low, high) = (to[0], from[0]);
    let mut candidates = Vec::with_capacity(2 * profile.len());
    for (index, piece) in profile.iter().enumerate() {
        let ends = [piece.start, piece.end].map(|end| beside(piece, end, distance_mm)[0]);
        let parallel = parallel(piece, distance_mm);
        candidates.extend(parallel.map(|shape| (ends[1], ends[0], shape)));
        if index > 0 {
            let corner = piece.start;
            let about = PieceShape::Hill(corner, distance_mm);
            candidates.push((corner[0] - distance_mm, corner[0] + distance_mm, about));
        }
    }
    let spans: Vec<Candidate> = candidates
        .into_iter()
        .map(|(from, to, shape)| Candidate {
            low: from.max(low),
            high: to.min(high),
            shape,
        })
        .filter(|span| span.high - span.low > SHORT_MM)
        .collect();
    let wall = |piece: &ContourPiece, free: Point| {
        (piece.start[0] - piece.end[0] <= SHORT_MM).then_some((free[1], piece.falls()))
    };
    let walls = [wall(first, from), wall(last, to)];
    joined(&highest(&spans), walls)
}

/// The direction from a point of a piece to the stock, times the distance, from the point.
fn beside(piece: &ContourPiece, at: Point, distance_mm: f64) -> Point {
    let along = match piece.shape {
        PieceShape::Line(p, q) => [q[1] - p[1], p[0] - q[0]],
        PieceShape::Hill(center, _) => [at[0] - center[0], at[1] - center[1]],
        PieceShape::Valley(center, _) => [center[0] - at[0], center[1] - at[1]],
    };
    let length = along[0].hypot(along[1]);
    if length > 0.0 {
        let share = distance_mm / length;
        [at[0] + share * along[0], at[1] + share * along[1]]
    } else {
        at
    }
}

/// The shape parallel to a piece; `None` for walls, and for valleys that are too narrow.
fn parallel(piece: &ContourPiece, distance_mm: f64) -> Option<PieceShape> {
    match piece.shape {
        PieceShape::Line(..) => Some(PieceShape::Line(
            beside(piece, piece.start, distance_mm),
            beside(piece, piece.end, distance_mm),
        )),
        PieceShape::Hill(center, radius) => Some(PieceShape::Hill(center, radius + distance_mm)),
        PieceShape::Valley(center, radius) if radius - distance_mm > SHORT_MM => {
            Some(PieceShape::Valley(center, radius - distance_mm))
        }
        PieceShape::Valley(..) => None,
    }
}

/// The highest of all candidates, by rising *a*.
fn highest(spans: &[Candidate]) -> Vec<Candidate> {
    if spans.len() < 2 {
        return spans.to_vec();
    }
    let (left, right) = spans.split_at(spans.len() / 2);
    higher(&highest(left), &highest(right))
}

/// The higher of two functions, each given by spans of rising *a* that do not overlap.
fn higher(one: &[Candidate], other: &[Candidate]) -> Vec<Candidate> {
    let mut breaks: Vec<f64> = one
        .iter()
        .chain(other)
        .flat_map(|span| [span.low, span.high])
        .collect();
    breaks.sort_by(f64::total_cmp);
    let mut found = Vec::with_capacity(one.len() + other.len());
    let (mut ones, mut others) = (one.iter().peekable(), other.iter().peekable());
    for (&low, &high) in breaks.iter().zip(breaks.iter().skip(1)) {
        if high - low <= SHORT_MM {
            continue;
        }
        let middle = 0.5 * (low + high);
        while ones.next_if(|span| span.high <= middle).is_some() {}
        while others.next_if(|span| span.high <= middle).is_some() {}
        let here = |span: &&Candidate| (span.low <= middle).then_some(span.shape);
        match (ones.peek().and_then(here), others.peek().and_then(here)) {
            (Some(shape), None) | (None, Some(shape)) => push(&mut found, low, high, shape),
            (Some(a), Some(b)) => push_higher(&mut found, low, high, [a, b]),
            (None, None) => {}
        }
    }
    found
}

/// The higher of two curves, which changes where they cross.
fn push_higher(found: &mut Vec<Candidate>, low: f64, high: f64, curves: [PieceShape; 2]) {
    let mut cuts = vec![low, high];
    let inside = |a: &f64| *a > low + SHORT_MM && *a < high - SHORT_MM;
    cuts.extend(
        crossings(&curves[0], &curves[1])
            .into_iter()
            .flatten()
            .filter(inside),
    );
    cuts.sort_by(f64::total_cmp);
    for (&from, &to) in cuts.iter().zip(cuts.iter().skip(1)) {
        let middle = 0.5 * (from + to);
        let first = curves[0].at(middle) >= curves[1].at(middle);
        push(found, from, to, curves[usize::from(!first)]);
    }
}

fn push(found: &mut Vec<Candidate>, low: f64, high: f64, shape: PieceShape) {
    if let Some(last) = found.last_mut()
        && last.shape == shape
        && low - last.high <= SHORT_MM
    {
        last.high = high;
        return;
    }
    found.push(Candidate { low, high, shape });
}

/// Values of *a* at which the lines or circles of two curves meet.
fn crossings(one: &PieceShape, other: &PieceShape) -> [Option<f64>; 2] {
    let circle = |shape: &PieceShape| match shape {
        PieceShape::Line(..) => None,
        PieceShape::Hill(center, radius) | PieceShape::Valley(center, radius) => {
            Some((*center, *radius))
        }
    };
    match (one, other) {
        (PieceShape::Line(p, q), PieceShape::Line(r, s)) => {
            let slopes = [(p, q), (r, s)].map(|(p, q)| (q[1] - p[1]) / (q[0] - p[0]));
            let a = p[0] + (other.at(p[0]) - p[1]) / (slopes[0] - slopes[1]);
            [a.is_finite().then_some(a), None]
        }
        (PieceShape::Line(p, q), round) | (round, PieceShape::Line(p, q)) => circle(round)
            .map_or([None, None], |(center, radius)| {
                line_circle(*p, *q, center, radius)
            }),
        (one, other) => match (circle(one), circle(other)) {
            (Some(one), Some(other)) => circles(one, other),
            _ => [None, None],
        },
    }
}

fn line_circle(p: Point, q: Point, center: Point, radius: f64) -> [Option<f64>; 2] {
    let length = (q[0] - p[0]).hypot(q[1] - p[1]);
    let along = [(q[0] - p[0]) / length, (q[1] - p[1]) / length];
    let foot = (center[0] - p[0]) * along[0] + (center[1] - p[1]) * along[1];
    let height = (center[0] - p[0]) * along[1] - (center[1] - p[1]) * along[0];
    let half = (radius * radius - height * height).sqrt();
    [foot - half, foot + half].map(|s| {
        let a = p[0] + s * along[0];
        a.is_finite().then_some(a)
    })
}

fn circles((c1, r1): (Point, f64), (c2, r2): (Point, f64)) -> [Option<f64>; 2] {
    let apart = [c2[0] - c1[0], c2[1] - c1[1]];
    let squared = apart[0] * apart[0] + apart[1] * apart[1];
    let share = 0.5 * (1.0 + (r1 * r1 - r2 * r2) / squared);
    let rise = (r1 * r1 / squared - share * share).sqrt();
    [rise, -rise].map(|rise| {
        let a = c1[0] + share * apart[0] - rise * apart[1];
        a.is_finite().then_some(a)
    })
}

/// The pieces of the contour on the way to smaller *a*, with walls where it jumps. `walls`: the
/// levels of the free ends of walls at which it begins and ends, and whether they fall.
fn joined(spans: &[Candidate], walls: [Option<(f64, bool)>; 2]) -> Option<Vec<ContourPiece>> {
    let highest = spans.last()?;
    let mut at = [highest.high, highest.shape.at(highest.high)];
    let mut pieces: Vec<ContourPiece> = Vec::with_capacity(spans.len() + 2);
    if let Some((level, falls)) = walls[0] {
        at[1] = if falls {
            at[1].max(level)
        } else {
            at[1].min(level)
        };
    }
    for span in spans.iter().rev() {
        let start = [at[0], span.shape.at(span.high)];
        if (start[1] - at[1]).abs() > STEP_MM {
            pieces.push(ContourPiece::line(at, start));
            at = start;
        }
        let end = [span.low, span.shape.at(span.low)];
        let shape = match span.shape {
            PieceShape::Line(..) => PieceShape::Line(at, end),
            shape => shape,
        };
        pieces.push(ContourPiece {
            start: at,
            end,
            shape,
        });
        at = end;
    }
    let beyond = |(level, falls): &(f64, bool)| (*level < at[1]) == *falls;
    if let Some((level, _)) = walls[1].filter(beyond) {
        pieces.push(ContourPiece::line(at, [at[0], level]));
    }
    Some(pieces)
}
