//! An implicit curve as a sequence of chords whose error is proven.

use super::branch::Branch;
use super::node::touching_point;
use super::passage::Passage;
use super::step::{ImplicitStep, ImplicitStepper, StepperState, onto_curve};
use super::tube::chord_error_mm;
use super::{ImplicitCurve, curvature_k};
use crate::{Chord, ChordRule, CurveError, arc_over_chord, chord_mm, sagitta_mm};
use nalgebra::Vector3;

/// How far a given point may be off the curve, mm: coordinates in files are rounded.
const GIVEN_MM: f64 = 0.01;
/// Length after which a curve that does not end is given up, mm.
const ENDLESS_MM: f64 = 1e7;
/// Corrections beyond which a chord is too long for the curve.
const HARD: u32 = 6;
/// How far ahead or behind a node is looked for, in chords.
const NODE_CHORDS: f64 = 10.0;
/// Longest chord without proof where surfaces nearly touch, mm.
const TOUCHING_MM: f64 = 0.01;
/// How far an end may be off the curve, mm: as far as it is solved for where surfaces nearly touch.
const END_MM: f64 = 1e-7;
/// An end that is nearer to the start is the start, mm.
const AT_START_MM: f64 = 1e-9;
/// Angle of the surfaces (its sine) below which they nearly touch.
const TOUCHING_SINE: f64 = 0.01;

/// The end of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    /// Back at its start.
    Closed,
    /// At a point of the curve.
    At(Vector3<f64>),
    /// After a length along the curve, mm.
    Length(f64),
}

/// Chords from a start to an end.
#[derive(Debug, Clone)]
pub struct ImplicitChords {
    curve: ImplicitCurve,
    place: StepperState,
    rule: ChordRule,
    /// Where it ends, if at a point.
    target: Option<Vector3<f64>>,
    /// Tangents of the branch by which a closed curve left a node, and of the other: passing the
    /// node on the other is not its end.
    branches: Option<[Vector3<f64>; 2]>,
    /// Length along the curve at which it ends, mm.
    until_mm: f64,
    travelled_mm: f64,
    last_mm: f64,
    is_over: bool,
}

/// The branches of a node next to a point, first the one that leads ahead, or nearly.
fn leaving(
    curve: &ImplicitCurve,
    point: &Vector3<f64>,
    ahead: &Vector3<f64>,
) -> Result<[Branch; 2], CurveError> {
    let branches = Branch::through(curve, point, GIVEN_MM, ahead)
        .ok_or(CurveError::Singular { point: *point })?;
    let straight = |branch: &Branch| branch.along().dot(ahead) / ahead.norm();
    let [a, b] = branches;
    let (branch, other) = if straight(&a) >= straight(&b) {
        (a, b)
    } else {
        (b, a)
    };
    // Midway between the branches, no one can tell which is meant.
    let is_told = straight(&branch) > straight(&other) + 1e-6;
    is_told
        .then_some([branch, other])
        .ok_or(CurveError::Sideways)
}

/// The end of a curve: the point next to the given one, or the node.
fn ending(curve: &ImplicitCurve, point: &Vector3<f64>) -> Result<Vector3<f64>, CurveError> {
    let end = onto_curve(curve, point, GIVEN_MM)?;
    let is_clean = curve.contact(&end).is_clean();
    let node = if is_clean {
        None
    } else {
        touching_point(curve, &end, GIVEN_MM)
    };
    Ok(node.unwrap_or(end))
}

