//! Corners between feed moves, and their outer sides.

use crate::follow::Move;
use glidepath_geometry::{AxisVector, LINEAR_XYZ, Line};

/// Cosine of the least turn of a corner, 20°: what turns less may be a curve in chords, which bulges
/// beyond them.
const LEAST_TURN_COS: f64 = 0.939_692_620_785_908_4;
/// Cosine beyond which the path comes back on itself, and neither side of it is the outer one.
const REVERSAL_COS: f64 = -0.999;
/// Sides shorter than so many tolerances are no figure: the motion may leave them out.
const SIDE_TOLERANCES: f64 = 8.0;

/// Cosine of how much an arc or a curve may have turned from its corner, 60°: further on the inner side of the
/// corner is not that of the curve.
const STILL_OF_CORNER_COS: f64 = 0.5;

/// A vertex between two moves.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    /// Unit vectors along the moves before and behind, where they meet.
    sides: [AxisVector; 2],
}

/// X, Y and Z of a vector alone.
fn in_space(vector: &AxisVector) -> AxisVector {
    let mut part = AxisVector::zeros();
    for axis in LINEAR_XYZ {
        part[axis] = vector[axis];
    }
    part
}

fn unit(line: &Line) -> Option<AxisVector> {
    in_space(&line.displacement()).try_normalize(1e-6)
}

/// The directions of two moves one after the other where they meet, in X, Y and Z; none where either does not
/// move there.
fn directions(before: &Move, behind: &Move) -> Option<[AxisVector; 2]> {
    let ends = [
        before.programmed.jet(before.length_s).d1,
        behind.programmed.jet(0.0).d1,
    ];
    let [from, to] = ends.map(|along| in_space(&along).try_normalize(1e-6));
    Some([from?, to?])
}

/// Cosine of the turn from one move to the next, in X, Y and Z; none where either does not move there.
pub(super) fn turn_cos(before: &Move, behind: &Move) -> Option<f64> {
    directions(before, behind).map(|[from, to]| from.dot(&to))
}

impl Corner {
    /// Between two feed moves one after the other; none where they are no corner of a figure.
    pub(super) fn between(before: &Move, behind: &Move) -> Option<Self> {
        let least_mm = SIDE_TOLERANCES * before.tolerance_mm.max(behind.tolerance_mm);
        let is_figure = |side: &Move| !side.is_rapid() && side.length_s >= least_mm;
        if !is_figure(before) || !is_figure(behind) {
            return None;
        }
        let sides = directions(before, behind)?;
        (REVERSAL_COS..=LEAST_TURN_COS)
            .contains(&sides[0].dot(&sides[1]))
            .then_some(Self { sides })
    }

    /// How far a position is on the outer side of the move that it is on, at a progress, mm; 0 on the inner one.
    pub(super) fn outside_mm(
        &self,
        position: &AxisVector,
        (here, here_s): (&Move, f64),
        is_before: bool,
    ) -> f64 {
        let [before, behind] = self.sides;
        let at_corner = if is_before { before } else { behind };
        let jet = here.programmed.jet(here_s);
        let along = in_space(&jet.d1).try_normalize(1e-6).unwrap_or(at_corner);
        if along.dot(&at_corner) < STILL_OF_CORNER_COS {
            return 0.0;
        }
        // First the inner side at the corner: further on along an arc what the path turns by there lies across it
        // on either side.
        let across = |vector: AxisVector, along: &AxisVector| vector - along * vector.dot(along);
        let at_corner_inner = across(behind - before, &at_corner);
        let off = in_space(&(position - jet.position));
        let inner = across(at_corner_inner, &along)
            .try_normalize(1e-6)
            .unwrap_or_default();
        let outside_mm = (-inner.dot(&off)).max(0.0);
        // Among moves of a few tolerances the motion may be taken to be on one that it has left. Whoever is further off
        // than the tolerance is on another one; if not, it is the deviation that is found.
        if outside_mm > 1.001 * here.tolerance_mm {
            return 0.0;
        }
        outside_mm
    }
}

/// How far a position is beside a line, mm of X, Y and Z.
pub(super) fn beside_mm(line: &Line, position: &AxisVector) -> f64 {
    let Some(along) = unit(line) else {
        return 0.0;
    };
    let off = in_space(&(position - line.start));
    (off - along * off.dot(&along)).norm()
}
