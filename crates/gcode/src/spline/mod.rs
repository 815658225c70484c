//! Splines: one block (G5, G5.1), or a list of control points (G5.2 … G5.3, G6.2).
//!
//! | words | curve |
//! |---|---|
//! | G5 X Y I J P Q | cubic: control points start + (I, J) and end + (P, Q); without I J as smooth as the G5 before goes on |
//! | G5.1 X Y I J | quadratic: control point start + (I, J) |
//! | G5.2 P L, then X Y P …, then G5.3 | NURBS with weights P and uniform knots; L: degree + 1, 3 if it is not given. The first control point is where the tool stands |
//! | G6.2 P, X Y Z K R …, then K alone | NURBS with knots K and weights R, P: degree + 1, 4 if it is not given. The first control point is given, and is where the tool stands |
//!
//! The words are those of LinuxCNC and, for G6.2, those FANUC writes as G06.2 (Q is read over). G5 and
//! G5.1 go in the XY plane, G5.2 in the two axes of the active plane, G6.2 in any axes.
//!
//! A curve is given out in smooth pieces (straight ones, where other axes than X, Y, Z move along) that
//! are away from it by no more than [`crate::Options::spline_tolerance_mm`].

mod open;

use glidepath_geometry::{Axis, AxisVector, Nurbs, NurbsPath, Plane, Segment};
use glidepath_program::{Item, PathMode};

use crate::block::{AXIS_WORDS, Block, Letters};
use crate::diagnostic::{Code, Fault, Outcome, Span};
use crate::interpreter::Interpreter;
use crate::modes::{Motion, Spline};
use crate::moves::{Pace, Speed, motion_span, settled};
use crate::words::missing;
pub(crate) use open::OpenSpline;

/// Share of the tolerance of G64 P that the pieces of a curve may be away from it.
const PIECE_R: f64 = 1e-3;

impl Interpreter {
    /// Makes a spline, or the part of one that stands in a block.
    pub(crate) fn spline(
        &mut self,
        block: &Block,
        spline: Spline,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        if self.compensation.is_some() || self.state.leaving_contour {
            let span = motion_span(block);
            let message = "a spline with cutter radius compensation";
            return Err(Fault::new(Code::Spline, span, message)
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
        let span = motion_span(block);
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
            return Err(missing(motion_span(block), "G5.1", "I or J", meaning));
        }
        let offset = [b'I', b'J'].map(|letter| block.get(letter).unwrap_or(0.0));
        let offset = self.turned(offset);
        let (start, end) = self.ends(block)?;
        self.bezier(block, &[start, beside(start, offset), end], out)
    }

    /// Refuses what a spline of one block cannot be.
    fn check_xy(&self, block: &Block, code: &str) -> Outcome<()> {
        let span = motion_span(block);
        if self.state.modal.plane != Plane::Xy {
            return Err(
                Fault::new(Code::Spline, span, format!("{code} outside the XY plane"))
                    .because("its control points are given in X and Y")
                    .help("write G17 before it"),
            );
        }
        let other = block
            .axes()
            .find(|(axis, _)| !matches!(axis, Axis::X | Axis::Y));
        if let Some((axis, _)) = other {
            let message = format!("{axis} in a block with {code}");
            return Err(Fault::new(Code::Spline, block.axis_span(axis), message)
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
        let turned = self.offsets.system().rotate(by, 1.0);
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
            Ok(curve) => self.push_curve(block, curve, out),
            Err(error) => Err(Fault::new(
                Code::Spline,
                motion_span(block),
                error.to_string(),
            )),
        }
    }

    /// Refuses the end of the input inside a NURBS.
    pub(crate) fn check_spline_complete(&self) -> Outcome<()> {
        self.open_spline
            .as_ref()
            .map_or(Ok(()), |open| Err(interrupted(open, Span::default())))
    }

    /// Gives out a curve, piece by piece, at the feedrate. It starts where the last move ended.
    fn push_curve(&mut self, block: &Block, curve: Nurbs, out: &mut Vec<Item>) -> Outcome<()> {
        let error_mm = match self.state.modal.path_mode {
            PathMode::Continuous {
                tolerance_mm: Some(tolerance_mm),
            } => PIECE_R * tolerance_mm,
            _ => self.options.spline_tolerance_mm,
        };
        let path = NurbsPath::new(curve);
        let start = self.state.path_end;
        let segments = path.segments(error_mm);
        let (low, high) = segments
            .iter()
            .fold((start, start), |(low, high), segment| {
                let (from, to) = segment.bounding_box();
                (low.inf(&from), high.sup(&to))
            });
        self.check_limits(block, &low, &high, "a point")?;
        let farthest = Segment::line(low, high);
        let speed = match self.speed(block, &farthest, Pace::Feed)? {
            // The whole curve is one move.
            Speed::Moves(per_minute) => Speed::Feed(path.length() * per_minute / 60.0),
            speed => speed,
        };
        for segment in segments {
            self.push_move(segment, speed, out);
        }
        Ok(())
    }
}

/// A point moved in X and Y.
fn beside(point: AxisVector, by: [f64; 2]) -> AxisVector {
    let mut moved = point;
    moved[0] += by[0];
    moved[1] += by[1];
    moved
}

/// Refuses a block between the blocks of a NURBS.
pub(crate) fn interrupted(open: &OpenSpline, span: Span) -> Box<Fault> {
    let message = format!("the NURBS begun in line {} is not complete", open.line);
    Fault::new(Code::Spline, span, message)
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

/// The axis words a control point has.
fn has_point(block: &Block) -> bool {
    block.has_any(AXIS_WORDS) || block.polar.iter().any(Option::is_some)
}
