//! The admission of a position to a hexapod: which poses its build and its singularities forbid.

use super::struts::{Hexapod, STRUTS, conditioning_of, lengths_mm};
use crate::machine::MAX_CONDITION;
use crate::{Conditioning, KinematicsError};
use glidepath_geometry::AxisVector;
use nalgebra::Vector3;

/// Smallest singular value of the scaled Jacobian at which the platform is moved: there struts change by a
/// twentieth of what the platform's joints move by, so an error of a length is twenty times that there.
/// With less, positions are allowed in which the platform hardly holds; no measurement of it is kept.
const MIN_SINGULAR_VALUE: f64 = 0.05;
/// By how much a bound is to be kept for nobody to compute it exactly.
const PLAINLY: f64 = 1e-9;

/// The lengths of the struts at a position of the axes that a hexapod may go to, mm.
///
/// A jog asks this for every place of every stop that it plays through, so what is plainly allowed
/// costs little: singular values are computed, and angles, only where they may be beyond.
///
/// # Errors
/// What forbids the position.
pub(super) fn admitted(
    hexapod: &Hexapod,
    axes: &AxisVector,
) -> Result<[f64; STRUTS], KinematicsError> {
    let pose = hexapod.pose(axes);
    let struts = hexapod.struts(&pose);
    let lengths_mm = lengths_mm(&struts);
    let jacobian = hexapod.scaled_jacobian(&pose, &struts, &lengths_mm);
    if !is_plainly_regular(&jacobian) {
        let Conditioning {
            condition,
            smallest,
        } = conditioning_of(&jacobian);
        // Written so that what is not a number is refused.
        if !(condition < MAX_CONDITION && smallest > MIN_SINGULAR_VALUE) {
            return Err(KinematicsError::Singular { condition });
        }
    }
    let most_deg = hexapod.guards.max_base_angle_deg;
    admit_angles(&struts, &lengths_mm, &Vector3::z(), most_deg)?;
    let platform_normal = pose.rotation * Vector3::z();
    let most_deg = hexapod.guards.max_platform_angle_deg;
    admit_angles(&struts, &lengths_mm, &platform_normal, most_deg)?;
    admit_distances(hexapod, &struts)?;
    Ok(lengths_mm)
}

/// Whether the smallest singular value σ of a matrix J, given by its rows, is above what is asked, and so far
/// that their ratio is, too: JᵀJ − σ² has no eigenvalue below zero then, which the pivots of its elimination
/// show, and the largest one is at most the Frobenius norm. False where that is not plain.
fn is_plainly_regular(rows: &[[f64; 6]; STRUTS]) -> bool {
    let least = MIN_SINGULAR_VALUE * (1.0 + PLAINLY);
    // The lower half of JᵀJ.
    let mut gram = [[0.0; 6]; 6];
    for row in rows {
        for i in 0..6 {
            for j in 0..=i {
                gram[i][j] += row[i] * row[j];
            }
        }
    }
    let square: f64 = (0..6).map(|i| gram[i][i]).sum();
    for (i, row) in gram.iter_mut().enumerate() {
        row[i] -= least * least;
    }
    // What is not a number fails both comparisons.
    square.sqrt() < MAX_CONDITION * least && has_positive_pivots(gram)
}

/// Whether elimination of a symmetric matrix, given by its lower half, meets positive pivots alone: it has no
/// eigenvalue below zero then.
#[allow(
    clippy::needless_range_loop,
    reason = "with iterators over parts of rows it takes half as many instructions again"
)]
fn has_positive_pivots(mut lower: [[f64; 6]; 6]) -> bool {
    for k in 0..6 {
        let pivot = lower[k][k];
        // Not a number is no pivot.
        if pivot.partial_cmp(&0.0) != Some(core::cmp::Ordering::Greater) {
            return false;
        }
        for i in k + 1..6 {
            let factor = lower[i][k] / pivot;
            for j in k + 1..=i {
                lower[i][j] -= factor * lower[j][k];
            }
        }
    }
    true
}

fn admit_angles(
    struts: &[Vector3<f64>; STRUTS],
    lengths_mm: &[f64; STRUTS],
    normal: &Vector3<f64>,
    most_deg: f64,
) -> Result<(), KinematicsError> {
    let least_cos = most_deg.to_radians().cos() + PLAINLY;
    for (joint, (strut, length_mm)) in struts.iter().zip(lengths_mm).enumerate() {
        if strut.dot(normal) > least_cos * length_mm {
            continue;
        }
        let angle_deg = strut.angle(normal).to_degrees();
        if angle_deg > most_deg {
            return Err(KinematicsError::Tilted { joint, angle_deg });
        }
    }
    Ok(())
}

