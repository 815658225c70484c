//! The reference path of a stretch: a ring of straight pieces, dropped when the motion is past
//! them.
//!
//! Pieces are numbered from the start of the stretch, so that a number stays valid while the ring
//! moves on. Pieces far shorter than the tolerance carry no direction worth following and would
//! make the ring grow without bound: a vertex that lies within [`TINY_R`] tolerances of the vertex
//! before it is held back until the path leaves that ball, and the tolerance is smaller by as much.
//!
//! ```text
//!        held back:  · ·            a piece starts at the last vertex kept,
//!   ────────────────●···────────●   and ends at the first one outside the ball
//! ```

use super::direction::{Bounds, directional};
use super::reference::{Reference, Straightness};
use super::sense::{PieceGeometry, Sense};
use crate::feed_axes::counted_axes;
use crate::joints::JointRows;
use crate::programmed_rate::PieceRate;
use crate::scurve::Profile;
use glidepath_geometry::{AXES, AxisVector, LINEAR_XYZ, ROTARY_ABC, UVW, feed_length};
use glidepath_program::Limits;
use std::collections::VecDeque;

/// Radius of the ball, in tolerances, inside which vertices are drawn together.
const TINY_R: f64 = 1e-3;
/// How often a line is halved at most: with 16 as along the path windows near a stretched arm took up to fifteen times
/// the work, for nothing.
const MOST_HALVINGS: u32 = 4;
/// Margin between the tolerance that is planned for and the one that is promised.
const ROUNDING_R: f64 = 1e-7;

/// Turn from which the motion may run back for a moment, as a corner of less than the tolerance
/// does: 2·sin of half the angle, 17°. No measurement of it is kept.
pub(crate) const SHARP: f64 = 0.3;

/// One straight piece.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TubePiece {
    pub(crate) start: AxisVector,
    pub(crate) end: AxisVector,
    /// Feed length, mm (degrees for a move of rotary axes alone), > 0.
    pub(crate) length_s: f64,
    /// Feed length from the start of the stretch to the start of the piece.
    pub(crate) start_s: f64,
    /// Path speed by the feed and the axes.
    pub(crate) top_v: f64,
    /// How fast the axes that the feed counts may go together, whatever the others do. Where it counts all that move, no
    /// faster than along the piece.
    pub(crate) counted_v: f64,
    /// Tolerance of the linear axes, mm.
    pub(crate) tolerance_mm: f64,
    /// Tolerance of the rotary axes together, degrees.
    pub(crate) tolerance_deg: f64,
    /// From its middle to the program.
    pub(crate) sagitta_vector: AxisVector,
    /// Where it is to be straight, if that is asked for.
    pub(crate) straight: Option<Straightness>,
    /// What joints that are not the axes leave along it, by feed length.
    by_joints: Option<Bounds>,
    /// How far the motion may be beyond a border of it, at least.
    pub(crate) beyond_mm: f64,
    /// It has no feed.
    pub(crate) is_rapid: bool,
    /// What every axis does along it.
    pub(crate) senses: [Sense; AXES],
    /// The corner at which the run begins that it is of: pieces with feed that follow each other without another
    /// corner, as those of an arc or of a line in many pieces do.
    pub(crate) corner_before: Option<CornerBefore>,
    /// Feed length from the start of the stretch to where that run begins, with a corner or without one.
    pub(crate) run_from_s: f64,
    pub(crate) tag: u64,
}

/// A corner that pieces come from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CornerBefore {
    /// Displacements of the pieces before and after it.
    pub(crate) along: [AxisVector; 2],
    /// Feed length from the start of the stretch to it, and that of the run that leads to it.
    pub(crate) at_s: f64,
    pub(crate) run_s: f64,
}

/// How far a point is from another, by groups of axes with a tolerance together: the largest of each
/// kind.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Displacement {
    /// XYZ, or UVW.
    linear_mm: f64,
    /// The rotary axes together.
    rotary_deg: f64,
}