impl ImplicitChords {
    /// Chords from the point of the curve next to `start`, in the direction of `ahead`.
    ///
    /// # Errors
    /// Start or end are not on the curve, or the surfaces touch at the start without crossing.
    pub fn new(
        curve: ImplicitCurve,
        start: &Vector3<f64>,
        ahead: &Vector3<f64>,
        end: End,
        rule: ChordRule,
    ) -> Result<Self, CurveError> {
        let mut start = onto_curve(&curve, start, GIVEN_MM)?;
        let mut branches = None;
        let place = match ImplicitStepper::new(&curve, start, ahead) {
            Err(CurveError::Singular { point }) => {
                let [branch, other] = leaving(&curve, &point, ahead)?;
                start = *branch.node();
                branches = Some([*branch.along(), *other.along()]);
                StepperState::new(&curve, start, *branch.along())
            }
            stepper => stepper?.place(),
        };
        let (target, until_mm) = match end {
            End::Closed => (Some(start), ENDLESS_MM),
            End::At(point) => (Some(ending(&curve, &point)?), ENDLESS_MM),
            End::Length(length_mm) => (None, length_mm),
        };
        let branches = branches.filter(|_| end == End::Closed);
        Ok(Self {
            curve,
            place,
            rule,
            target,
            branches,
            until_mm,
            travelled_mm: 0.0,
            last_mm: f64::INFINITY,
            is_over: false,
        })
    }

    /// Where the next chord starts.
    #[must_use]
    pub const fn point(&self) -> &Vector3<f64> {
        &self.place.point
    }

    /// The next chord; `None` after the last.
    ///
    /// # Errors
    /// The error of no chord can be bounded, or the end does not come.
    pub fn next_chord(&mut self) -> Result<Option<Chord>, CurveError> {
        if self.is_over {
            return Ok(None);
        }
        if self.travelled_mm >= ENDLESS_MM {
            return Err(CurveError::Endless {
                length_mm: ENDLESS_MM,
            });
        }
        let here = self.bend_k(self.point());
        let mut wanted = self.rule.longest_mm.min(1.5 * self.last_mm);
        if here.is_finite() {
            wanted = wanted.min(chord_mm(here, self.rule.error_mm));
        }
        loop {
            let rest = self.until_mm - self.travelled_mm;
            let bend = if here.is_finite() && here * rest < 1.0 {
                arc_over_chord(here, rest)
            } else {
                1.0
            };
            wanted = wanted.min(rest / bend);
            if let Some((step, chord)) = self.attempt(wanted) {
                return Ok(Some(self.take(&step, chord, wanted)));
            }
            let is_least = wanted <= self.rule.shortest_mm();
            if is_least {
                return Err(CurveError::Singular {
                    point: *self.point(),
                });
            }
            wanted *= 0.6;
        }
    }

    /// A chord of a length, if it is within the error.
    fn attempt(&self, wanted: f64) -> Option<(ImplicitStep, Chord)> {
        let stepper = ImplicitStepper::resume(&self.curve, self.place);
        let step = stepper.look(wanted).ok();
        let step = step.filter(|step| step.corrections <= HARD);
        let expected = step.map(|step| self.expected_mm(&step, wanted));
        let proven = step.zip(expected).and_then(|(step, expected)| {
            let error_mm = chord_error_mm(&self.curve, self.point(), &step.point, expected)?;
            (error_mm <= self.rule.error_mm).then_some((step, error_mm))
        });
        let proven = proven.or_else(|| self.past_node(wanted));
        let is_proven = proven.is_some();
        let (step, error_mm) = proven.or_else(|| {
            // Of surfaces that nearly touch nothing can be proven, but a short chord is harmless.
            let (step, error_mm) = (step?, 2.0 * expected?);
            let is_short = wanted <= TOUCHING_MM && step.sine <= TOUCHING_SINE;
            (is_short && error_mm <= self.rule.error_mm).then_some((step, error_mm))
        })?;
        let chord = Chord {
            point: step.point,
            chord_mm: wanted,
            error_mm,
            is_proven,
        };
        Some((step, chord))
    }

    /// A chord of a length along the branch of a node nearby, and its error.
    fn past_node(&self, wanted: f64) -> Option<(ImplicitStep, f64)> {
        let (branch, from_s) = self.branch(wanted)?;
        let from = *self.point();
        let (to_s, point) = branch.step(&self.curve, from_s, &from, wanted)?;
        let passage = Passage {
            curve: &self.curve,
            branch: &branch,
            s: [from_s, to_s],
            ends: [from, point],
        };
        let error_mm = passage.error_mm(self.rule.error_mm)?;
        let stepper = ImplicitStepper::resume(&self.curve, self.place);
        Some((stepper.at(point), error_mm))
    }

