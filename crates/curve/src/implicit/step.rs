//! One chord along an implicit curve.
//!
//! Three equations for the end q of a chord from p: f(q) = 0, g(q) = 0, |q − p| = L. The predictor
//! is the last chord mirrored in the tangent, d = 2 (T·u) T − u: exact on circles, off by O(L³)
//! else, and free. Newton's method corrects, until the residuals are as small as the angle of the
//! surfaces needs: a residual r is a distance of about r / sin(angle).
//!
//! Where the surfaces (nearly) touch, the tangent is not to be had from the gradients: two
//! branches may cross there. The chord is then continued from the last two, d = 2 d₁ − d₂, and
//! corrected by Gauss-Newton steps in the directions the equations do determine. That stays on the
//! branch it came by; `branch.rs` does better where the surfaces touch exactly, and proves it.

use super::{Contact, ImplicitCurve};
use crate::CurveError;
use nalgebra::{Matrix3, Vector3};

/// Angle of the surfaces below which they count as touching (its sine). A residual of the equations is that
/// much more in the distance: a thousand times, here.
const TOUCHING: f64 = 1e-3;
/// Directions in which the equations change less than this are left alone.
const UNDETERMINED: f64 = 1e-8;
/// Cosine of the largest turn of the tangent against the last chord: 20°.
const TURN: f64 = 0.939_372_712_847_378_9;
/// Residual wanted where surfaces cross at right angles, mm.
const PRECISION_MM: f64 = 1e-10;
/// Longest correction, in chords.
const MOST_CORRECTION_R: f64 = 0.1;
/// Corrections at most; one to four are taken.
const CORRECTIONS: u32 = 60;

/// The end of a chord.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImplicitStep {
    /// mm.
    pub point: Vector3<f64>,
    /// Corrections taken.
    pub corrections: u32,
    /// Evaluations of both surfaces with their gradients.
    pub evaluations: u32,
    /// Sine of the angle between the surfaces, the smaller of both ends: near 0 near a node.
    pub sine: f64,
    contact: Contact,
}

/// Walks along a curve in chords.
#[derive(Debug, Clone)]
pub struct ImplicitStepper<'a> {
    curve: &'a ImplicitCurve,
    place: StepperState,
}

/// Where a stepper stands, and how it came there.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepperState {
    pub(super) point: Vector3<f64>,
    contact: Contact,
    /// The last two chords, the newer first; before the first chord, the direction to take.
    chords: [Option<Vector3<f64>>; 2],
    ahead: Vector3<f64>,
}

impl StepperState {
    /// At the start of a curve that leads `ahead`.
    pub(super) fn new(curve: &ImplicitCurve, point: Vector3<f64>, ahead: Vector3<f64>) -> Self {
        Self {
            point,
            contact: curve.contact(&point),
            chords: [None; 2],
            ahead,
        }
    }
}

/// Moves a point onto the curve the shortest way, by at most `most_mm`.
///
/// # Errors
/// There is no point of the curve that near.
pub fn onto_curve(
    curve: &ImplicitCurve,
    point: &Vector3<f64>,
    most_mm: f64,
) -> Result<Vector3<f64>, CurveError> {
    let mut moved = *point;
    for _ in 0..CORRECTIONS {
        let contact = curve.contact(&moved);
        if contact.residual_mm() <= PRECISION_MM * contact.sine().min(1.0) {
            break;
        }
        let rows = contact.rows(None);
        let step = rows.solve();
        moved -= step;
        if step.norm() <= 1e-15 * moved.amax() {
            break;
        }
    }
    let contact = curve.contact(&moved);
    let is_there = contact.residual_mm() <= 1e-9 && (moved - point).norm() <= most_mm;
    is_there
        .then_some(moved)
        .ok_or(CurveError::Lost { point: *point })
}

/// Equations to be solved, scaled to unit rows.
struct Rows {
    matrix: Matrix3<f64>,
    residual: Vector3<f64>,
}

impl Contact {
    /// Both surfaces, and the sphere that holds the end of the chord.
    fn rows(&self, sphere: Option<(Vector3<f64>, f64)>) -> Rows {
        let mut matrix = Matrix3::zeros();
        let mut residual = Vector3::zeros();
        for i in 0..2 {
            let size = self.normals[i].norm();
            matrix.set_row(i, &(self.normals[i] / size).transpose());
            residual[i] = self.values[i] / size;
        }
        if let Some((unit, excess)) = sphere {
            matrix.set_row(2, &unit.transpose());
            residual[2] = excess;
        }
        Rows { matrix, residual }
    }
}

impl Rows {
    fn size(&self) -> f64 {
        self.residual.amax()
    }

    /// The shortest correction, in the directions that the equations determine.
    fn solve(&self) -> Vector3<f64> {
        let unsolvable = Vector3::repeat(f64::NAN);
        if !self.matrix.iter().all(|c| c.is_finite()) {
            return unsolvable;
        }
        let det = self.matrix.determinant();
        if det.abs() > UNDETERMINED {
            return self.matrix.lu().solve(&self.residual).unwrap_or(unsolvable);
        }
        self.matrix
            .svd(true, true)
            .solve(&self.residual, UNDETERMINED)
            .unwrap_or(unsolvable)
    }
}

