//! The program of a stretch by the way along it: where a position is on it, and how far off.

use crate::feed_axes::counted_axes;
use crate::programmed_rate::{ProgrammedRate, axes_speed};
use core::f64::consts::TAU;
use glidepath_geometry::{
    AXES, Arc, Axis, AxisVector, LINEAR_XYZ, Line, Segment, UVW, feed_length, tolerance_norm,
};
use glidepath_program::{Item, ItemKind, Override, PathMode, Settings};
use std::collections::VecDeque;
use std::ops::Range;

/// Moves before and behind that of a frame on which it is looked for: where dense lines are drawn
/// together, frames tell the move they are on by its share of the length.
const NEAR_MOVES: usize = 4;
/// Angle from its start within which a full circle is not told from its end.
const SEAM_RAD: f64 = 0.2;

/// A move of the stretch.
#[derive(Debug, Clone)]
struct ProgramMove {
    /// Number of its item.
    number: u32,
    segment: Segment,
    /// From the start of the stretch to its start, and what that takes at the rates.
    start_s: f64,
    start_t: f64,
    length_s: f64,
    top_v: f64,
    /// Zero where nothing is known of places.
    tolerance_mm: f64,
}

/// The moves that are not passed yet.
#[derive(Debug, Clone)]
pub(super) struct ProgramPath {
    settings: Settings,
    wanted: Override,
    moves: VecDeque<ProgramMove>,
    length_s: f64,
    duration_t: f64,
}

/// A place on the program.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) at_s: f64,
    pub(super) off_mm: f64,
    pub(super) top_v: f64,
    pub(super) tolerance_mm: f64,
    /// Number of the move.
    number: u32,
}

impl ProgramPath {
    pub(super) const fn new(settings: Settings, wanted: Override) -> Self {
        Self {
            settings,
            wanted,
            moves: VecDeque::new(),
            length_s: 0.0,
            duration_t: 0.0,
        }
    }

    /// Takes the next item, whose block is its number.
    pub(super) fn push(&mut self, item: &Item) {
        let ItemKind::Move {
            segment,
            rate,
            mode,
        } = item.kind
        else {
            return;
        };
        let axes_v = axes_speed(&segment, &self.settings.limits);
        let is_free = matches!(mode, PathMode::Continuous { .. }) && is_placed(&segment);
        let length_s = segment.length();
        let top_v = ProgrammedRate { rate, axes_v }
            .under(self.wanted)
            .min(axes_v);
        self.moves.push_back(ProgramMove {
            number: item.block,
            segment,
            start_s: self.length_s,
            start_t: self.duration_t,
            length_s,
            top_v,
            tolerance_mm: if is_free {
                mode.tolerance_mm(self.settings.tolerance_mm)
            } else {
                0.0
            },
        });
        self.length_s += length_s;
        self.duration_t += length_s / top_v;
    }

    /// How long the moves known take at their rates from the move of a number on, s.
    pub(super) fn known_t(&self, number: u32) -> f64 {
        let start_t = self.moves.get(self.index(number)).map(|of| of.start_t);
        self.duration_t - start_t.unwrap_or(self.duration_t)
    }

    /// Drops the moves that no frame of a number or a later one is looked for on.
    pub(super) fn forget_before(&mut self, number: u32) {
        let kept = self.index(number).saturating_sub(2 * NEAR_MOVES);
        self.moves.drain(..kept);
    }

    /// The first move of a number or a later one.
    fn index(&self, number: u32) -> usize {
        self.moves.partition_point(|of| of.number < number)
    }

    /// Where a position is, on the move of a number or next to it.
    pub(super) fn place(&self, number: u32, position: &AxisVector) -> Option<Place> {
        let index = self.index(number);
        let near = index.saturating_sub(NEAR_MOVES)..(index + NEAR_MOVES + 1).min(self.moves.len());
        self.nearest(near, position)
    }

    /// Where a position is that follows a place, so far behind it at most.
    pub(super) fn place_after(
        &self,
        last: &Place,
        most_s: f64,
        position: &AxisVector,
    ) -> Option<Place> {
        let end_s = last.at_s + most_s;
        let index = self.index(last.number);
        let ahead = self.moves.range(index..);
        let count = ahead.take_while(|of| of.start_s <= end_s).count();
        self.nearest(index..index + count, position)
    }

