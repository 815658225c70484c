//! The assembly of segments, and of what joins them, to pieces of path.
//!
//! A segment waits until the one after it is known, since the junction between the two tells where
//! each ends.

use super::kept_blocks::KeptBlocks;
use super::pending::Pending;
use crate::joints::JointRows;
use crate::on_path::junction::{Junction, chord_error_mm, join};
use crate::on_path::pieces::{CurveRule, Element, JointRule, Piece, Shape, SpeedLimit, SpeedRule};
use crate::programmed_rate::ProgrammedRate;
use crate::rest::{Rest, RestKind};
use crate::scurve::Profile;
use glidepath_geometry::{Axis, Quintic, Segment, limit_along};
use glidepath_program::{Event, Limits, Override, PathMode, ProgramLine, Settings, tolerance_norm};

/// How often a line is halved at most: a metre to 15 µm.
const MOST_HALVINGS: u32 = 16;

/// Puts pieces together.
#[derive(Debug, Clone)]
pub(crate) struct Assembly {
    pub(crate) settings: Settings,
    /// Where joints are not the axes, these limit the motion, too.
    pub(crate) joints: Option<JointRows>,
    pub(crate) wanted: Override,
    /// The segment whose end is not decided.
    pub(crate) pending: Option<Pending>,
    /// The blocks since the last rest.
    pub(crate) blocks: KeptBlocks,
    /// Events that wait for the move they happen on.
    pub(crate) events: Vec<Event>,
    /// The line taken last.
    pub(crate) line: ProgramLine,
}

impl Assembly {
    pub(crate) const fn new(settings: Settings) -> Self {
        Self {
            settings,
            joints: None,
            wanted: Override::NONE,
            pending: None,
            blocks: KeptBlocks::new(),
            events: Vec::new(),
            line: ProgramLine::NONE,
        }
    }

    /// Plans what follows with another override.
    pub(crate) fn set_override(&mut self, wanted: Override) {
        self.wanted = wanted;
        self.blocks.lose_any();
        let settings = self.settings;
        if let Some(held) = &mut self.pending {
            let tolerance_mm = held.mode.tolerance_mm(settings.tolerance_mm);
            let mm_per_deg = settings.direction.mm_per_deg(tolerance_mm);
            let chord_v = chord_speed(&held.segment, tolerance_mm, mm_per_deg, &settings);
            held.rate_v = held.rate.under(wanted).min(chord_v);
        }
    }

    /// Decides the junction between two segments and puts out all of the first.
    pub(crate) fn join(&mut self, before: Pending, next: &mut Pending, out: &mut Vec<Element>) {
        let junction = join(
            before.ending(),
            next.starting(),
            &self.settings,
            self.joints.as_ref(),
        );
        let (line, rates) = (before.last_line(), [before.rate, next.rate]);
        match junction {
            Junction::Straight => self.put_segment(before, 0.0, out),
            Junction::Stop { exact } => {
                self.put_segment(before, 0.0, out);
                let kind = if exact {
                    RestKind::ExactStop
                } else {
                    RestKind::Corner
                };
                let stops = self.blocks.take(&next.segment.start());
                self.put_stops(stops, out);
                out.push(Element::Rest(Rest { kind, line }));
            }
            Junction::Blend {
                transition,
                trim_s,
                curve,
            } => {
                self.put_segment(before, trim_s, out);
                let length_s = transition.length();
                let shape = Shape::Transition(Box::new(transition));
                let rule = SpeedRule::Curve {
                    curve: Box::new(curve),
                    rates,
                };
                let mut piece = self.piece(shape, (0.0, length_s), rule, line);
                piece.events = core::mem::take(&mut next.events);
                piece.events_s = 0.5 * length_s;
                out.push(Element::Piece(piece));
                next.trimmed_s = trim_s;
            }
        }
    }

    /// Puts out the segment that waits: it is left without a junction.
    pub(crate) fn put_pending(&mut self, out: &mut Vec<Element>) {
        if let Some(pending) = self.pending.take() {
            self.put_segment(pending, 0.0, out);
        }
    }