    /// The branch of a node nearby on which the next chord begins, and where it does.
    fn branch(&self, chord_mm: f64) -> Option<(Branch, f64)> {
        let stepper = ImplicitStepper::resume(&self.curve, self.place);
        let (from, ahead) = (self.point(), stepper.ahead());
        // ∇f × ∇g vanishes at a node, nearly in proportion to the way to it.
        let along = |point: &Vector3<f64>| self.curve.contact(point).along();
        let here = along(from);
        let change = along(&(from + ahead * chord_mm)) - here;
        let chords = -here.dot(&change) / change.norm_squared();
        if chords.is_nan() || chords.abs() > NODE_CHORDS {
            return None;
        }
        let guess = from + ahead * (chord_mm * chords);
        let reach_mm = NODE_CHORDS * chord_mm;
        let branches = Branch::through(&self.curve, &guess, reach_mm, &ahead)?;
        let straight = |branch: &Branch| branch.along().dot(&ahead);
        branches
            .into_iter()
            .filter_map(|branch| Some((branch, branch.place(&self.curve, from)?)))
            .max_by(|(a, _), (b, _)| straight(a).total_cmp(&straight(b)))
    }

    /// Curvature at a point, 1/mm: that of the branch at a node where surfaces nearly touch,
    /// because it is lost in rounding there.
    fn bend_k(&self, point: &Vector3<f64>) -> f64 {
        if self.curve.contact(point).sine() >= TOUCHING_SINE {
            return curvature_k(&self.curve, point);
        }
        self.branch(self.rule.longest_mm)
            .map_or(f64::INFINITY, |(branch, _)| branch.curvature_k())
    }

    /// The sagitta by the curvature at both ends, as far as it is known.
    fn expected_mm(&self, step: &ImplicitStep, chord: f64) -> f64 {
        let ends = [*self.point(), step.point];
        let sharpest = ends
            .iter()
            .map(|p| curvature_k(&self.curve, p))
            .filter(|k| k.is_finite())
            .fold(1e-6, f64::max);
        sagitta_mm(sharpest, chord).min(chord)
    }

    fn take(&mut self, step: &ImplicitStep, chord: Chord, wanted: f64) -> Chord {
        self.last_mm = wanted;
        let from = *self.point();
        if let Some(target) = self.passed(&from, &chord) {
            self.is_over = true;
            self.place.point = target;
            return Chord {
                point: target,
                chord_mm: (target - from).norm(),
                ..chord
            };
        }
        let mut stepper = ImplicitStepper::resume(&self.curve, self.place);
        stepper.advance(step);
        self.place = stepper.place();
        let curvature = self.bend_k(&step.point);
        let arc = if curvature.is_finite() && curvature * wanted < 1.0 {
            wanted * arc_over_chord(curvature, wanted)
        } else {
            wanted
        };
        self.travelled_mm += arc;
        if self.travelled_mm >= self.until_mm - 1e-9 {
            self.is_over = true;
        }
        chord
    }

    /// The end point, if a chord passes it. The curve of a chord is inside a tube around it as wide
    /// as its error, and there is no other in it: a point of the curve is the end of a part of the
    /// chord if it is in that tube, and only then. However large the errors are that the rule
    /// allows, what is beyond is another part of the curve.
    fn passed(&self, from: &Vector3<f64>, chord: &Chord) -> Option<Vector3<f64>> {
        let target = self.target?;
        let along = chord.point - from;
        let out = target - from;
        // A closed curve begins at its end.
        if self.travelled_mm <= 0.0 && out.norm() <= AT_START_MM {
            return None;
        }
        let share = out.dot(&along) / along.norm_squared();
        let off = (out - along * share).norm();
        let near = chord.error_mm + END_MM;
        let is_home = self
            .branches
            .is_none_or(|[own, other]| own.dot(&along).abs() > other.dot(&along).abs());
        let is_passed = share > 0.0 && share <= 1.0 + 1e-9 && off <= near;
        (is_home && is_passed).then_some(target)
    }
}
