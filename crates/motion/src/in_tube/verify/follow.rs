//! Does a motion follow the path? The check that every motion passes before it is handed out.
//!
//! The motion is the polyline through its positions at the periods, and, where time runs slower,
//! the curve between them ([`super::between_periods`]). It follows the path if both can be run
//! through together, neither ever going back, without being further apart than the tolerance: that
//! keeps every point of the motion near the path, and every vertex of the path near the motion, in
//! order. All pairs (point of path, point of motion) that can be reached so are found chord by
//! chord of the motion:
//!
//! ```text
//!   path ▲
//!        │    ┌───┬───┐    In one cell (chord × piece) the pairs that are near are a convex set, so
//!    n+1 │    │   │ ╱ │    only its edges matter: what is reached on the right edge and on top
//!        │    ├───┼───┤    follows from what is reached on the left edge and at the bottom.
//!    n   │    │ ╱─│─  │    [`Reachable`] holds the right edges: the part of the path at which the
//!        └────┴───┴───┴─▶  other walker may be while the motion is at its present position.
//!               motion
//! ```
//!
//! This is the reachable set of the Fréchet distance (Alt and Godau 1995), with the tolerance of
//! each piece as its threshold. Distances are taken by groups of axes: XYZ together, UVW together,
//! each rotary axis by itself.

use super::beside::{Beside, near};
use super::between_periods::BetweenPeriods;
use super::parameter_range::ParameterRange;
use crate::in_tube::path::{Displacement, ReferencePath, TubePiece};
use glidepath_geometry::AxisVector;

/// The places on the path the motion may be at: a range of each of some consecutive pieces.
#[derive(Debug, Clone)]
pub(crate) struct Reachable {
    /// The first piece.
    pub(crate) first: usize,
    pub(crate) ranges: Vec<ParameterRange>,
}

impl Reachable {
    /// At the start of a piece.
    pub(crate) fn start_of(index: usize) -> Self {
        Self {
            first: index,
            ranges: vec![ParameterRange { from: 0.0, to: 0.0 }],
        }
    }

    /// The furthest piece it has a part of.
    pub(crate) fn last(&self) -> usize {
        self.first + self.ranges.len().saturating_sub(1)
    }

    /// True if the end of the path has been reached.
    pub(crate) fn is_at_end(&self, reference_path: &ReferencePath) -> bool {
        reference_path.is_last(self.last()) && self.is_at_end_of(self.last())
    }

    /// True if the end of piece `index` has been reached, and no later piece.
    pub(crate) fn is_at_end_of(&self, index: usize) -> bool {
        self.last() == index && self.ranges.last().is_some_and(|range| range.to >= 1.0)
    }

    /// The place nearest to a position that is not before `(piece, parameter)`.
    pub(crate) fn nearest(
        &self,
        reference_path: &ReferencePath,
        position: &AxisVector,
        not_before: (usize, f64),
    ) -> (usize, f64) {
        let mut best = (f64::INFINITY, not_before);
        for (offset, range) in self.ranges.iter().enumerate() {
            let index = self.first + offset;
            let Some(piece) = reference_path.get(index) else {
                continue;
            };
            if index < not_before.0 || range.is_empty() {
                continue;
            }
            let along = piece.end - piece.start;
            let foot = (position - piece.start).dot(&along) / along.norm_squared();
            let u = if foot.is_finite() {
                foot.clamp(range.from, range.to)
            } else {
                range.to
            };
            let u = if index == not_before.0 {
                u.max(not_before.1)
            } else {
                u
            };
            let distance_r = piece.distance_r(&(position - (piece.start + along * u)));
            if distance_r < best.0 {
                best = (distance_r, (index, u));
            }
        }
        best.1
    }

    /// How far a position is from the program along the part of piece `index` that has been reached, mm or
    /// degrees; `None` if none of it has.
    pub(super) fn away_mm(
        &self,
        reference_path: &ReferencePath,
        index: usize,
        position: &AxisVector,
    ) -> Option<f64> {
        let range = self.ranges.get(index.checked_sub(self.first)?)?;
        let piece = reference_path.get(index).filter(|_| !range.is_empty())?;
        let along = piece.end - piece.start;
        let foot = (position - piece.start).dot(&along) / along.norm_squared();
        let u = if foot.is_finite() {
            foot.clamp(range.from, range.to)
        } else {
            range.to
        };
        let program = piece.start + along * u + piece.sagitta_vector * (4.0 * u * (1.0 - u));
        Some(piece.in_mm(Displacement::of(&(position - program))))
    }

    fn trim(&mut self) {
        while self.ranges.last().is_some_and(|range| range.is_empty()) {
            self.ranges.pop();
        }
        let empty = self
            .ranges
            .iter()
            .take_while(|range| range.is_empty())
            .count();
        self.ranges.drain(..empty);
        self.first += empty;
    }
}

