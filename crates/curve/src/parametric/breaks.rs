//! The breaks of a curve, where it stands still in its parameter: cusps and other points with C′ =
//! 0.
//!
//! A chord must not cross such a point, it would cut the tip off. The zeros of C′ are isolated by
//! bisection: a range over which one component of C′ has no zero holds none.

use super::ParametricCurve;
use crate::CurveError;

/// Ranges looked at, at most.
const MOST: usize = 200_000;
/// Width of a range that is a point, relative to the whole domain.
const POINT: f64 = 1e-10;

/// Parameters strictly inside a domain at which C′ vanishes, in order.
///
/// # Errors
/// The curve is not defined or not bounded somewhere, or stands still over a whole range.
pub fn breaks(curve: &ParametricCurve, from: f64, to: f64) -> Result<Vec<f64>, CurveError> {
    let point = POINT * (to - from);
    // Depth first, left to right; odd thirds, so that no zero is likely to be on a boundary.
    let mut open = vec![(from, to)];
    let mut found: Vec<(f64, f64)> = Vec::new();
    for _ in 0..MOST {
        let Some((a, b)) = open.pop() else {
            let middle = |(a, b): &(f64, f64)| 0.5 * (a + b);
            let mut points: Vec<f64> = found.iter().map(middle).collect();
            points.retain(|t| *t > from + 2.0 * point && *t < to - 2.0 * point);
            return Ok(points);
        };
        let [position, d1, d2] = curve.enclosure(a, b);
        let bounded = [position, d1, d2]
            .iter()
            .flatten()
            .all(|c| c.width().is_finite());
        if bounded && d1.iter().any(|c| !c.contains(0.0)) {
            continue;
        }
        if b - a > point {
            let middle = a + 0.4375 * (b - a);
            open.push((middle, b));
            open.push((a, middle));
        } else if !bounded {
            return Err(CurveError::Unbounded { t: 0.5 * (a + b) });
        } else if let Some(last) = found.last_mut().filter(|last| a - last.1 <= point) {
            last.1 = b;
            if last.1 - last.0 > 1e3 * point {
                return Err(CurveError::StandsStill { t: last.0 });
            }
        } else {
            found.push((a, b));
        }
    }
    let t = open.last().map_or(from, |range| range.0);
    Err(CurveError::StandsStill { t })
}