impl Displacement {
    /// That of a vector.
    pub(crate) fn of(vector: &AxisVector) -> Self {
        let norm =
            |axes: core::ops::Range<usize>| axes.map(|i| vector[i] * vector[i]).sum::<f64>().sqrt();
        Self {
            linear_mm: norm(LINEAR_XYZ).max(norm(UVW)),
            rotary_deg: norm(ROTARY_ABC),
        }
    }

    /// The larger one of each kind.
    pub(crate) const fn max(self, other: Self) -> Self {
        Self {
            linear_mm: self.linear_mm.max(other.linear_mm),
            rotary_deg: self.rotary_deg.max(other.rotary_deg),
        }
    }
}

impl TubePiece {
    /// How far a point is from another in tolerances of this piece: the largest over the groups.
    pub(crate) fn distance_r(&self, displacement: &AxisVector) -> f64 {
        self.in_tolerances(Displacement::of(displacement))
    }

    /// The same, of what is known of a displacement.
    pub(crate) const fn in_tolerances(&self, displacement: Displacement) -> f64 {
        let linear = displacement.linear_mm / self.tolerance_mm;
        linear.max(displacement.rotary_deg / self.tolerance_deg)
    }

    /// The same in mm, where both tolerances are as far.
    pub(crate) const fn in_mm(&self, displacement: Displacement) -> f64 {
        let rotary_mm = displacement.rotary_deg * (self.tolerance_mm / self.tolerance_deg);
        displacement.linear_mm.max(rotary_mm)
    }
}

impl TubePiece {
    /// The tolerance of an axis.
    pub(crate) fn tolerance(&self, axis: usize) -> f64 {
        if ROTARY_ABC.contains(&axis) {
            self.tolerance_deg
        } else {
            self.tolerance_mm
        }
    }

    /// It goes on where another one ends, at a corner or without one.
    fn follow(&mut self, last: &Self) {
        let along = [last.end - last.start, self.end - self.start];
        let cos = along[0].dot(&along[1]) / (along[0].norm() * along[1].norm());
        if (2.0 - 2.0 * cos).max(0.0).sqrt() > SHARP {
            self.corner_before = Some(CornerBefore {
                along,
                at_s: self.start_s,
                run_s: self.start_s - last.run_from_s,
            });
        } else {
            self.corner_before = last.corner_before;
            self.run_from_s = last.run_from_s;
        }
    }

    fn geometry(&self) -> PieceGeometry<'_> {
        PieceGeometry {
            start: &self.start,
            end: &self.end,
            sagitta_vector: &self.sagitta_vector,
            start_s: self.start_s,
            tolerances: core::array::from_fn(|axis| self.tolerance(axis)),
        }
    }

    /// What joints leave along it of bounds, which are by a length that is `per_s` of its feed length.
    pub(crate) fn within_joints(&self, bounds: Bounds, per_s: f64) -> Bounds {
        self.by_joints
            .map_or(bounds, |joints| bounds.weaker(joints.times(per_s)))
    }

    /// Looks at joints, at speeds up to its feed. True if they leave less at one place of it than at another.
    fn ask_joints(&mut self, limits: &Limits, joints: &JointRows) -> bool {
        let (own, along) = self.own_bounds(limits);
        let (by_joints, is_uneven) =
            own.within_joints_each(joints, (&self.start, &along), self.length_s);
        self.by_joints = Some(by_joints);
        is_uneven
    }

    /// What axes and the feed leave along it, and the change of every axis per unit of it.
    fn own_bounds(&self, limits: &Limits) -> (Bounds, AxisVector) {
        let along = (self.end - self.start) / self.length_s;
        let own = directional(limits, &along);
        let own = Bounds {
            speed_v: own.speed_v.min(self.top_v),
            ..own
        };
        (own, along)
    }

    /// How long it takes from rest to rest, s, with what joints leave all along it.
    fn alone_t(&self, limits: &Limits, joints: &JointRows) -> Option<f64> {
        let (own, along) = self.own_bounds(limits);
        let bounds = own.within_joints(joints, (&self.start, &along), self.length_s);
        let profile = Profile::new(0.0, 0.0, self.length_s, bounds.speed_v, bounds.path)?;
        Some(profile.duration_t())
    }

    /// Speed along the path in the sense of the feed.
    pub(crate) fn path_v(&self, velocity: &AxisVector) -> f64 {
        let counted = counted_axes(&(self.end - self.start));
        counted
            .map(|i| velocity[i] * velocity[i])
            .sum::<f64>()
            .sqrt()
    }
}

