//! Pieces of smooth path.

use super::joint_rule::JointRule;
use super::speed_limit::{SpeedLimit, SpeedRule};
use crate::scurve::Extremes;
use glidepath_geometry::{Cubic, Jet, Segment, Transition};
use glidepath_program::{Event, Limits, Override, ProgramLine};

/// A smooth piece of path with one speed limit.
#[derive(Debug, Clone)]
pub(crate) struct Piece {
    pub shape: Shape,
    /// Where in the shape the piece begins.
    pub from_s: f64,
    pub length_s: f64,
    pub rule: SpeedRule,
    /// What joints make of its limit, where they are not the axes.
    pub joints: Option<Box<JointRule>>,
    pub limit: SpeedLimit,
    /// The override that `limit` was computed with.
    pub planned: Override,
    /// Source line at its start.
    pub line: ProgramLine,
    /// The lines of further blocks on it, and where in the shape they start.
    pub lines: Vec<(f64, ProgramLine)>,
    pub rapid: bool,
    /// It follows the spindle.
    pub synchronised: bool,
    /// Its feed is one per revolution.
    pub per_revolution: bool,
    /// Events that happen on it, without stopping.
    pub events: Vec<Event>,
    /// How far after its start they happen, mm: in the middle of what replaces a corner, where the motion comes
    /// nearest to that, and else as soon as the piece is entered.
    pub events_s: f64,
}

/// The curve a piece is cut from.
#[allow(clippy::large_enum_variant, reason = "a piece is mostly of a segment")]
#[derive(Debug, Clone)]
pub(crate) enum Shape {
    Segment(Segment),
    Transition(Box<Transition>),
    Spline(Box<Cubic>),
}

impl Piece {
    /// Memory that it keeps beside its own, bytes.
    pub(crate) fn heap_bytes(&self) -> usize {
        let of_shape = match &self.shape {
            Shape::Segment(_) => 0,
            Shape::Transition(transition) => size_of_val(&**transition),
            Shape::Spline(spline) => size_of_val(&**spline),
        };
        let of_lines = self.lines.capacity() * size_of::<(f64, ProgramLine)>();
        let of_joints = self.joints.as_deref().map_or(0, size_of_val);
        of_shape + of_joints + of_lines + self.events.capacity() * size_of::<Event>()
    }

    /// True for a line.
    pub(crate) fn is_straight(&self) -> bool {
        matches!(self.shape, Shape::Segment(Segment::Line(_)))
    }

    /// The override that applies to the piece, as planned.
    pub(crate) const fn planned_override(&self) -> f64 {
        if self.rapid {
            self.planned.rapid_r
        } else if self.synchronised {
            1.0
        } else {
            self.planned.feed_r
        }
    }

    /// The same piece under another override.
    pub(crate) fn under(mut self, planned: Override, limits: &Limits) -> Self {
        self.planned = planned;
        self.limit = self.limit_under(limits);
        self
    }

    /// What the piece allows under the override that it is planned with.
    pub(crate) fn limit_under(&self, limits: &Limits) -> SpeedLimit {
        let of_axes = self.rule.limit(self.planned, limits);
        match &self.joints {
            Some(joints) => joints.within(of_axes),
            None => of_axes,
        }
    }

    /// True if it may be driven with so much speed, acceleration and jerk along the path, all at once.
    pub(crate) fn permits(&self, most: &Extremes, limits: &Limits) -> bool {
        let by_joints = self.joints.as_ref();
        self.rule.permits(&self.limit, most, limits)
            && by_joints.is_none_or(|joints| joints.permits(most))
    }

    /// The piece up to `s` after its start.
    pub(crate) fn before(self, s: f64) -> Self {
        Self {
            length_s: s,
            ..self
        }
    }

    /// What is left of the piece `s` after its start. Its events have happened, or wait for their place.
    pub(crate) fn after(self, s: f64) -> Self {
        Self {
            from_s: self.from_s + s,
            length_s: self.length_s - s,
            events: Vec::new(),
            ..self
        }
    }

    /// Position and derivatives `s` after the start of the piece.
    pub(crate) fn jet(&self, s: f64) -> Jet {
        match &self.shape {
            Shape::Segment(segment) => segment.jet(self.from_s + s),
            Shape::Transition(transition) => transition.jet(self.from_s + s),
            Shape::Spline(span) => span.jet(self.from_s + s),
        }
    }

    /// The source line `s` after the start of the piece.
    pub(crate) fn line_at(&self, s: f64) -> ProgramLine {
        let passed = self
            .lines
            .partition_point(|(from_s, _)| *from_s <= self.from_s + s);
        match passed.checked_sub(1).and_then(|last| self.lines.get(last)) {
            Some((_, line)) => *line,
            None => self.line,
        }
    }
}
