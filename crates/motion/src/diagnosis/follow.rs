//! Where on the program a frame is: the nearest point a little further on.
//!
//! Unlike the auditor this does not prove anything. It goes forward to the nearest point within the
//! reach of a period, which is right wherever the path does not come back on itself that closely,
//! and costs a few distances a frame.

use crate::audit::AuditSettings;
use crate::joint::tolerance_norm;
use crate::{Frame, Item, ItemKind, Limits, PathMode, Rate};
use glidepath_geometry::{AxisVector, Segment, feed_length, limit_along};
use std::collections::VecDeque;

/// A programmed move.
#[derive(Debug)]
struct Move {
    segment: Segment,
    length_s: f64,
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
}

/// The program near a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Nearby {
    /// The speed wanted, overrides included, mm/s; infinite for a rapid at 100 %, and where there is
    /// no program.
    pub(super) feed_v: f64,
    pub(super) deviation_mm: f64,
    pub(super) tolerance_mm: f64,
}

impl Follow {
    pub(super) fn new(settings: &AuditSettings) -> Self {
        Self {
            limits: settings.limits,
            tolerance_mm: settings.tolerance_mm,
            moves: VecDeque::new(),
            passed_s: 0.0,
            position: AxisVector::zeros(),
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
        let tolerance_mm = match mode {
            PathMode::Continuous {
                tolerance_mm: Some(tolerance_mm),
            } => tolerance_mm,
            _ => self.tolerance_mm,
        };
        self.moves.push_back(Move {
            segment,
            length_s,
            rate,
            tolerance_mm,
        });
    }

    /// Goes on to a frame.
    pub(super) fn to(&mut self, frame: &Frame) -> Nearby {
        let step_s = feed_length(&(frame.position - self.position));
        self.position = frame.position;
        let Some(first) = self.moves.front() else {
            return Nearby {
                feed_v: f64::INFINITY,
                deviation_mm: 0.0,
                tolerance_mm: self.tolerance_mm,
            };
        };
        let reach_s = self.passed_s + 2.0 * step_s + 4.0 * first.tolerance_mm;
        let (mut best, mut best_s, mut best_mm) = (0, self.passed_s, f64::INFINITY);
        let (mut start_s, mut from_s) = (0.0, self.passed_s);
        for (index, candidate) in self.moves.iter().enumerate() {
            if start_s > reach_s {
                break;
            }
            let (s, distance_mm) = candidate.nearest(&frame.position, from_s);
            if distance_mm <= best_mm {
                (best, best_s, best_mm) = (index, s, distance_mm);
            }
            start_s += candidate.length_s;
            from_s = 0.0;
        }
        self.moves.drain(..best);
        self.passed_s = best_s;
        let here = self.moves.front();
        Nearby {
            feed_v: here.map_or(f64::INFINITY, |here| self.feed_v(here, best_s, frame)),
            deviation_mm: best_mm,
            tolerance_mm: here.map_or(self.tolerance_mm, |here| here.tolerance_mm),
        }
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
    /// The point nearest to a position, from `from_s` on: path position and distance. On an arc,
    /// within half a turn of `from_s`.
    fn nearest(&self, position: &AxisVector, from_s: f64) -> (f64, f64) {
        let s = match &self.segment {
            Segment::Line(line) => {
                let along = line.displacement();
                let u = along.dot(&(position - line.start)) / along.norm_squared();
                u * self.length_s
            }
            Segment::Arc(arc) => {
                let (first, second) = arc.plane.axes();
                let angle_rad = (position[second.index()] - arc.center[1])
                    .atan2(position[first.index()] - arc.center[0]);
                let per_s = arc.sweep_rad / self.length_s;
                let from_rad = arc.start_angle_rad() + per_s * from_s;
                let turn = core::f64::consts::TAU;
                let step_rad = (angle_rad - from_rad + 0.5 * turn).rem_euclid(turn) - 0.5 * turn;
                from_s + step_rad / per_s
            }
            Segment::Curve(curve) => {
                // A piece turns little: from the place on its chord, Newton's method.
                let way = curve.end - curve.start;
                let mut s = way.dot(&(position - curve.start)) / way.norm_squared() * self.length_s;
                for _ in 0..3 {
                    let jet = self.segment.jet(s.max(0.0).min(self.length_s));
                    let gap = position - jet.position;
                    s += gap.dot(&jet.d1) / (jet.d1.norm_squared() - gap.dot(&jet.d2)).max(0.5);
                }
                s
            }
        };
        let s = s.max(from_s).min(self.length_s);
        let gap = position - self.segment.jet(s).position;
        (s, tolerance_norm(&gap))
    }
}