/// The part of the path that is known and not yet passed.
#[derive(Debug, Clone)]
pub(crate) struct ReferencePath {
    pieces: VecDeque<TubePiece>,
    /// Number of the first piece of the ring.
    base: usize,
    /// The last vertex kept, and feed length up to it.
    corner: AxisVector,
    corner_s: f64,
    /// The piece that ends there.
    last: Option<TubePiece>,
    /// A piece that has not left the ball round the last vertex.
    held: Option<Reference>,
    is_finished: bool,
    /// Limits of axes and joints, where these are not the axes.
    machine: Option<Box<(Limits, JointRows)>>,
}

impl ReferencePath {
    pub(crate) fn new(start: AxisVector) -> Self {
        Self {
            pieces: VecDeque::new(),
            base: 0,
            corner: start,
            corner_s: 0.0,
            last: None,
            held: None,
            is_finished: false,
            machine: None,
        }
    }

    /// The same path, before its first piece, for joints that are not the axes.
    pub(crate) fn with_joints(self, limits: &Limits, joints: Option<&JointRows>) -> Self {
        let machine = joints.map(|joints| Box::new((*limits, joints.clone())));
        Self { machine, ..self }
    }

    /// The path goes on with a piece.
    pub(crate) fn push(&mut self, piece: Reference) {
        let tolerances_r = self.reach_r(&piece);
        self.held = Some(piece);
        if tolerances_r > TINY_R {
            self.keep_held();
        }
    }

    /// Distance of the end of a piece from the last vertex kept, in tolerances.
    fn reach_r(&self, piece: &Reference) -> f64 {
        let displacement = piece.end - self.corner;
        self.as_piece(piece).distance_r(&displacement)
    }

    fn as_piece(&self, piece: &Reference) -> TubePiece {
        let keep_r = 1.0 - TINY_R - ROUNDING_R;
        TubePiece {
            start: self.corner,
            end: piece.end,
            length_s: feed_length(&(piece.end - self.corner)),
            start_s: self.corner_s,
            top_v: piece.rate.top_v,
            counted_v: piece.rate.counted_v(&(piece.end - self.corner)),
            tolerance_mm: piece.tolerance_mm * keep_r,
            tolerance_deg: piece.tolerance_deg * keep_r,
            sagitta_vector: piece.sagitta_vector,
            straight: piece.straight,
            by_joints: None,
            beyond_mm: piece.beyond_mm,
            is_rapid: piece.is_rapid,
            senses: core::array::from_fn(|axis| Sense::at_rest(self.corner[axis])),
            corner_before: None,
            run_from_s: self.corner_s,
            tag: piece.tag,
        }
    }

    fn keep_held(&mut self) {
        if let Some(reference) = self.held.take() {
            self.keep(&reference, MOST_HALVINGS);
        }
    }

    /// Keeps a piece, in halves where joints leave far more on the one than on the other: what holds all along it
    /// would keep it slow everywhere.
    fn keep(&mut self, reference: &Reference, halvings: u32) {
        let mut piece = self.as_piece(reference);
        if piece.length_s > 0.0 {
            let machine = self.machine.as_deref();
            let is_uneven =
                machine.is_some_and(|(limits, joints)| piece.ask_joints(limits, joints));
            if is_uneven
                && let Some(left) = halvings.checked_sub(1)
                && let Some(halves) = self.halves(reference, &piece)
            {
                for half in &halves {
                    self.keep(half, left);
                }
                return;
            }
            let before = self.last.map(|last| last.end - last.start);
            let senses = self.last.map_or(piece.senses, |last| last.senses);
            piece.senses = piece.geometry().senses(&senses, before.as_ref());
            if let Some(last) = self.last.filter(|last| !last.is_rapid && !piece.is_rapid) {
                piece.follow(&last);
            }
            self.last = Some(piece);
            self.corner = piece.end;
            self.corner_s += piece.length_s;
            self.pieces.push_back(piece);
        }
    }