/// Walks a motion along a path: its chords, and the curve between them.
#[derive(Debug, Clone)]
pub(crate) struct Follower {
    pub(crate) reachable: Reachable,
    /// Pieces from this one on are not looked at, though they may be known: what comes out must not
    /// depend on when they became known.
    pub(crate) end: usize,
    /// Places of the curve.
    curve: Reachable,
    /// Places of chords that begin at other parts of a period, and where their last ones end.
    phases: [Reachable; PHASES.len()],
    phase_ends: Option<[AxisVector; PHASES.len()]>,
    /// [`BetweenPeriods::sagittas`] of the last period.
    sagittas: [AxisVector; 2],
    /// Memory for the places after a step.
    next: Reachable,
    curve_next: [Reachable; 2],
    phases_next: [Reachable; PHASES.len()],
}

/// Parts of a period at which chords begin, if time has run slower for a while.
const PHASES: [f64; 7] = [0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875];

impl Follower {
    pub(crate) fn new(reachable: Reachable, end: usize) -> Self {
        Self {
            end,
            curve: reachable.clone(),
            next: reachable.clone(),
            curve_next: [reachable.clone(), reachable.clone()],
            phases: PHASES.map(|_| reachable.clone()),
            phases_next: PHASES.map(|_| reachable.clone()),
            phase_ends: None,
            sagittas: [AxisVector::zeros(); 2],
            reachable,
        }
    }

    /// Another one at the same place that looks at pieces up to `end`.
    pub(crate) fn to(&self, end: usize) -> Self {
        Self {
            end,
            ..self.clone()
        }
    }

    /// The first piece that matters to what comes.
    pub(crate) fn first(&self) -> usize {
        let phases = self.phases.iter().map(|reachable| reachable.first);
        phases.fold(self.reachable.first.min(self.curve.first), usize::min)
    }

    /// The furthest piece that all walkers have a part of.
    pub(crate) fn least_reach(&self) -> usize {
        let phases = self.phases.iter().map(Reachable::last);
        phases.fold(self.reachable.last().min(self.curve.last()), usize::min)
    }

    /// Goes on by a period. False if that leaves the path; then the place is what it was.
    pub(crate) fn step(
        &mut self,
        reference_path: &ReferencePath,
        bend: &BetweenPeriods<'_>,
    ) -> bool {
        let (from, to) = (&bend.from.position, &bend.to.position);
        let sagittas = bend.sagittas();
        let shift = Shift::of([self.sagittas, sagittas]);
        let Some(piece) = reference_path.get(self.reachable.first) else {
            return false;
        };
        if !walk(
            reference_path,
            self.end,
            &self.reachable,
            &mut self.next,
            ([from, to], Some(&shift)),
        ) {
            return false;
        }
        let [curve, next] = &mut self.curve_next;
        curve.clone_from(&self.curve);
        let phase_ends = PHASES.map(|phase| bend.at(phase));
        let phase_starts = self.phase_ends.unwrap_or([*from; PHASES.len()]);
        for (k, next) in self.phases_next.iter_mut().enumerate() {
            let way = [&phase_starts[k], &phase_ends[k]];
            if !walk(
                reference_path,
                self.end,
                &self.phases[k],
                next,
                (way, Some(&shift)),
            ) {
                return false;
            }
        }
        let mut from = *from;
        for to in bend.points(piece) {
            if !walk(reference_path, self.end, curve, next, ([&from, &to], None)) {
                return false;
            }
            core::mem::swap(curve, next);
            from = to;
        }
        core::mem::swap(&mut self.curve, curve);
        core::mem::swap(&mut self.phases, &mut self.phases_next);
        self.phase_ends = Some(phase_ends);
        self.sagittas = sagittas;
        core::mem::swap(&mut self.reachable, &mut self.next);
        true
    }
}

/// Goes straight from one position to the next, nearer to vertices than the tolerance by what a
/// chord that begins a little earlier or later may be further off; `next` is where that leads.
/// False if it leaves the path.
fn walk(
    reference_path: &ReferencePath,
    end: usize,
    reachable: &Reachable,
    next: &mut Reachable,
    (way, shift): ([&AxisVector; 2], Option<&Shift>),
) -> bool {
    next.ranges.clear();
    next.first = reachable.first;
    let known = reachable.first + reachable.ranges.len();
    let mut bottom = ParameterRange::EMPTY;
    let chord = Chord::new(way);
    let mut index = reachable.first;
    while index < known || (index < end && !bottom.is_empty()) {
        let Some(piece) = reference_path.get(index) else {
            break;
        };
        let left = match reachable.ranges.get(index - reachable.first) {
            Some(range) => *range,
            None => ParameterRange::EMPTY,
        };
        let (right, top) = cell(
            piece,
            (corner_tolerance(reference_path, index), shift),
            left,
            bottom,
            &chord,
        );
        next.ranges.push(right);
        bottom = top;
        index += 1;
    }
    next.trim();
    !next.ranges.is_empty()
}

