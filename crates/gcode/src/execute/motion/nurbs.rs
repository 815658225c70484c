//! The blocks of a NURBS: G5.2 … G5.3 and G6.2.

use glidepath_geometry::{AxisVector, Nurbs, NurbsError};
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::open_spline::{OpenSpline, SplineLog};
use crate::syntax::block::Block;
use crate::syntax::letters::AXIS_WORDS;
use crate::syntax::word_check::{missing, whole};

/// Most control points of one curve.
const MAX_POINTS: usize = 100_000;
/// Degree + 1 of G5.2 without L.
const WEIGHTED_ORDER: u32 = 3;
/// Degree + 1 of G6.2 without P.
const KNOTTED_ORDER: u32 = 4;
/// The largest degree + 1.
const MAX_ORDER: u32 = 8;
/// How far the first control point of G6.2 may be from where the tool stands, mm: programs round.
const START_MM: f64 = 0.01;

impl Interpreter {
    /// G5.2, and every block of control points after it.
    pub(super) fn weighted_point(&mut self, block: &Block) -> Outcome<()> {
        let weight = positive_weight(block, b'P')?;
        let order = whole(block, b'L', MAX_ORDER)?;
        let point = self.plane_point(block)?;
        let start = (
            self.state.path_end,
            if point.is_none() { weight } else { 1.0 },
        );
        let (log, line) = (&mut self.spline_log, self.line);
        let opens = self.state.open.spline.is_none();
        let open = self.state.open.spline.get_or_insert_with(|| {
            let mut open = OpenSpline::begun(false, WEIGHTED_ORDER, line);
            log.add_point(&mut open, start.0, start.1);
            open
        });
        match order {
            Some(order) if order < 2 => {
                let message = format!("a NURBS of order L{order}");
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::Spline,
                    block.span(b'L'),
                    message,
                )
                .because("the order is the degree + 1; lines have order 2")
                .help("write L2 to L8"));
            }
            Some(order) => open.order = order,
            None => {}
        }
        match point {
            Some(point) => push_point((open, log), block, point, weight),
            None if opens => Ok(()),
            None => Err(missing(
                block.motion_span(),
                "a control point",
                "both axes of the plane",
                "where it is",
            )),
        }
    }

    /// The control point of a block in the active plane; none if it has no axis words.
    fn plane_point(&mut self, block: &Block) -> Outcome<Option<AxisVector>> {
        if !has_point(block) {
            return Ok(None);
        }
        let (first, second) = self.state.modal.plane.axes();
        let other = block
            .axes()
            .find(|(axis, _)| *axis != first && *axis != second);
        if let Some((axis, _)) = other {
            let message = format!("{axis} in a control point of G5.2");
            return Err(BlockDiagnostic::new(
                DiagnosticCode::Spline,
                block.axis_span(axis),
                message,
            )
            .because(format!(
                "the curve goes in {first} and {second}, the axes of the plane"
            ))
            .help("select the plane it goes in, or use G6.2"));
        }
        let values = self.axis_values(block)?;
        for axis in [first, second] {
            if values[axis.index()].is_none() {
                let word = axis.letter().to_string();
                return Err(missing(
                    block.motion_span(),
                    "a control point",
                    &word,
                    "both its coordinates",
                ));
            }
        }
        let target = self.target(block)?;
        self.state.position = target;
        Ok(Some(target))
    }

    /// G5.3.
    pub(super) fn end_weighted(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let span = block.motion_span();
        self.state.modal.motion = None;
        let Some(open) = self.state.open.spline.take() else {
            return Err(
                BlockDiagnostic::new(DiagnosticCode::Spline, span, "G5.3 without G5.2")
                    .because("it ends a NURBS, and none has begun")
                    .help("write G5.2 and its control points before it"),
            );
        };
        self.push_nurbs(block, (&open, &open.uniform_knots()), span, out)
    }

    /// G6.2, and every block after it until there are as many knots as the curve needs.
    pub(super) fn knotted_point(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let span = block.motion_span();
        let knot = block
            .get(b'K')
            .ok_or_else(|| missing(span, "G6.2", "K", "the knot of each block"))?;
        let weight = positive_weight(block, b'R')?;
        let order = whole(block, b'P', MAX_ORDER)?;
        let point = if has_point(block) {
            Some(self.target(block)?)
        } else {
            None
        };
        let (log, line) = (&mut self.spline_log, self.line);
        let opens = self.state.open.spline.is_none();
        let here = self.state.path_end;
        let begun = || OpenSpline::begun(true, KNOTTED_ORDER, line);
        let open = self.state.open.spline.get_or_insert_with(begun);
        match order {
            Some(order) if order < 2 || (!opens && order != open.order) => {
                let message = format!("P{order} cannot be the order of this NURBS");
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::Spline,
                    block.span(b'P'),
                    message,
                )
                .because("the order is the degree + 1, 2 to 8, and stands in the first block")
                .help("write P4 for a cubic"));
            }
            Some(order) => open.order = order,
            None => {}
        }
        if log.knots(open).last().is_some_and(|last| knot < *last) {
            let message = format!("the knot {knot} is below the one before it");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::Spline, block.span(b'K'), message)
                    .because("knots never descend")
                    .help("correct K"),
            );
        }
        log.add_knot(open, knot);
        if let Some(mut point) = point {
            if opens {
                if (point - here).amax() > START_MM {
                    let message = "the first control point is not where the tool stands";
                    return Err(BlockDiagnostic::new(DiagnosticCode::Spline, span, message)
                        .because("the curve begins at its first control point")
                        .help("move there before it, with G1 or G0"));
                }
                point = here;
            }
            if open.knots != open.points + 1 {
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::Spline,
                    span,
                    "a control point after the last knots",
                )
                .because("blocks with K alone end the list of control points")
                .help("put the control points before them"));
            }
            self.state.position = point;
            return push_point((open, log), block, point, weight);
        }
        if opens {
            return Err(missing(span, "G6.2", "an axis", "its first control point"));
        }
        if open.knots < open.knots_needed() {
            return Ok(());
        }
        self.state.modal.motion = None;
        match self.state.open.spline.take() {
            Some(open) => {
                let knots = self.spline_log.knots(&open).to_vec();
                self.push_nurbs(block, (&open, &knots), span, out)
            }
            None => Ok(()),
        }
    }

    fn push_nurbs(
        &mut self,
        block: &Block,
        (open, knots): (&OpenSpline, &[f64]),
        span: SourceSpan,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let degree = open.order as usize - 1;
        let log = &self.spline_log;
        let curve = Nurbs::new(degree, log.points(open), log.weights(open), knots)
            .map_err(|error| no_curve(open, &error, span))?;
        self.push_curve(block, curve, None, out)
    }
}

