//! Where a hexapod must not go.

use super::struts::{Hexapod, STRUTS};
use crate::machine::MAX_CONDITION;
use crate::{Conditioning, KinematicsError};
use glidepath_geometry::AxisVector;
use nalgebra::Vector3;

/// Smallest singular value of the scaled Jacobian at which the platform is moved.
const MIN_SINGULAR_VALUE: f64 = 0.05;

/// Whether a hexapod may go to a position of the axes.
///
/// # Errors
/// What forbids it.
pub(super) fn admit(hexapod: &Hexapod, axes: &AxisVector) -> Result<(), KinematicsError> {
    let Conditioning {
        condition,
        smallest,
    } = hexapod.strut_conditioning(axes);
    // Written so that what is not a number is refused.
    if !(condition < MAX_CONDITION && smallest > MIN_SINGULAR_VALUE) {
        return Err(KinematicsError::Singular { condition });
    }
    let pose = hexapod.pose(axes);
    let struts = hexapod.struts(&pose);
    let platform_normal = pose.rotation * Vector3::z();
    for (joint, strut) in struts.iter().enumerate() {
        for (normal, most) in [
            (Vector3::z(), hexapod.guards.max_base_angle_deg),
            (platform_normal, hexapod.guards.max_platform_angle_deg),
        ] {
            let angle_deg = strut.angle(&normal).to_degrees();
            if angle_deg > most {
                return Err(KinematicsError::Tilted { joint, angle_deg });
            }
        }
    }
    admit_distances(hexapod, &struts)
}

fn admit_distances(
    hexapod: &Hexapod,
    struts: &[Vector3<f64>; STRUTS],
) -> Result<(), KinematicsError> {
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

/// Distance of two line pieces, each from a point along a vector.
fn distance_mm((a, u): (Vector3<f64>, Vector3<f64>), (b, v): (Vector3<f64>, Vector3<f64>)) -> f64 {
    let gap = a - b;
    let (uu, uv, vv) = (u.dot(&u), u.dot(&v), v.dot(&v));
    let (ug, vg) = (u.dot(&gap), v.dot(&gap));
    let det = uu * vv - uv * uv;
    // Nearest point of the first line to the second, kept on the piece; then the nearest of the
    // second piece to that, and back: for convex pieces this is the minimum.
    let free = if det > 1e-12 * uu * vv {
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