/// What chords may be further off a vertex that begin up to half a step of [`PHASES`] earlier or
/// later.
///
/// Of a motion q of constant acceleration, a chord over one period T is off by e = aT²/2·λ(1 − λ)
/// at its parameter λ. One that begins by δ·T later has the same time at λ − δ, where it is off by
/// aT²/2·δ(1 − 2λ + δ) less: so much the nearest chords can hide, and most at the ends of a chord.
/// A change of acceleration adds, to first order in δ, jT³/6·δ/2.
#[derive(Debug)]
struct Shift {
    /// The largest of aT²/8, and of its changes.
    sagitta: Displacement,
    change: Displacement,
}

/// Half a step of [`PHASES`].
const HALF_STEP: f64 = 0.0625;
/// Parts round the middle of a chord in which it is asked whether the chord is near enough.
const MIDDLES: [f64; 3] = [0.5, 0.25, 0.0625];

impl Shift {
    /// From [`BetweenPeriods::sagittas`] of the two periods that a chord has a part of.
    fn of(periods: [[AxisVector; 2]; 2]) -> Self {
        let all = periods.iter().flatten().map(Displacement::of);
        let changes = periods.iter().map(|[a, b]| Displacement::of(&(b - a)));
        Self {
            sagitta: all.fold(Displacement::default(), Displacement::max),
            change: changes.fold(Displacement::default(), Displacement::max),
        }
    }

    /// The part of a chord from which the vertex at the end of a piece, beside it, is within
    /// `corner_r` tolerances, less what holds there. Distance and loss are convex, so it is a
    /// range, and the parts of it found are joined.
    fn near_vertex(&self, piece: &TubePiece, corner_r: f64, beside: &Beside) -> ParameterRange {
        let sagitta_r = piece.in_tolerances(self.sagitta);
        let change_r = piece.in_tolerances(self.change);
        let mut joined = ParameterRange::EMPTY;
        for half in MIDDLES {
            let loss_r = 4.0 * HALF_STEP * (2.0 * half + HALF_STEP) * sagitta_r
                + 2.0 / 3.0 * HALF_STEP * change_r;
            let middle = ParameterRange {
                from: 0.5 - half,
                to: 0.5 + half,
            };
            let share_r = (corner_r - loss_r).max(0.0);
            let part = beside.within(share_r).cut(middle);
            if !part.is_empty() {
                joined = ParameterRange {
                    from: joined.from.min(part.from),
                    to: joined.to.max(part.to),
                };
            }
        }
        joined
    }
}

/// Share of a piece's own tolerance that holds at its end: the smaller one of both sides.
fn corner_tolerance(reference_path: &ReferencePath, index: usize) -> f64 {
    match (reference_path.get(index), reference_path.get(index + 1)) {
        (Some(piece), Some(next)) => (next.tolerance_mm / piece.tolerance_mm)
            .min(next.tolerance_deg / piece.tolerance_deg)
            .min(1.0),
        _ => 1.0,
    }
}

/// A chord of the motion.
struct Chord<'a> {
    ends: [&'a AxisVector; 2],
    /// In XYZ, and a little more than that.
    length_mm: f64,
}

/// What rounding may make of a length.
const ROUNDING_R: f64 = 1.0 + 1e-9;

impl<'a> Chord<'a> {
    fn new(ends: [&'a AxisVector; 2]) -> Self {
        Self {
            ends,
            length_mm: distance_2(ends[0], ends[1]).sqrt() * ROUNDING_R,
        }
    }

    /// True if nothing of it can be within a tolerance of a point, for what XYZ tell: most vertices
    /// need no other look.
    fn is_far_from(&self, point: &AxisVector, tolerance_mm: f64) -> bool {
        let reach_mm = self.length_mm + tolerance_mm;
        distance_2(self.ends[0], point) > reach_mm * reach_mm * ROUNDING_R
    }
}

/// Square of the distance in XYZ.
fn distance_2(from: &AxisVector, to: &AxisVector) -> f64 {
    let square = |i: usize| (to[i] - from[i]) * (to[i] - from[i]);
    square(0) + square(1) + square(2)
}

/// What is reached on the right edge and on top of a cell.
fn cell(
    piece: &TubePiece,
    (corner_r, shift): (f64, Option<&Shift>),
    left: ParameterRange,
    bottom: ParameterRange,
    chord: &Chord<'_>,
) -> (ParameterRange, ParameterRange) {
    if left.is_empty() && bottom.is_empty() {
        return (ParameterRange::EMPTY, ParameterRange::EMPTY);
    }
    let [from, to] = chord.ends;
    let mut right = near(piece, [&piece.start, &piece.end], to);
    if bottom.is_empty() {
        right = right.not_before(left.from);
    }
    if chord.is_far_from(&piece.end, piece.tolerance_mm) {
        return (right, ParameterRange::EMPTY);
    }
    let beside = Beside::new(piece, [from, to], &piece.end);
    let mut top = beside.within(corner_r);
    if let Some(shift) = shift.filter(|_| !top.is_empty()) {
        top = shift.near_vertex(piece, corner_r, &beside);
    }
    if left.is_empty() {
        top = top.not_before(bottom.from);
    }
    (right, top)
}
