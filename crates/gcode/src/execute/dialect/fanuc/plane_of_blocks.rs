//! P2 and P3 of G68.2: a plane by three points, or by two directions, one to a block.
//!
//! | | |
//! |---|---|
//! | `G68.2 P2 Q1 X Y Z`, `P2 Q2 …`, `P2 Q3 …` | the zero is the first point; X leads to the second one; the third one is on the side of Y |
//! | `G68.2 P2 Q0 X Y Z` before them | the zero goes on by X, Y and Z of the plane |
//! | `G68.2 P2 Q0 R` before them | the plane turns by R about its normal |
//! | `G68.2 P3 Q1 X Y Z I J K`, `P3 Q2 I J K` | the zero and the direction of X; the direction of Z |

use glidepath_geometry::AxisVector;
use nalgebra::Vector3;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::frame::Frame;
use crate::execute::state::open_plane::OpenPlane;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::frame_codes::{FrameCode, TiltCode};
use crate::syntax::letters::Letters;
use crate::syntax::word_check::{missing, whole};

/// Points that are less far apart are one point, mm.
const APART_MM: f64 = 1e-6;
/// Sine of the least angle between two directions that give a plane.
const LEAST_SINE: f64 = 1e-3;
/// Cosine of an angle that is no right one: 0.1 degrees beside it, for numbers of a few digits.
const MOST_COSINE: f64 = 1.75e-3;

impl Interpreter {
    /// One block of a plane; the plane begins with its last one.
    pub(super) fn plane_of_blocks(
        &mut self,
        block: &Block,
        form: u32,
        span: SourceSpan,
    ) -> Outcome<()> {
        self.check_may_tilt(span)?;
        let meaning = "which block of the plane it is";
        let number = whole(block, b'Q', 3)?.ok_or_else(|| missing(span, "G68.2", "Q", meaning))?;
        let open = match (form, number, self.state.fanuc.open_plane.take()) {
            (2, 0, None) => self.way_in_plane(block)?,
            (2, 1, None) => OpenPlane::of_points().and_point(self.point(block)?),
            (2, 1..=2, Some(open)) if open.is_point(number) => open.and_point(self.point(block)?),
            (2, 3, Some(open)) if open.is_point(number) => {
                let frame = by_points(&open, self.point(block)?, span)?;
                return self.begin_tilt(frame, span);
            }
            (3, 1, None) => OpenPlane::Directions {
                zero: self.point(block)?,
                x: direction(block)?,
            },
            (3, 2, Some(OpenPlane::Directions { zero, x })) => {
                let frame = by_directions(&zero, &x, &direction(block)?, span)?;
                return self.begin_tilt(frame, span);
            }
            _ => return Err(out_of_order(block)),
        };
        self.state.fanuc.open_plane = Some(open);
        Ok(())
    }

    /// Refuses what stands between the blocks of a plane; G69 gives it up.
    pub(crate) fn check_open_plane(&mut self, block: &Block) -> Outcome<()> {
        let goes_on = matches!(
            block.codes.tilt,
            Some(Coded {
                code: TiltCode::Plane,
                ..
            })
        );
        if self.state.fanuc.open_plane.is_none() || goes_on {
            return Ok(());
        }
        let codes = &block.codes;
        let frame = codes.frame.map(|coded| coded.code);
        if frame == Some(FrameCode::Turn(false)) || codes.frame_ends[1] {
            self.state.fanuc.open_plane = None;
            return Ok(());
        }
        let only_assigns = !block.codes.any() && block.unused(Letters::of(b"")).is_none();
        if only_assigns {
            return Ok(());
        }
        self.check_plane_complete(block.first_span())
    }

    /// Refuses what ends a plane before its last block.
    pub(crate) fn check_plane_complete(&self, span: SourceSpan) -> Outcome<()> {
        match self.state.fanuc.open_plane {
            Some(_) => Err(incomplete(span)),
            None => Ok(()),
        }
    }

