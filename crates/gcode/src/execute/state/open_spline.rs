//! A NURBS whose control points come block by block.

use glidepath_geometry::AxisVector;

use crate::diagnostic::block_diagnostic::BlockDiagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::block::Block;
use crate::syntax::letters::Letters;
use crate::syntax::modes::{Motion, Spline};

/// A curve as far as it is known.
#[derive(Debug, Clone)]
pub(crate) struct OpenSpline {
    pub(crate) knotted: bool,
    pub(crate) order: u32,
    pub(crate) points: Vec<AxisVector>,
    pub(crate) weights: Vec<f64>,
    pub(crate) knots: Vec<f64>,
    /// Line of its first block.
    pub(crate) line: u32,
}

/// How far a curve was known before a block.
pub(crate) type SplineMark = Option<(usize, usize, u32)>;

impl OpenSpline {
    pub(crate) fn mark(open: Option<&Self>) -> SplineMark {
        open.map(|open| (open.points.len(), open.knots.len(), open.order))
    }

    /// Takes back what a refused block has added. A curve that was completed is gone.
    pub(crate) fn rewind(open: &mut Option<Self>, mark: SplineMark) {
        match (mark, open.as_mut()) {
            (Some((points, knots, order)), Some(open)) => {
                open.points.truncate(points);
                open.weights.truncate(points);
                open.knots.truncate(knots);
                open.order = order;
            }
            _ => *open = None,
        }
    }

    pub(crate) const fn takes(&self, spline: Spline) -> bool {
        match spline {
            Spline::Knotted => self.knotted,
            Spline::Weighted | Spline::EndWeighted => !self.knotted,
            Spline::Cubic | Spline::Quadratic => false,
        }
    }

    pub(crate) fn knots_needed(&self) -> usize {
        self.points.len() + self.order as usize
    }

    /// What is missing, in words.
    pub(crate) fn lacks(&self) -> String {
        if self.knotted {
            let (have, need) = (self.knots.len(), self.knots_needed());
            format!("it has {have} knots (K), and needs {need}: control points and P together")
        } else {
            "its end, G5.3, has not come".to_owned()
        }
    }

    /// Uniform knots that reach both ends.
    pub(crate) fn uniform_knots(&self) -> Vec<f64> {
        let (order, count) = (self.order as usize, self.points.len());
        let inside = count.saturating_sub(order);
        (0..count + order)
            .map(|i| i.saturating_sub(order - 1).min(inside + 1) as f64)
            .collect()
    }
}

/// Refuses a block between the blocks of a NURBS.
pub(crate) fn interrupted(open: &OpenSpline, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("the NURBS begun in line {} is not complete", open.line);
    BlockDiagnostic::new(DiagnosticCode::Spline, span, message)
        .because(open.lacks())
        .help("complete it before anything else, or let it be")
}

/// True if the block can stand between the blocks of a NURBS: it belongs to it, or only assigns
/// parameters.
pub(crate) fn goes_on(block: &Block, open: &OpenSpline, motion: Option<Motion>) -> bool {
    match motion {
        Some(Motion::Spline(spline)) => open.takes(spline),
        Some(_) => false,
        None => !block.codes.any() && block.unused(Letters::of(b"")).is_none(),
    }
}
