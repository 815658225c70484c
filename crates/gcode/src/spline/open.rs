//! NURBS whose control points come block by block.

use glidepath_geometry::{AxisVector, Nurbs, NurbsError};
use glidepath_program::Item;

use crate::block::Block;
use crate::diagnostic::{Code, Fault, Outcome, Span};
use crate::interpreter::Interpreter;
use crate::modes::Spline;
use crate::moves::motion_span;
use crate::spline::has_point;
use crate::words::{missing, whole};

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

/// A curve as far as it is known.
#[derive(Debug, Clone)]
pub(crate) struct OpenSpline {
    knotted: bool,
    order: u32,
    points: Vec<AxisVector>,
    weights: Vec<f64>,
    knots: Vec<f64>,
    /// Line of its first block.
    pub(crate) line: u32,
}

/// How far a curve was known before a block.
pub(crate) type Mark = Option<(usize, usize, u32)>;

impl OpenSpline {
    pub(crate) fn mark(open: Option<&Self>) -> Mark {
        open.map(|open| (open.points.len(), open.knots.len(), open.order))
    }

    /// Takes back what a refused block has added. A curve that was completed is gone.
    pub(crate) fn rewind(open: &mut Option<Self>, mark: Mark) {
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

    fn knots_needed(&self) -> usize {
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
    fn uniform_knots(&self) -> Vec<f64> {
        let (order, count) = (self.order as usize, self.points.len());
        let inside = count.saturating_sub(order);
        (0..count + order)
            .map(|i| i.saturating_sub(order - 1).min(inside + 1) as f64)
            .collect()
    }
}

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
        let opens = self.open_spline.is_none();
        let line = self.line;
        let open = self.open_spline.get_or_insert_with(|| OpenSpline {
            knotted: false,
            order: WEIGHTED_ORDER,
            points: vec![start.0],
            weights: vec![start.1],
            knots: Vec::new(),
            line,
        });
        match order {
            Some(order) if order < 2 => {
                let message = format!("a NURBS of order L{order}");
                return Err(Fault::new(Code::Spline, block.span(b'L'), message)
                    .because("the order is the degree + 1; lines have order 2")
                    .help("write L2 to L8"));
            }
            Some(order) => open.order = order,
            None => {}
        }
        match point {
            Some(point) => push_point(open, block, point, weight),
            None if opens => Ok(()),
            None => Err(missing(
                motion_span(block),
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
            return Err(Fault::new(Code::Spline, block.axis_span(axis), message)
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
                    motion_span(block),
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
        let span = motion_span(block);
        self.state.modal.motion = None;
        let Some(mut open) = self.open_spline.take() else {
            return Err(Fault::new(Code::Spline, span, "G5.3 without G5.2")
                .because("it ends a NURBS, and none has begun")
                .help("write G5.2 and its control points before it"));
        };
        open.knots = open.uniform_knots();
        self.push_nurbs(block, &open, span, out)
    }

    /// G6.2, and every block after it until there are as many knots as the curve needs.
    pub(super) fn knotted_point(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let span = motion_span(block);
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
        let line = self.line;
        let opens = self.open_spline.is_none();
        let here = self.state.path_end;
        let open = self.open_spline.get_or_insert_with(|| OpenSpline {
            knotted: true,
            order: KNOTTED_ORDER,
            points: Vec::new(),
            weights: Vec::new(),
            knots: Vec::new(),
            line,
        });
        match order {
            Some(order) if order < 2 || (!opens && order != open.order) => {
                let message = format!("P{order} cannot be the order of this NURBS");
                return Err(Fault::new(Code::Spline, block.span(b'P'), message)
                    .because("the order is the degree + 1, 2 to 8, and stands in the first block")
                    .help("write P4 for a cubic"));
            }
            Some(order) => open.order = order,
            None => {}
        }
        if open.knots.last().is_some_and(|last| knot < *last) {
            let message = format!("the knot {knot} is below the one before it");
            return Err(Fault::new(Code::Spline, block.span(b'K'), message)
                .because("knots never descend")
                .help("correct K"));
        }
        open.knots.push(knot);
        if let Some(mut point) = point {
            if opens {
                if (point - here).amax() > START_MM {
                    let message = "the first control point is not where the tool stands";
                    return Err(Fault::new(Code::Spline, span, message)
                        .because("the curve begins at its first control point")
                        .help("move there before it, with G1 or G0"));
                }
                point = here;
            }
            if open.knots.len() != open.points.len() + 1 {
                return Err(
                    Fault::new(Code::Spline, span, "a control point after the last knots")
                        .because("blocks with K alone end the list of control points")
                        .help("put the control points before them"),
                );
            }
            self.state.position = point;
            return push_point(open, block, point, weight);
        }
        if opens {
            return Err(missing(span, "G6.2", "an axis", "its first control point"));
        }
        if open.knots.len() < open.knots_needed() {
            return Ok(());
        }
        self.state.modal.motion = None;
        match self.open_spline.take() {
            Some(open) => self.push_nurbs(block, &open, span, out),
            None => Ok(()),
        }
    }

    fn push_nurbs(
        &mut self,
        block: &Block,
        open: &OpenSpline,
        span: Span,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let degree = open.order as usize - 1;
        let curve = Nurbs::new(degree, &open.points, &open.weights, &open.knots)
            .map_err(|error| no_curve(open, &error, span))?;
        self.push_curve(block, curve, out)
    }
}

fn push_point(open: &mut OpenSpline, block: &Block, point: AxisVector, weight: f64) -> Outcome<()> {
    if open.points.len() >= MAX_POINTS {
        let message = format!("a NURBS of more than {MAX_POINTS} control points");
        return Err(Fault::new(Code::Spline, motion_span(block), message)
            .because("a curve is kept until it is complete")
            .help("write several curves"));
    }
    open.points.push(point);
    open.weights.push(weight);
    Ok(())
}

/// A weight; 1 if the block has none.
fn positive_weight(block: &Block, letter: u8) -> Outcome<f64> {
    match block.get(letter) {
        Some(weight) if weight > 0.0 => Ok(weight),
        Some(weight) => {
            let message = format!("a weight of {weight}");
            Err(Fault::new(Code::Spline, block.span(letter), message)
                .because("a control point of no weight draws nothing, one below zero pushes away")
                .help("write a weight above zero"))
        }
        None => Ok(1.0),
    }
}

fn no_curve(open: &OpenSpline, error: &NurbsError, span: Span) -> Box<Fault> {
    let message = format!("the NURBS begun in line {} is no curve", open.line);
    let help = match error {
        NurbsError::TooFewPoints { .. } => "write more control points, or a lower order",
        NurbsError::StandsStill { .. } => "remove the control points that repeat",
        _ => "correct its knots",
    };
    Fault::new(Code::Spline, span, message)
        .because(error.to_string())
        .help(help)
}