    /// Q0: the zero of the plane, seen from its first point, or an angle about its normal.
    fn way_in_plane(&self, block: &Block) -> Outcome<OpenPlane> {
        let words = self.axis_values(block)?;
        let shift = Vector3::from_fn(|axis, _| words[axis].unwrap_or(0.0));
        let turn_deg = block.get(b'R').unwrap_or(0.0);
        if shift.norm() > 0.0 && turn_deg.abs() > 0.0 {
            let message = "a way and R in one plane by points";
            return Err(BlockDiagnostic::new(
                DiagnosticCode::AmbiguousWord,
                block.span(b'R'),
                message,
            )
            .because("whether the way counts before the turn or behind it is not known")
            .help("write another first point, or other points instead of R"));
        }
        Ok(OpenPlane::Points {
            shift,
            turn_deg,
            first: None,
            second: None,
        })
    }

    fn point(&self, block: &Block) -> Outcome<Vector3<f64>> {
        let words = self.axis_values(block)?;
        let mut point = Vector3::zeros();
        for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
            let meaning = "a point of the plane";
            let place = words[axis];
            point[axis] =
                place.ok_or_else(|| missing(block.first_span(), "G68.2", name, meaning))?;
        }
        Ok(point)
    }
}

/// I, J and K.
fn direction(block: &Block) -> Outcome<Vector3<f64>> {
    let way = Vector3::from([b'I', b'J', b'K'].map(|letter| block.get(letter).unwrap_or(0.0)));
    if way.norm() > 0.0 {
        return Ok(way.normalize());
    }
    Err(missing(
        block.first_span(),
        "G68.2 P3",
        "I, J, K",
        "a direction in the coordinates of the work",
    ))
}

/// The plane of three points.
fn by_points(open: &OpenPlane, third: Vector3<f64>, span: SourceSpan) -> Outcome<Frame> {
    let OpenPlane::Points {
        shift,
        turn_deg,
        first: Some(first),
        second: Some(second),
    } = *open
    else {
        return Err(incomplete(span));
    };
    let (along, aside) = (second - first, third - first);
    let lengths = along.norm() * aside.norm();
    let normal = along.cross(&aside);
    let is_near = along.norm() < APART_MM || aside.norm() < APART_MM;
    if is_near || normal.norm() < LEAST_SINE * lengths {
        let message = "three points that give no plane";
        return Err(
            BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                .because("they are on one line, or two of them are one point")
                .help("write three corners of the plane"),
        );
    }
    Ok(Frame::shifted(lengths_of(&first))
        .with(&Frame::of_axes(&along.normalize(), &normal.normalize()))
        .with(&Frame::turned([0.0, 0.0, turn_deg]))
        .with(&Frame::shifted(lengths_of(&shift))))
}

/// The plane of the directions of X and Z.
fn by_directions(
    zero: &Vector3<f64>,
    x: &Vector3<f64>,
    z: &Vector3<f64>,
    span: SourceSpan,
) -> Outcome<Frame> {
    if x.dot(z).abs() > MOST_COSINE {
        let message = "directions of X and Z that are not at right angles";
        return Err(
            BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                .because("the axes of a plane are")
                .help("correct I, J and K of Q1 or of Q2"),
        );
    }
    // What digits have left out is taken from X.
    let x = (x - z * x.dot(z)).normalize();
    Ok(Frame::shifted(lengths_of(zero)).with(&Frame::of_axes(&x, z)))
}

fn lengths_of(place: &Vector3<f64>) -> AxisVector {
    let mut lengths = AxisVector::zeros();
    for axis in 0..3 {
        lengths[axis] = place[axis];
    }
    lengths
}

fn out_of_order(block: &Block) -> Box<BlockDiagnostic> {
    let message = "a block of a plane that does not follow the one before it";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, block.span(b'Q'), message)
        .because("three points are P2 with Q1, Q2 and Q3, Q0 may stand before them; two directions are P3 with Q1 and Q2")
        .help("write them in this order, one behind the other")
}

fn incomplete(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "a tilted plane whose blocks are not complete";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("G68.2 P2 has three points, Q1 to Q3, and P3 two directions, Q1 and Q2")
        .help("write the blocks of G68.2 one behind the other, or G69, which gives the plane up")
}