    /// Puts out what is left of a segment after both its junctions.
    fn put_segment(&self, pending: Pending, trim_end_s: f64, out: &mut Vec<Element>) {
        let length_s = pending.length_s - pending.trimmed_s - trim_end_s;
        // Half is the most a junction takes, so nothing left means rounding of two halves.
        if length_s <= 1e-12 * pending.length_s {
            return;
        }
        let rule = self.rule(&pending.segment, pending.rate, pending.mode);
        let shape = Shape::Segment(pending.segment);
        let mut piece = self.piece(shape, (pending.trimmed_s, length_s), rule, pending.line);
        (piece.events, piece.lines) = (pending.events, pending.lines);
        self.put_even(piece, MOST_HALVINGS, out);
    }

    /// Puts out a piece, a line in halves where joints are far faster on the one than on the other: what holds all
    /// along it would keep it slow everywhere.
    fn put_even(&self, piece: Piece, halvings: u32, out: &mut Vec<Element>) {
        let is_uneven = piece.is_straight() && piece.joints.as_ref().is_some_and(|j| j.is_uneven());
        let halves = halvings
            .checked_sub(1)
            .filter(|_| is_uneven)
            .and_then(|left| Some((left, self.halves(&piece)?)));
        let Some((left, halves)) = halves else {
            out.push(Element::Piece(piece));
            return;
        };
        for half in halves {
            self.put_even(half, left, out);
        }
    }

    /// The halves of a piece, if it takes less time with a rest between them than as one.
    fn halves(&self, piece: &Piece) -> Option<[Piece; 2]> {
        let alone_t = |piece: &Piece| {
            let SpeedLimit { top_v, change, .. } = piece.limit;
            let alone = Profile::new(0.0, 0.0, piece.length_s, top_v, change)?;
            Some(alone.duration_t())
        };
        let middle_s = 0.5 * piece.length_s;
        let halves = [
            piece.clone().before(middle_s),
            piece.clone().after(middle_s),
        ]
        .map(|half| self.within_joints(half));
        let apart_t = alone_t(&halves[0])? + alone_t(&halves[1])?;
        (apart_t < alone_t(piece)?).then_some(halves)
    }

    /// What limits the speed on a segment.
    pub(crate) fn rule(
        &self,
        segment: &Segment,
        rate: ProgrammedRate,
        mode: PathMode,
    ) -> SpeedRule {
        let tolerance_mm = mode.tolerance_mm(self.settings.tolerance_mm);
        let mm_per_deg = self.settings.direction.mm_per_deg(tolerance_mm);
        match segment {
            Segment::Line(_) => SpeedRule::Straight {
                d1: segment.jet(0.0).d1,
                rate,
            },
            Segment::Arc(arc) => SpeedRule::Arc {
                arc: *arc,
                rate,
                chord_v: chord_speed(segment, tolerance_mm, mm_per_deg, &self.settings),
            },
            Segment::Curve(curve) => SpeedRule::Curve {
                curve: Box::new(CurveRule {
                    bounds: curve.bounds(),
                    gentle: true,
                    stretch_r: 1.0,
                    chord_v: chord_speed(segment, tolerance_mm, mm_per_deg, &self.settings),
                    mm_per_deg,
                }),
                rates: [rate; 2],
            },
        }
    }

    /// Tells of the other way to drive up to the rest that comes next.
    pub(crate) fn put_stops(&self, stops: Option<Vec<Piece>>, out: &mut Vec<Element>) {
        if let Some(pieces) = stops {
            let tolerance_mm = self.settings.tolerance_mm;
            let exact = self.stops_cut_mm(&pieces, tolerance_mm) > 0.05 * tolerance_mm;
            out.push(Element::Stops { pieces, exact });
        }
    }

    /// How much the chord of one period can cut off at a stop between two setpoints, at most, mm.
    pub(crate) fn stop_cut_mm(&self, tolerance_mm: f64) -> f64 {
        let mm_per_deg = self.settings.direction.mm_per_deg(tolerance_mm);
        let jerk_j = self.settings.limits.jerk;
        let limited = Axis::ALL.into_iter().filter_map(|axis| {
            let axis_j = jerk_j[axis.index()];
            let counts = if axis.is_rotary() { mm_per_deg } else { 1.0 };
            (axis_j < Limits::UNLIMITED).then_some(counts * axis_j)
        });
        self.cut_mm(limited)
    }

