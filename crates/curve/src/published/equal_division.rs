//! The published division of a whole curve into equal chords.
//!
//! Production has no use for it: the last chord of a curve may be shorter than the others.

use crate::CurveError;
use crate::parametric::{Method, ParametricCurve, ParametricStepper, inside};

/// Chords that divide a domain into equal ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EqualChords {
    /// Full chords of the length asked for.
    pub full: u32,
    /// What then remains to the end, mm, shorter than a chord.
    pub remainder_mm: f64,
    /// The number of equal chords, one more than `full`.
    pub count: u32,
    /// Their length, mm.
    pub chord_mm: f64,
}

/// The chord not longer than `chord_mm` of which a whole number leads from `from` to `to`.
///
/// # Errors
/// The curve is not defined or not bounded, or the length cannot be found.
pub fn equal_chords(
    curve: &ParametricCurve,
    (from, to): (f64, f64),
    chord_mm: f64,
) -> Result<EqualChords, CurveError> {
    let walk = |chord_mm: f64, most: u32| -> Result<(u32, f64), CurveError> {
        let mut stepper = ParametricStepper::new(curve, from, Method::Newton);
        for count in 0..most {
            let step = stepper.look(chord_mm, to)?;
            if step.is_end {
                return Ok((count, step.chord_mm));
            }
            stepper.advance(&step);
        }
        // Too short: what is left, as if it were negative.
        let left = (curve.point(to) - stepper.local().point).norm();
        Ok((most, left))
    };
    let (full, remainder_mm) = walk(chord_mm, u32::MAX)?;
    let count = full + 1;
    // How much the last of `count` chords is longer than the others: 0 for the equal ones. Falls as
    // the others grow.
    let excess = |chord: f64| -> Result<f64, CurveError> {
        let (done, rest) = walk(chord, full)?;
        Ok(if done < full {
            rest - chord - chord * f64::from(full - done)
        } else {
            rest - chord
        })
    };
    let (mut short, mut long) = (chord_mm * f64::from(full) / f64::from(count + 1), chord_mm);
    let (mut x, mut last) = (chord_mm, (chord_mm, remainder_mm - chord_mm));
    x -= (chord_mm - remainder_mm) / f64::from(count);
    for _ in 0..100 {
        let y = excess(x)?;
        if y.abs() <= 1e-11 * f64::from(count) || long - short <= 1e-14 * chord_mm {
            return Ok(EqualChords {
                full,
                remainder_mm,
                count,
                chord_mm: x,
            });
        }
        if y > 0.0 {
            short = x;
        } else {
            long = x;
        }
        let secant = x - y * (x - last.0) / (y - last.1);
        last = (x, y);
        x = inside(secant, short, long);
    }
    Err(CurveError::Unbounded { t: to })
}