    fn nearest(&self, among: Range<usize>, position: &AxisVector) -> Option<Place> {
        let mut best: Option<Place> = None;
        for index in among {
            let of = self.moves.get(index)?;
            let Some((along_s, foot)) = of.foot(position) else {
                continue;
            };
            let off_mm = tolerance_norm(&(position - foot));
            if best.is_none_or(|best| off_mm < best.off_mm) {
                best = Some(Place {
                    at_s: of.start_s + along_s,
                    off_mm,
                    top_v: of.top_v,
                    tolerance_mm: of.tolerance_mm,
                    number: of.number,
                });
            }
        }
        best
    }

    /// The ends of moves between two places, in order, each with its place and the tolerance there;
    /// `None` if there is a move between on which nothing is known of places.
    pub(super) fn vertices_between(
        &self,
        from: &Place,
        to: &Place,
    ) -> Option<Vec<(f64, AxisVector, f64)>> {
        let mut vertices = Vec::new();
        let last = self.index(to.number);
        for index in self.index(from.number)..=last {
            let of = self.moves.get(index)?;
            if of.tolerance_mm <= 0.0 {
                return None;
            }
            let end_s = of.start_s + of.length_s;
            if index < last && end_s > from.at_s {
                let after_mm = self.moves.get(index + 1)?.tolerance_mm;
                let tolerance_mm = of.tolerance_mm.min(after_mm);
                vertices.push((end_s, of.segment.end(), tolerance_mm));
            }
        }
        Some(vertices)
    }
}

impl ProgramMove {
    /// The nearest point of it, by its way from the start.
    fn foot(&self, position: &AxisVector) -> Option<(f64, AxisVector)> {
        match &self.segment {
            _ if self.tolerance_mm <= 0.0 || self.length_s <= 0.0 => None,
            Segment::Line(Line { start, end }) => {
                let along = end - start;
                let share = (position - start).dot(&along) / along.norm_squared();
                let share = share.clamp(0.0, 1.0);
                Some((share * self.length_s, start + along * share))
            }
            Segment::Arc(arc) => {
                let along_s = share_of(arc, position)? * self.length_s;
                Some((along_s, self.segment.jet(along_s).position))
            }
            Segment::Curve(_) => None,
        }
    }
}

/// The share of an arc up to the point at the angle of a position.
fn share_of(arc: &Arc, position: &AxisVector) -> Option<f64> {
    let (first, second) = arc.plane.axes();
    let [u, v] = [(first, 0), (second, 1)].map(|(axis, k)| position[axis.index()] - arc.center[k]);
    let turned = (v.atan2(u) - arc.start_angle_rad()) * arc.sweep_rad.signum();
    let (turned, sweep) = (turned.rem_euclid(TAU), arc.sweep_rad.abs());
    if sweep > TAU - 2.0 * SEAM_RAD && !(SEAM_RAD..=sweep - SEAM_RAD).contains(&turned) {
        return None;
    }
    let is_before = turned > sweep && TAU - turned < turned - sweep;
    Some(if is_before {
        0.0
    } else {
        (turned / sweep).min(1.0)
    })
}

/// True if places on a segment are known by its geometry: one group of axes moves, straight or
/// round.
fn is_placed(segment: &Segment) -> bool {
    match segment {
        Segment::Line(line) => {
            let moved = line.end - line.start;
            let counted = counted_axes(&moved);
            feed_length(&moved) > 0.0
                && (0..AXES).all(|i| counted.contains(&i) || moved[i].abs() <= 0.0)
        }
        Segment::Arc(arc) => {
            let moved = arc.end - arc.start;
            let (first, _) = arc.plane.axes();
            let is_xyz = LINEAR_XYZ.contains(&first.index());
            let group = if is_xyz { LINEAR_XYZ } else { UVW };
            let is_one_kind = Axis::ALL
                .into_iter()
                .all(|axis| group.contains(&axis.index()) || moved[axis.index()].abs() <= 0.0);
            is_one_kind && arc.sweep_rad.abs() <= TAU * (1.0 + 1e-9)
        }
        Segment::Curve(_) => false,
    }
}
