//! The place on the program of each frame: the nearest point a little further on.
//!
//! ```text
//!        earliest                here            as far as a period may reach
//!  ─────────┼─────────────────────┼───────────────────────┤
//!           └───── how far the frame is from the program ─┘
//!                                 └── where it is now ─────┘
//! ```
//!
//! Unlike the auditor this does not prove anything. It goes forward to the nearest point within the
//! reach of a period, which is right wherever the path does not come back on itself that closely,
//! and costs a few distances a frame. Where it does come back, the nearest point is that of a later
//! move too early. So the earliest place is kept, too, at which the motion may still be within
//! tolerance, and the distance is that from all that lies between: it is never more than what the
//! auditor allows the motion.

use crate::AuditSettings;
use glidepath_geometry::{AxisVector, Prepared, Segment, feed_length, limit_along};
use glidepath_program::tolerance_norm;
use glidepath_program::{DirectionTolerance, Frame, Item, ItemKind, Limits, Rate};
use std::collections::VecDeque;

/// A tolerance counts as kept up to this factor.
const WITHIN_R: f64 = 1.0 + 1e-3;
/// How much further back a place on an arc may be than on a line.
const EARLIER_R: f64 = 1.5;

/// A programmed move.
#[derive(Debug)]
pub(crate) struct Move {
    /// Moves before it.
    pub(crate) number: u64,
    pub(crate) programmed: Segment,
    segment: Prepared,
    pub(crate) length_s: f64,
    /// The least and the largest coordinate of each axis.
    extent: (AxisVector, AxisVector),
    /// The square of the displacement over all axes.
    displacement_2: f64,
    rate: Rate,
    pub(crate) tolerance_mm: f64,
    /// What a degree of the rotary axes counts for, mm.
    mm_per_deg: f64,
    /// How near the motion is at least while it is on the move: at its start the tolerance of the
    /// move before holds.
    within_mm: f64,
}

/// Follows frames along the program.
#[derive(Debug)]
pub(crate) struct Follow {
    limits: Limits,
    tolerance_mm: f64,
    direction: DirectionTolerance,
    /// The tolerance of the move fed last.
    last_tolerance_mm: f64,
    /// Moves fed.
    count: u64,
    /// The moves from the earliest that the motion may be on, and the one before them.
    moves: VecDeque<Move>,
    before: Option<Move>,
    /// Where on the first of them it may be at the earliest.
    earliest_s: f64,
    /// The move at hand, and where on it the last frame was.
    here: usize,
    here_s: f64,
    /// Up to this move, itself left out, they begin within reach of it.
    ahead: usize,
    position: AxisVector,
    /// How far the last frame was from there, and from all it may be on.
    distance_mm: f64,
    least_mm: f64,
    /// The points of the program between the frame before and the last one: the ends of its moves, and some of
    /// what is no line.
    passed: Vec<ProgramPoint>,
    /// Up to where what is no line was looked at: the move by its number, and path position on it, mm.
    noted: (u64, f64),
}

/// Points of what is no line are noted no nearer to each other than for this length of path, mm. At a slow feed the
/// motion takes thousands of frames to leave a micrometre behind, and every point stays in mind until it has.
const LEAST_NOTED_S: f64 = 1e-3;

/// A place on the program: moves before it, and path position on its move.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(crate) struct ProgramPlace(u64, f64);

/// A point of the program.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProgramPoint {
    pub(crate) place: ProgramPlace,
    pub(crate) position: AxisVector,
}

/// The program near a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Nearby {
    /// The speed wanted, overrides included, mm/s; infinite for a rapid at 100 %, and where there
    /// is no program.
    pub(crate) feed_v: f64,
    pub(crate) tolerance_mm: f64,
}

impl Follow {
    pub(crate) fn new(settings: &AuditSettings) -> Self {
        Self {
            limits: settings.limits,
            tolerance_mm: settings.tolerance_mm,
            direction: settings.direction,
            last_tolerance_mm: 0.0,
            count: 0,
            moves: VecDeque::new(),
            before: None,
            earliest_s: 0.0,
            here: 0,
            here_s: 0.0,
            ahead: 0,
            position: AxisVector::zeros(),
            distance_mm: 0.0,
            least_mm: 0.0,
            passed: Vec::new(),
            noted: (u64::MAX, 0.0),
        }
    }

    pub(crate) fn program(&mut self, item: &Item) {
        let ItemKind::Move {
            segment,
            rate,
            mode,
        } = item.kind
        else {
            return;
        };
        let length_s = segment.length();
        if length_s <= 0.0 {
            return;
        }
        let tolerance_mm = mode.tolerance_mm(self.tolerance_mm);
        self.moves.push_back(Move {
            number: self.count,
            programmed: segment,
            segment: segment.prepared(),
            length_s,
            extent: segment.bounding_box(),
            displacement_2: (segment.end() - segment.start()).norm_squared(),
            rate,
            tolerance_mm,
            mm_per_deg: self.direction.mm_per_deg(tolerance_mm),
            within_mm: tolerance_mm.max(self.last_tolerance_mm) * WITHIN_R,
        });
        self.last_tolerance_mm = tolerance_mm;
        self.count += 1;
    }

