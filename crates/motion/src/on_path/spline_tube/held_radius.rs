//! The radius that is held: curves that can be driven at the feed keep theirs.
//!
//! A spline of little jerk cuts a curve short on its inside, as far as the tube lets it: of the circle
//! that the program goes round it makes a smaller one. Where the curve binds the speed, that is what the
//! tolerance is for. Where the feed binds, it gains nothing but a shorter way, and a hole that is too
//! small. So there the weight of a sample has a floor. On a circle of curvature κ the penalty and a
//! weight w are in balance where
//!
//! ```text
//!   κ⁵ = w · offset         (minimise ∫ |C‴|² + w |C − Q|² over circles about the same middle)
//! ```
//!
//! so w is to be κ⁵ over the offset that is allowed. Besides, where a window ends the curve goes on
//! without a third derivative. That is wrong by up to κ² ℓ³ there, with ℓ = w^(-1/6), and decays over
//! 2 ℓ: so either κ² ℓ³ is within the offset, too, or ℓ is some samples at most. Both floors are
//! hardly more than nothing where the path is straight, and still let noise of the program pass
//! unheeded, which has shorter waves.

use super::fit::Spline;
use super::knots::second_derivative;
use super::sample::Sample;
use super::vector::norm;
use core::ops::Range;
use glidepath_program::Limits;

/// How much of what the axes can do a curve may ask for at the feed for the feed to be what binds: from
/// one curve to the next it takes several times as much. With .5, and no bound by the jerk to swing into a
/// curve, small letters took 8 ‰ longer.
const ASKED_R: f64 = 0.2;
/// How far a circle may be off its radius, in tolerances.
const OFFSET_R: f64 = 0.01;
/// How far what is wrong at one place may reach, in samples: what a window puts out is half a window
/// away from its open end, eight times as far.
const REACH_R: f64 = 4.0;

/// What a curve must not ask for at the feed, and how near its radius it is kept if it does not.
#[derive(Debug, Clone, Copy)]
pub(super) struct HeldRadius {
    acceleration_a: f64,
    jerk_j: f64,
    offset_mm: f64,
}

impl HeldRadius {
    pub(super) fn new(tolerance_mm: f64, limits: &Limits, axes: Range<usize>) -> Self {
        let least =
            |limit: &dyn Fn(usize) -> f64| axes.clone().map(limit).fold(f64::INFINITY, f64::min);
        Self {
            acceleration_a: ASKED_R * least(&|i| limits.acceleration[i]),
            jerk_j: ASKED_R * least(&|i| limits.jerk[i]),
            offset_mm: OFFSET_R * tolerance_mm,
        }
    }

    /// The least weight of a sample, 1/mm⁶, whose foot is on a span; `per_length6` is its spacing to
    /// the power of -6.
    pub(super) fn least_weight<const D: usize>(
        &self,
        spline: &Spline<D>,
        span: usize,
        (sample, per_length6): (&Sample<D>, f64),
    ) -> f64 {
        let control = &spline.control[span..];
        let curvature_k = norm(&second_derivative(
            &spline.knots,
            control,
            (span, sample.foot_t),
        ));
        let feed_v = sample.feed_v;
        // |C″| is the curvature, as the parameter is nearly length: v²·κ and v³·κ².
        let normal_a = feed_v * feed_v * curvature_k;
        if normal_a > self.acceleration_a || feed_v * curvature_k * normal_a > self.jerk_j {
            return 0.0;
        }
        // The floors of the module's text: of the radius, and of the window's end as 1/ℓ⁶, once with ℓ of
        // some samples, once with κ²·ℓ³ the offset. None so stiff that to swing into the curve within ℓ
        // takes more jerk than is asked for.
        let of_radius = curvature_k.powi(5) / self.offset_mm;
        let of_window = REACH_R.powi(-6) * per_length6;
        let most = (self.jerk_j / (feed_v * normal_a)).powi(6);
        let of_window = of_window.min((curvature_k * curvature_k / self.offset_mm).powi(2));
        of_radius.max(of_window).min(most)
    }
}
