//! Where on the program a frame is: the nearest point a little further on.
//!
//! Unlike the auditor this does not prove anything. It goes forward to the nearest point within the
//! reach of a period, which is right wherever the path does not come back on itself that closely,
//! and costs a few distances a frame.

use crate::AuditSettings;
use glidepath_geometry::{AxisVector, Prepared, feed_length, limit_along};
use glidepath_program::tolerance_norm;
use glidepath_program::{Frame, Item, ItemKind, Limits, Rate};
use std::collections::VecDeque;

/// A programmed move.
#[derive(Debug)]
struct Move {
    segment: Prepared,
    length_s: f64,
    /// The square of the displacement over all axes.
    displacement_2: f64,
    rate: Rate,
    tolerance_mm: f64,
}

/// Follows frames along the program.
#[derive(Debug)]
pub(super) struct Follow {
    limits: Limits,
    tolerance_mm: f64,
    /// The move at hand and those behind it.
    moves: VecDeque<Move>,
    /// Where on the first of them the last frame was.
    passed_s: f64,
    position: AxisVector,
    /// The move that was left last, and where on it: a motion that turns round at its end may be
    /// nearer to it for a while.
    left: Option<(Move, f64)>,
    /// How far the last frame was from there, if that had to be known.
    distance_mm: Option<f64>,
}

/// The program near a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Nearby {
    /// The speed wanted, overrides included, mm/s; infinite for a rapid at 100 %, and where there
    /// is no program.
    pub(super) feed_v: f64,
    pub(super) tolerance_mm: f64,
}

impl Follow {
    pub(super) fn new(settings: &AuditSettings) -> Self {
        Self {
            limits: settings.limits,
            tolerance_mm: settings.tolerance_mm,
            moves: VecDeque::new(),
            passed_s: 0.0,
            left: None,
            position: AxisVector::zeros(),
            distance_mm: None,
        }
    }

    pub(super) fn program(&mut self, item: &Item) {
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
            segment: segment.prepared(),
            length_s,
            displacement_2: (segment.end() - segment.start()).norm_squared(),
            rate,
            tolerance_mm,
        });
    }

    /// Goes on to a frame.
    pub(super) fn to(&mut self, frame: &Frame) -> Nearby {
        let step_s = feed_length(&(frame.position - self.position));
        self.position = frame.position;
        let Some(first) = self.moves.front() else {
            self.distance_mm = Some(0.0);
            return Nearby {
                feed_v: f64::INFINITY,
                tolerance_mm: self.tolerance_mm,
            };
        };
        let reach_s = self.passed_s + 2.0 * step_s + 4.0 * first.tolerance_mm;
        if self.moves.len() == 1 || first.length_s > reach_s {
            // Nothing to choose from.
            self.passed_s = first.nearest(&frame.position, self.passed_s);
            self.distance_mm = None;
        } else {
            self.choose(&frame.position, reach_s);
        }
        let here = self.moves.front();
        Nearby {
            feed_v: here.map_or(f64::INFINITY, |here| {
                self.feed_v(here, self.passed_s, frame)
            }),
            tolerance_mm: here.map_or(self.tolerance_mm, |here| here.tolerance_mm),
        }
    }

    /// Goes on to the nearest of the moves that begin within reach.
    fn choose(&mut self, position: &AxisVector, reach_s: f64) {
        let (mut best, mut best_s, mut best_mm) = (0, self.passed_s, f64::INFINITY);
        let (mut start_s, mut from_s) = (0.0, self.passed_s);
        for (index, candidate) in self.moves.iter().enumerate() {
            if start_s > reach_s {
                break;
            }
            let s = candidate.nearest(position, from_s);
            let distance_mm = candidate.distance_mm(position, s);
            if distance_mm <= best_mm {
                (best, best_s, best_mm) = (index, s, distance_mm);
            }
            start_s += candidate.length_s;
            from_s = 0.0;
        }
        if let Some(left) = self.moves.drain(..best).next_back() {
            let from_s = if best == 1 { self.passed_s } else { 0.0 };
            self.left = Some((left, from_s));
        }
        self.passed_s = best_s;
        self.distance_mm = Some(best_mm);
    }

    /// How far the last frame is from the program, mm.
    pub(super) fn deviation_mm(&self) -> f64 {
        let distance_mm = || {
            let here = self.moves.front();
            here.map_or(0.0, |here| here.distance_mm(&self.position, self.passed_s))
        };
        self.distance_mm.unwrap_or_else(distance_mm)
    }

    /// How far the last frame is from the program, mm, the move before counted in: where the program
    /// turns round, the nearest point further on is that of the way back too early.
    pub(super) fn least_deviation_mm(&self) -> f64 {
        let here_mm = self.deviation_mm();
        let left = self.left.as_ref().map(|(left, from_s)| {
            let s = left.nearest(&self.position, *from_s);
            left.distance_mm(&self.position, s)
        });
        left.map_or(here_mm, |left_mm| left_mm.min(here_mm))
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
                from_s + step_rad / per_s
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
        tolerance_norm(&(position - self.segment.position(s)))
    }
}