    /// The same at the ends of some pieces: where joints limit the motion, there is much less jerk than
    /// axes allow.
    fn stops_cut_mm(&self, pieces: &[Piece], tolerance_mm: f64) -> f64 {
        if self.joints.is_none() {
            return self.stop_cut_mm(tolerance_mm);
        }
        let mm_per_deg = self.settings.direction.mm_per_deg(tolerance_mm);
        let of_piece = |piece: &Piece| {
            // Rotary axes may go much further than the path does.
            let per_path = tolerance_norm(&piece.jet(0.0).d1, mm_per_deg).max(1.0);
            per_path * piece.limit.alone.jerk_j
        };
        self.cut_mm(pieces.iter().map(of_piece))
    }

    fn cut_mm(&self, jerk_j: impl Iterator<Item = f64>) -> f64 {
        jerk_j.fold(0.0_f64, f64::max) * self.settings.period_t.powi(3) / 48.0
    }

    /// A piece of a shape: where in the shape it starts, and how long it is.
    pub(crate) fn piece(
        &self,
        shape: Shape,
        (from_s, length_s): (f64, f64),
        rule: SpeedRule,
        line: ProgramLine,
    ) -> Piece {
        let limits = &self.settings.limits;
        let piece = Piece {
            shape,
            from_s,
            length_s,
            limit: rule.limit(self.wanted, limits),
            rapid: rule.is_rapid(),
            synchronised: rule.is_synchronised(),
            per_revolution: rule.is_per_revolution(),
            rule,
            joints: None,
            planned: self.wanted,
            line,
            lines: Vec::new(),
            events: Vec::new(),
            events_s: 0.0,
        };
        self.within_joints(piece)
    }

    /// A piece with what joints leave of its limit.
    fn within_joints(&self, mut piece: Piece) -> Piece {
        if let Some(joints) = &self.joints {
            piece.joints = joint_rule(joints, &piece).map(Box::new);
            piece.limit = piece.limit_under(&self.settings.limits);
        }
        piece
    }
}

/// What joints make of the speed limit of a piece.
fn joint_rule(joints: &JointRows, piece: &Piece) -> Option<JointRule> {
    let jet_at = |part: f64| piece.jet(part * piece.length_s);
    match (&piece.shape, &piece.rule) {
        (Shape::Transition(_), SpeedRule::Curve { curve, .. }) => {
            JointRule::of_transition(joints, curve.gentle, jet_at)
        }
        _ => JointRule::of_curve(joints, piece.length_s, jet_at),
    }
}

/// The speed on a curve at which the chords of one period reach the tolerance although it changes
/// there, of that at which they do so at constant speed.
///
/// Across the chord there is not only v²k, but also a part of the acceleration along the path: at its
/// ends the path is turned against it by θ = kvT/2. Before a sharp place the motion brakes and behind
/// it it speeds up, and both bend it further from the chord. Weighted as its middle sees it, that is
/// aθ/3, so v²k (1 + aT/6v) has to be what v²k is at constant speed.
fn changing_chord_v(curve: &Quintic, steady_v: f64, settings: &Settings) -> f64 {
    /// In a period the speed changes by no more than twice itself.
    const LEAST_R: f64 = 0.866;
    let limits = &settings.limits;
    let along_a = [0.0, 0.5, 1.0]
        .map(|part| limit_along(&curve.jet(part * curve.length).d1, &limits.acceleration))
        .into_iter()
        .fold(0.0, f64::max)
        .min(limits.path.tangential_a);
    let half_v = along_a * settings.period_t / 12.0;
    (half_v.hypot(steady_v) - half_v).max(LEAST_R * steady_v)
}

/// The speed at which the chords of one period reach a tolerance of an arc or another curve, mm/s. A degree of the
/// rotary axes counts for `mm_per_deg`.
pub(crate) fn chord_speed(
    segment: &Segment,
    tolerance_mm: f64,
    mm_per_deg: f64,
    settings: &Settings,
) -> f64 {
    let arc = match segment {
        Segment::Line(_) => return f64::INFINITY,
        Segment::Arc(arc) => arc,
        Segment::Curve(curve) => {
            let left_mm = tolerance_mm - curve.error_mm;
            let at_unit_mm = chord_error_mm(&curve.bounds(), 1.0, settings.period_t, mm_per_deg);
            let steady_v = (left_mm.max(0.0) / at_unit_mm).sqrt();
            return changing_chord_v(curve, steady_v, settings);
        }
    };
    let radius_mm = arc.start_radius().max(arc.end_radius());
    let omega = arc.sweep_rad / arc.length();
    let curvature_k = radius_mm * omega * omega;
    (8.0 * tolerance_mm / curvature_k).sqrt() / settings.period_t
}