impl<'a> ImplicitStepper<'a> {
    /// Starts at a point of the curve, in the direction of `ahead`.
    ///
    /// # Errors
    /// The surfaces touch there, or the curve runs across the direction.
    pub fn new(
        curve: &'a ImplicitCurve,
        point: Vector3<f64>,
        ahead: &Vector3<f64>,
    ) -> Result<Self, CurveError> {
        let contact = curve.contact(&point);
        if !contact.is_clean() {
            return Err(CurveError::Singular { point });
        }
        let along = contact.tangent(ahead);
        if along.dot(ahead) <= 1e-6 * ahead.norm() {
            return Err(CurveError::Sideways);
        }
        let place = StepperState::new(curve, point, along);
        Ok(Self { curve, place })
    }

    /// Goes on where another one stood.
    pub(super) const fn resume(curve: &'a ImplicitCurve, place: StepperState) -> Self {
        Self { curve, place }
    }

    /// Where it stands, to go on from later.
    pub(super) const fn place(&self) -> StepperState {
        self.place
    }

    /// Where it stands.
    #[must_use]
    pub const fn point(&self) -> &Vector3<f64> {
        &self.place.point
    }

    /// Unit vector the way it goes: along the tangent, or along the last chord near a node.
    #[must_use]
    pub fn ahead(&self) -> Vector3<f64> {
        if self.place.contact.is_clean() {
            self.place.contact.tangent(&self.place.ahead)
        } else {
            self.place.ahead
        }
    }

    fn predict(&self, chord_mm: f64) -> Vector3<f64> {
        let tangent = self.place.contact.tangent(&self.place.ahead);
        let Some(last) = self.place.chords[0].map(|d| d.normalize()) else {
            return tangent * chord_mm;
        };
        if self.place.contact.is_clean() && tangent.dot(&last) >= TURN {
            // The curve turned from the last chord to the tangent, and goes on turning: as much for
            // a chord of the same length (the mirror), in proportion for another.
            let across = tangent * tangent.dot(&last) - last;
            let sine = across.norm();
            if sine < 1e-12 {
                return tangent * chord_mm;
            }
            let ratio = chord_mm / self.place.chords[0].map_or(chord_mm, |d| d.norm());
            let (sin, cos) = (sine.asin() * ratio).sin_cos();
            return (tangent * cos + across * (sin / sine)) * chord_mm;
        }
        let before = self.place.chords[1].map_or(last, |d| d.normalize());
        (last * 2.0 - before).normalize() * chord_mm
    }

    /// The end of the next chord of a length. Does not move.
    ///
    /// # Errors
    /// The corrector does not find a point of the curve at that distance, ahead.
    pub fn look(&self, chord_mm: f64) -> Result<ImplicitStep, CurveError> {
        let lost = CurveError::Lost {
            point: self.place.point,
        };
        let predicted = self.predict(chord_mm);
        let mut point = self.place.point + predicted;
        let mut last_size = f64::INFINITY;
        for corrections in 0..CORRECTIONS {
            let contact = self.curve.contact(&point);
            let out = point - self.place.point;
            let distance = out.norm();
            // (d² − L²)/(2L), which is d − L to first order where d is L; its gradient is the way out over L.
            let square = distance * distance - chord_mm * chord_mm;
            let rows = contact.rows(Some((out / chord_mm, 0.5 * square / chord_mm)));
            let (size, sine) = (rows.size(), contact.sine());
            let floor = 16.0 * f64::EPSILON * point.amax();
            let is_exact = size <= (PRECISION_MM * sine).max(floor);
            // Rounding decides where surfaces hardly differ; no progress there is the end of it.
            let is_stuck = size <= PRECISION_MM && size >= 0.5 * last_size;
            if is_exact || is_stuck {
                if out.dot(&predicted) < 0.5 * chord_mm * chord_mm {
                    return Err(lost);
                }
                return Ok(ImplicitStep {
                    point,
                    corrections,
                    evaluations: corrections + 1,
                    sine: sine.min(self.place.contact.sine()),
                    contact,
                });
            }
            last_size = size;
            let correction = rows.solve();
            let length = correction.norm();
            if !length.is_finite() {
                return Err(lost);
            }
            // Next to a node Newton's step may lead to the other branch, or anywhere.
            point -= correction * (MOST_CORRECTION_R * chord_mm / length).min(1.0);
        }
        Err(lost)
    }

    /// A step to a point of the curve that is known.
    pub(super) fn at(&self, point: Vector3<f64>) -> ImplicitStep {
        let contact = self.curve.contact(&point);
        ImplicitStep {
            point,
            corrections: 0,
            evaluations: 1,
            sine: contact.sine().min(self.place.contact.sine()),
            contact,
        }
    }

    /// Moves to the end of a chord.
    pub fn advance(&mut self, step: &ImplicitStep) {
        let chord = step.point - self.place.point;
        self.place.chords = [Some(chord), self.place.chords[0]];
        self.place.ahead = chord.normalize();
        self.place.point = step.point;
        self.place.contact = step.contact;
    }
}

impl Contact {
    pub(super) fn is_clean(&self) -> bool {
        self.sine() >= TOUCHING
    }
}
