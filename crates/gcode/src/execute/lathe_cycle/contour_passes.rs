//! The passes of a cycle that has its contour and its depths ready, and writes them out as lines.

use crate::execute::compensation::element::{Element, Point};
use crate::execute::lathe_cycle::offset::offset;
use crate::execute::lathe_cycle::pass_axes::{PassAxes, pieces};
use crate::execute::lathe_cycle::passes::{PassMove, Roughing, rough};
use crate::execute::motion::speed::Pace;
use crate::syntax::modes::Pockets;

/// How deep the passes are, and what they leave, mm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContourRoughing {
    pub(crate) increment_mm: f64,
    /// How far the tool retreats behind a pass, in both axes.
    pub(crate) retract_mm: f64,
    /// What is left along the whole contour.
    pub(crate) distance_mm: f64,
}

/// The moves of passes along Z down to a contour, in Z and X, for a tool at `start`; `None` where nothing is
/// left of the contour, or of the way to it.
pub(crate) fn rough_contour(
    contour: &[Element],
    start: Point,
    words: ContourRoughing,
) -> Option<Vec<PassMove>> {
    let axes = PassAxes::new(false, contour, start)?;
    let pieces = pieces(&axes, contour).ok()?;
    let at_distance = offset(&pieces, words.distance_mm)?;
    let roughing = Roughing {
        pockets: Pockets::LeftOut,
        increment_mm: words.increment_mm,
        retract_mm: words.retract_mm,
        first_level: 1.0,
        infeed: Pace::Rapid,
    };
    let moves = rough(&at_distance, axes.inside(start), roughing).ok()?;
    let outside = |pass_move: PassMove| match pass_move {
        PassMove::Rapid(end) => PassMove::Rapid(axes.outside(end)),
        PassMove::Feed(end) => PassMove::Feed(axes.outside(end)),
        PassMove::Arc(end, center, left) => PassMove::Arc(
            axes.outside(end),
            axes.outside(center),
            left != axes.mirrors(),
        ),
    };
    Some(moves.into_iter().map(outside).collect())
}