    /// Goes on to a position.
    pub(crate) fn go(&mut self, position: &AxisVector) {
        let step_s = feed_length(&(position - self.position));
        self.position = *position;
        self.passed.clear();
        let Some(here) = self.moves.get(self.here) else {
            (self.distance_mm, self.least_mm) = (0.0, 0.0);
            return;
        };
        let reach_s = self.here_s + 2.0 * step_s + 4.0 * here.tolerance_mm;
        let from = (self.here, self.here_s);
        self.choose(position, reach_s);
        self.pass(from);
        self.leave(position);
    }

    /// Notes what lies between a place and the one at hand.
    fn pass(&mut self, (first, mut from_s): (usize, f64)) {
        for (index, passed) in self.moves.iter().enumerate().skip(first) {
            let is_here = index == self.here;
            let to_s = if is_here {
                self.here_s
            } else {
                passed.length_s
            };
            let point = |s: f64| ProgramPoint {
                place: ProgramPlace(passed.number, s),
                position: passed.segment.position(s),
            };
            let noted_s = Some(self.noted.1).filter(|_| self.noted.0 == passed.number);
            let since_s = noted_s.unwrap_or(from_s);
            let is_straight = matches!(passed.segment, Prepared::Line(_));
            if !is_straight && to_s > since_s && to_s - since_s >= LEAST_NOTED_S {
                let quarter_s = 0.25 * (to_s - since_s);
                let between = [1.0, 2.0, 3.0].map(|i| point(since_s + i * quarter_s));
                self.passed.extend(between);
                self.noted = (passed.number, to_s);
            }
            if is_here {
                break;
            }
            self.passed.push(point(passed.length_s));
            from_s = 0.0;
        }
    }

    /// Goes on to a frame.
    pub(crate) fn to(&mut self, frame: &Frame) -> Nearby {
        self.go(&frame.position);
        let here = self.moves.get(self.here);
        Nearby {
            feed_v: here.map_or(f64::INFINITY, |here| self.feed_v(here, self.here_s, frame)),
            tolerance_mm: here.map_or(self.tolerance_mm, |here| here.tolerance_mm),
        }
    }

    /// Goes on to the nearest of the moves that begin within reach.
    fn choose(&mut self, position: &AxisVector, reach_s: f64) {
        let (mut best, mut best_s, mut best_mm) = (self.here, self.here_s, f64::INFINITY);
        let (mut start_s, mut from_s) = (0.0, self.here_s);
        for (index, candidate) in self.moves.iter().enumerate().skip(self.here) {
            if start_s > reach_s {
                break;
            }
            self.ahead = index + 1;
            let s = candidate.nearest(position, from_s);
            let distance_mm = candidate.distance_mm(position, s);
            if distance_mm <= best_mm {
                (best, best_s, best_mm) = (index, s, distance_mm);
            }
            start_s += candidate.length_s;
            from_s = 0.0;
        }
        (self.here, self.here_s, self.distance_mm) = (best, best_s, best_mm);
    }

    /// Leaves the places behind that the motion cannot be on any more, and looks how far it is from
    /// the others.
    fn leave(&mut self, position: &AxisVector) {
        self.least_mm = self.distance_mm;
        let mut is_left = true;
        let mut left = 0;
        let mut from_s = self.earliest_s;
        for (index, candidate) in self.moves.iter().enumerate().take(self.here + 1) {
            let s = candidate.nearest(position, from_s);
            let distance_mm = candidate.distance_mm(position, s);
            self.least_mm = self.least_mm.min(distance_mm);
            let left_mm = candidate.within_mm - distance_mm;
            if is_left && left_mm >= 0.0 {
                is_left = false;
                left = index;
                // Where it comes within the tolerance of the frame; along an arc a little earlier.
                let half_s = (left_mm * (candidate.within_mm + distance_mm)).sqrt();
                self.earliest_s = (s - EARLIER_R * half_s).max(from_s);
            }
            from_s = 0.0;
        }
        if is_left {
            // Out of tolerance: it is taken up again where it seems to be.
            (left, self.earliest_s) = (self.here, self.here_s);
        }
        if let Some(before) = self.moves.drain(..left).next_back() {
            self.before = Some(before);
        }
        self.here -= left;
        self.ahead -= left;
    }

    /// The points of the program between the frame before and the last one.
    pub(crate) fn passed(&self) -> &[ProgramPoint] {
        &self.passed
    }