fn push_point(
    (open, log): (&mut OpenSpline, &mut SplineLog),
    block: &Block,
    point: AxisVector,
    weight: f64,
) -> Outcome<()> {
    if open.points >= MAX_POINTS {
        let message = format!("a NURBS of more than {MAX_POINTS} control points");
        return Err(
            BlockDiagnostic::new(DiagnosticCode::Spline, block.motion_span(), message)
                .because("a curve is kept until it is complete")
                .help("write several curves"),
        );
    }
    log.add_point(open, point, weight);
    Ok(())
}

/// A weight; 1 if the block has none.
fn positive_weight(block: &Block, letter: u8) -> Outcome<f64> {
    match block.get(letter) {
        Some(weight) if weight > 0.0 => Ok(weight),
        Some(weight) => {
            let message = format!("a weight of {weight}");
            Err(
                BlockDiagnostic::new(DiagnosticCode::Spline, block.span(letter), message)
                    .because(
                        "a control point of no weight draws nothing, one below zero pushes away",
                    )
                    .help("write a weight above zero"),
            )
        }
        None => Ok(1.0),
    }
}

fn no_curve(open: &OpenSpline, error: &NurbsError, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("the NURBS begun in line {} is no curve", open.line);
    let help = match error {
        NurbsError::TooFewPoints { .. } => "write more control points, or a lower order",
        NurbsError::StandsStill { .. } => "remove the control points that repeat",
        _ => "correct its knots",
    };
    BlockDiagnostic::new(DiagnosticCode::Spline, span, message)
        .because(error.to_string())
        .help(help)
}

/// The axis words a control point has.
pub(crate) fn has_point(block: &Block) -> bool {
    block.has_any(AXIS_WORDS) || block.polar.iter().any(Option::is_some)
}