    /// The halves of a piece that is a line, not within its tolerance, if it takes less time with a rest between them than
    /// as one.
    fn halves(&self, reference: &Reference, piece: &TubePiece) -> Option<[Reference; 2]> {
        let (limits, joints) = self.machine.as_deref()?;
        let is_long = piece.distance_r(&(piece.end - piece.start)) > 2.0;
        if !is_long || reference.sagitta_vector != AxisVector::zeros() {
            return None;
        }
        let halves = reference.halves_from(&piece.start);
        let first = self.as_piece(&halves[0]);
        let second = TubePiece {
            start: first.end,
            length_s: feed_length(&(piece.end - first.end)),
            ..*piece
        };
        let apart_t = first.alone_t(limits, joints)? + second.alone_t(limits, joints)?;
        (apart_t < piece.alone_t(limits, joints)?).then_some(halves)
    }

    /// The path ends with what has been pushed.
    pub(crate) fn finish(&mut self) {
        self.keep_held();
        self.is_finished = true;
    }

    /// Number of the piece after the last one known.
    pub(crate) fn end(&self) -> usize {
        self.base + self.pieces.len()
    }

    /// Piece `index`, if it is known and not yet dropped.
    pub(crate) fn get(&self, index: usize) -> Option<&TubePiece> {
        self.pieces.get(index.checked_sub(self.base)?)
    }

    /// True if the path is known to end with piece `index`.
    pub(crate) fn is_last(&self, index: usize) -> bool {
        self.is_finished && index + 1 == self.end()
    }

    /// True if all is known that the motion along piece `index` depends on: the piece, and the next
    /// one or that there is none.
    pub(crate) fn is_settled(&self, index: usize) -> bool {
        index + 1 < self.end() || self.is_last(index)
    }

    /// True if the path is known to end where it starts.
    pub(crate) fn is_empty_and_finished(&self) -> bool {
        self.is_finished && self.end() == 0
    }

    /// The largest speed of the ring.
    pub(crate) fn counted_v(&self) -> f64 {
        self.pieces
            .iter()
            .fold(0.0, |most, piece| most.max(piece.counted_v))
    }

    /// Drops the pieces before `index`.
    pub(crate) fn forget_before(&mut self, index: usize) {
        while self.base < index && self.pieces.pop_front().is_some() {
            self.base += 1;
        }
    }

    /// Gives every piece of the ring the speed it is to have; true if one had another before.
    pub(crate) fn set_rates(&mut self, mut rate_of: impl FnMut(u64) -> PieceRate) -> bool {
        let mut is_other = false;
        if let Some(held) = &mut self.held {
            let before = core::mem::replace(&mut held.rate, rate_of(held.tag));
            is_other |= !held.rate.is(&before);
        }
        for piece in &mut self.pieces {
            let rate = rate_of(piece.tag);
            let counted_v = rate.counted_v(&(piece.end - piece.start));
            let is_changed =
                exchange(&mut piece.top_v, rate.top_v) | exchange(&mut piece.counted_v, counted_v);
            is_other |= is_changed;
            if let Some(machine) = self.machine.as_ref().filter(|_| is_changed) {
                piece.ask_joints(&machine.0, &machine.1);
            }
        }
        is_other
    }
}

/// True if a rate is another one than before.
fn exchange(top_v: &mut f64, rate_v: f64) -> bool {
    let before_v = core::mem::replace(top_v, rate_v);
    before_v.to_bits() != rate_v.to_bits()
}
