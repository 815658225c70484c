//! A NURBS whose control points come block by block.

use glidepath_geometry::AxisVector;

use crate::diagnostic::block_diagnostic::BlockDiagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::block::Block;
use crate::syntax::letters::Letters;
use crate::syntax::modes::{Motion, Spline};

/// A curve as far as it is known: its points and knots are the first ones of the [`SplineLog`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct OpenSpline {
    pub(crate) knotted: bool,
    pub(crate) order: u32,
    /// How many control points it has so far, each with its weight.
    pub(crate) points: usize,
    pub(crate) knots: usize,
    /// Line of its first block.
    pub(crate) line: u32,
}

/// What is known of the open curve: control points, weights and knots, and behind them what a refused block has
/// added. A curve may have very many, so no copy is made of them in front of each block.
#[derive(Debug, Default)]
pub(crate) struct SplineLog {
    points: Vec<AxisVector>,
    weights: Vec<f64>,
    knots: Vec<f64>,
}

impl SplineLog {
    pub(crate) fn add_point(&mut self, open: &mut OpenSpline, point: AxisVector, weight: f64) {
        self.points.truncate(open.points);
        self.weights.truncate(open.points);
        self.points.push(point);
        self.weights.push(weight);
        open.points = self.points.len();
    }

    pub(crate) fn add_knot(&mut self, open: &mut OpenSpline, knot: f64) {
        self.knots.truncate(open.knots);
        self.knots.push(knot);
        open.knots = self.knots.len();
    }

    pub(crate) fn points(&self, open: &OpenSpline) -> &[AxisVector] {
        self.points.get(..open.points).unwrap_or_default()
    }

    /// The weights of the points.
    pub(crate) fn weights(&self, open: &OpenSpline) -> &[f64] {
        self.weights.get(..open.points).unwrap_or_default()
    }

    pub(crate) fn knots(&self, open: &OpenSpline) -> &[f64] {
        self.knots.get(..open.knots).unwrap_or_default()
    }
}

impl OpenSpline {
    /// A curve of which nothing is known yet.
    pub(crate) const fn begun(knotted: bool, order: u32, line: u32) -> Self {
        Self {
            knotted,
            order,
            points: 0,
            knots: 0,
            line,
        }
    }

    pub(crate) const fn takes(&self, spline: Spline) -> bool {
        match spline {
            Spline::Knotted => self.knotted,
            Spline::Weighted | Spline::EndWeighted => !self.knotted,
            Spline::Cubic | Spline::Quadratic => false,
        }
    }

    pub(crate) const fn knots_needed(&self) -> usize {
        self.points + self.order as usize
    }

    /// What is missing, in words.
    pub(crate) fn lacks(&self) -> String {
        if self.knotted {
            let (have, need) = (self.knots, self.knots_needed());
            format!("it has {have} knots (K), and needs {need}: control points and P together")
        } else {
            "its end, G5.3, has not come".to_owned()
        }
    }

    /// Uniform knots that reach both ends.
    pub(crate) fn uniform_knots(&self) -> Vec<f64> {
        let (order, count) = (self.order as usize, self.points);
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
        .help("complete it before anything else")
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