fn admit_distances(
    hexapod: &Hexapod,
    struts: &[Vector3<f64>; STRUTS],
) -> Result<(), KinematicsError> {
    if hexapod.guards.min_strut_distance_mm <= 0.0 {
        return Ok(());
    }
    for second in 1..STRUTS {
        for first in 0..second {
            let distance_mm = distance_mm(
                (hexapod.base[first], struts[first]),
                (hexapod.base[second], struts[second]),
            );
            if distance_mm < hexapod.guards.min_strut_distance_mm {
                return Err(KinematicsError::Colliding {
                    first,
                    second,
                    distance_mm,
                });
            }
        }
    }
    Ok(())
}

/// The square of the sine of an angle between struts below which they are parallel: every point of one is
/// as near as another then.
const PARALLEL_R: f64 = 1e-12;

/// Distance of two line pieces, each from a point along a vector.
fn distance_mm((a, u): (Vector3<f64>, Vector3<f64>), (b, v): (Vector3<f64>, Vector3<f64>)) -> f64 {
    let gap = a - b;
    let (uu, uv, vv) = (u.dot(&u), u.dot(&v), v.dot(&v));
    let (ug, vg) = (u.dot(&gap), v.dot(&gap));
    let det = uu * vv - uv * uv;
    // Nearest point of the first line to the second, kept on the piece; then the nearest of the
    // second piece to that, and back: for convex pieces this is the minimum.
    let free = if det > PARALLEL_R * uu * vv {
        ((uv * vg - vv * ug) / det).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let t = ((uv * free + vg) / vv).clamp(0.0, 1.0);
    let s = ((uv * t - ug) / uu).clamp(0.0, 1.0);
    (gap + u * s - v * t).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_plainly_regular_is_by_its_singular_values() {
        let number = |i: u32| (f64::from(i) * 12.9898).sin() * 43_758.545_3;
        let number = |i: u32| number(i) - number(i).floor() - 0.5;
        let (mut plain, mut not) = (0, 0);
        for case in 0..2_000_u32 {
            let mut rows: [[f64; 6]; STRUTS] = core::array::from_fn(|row| {
                core::array::from_fn(|column| {
                    2.0 * number(case * 36 + u32::try_from(6 * row + column).unwrap_or(0))
                })
            });
            // Some of them are nearly singular, by two rows that are nearly the same.
            let near = [1.0, 0.1, 0.05, 0.01][case as usize % 4];
            rows[1] = core::array::from_fn(|column| rows[0][column] + rows[1][column] * near);
            let exact = conditioning_of(&rows);
            let is_regular = exact.condition < MAX_CONDITION && exact.smallest > MIN_SINGULAR_VALUE;
            if is_plainly_regular(&rows) {
                assert!(is_regular, "{case}: {exact:?}");
                plain += 1;
            } else {
                assert!(
                    !is_regular || exact.smallest < MIN_SINGULAR_VALUE * (1.0 + 1e-6),
                    "{case}: {exact:?} took the long way"
                );
                not += 1;
            }
        }
        assert!(plain > 500 && not > 500, "{plain} {not}");
        assert!(!is_plainly_regular(&[[f64::NAN; 6]; STRUTS]));
    }

    #[test]
    fn distance_of_pieces_against_brute_force() {
        let point = |i: u32| {
            let x = f64::from(i);
            Vector3::new((x * 1.7).sin(), (x * 2.3).cos(), (x * 0.9).sin()) * 10.0
        };
        for i in 0..40 {
            let (a, u, b, v) = (point(i), point(i + 50), point(i + 100), point(i + 150));
            let mut brute = f64::INFINITY;
            for k in 0..=200 {
                for l in 0..=200 {
                    let (s, t) = (f64::from(k) / 200.0, f64::from(l) / 200.0);
                    brute = brute.min((a + u * s - b - v * t).norm());
                }
            }
            let exact = distance_mm((a, u), (b, v));
            assert!(
                exact <= brute + 1e-9 && exact > brute - 0.1,
                "{i}: {exact} {brute}"
            );
        }
    }
}
