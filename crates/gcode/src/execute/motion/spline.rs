//! Splines: one block (G5, G5.1), or a list of control points (G5.2 … G5.3, G6.2).
//!
//! | words | curve |
//! |---|---|
//! | G5 X Y I J P Q | cubic: control points start + (I, J) and end + (P, Q); without I J as smooth as the G5 before goes on |
//! | G5.1 X Y I J | quadratic: control point start + (I, J) |
//! | G5.2 P L, then X Y P …, then G5.3 | NURBS with weights P and uniform knots; L: degree + 1, 3 if it is not given. The first control point is where the tool stands |
//! | G6.2 P, X Y Z K R …, then K alone | NURBS with knots K and weights R, P: degree + 1, 4 if it is not given. The first control point is given, and is where the tool stands |
//!
//! The words are those of LinuxCNC and, for G6.2, those FANUC writes as G06.2 (Q is read over). G5
//! and G5.1 go in the XY plane, G5.2 in the two axes of the active plane, G6.2 in any axes.
//!
//! A curve is given out in smooth pieces (straight ones, where other axes than X, Y, Z move along)
//! that are away from it by no more than [`crate::Options::spline_tolerance_mm`].

use glidepath_geometry::{Axis, AxisVector, Nurbs, Plane};
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::settled::settled;
use crate::execute::motion::speed::Pace;
use crate::execute::state::open_spline::interrupted;
use crate::syntax::block::Block;
use crate::syntax::letters::Letters;
use crate::syntax::modes::Spline;
use crate::syntax::word_check::missing;

impl Interpreter {
    /// Makes a spline, or the part of one that stands in a block.
    pub(crate) fn spline(
        &mut self,
        block: &Block,
        spline: Spline,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        if self.state.open.compensation.is_some() || self.state.leaving_contour {
            let span = block.motion_span();
            let message = "a spline with cutter radius compensation";
            return Err(BlockDiagnostic::new(DiagnosticCode::Spline, span, message)
                .because("beside a spline there runs no spline")
                .help("let the CAM system compensate, or write lines and arcs"));
        }
        match spline {
            Spline::Cubic => self.cubic(block, out),
            Spline::Quadratic => self.quadratic(block, out),
            Spline::Weighted => self.weighted_point(block),
            Spline::EndWeighted => self.end_weighted(block, out),
            Spline::Knotted => self.knotted_point(block, out),
        }
    }

    /// G5.
    fn cubic(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let span = block.motion_span();
        self.check_xy(block, "G5")?;
        let second = match (block.get(b'P'), block.get(b'Q')) {
            (Some(p), Some(q)) => [p, q],
            _ => {
                return Err(missing(
                    span,
                    "G5",
                    "P and Q",
                    "the second control point, from the end",
                ));
            }
        };
        let first = match (block.get(b'I'), block.get(b'J'), self.state.cubic_tail) {
            (Some(i), Some(j), _) => self.turned([i, j]),
            (None, None, Some(tail)) => tail,
            (None, None, None) => {
                let meaning = "the first control point, from the start";
                return Err(missing(span, "the first G5", "I and J", meaning));
            }
            _ => {
                return Err(missing(
                    span,
                    "G5",
                    "both I and J",
                    "or neither, to go on smoothly",
                ));
            }
        };
        let second = self.turned(second);
        let (start, end) = self.ends(block)?;
        self.state.cubic_tail = Some(second.map(|offset| -offset));
        let points = [start, beside(start, first), beside(end, second), end];
        self.bezier(block, &points, out)
    }

    /// G5.1.
    fn quadratic(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        self.check_xy(block, "G5.1")?;
        if !block.has_any(Letters::of(b"IJ")) {
            let meaning = "the control point, from the start";
            return Err(missing(block.motion_span(), "G5.1", "I or J", meaning));
        }
        let offset = [b'I', b'J'].map(|letter| block.get(letter).unwrap_or(0.0));
        let offset = self.turned(offset);
        let (start, end) = self.ends(block)?;
        self.bezier(block, &[start, beside(start, offset), end], out)
    }

    /// Refuses what a spline of one block cannot be.
    fn check_xy(&self, block: &Block, code: &str) -> Outcome<()> {
        let span = block.motion_span();
        if self.state.modal.plane != Plane::Xy {
            return Err(BlockDiagnostic::new(
                DiagnosticCode::Spline,
                span,
                format!("{code} outside the XY plane"),
            )
            .because("its control points are given in X and Y")
            .help("write G17 before it"));
        }
        let other = block
            .axes()
            .find(|(axis, _)| !matches!(axis, Axis::X | Axis::Y));
        if let Some((axis, _)) = other {
            let message = format!("{axis} in a block with {code}");
            return Err(BlockDiagnostic::new(
                DiagnosticCode::Spline,
                block.axis_span(axis),
                message,
            )
            .because("the curve goes in X and Y alone")
            .help("write the other axes in a block of their own"));
        }
        if !block.has_axes() {
            return Err(missing(span, code, "X or Y", "where the curve ends"));
        }
        Ok(())
    }

    /// Start and end of a spline of one block; the position becomes the end.
    fn ends(&mut self, block: &Block) -> Outcome<(AxisVector, AxisVector)> {
        let target = self.target(block)?;
        let start = self.state.path_end;
        self.state.position = target;
        Ok((start, settled(start, target, [None, None])))
    }

    /// Words of a direction in X and Y, in mm and turned as the coordinate system is.
    fn turned(&self, words: [f64; 2]) -> [f64; 2] {
        let scale = self.state.modal.units.mm();
        let mut by = AxisVector::zeros();
        (by[0], by[1]) = (words[0] * scale, words[1] * scale);
        let turned = self.state.offsets.turn(by);
        [turned[0], turned[1]]
    }

    fn bezier(&mut self, block: &Block, points: &[AxisVector], out: &mut Vec<Item>) -> Outcome<()> {
        let degree = points.len() - 1;
        let mut knots = vec![0.0; points.len()];
        knots.extend(vec![1.0; points.len()]);
        let stands = points.iter().all(|point| point == &points[0]);
        if stands {
            self.count_zero_length(Pace::Feed);
            return Ok(());
        }
        match Nurbs::new(degree, points, &vec![1.0; points.len()], &knots) {
            Ok(curve) => self.push_curve(block, curve, None, out),
            Err(error) => Err(BlockDiagnostic::new(
                DiagnosticCode::Spline,
                block.motion_span(),
                error.to_string(),
            )),
        }
    }

    /// Refuses the end of the input inside a NURBS.
    pub(crate) fn check_spline_complete(&self) -> Outcome<()> {
        self.state
            .open
            .spline
            .as_ref()
            .map_or(Ok(()), |open| Err(interrupted(open, SourceSpan::default())))
    }
}

/// A point moved in X and Y.
fn beside(point: AxisVector, by: [f64; 2]) -> AxisVector {
    let mut moved = point;
    moved[0] += by[0];
    moved[1] += by[1];
    moved
}