    /// The earliest place at which the motion may be.
    pub(crate) fn earliest(&self) -> ProgramPlace {
        let first = self.moves.front();
        ProgramPlace(
            first.map_or(self.count, |first| first.number),
            self.earliest_s,
        )
    }

    /// The move at hand.
    pub(crate) fn here(&self) -> Option<&Move> {
        self.moves.get(self.here)
    }

    /// Where on it the last frame was.
    pub(crate) const fn here_s(&self) -> f64 {
        self.here_s
    }

    /// The move before the one at hand.
    pub(crate) fn previous(&self) -> Option<&Move> {
        match self.here.checked_sub(1) {
            Some(index) => self.moves.get(index),
            None => self.before.as_ref(),
        }
    }

    /// The move behind the one at hand, if it has been fed.
    pub(crate) fn next(&self) -> Option<&Move> {
        self.moves.get(self.here + 1)
    }

    /// The least and the largest coordinate of each axis on what the motion may be on; none without
    /// a program.
    pub(crate) fn extent(&self) -> Option<(AxisVector, AxisVector)> {
        let first = self.moves.front()?;
        let (mut low, mut high) = match &first.segment {
            Prepared::Line(line) => {
                let from = line.position(self.earliest_s);
                (from.inf(&line.line().end), from.sup(&line.line().end))
            }
            Prepared::Arc(_) | Prepared::Curve(_) => first.extent,
        };
        for ahead in self.moves.iter().take(self.ahead).skip(1) {
            (low, high) = (low.inf(&ahead.extent.0), high.sup(&ahead.extent.1));
        }
        Some((low, high))
    }

    /// How far the last frame is from the place it is at, mm.
    pub(crate) const fn deviation_mm(&self) -> f64 {
        self.distance_mm
    }

    /// How far the last frame is from the program, mm: from all places at which it may be.
    pub(crate) const fn least_deviation_mm(&self) -> f64 {
        self.least_mm
    }

    fn feed_v(&self, here: &Move, s: f64, frame: &Frame) -> f64 {
        let programmed_v = match here.rate.feed_v() {
            Some(feed_v) => feed_v * frame.planned_override,
            None if frame.planned_override >= 1.0 => f64::INFINITY,
            None => {
                let axes_v = limit_along(&here.segment.jet(s).d1, &self.limits.velocity);
                axes_v * frame.planned_override
            }
        };
        programmed_v.min(here.rate.most_v())
    }
}

impl Move {
    /// Whether it has no feedrate.
    pub(crate) const fn is_rapid(&self) -> bool {
        self.rate.is_rapid()
    }

    /// Path position of the point nearest to a position, from `from_s` on. On an arc, within half a
    /// turn of `from_s`.
    fn nearest(&self, position: &AxisVector, from_s: f64) -> f64 {
        let s = match &self.segment {
            Prepared::Line(line) => {
                let along = line.displacement();
                let u = along.dot(&(position - line.line().start)) / self.displacement_2;
                u * self.length_s
            }
            Prepared::Arc(arc) => {
                let (start_angle_rad, arc) = (arc.start_angle_rad(), arc.arc());
                let (first, second) = arc.plane.axes();
                let angle_rad = (position[second.index()] - arc.center[1])
                    .atan2(position[first.index()] - arc.center[0]);
                let per_s = arc.sweep_rad / self.length_s;
                let from_rad = start_angle_rad + per_s * from_s;
                let turn = core::f64::consts::TAU;
                let step_rad = (angle_rad - from_rad + 0.5 * turn).rem_euclid(turn) - 0.5 * turn;
                // The angle alone is right on circles; the nearest place on a helix is beside it.
                let mut s = from_s + step_rad / per_s;
                for _ in 0..2 {
                    let jet = self.segment.jet(s.max(0.0).min(self.length_s));
                    let gap = position - jet.position;
                    s += gap.dot(&jet.d1) / (jet.d1.norm_squared() - gap.dot(&jet.d2)).max(0.5);
                }
                s
            }
            Prepared::Curve(curve) => {
                // A piece turns little: from the place on its chord, Newton's method.
                let way = curve.end - curve.start;
                let mut s =
                    way.dot(&(position - curve.start)) / self.displacement_2 * self.length_s;
                for _ in 0..3 {
                    let jet = curve.jet(s.max(0.0).min(self.length_s));
                    let gap = position - jet.position;
                    s += gap.dot(&jet.d1) / (jet.d1.norm_squared() - gap.dot(&jet.d2)).max(0.5);
                }
                s
            }
        };
        s.max(from_s).min(self.length_s)
    }

    /// How far a position is from a place on the move, mm.
    fn distance_mm(&self, position: &AxisVector, s: f64) -> f64 {
        tolerance_norm(&(position - self.segment.position(s)), self.mm_per_deg)
    }
}
