//! The jerk that a curve has at the feed.
//!
//! Where the motion is at the feed jerk is dear ([`super::tube::JERK_AT_FEED`]), and that of a circle is no fault of the
//! motion: with a price on all of it, small circles would become larger, and slower where they end. So the price there
//! counts from what the curve asks for.
//!
//! On a curve of curvature κ jerk at a speed v is −v³·κ² along it, but for what κ changes. A piece of length L stands
//! for a curve whose middle is s beside it: κ = 8·s/L².

use super::solver::{Problem, dot};
use super::tube::Layout;

/// Takes the jerk of the curve out of the price of jerk in the first knot intervals.
pub(crate) fn add<const D: usize>(
    problem: &mut Problem<D>,
    layout: &Layout<'_, D>,
    intervals: usize,
) {
    let (path, samples, grid) = (layout.path, layout.samples, &layout.style.grid);
    let h = grid.knot_t;
    for k in 0..intervals {
        // The sample in the middle of the interval, or before it where there are several knots in a period.
        let at = ((2 * k + 1) * grid.periods / (2 * grid.knots)).min(samples.count());
        let segment = &path.segments[samples.piece[at]];
        let bulge = dot(&segment.sagitta_vector, &segment.sagitta_vector).sqrt();
        if bulge <= 0.0 {
            continue;
        }
        let u = ((samples.progress[at] - segment.s) / segment.length).clamp(0.0, 1.0);
        // The direction of the parabola there.
        let slope = 4.0 * (1.0 - 2.0 * u) / segment.length;
        let along: [f64; D] =
            core::array::from_fn(|a| segment.tangent[a] + slope * segment.sagitta_vector[a]);
        let size = dot(&along, &along).sqrt();
        let curvature = 8.0 * bulge / (segment.length * segment.length);
        let jerk = -segment.top.powi(3) * curvature * curvature * h * h * h / size;
        problem.aim_jerk(k, &along.map(|part| jerk * part));
    }
}
