//! The damping of a smooth motion: what keeps it from swinging about the path when it comes back to it.
//!
//! A pull to the path and a price on jerk by themselves make a motion that overshoots: of the six
//! ways in which such a motion may come and go, two pairs swing, with a damping ratio of one half.
//!
//! ```text
//!   corner                          minimise  Σ p·y² + v·y′² + a·y″² + j·y‴²       y: across the path
//!      ╲  swings about the path
//!       ╲      ╭─╮                  stationary where  j·z³ − a·z² + v·z − p = 0,   z = s²
//!  ──────╲────╱───╲───╭──           with v = a = 0:   s = ±ω and, swinging, ω·e^{±i·60°}, −ω·e^{±i·60°}
//!         ╰──╯     ╰─╯              with a = 3jω², v = 3jω⁴:   (z − ω²)³, all at ±ω, none swings
//! ```
//!
//! So the velocity across the path and the acceleration across it get prices, too, those that go with
//! the other two. They are measured against what the curve that the piece stands for has of both.
//! Near corners there are none: there the motion is off the path, and crosses it, on purpose; and
//! none where pieces are shorter than the way of two periods, because their curves are as rough as the
//! points they were laid through.

use super::samples::Samples;
use super::scaled_path::ScaledPath;
use super::solver::{Problem, dot};
use super::tube::{JERK_AT_FEED, Layout, Style};

/// Turn of the program, radians, from which there is a corner: what a motion does there crosses the path
/// on purpose. With less, the vertices of a coarse polyline would leave all of it undamped.
const CORNER: f64 = 0.1;
/// Nothing is damped in one part in so many of the time to settle, on both sides of a corner.
const LEFT_OUT: usize = 4;

/// Adds the prices that go with those of offset and jerk that the style has.
pub(crate) fn add<const D: usize>(problem: &mut Problem<D>, layout: &Layout<'_, D>) {
    let margin = margin(layout.path, layout.style);
    let usual_jerk = dearest_jerk(layout);
    let at_feed = layout.style.intervals_at_feed();
    for k in 1..layout.samples.count() {
        if !is_near_corner(layout.path, layout.samples, k, margin) {
            let interval = k * layout.style.grid.knots / layout.style.grid.periods;
            let dearest_jerk = if interval < at_feed {
                JERK_AT_FEED * usual_jerk
            } else {
                usual_jerk
            };
            add_at(problem, layout, k, dearest_jerk);
        }
    }
}

/// Periods about a corner in which nothing is damped.
pub(super) fn margin<const D: usize>(path: &ScaledPath<D>, style: &Style) -> usize {
    style.settling_periods(path).div_ceil(LEFT_OUT)
}

/// True if the program turns sharply within some periods of a sample: chords of a curve do not count.
pub(super) fn is_near_corner<const D: usize>(
    path: &ScaledPath<D>,
    samples: &Samples,
    k: usize,
    margin: usize,
) -> bool {
    let last = (k + margin).min(samples.count());
    let mut seen = samples.piece[k.saturating_sub(margin)]..samples.piece[last];
    seen.any(|i| {
        let corner = path.corner(i);
        dot(&corner, &corner) > CORNER * CORNER
    })
}

fn add_at<const D: usize>(
    problem: &mut Problem<D>,
    layout: &Layout<'_, D>,
    k: usize,
    dearest_jerk: f64,
) {
    let (path, samples, style) = (layout.path, layout.samples, layout.style);
    let piece = samples.piece[k];
    let segment = &path.segments[piece];
    let progress = [k - 1, k, k + 1].map(|k| samples.progress[k]);
    if segment.length < progress[2] - progress[0] {
        return;
    }
    let center = progress.map(|progress| path.center_beyond(piece, progress));
    let radius = segment.radius * style.keep_r;
    let pull = style.attraction / (radius * radius);
    // The square of ω, per period: of the rate that this pull makes with the price of jerk, p = j·ω⁶.
    let square = (pull / dearest_jerk).cbrt() * style.period_t.powi(2);
    let mut price = |(first, weights), attraction, center: [f64; D]| {
        problem.add_site(first, weights);
        if let Some(site) = problem.sites.last_mut() {
            (site.attraction, site.center, site.tangent) = (attraction, center, segment.tangent);
        }
    };
    // v = 3jω⁴ = 3p/ω², a = 3jω² = 3p/ω⁴.
    price(
        style.grid.velocity_site(k),
        3.0 * pull / square,
        core::array::from_fn(|a| 0.5 * (center[2][a] - center[0][a])),
    );
    price(
        style.grid.bend_site(k),
        3.0 * pull / (square * square),
        core::array::from_fn(|a| center[2][a] - 2.0 * center[1][a] + center[0][a]),
    );
}

/// The price of jerk for a period, on the axis where it is highest.
fn dearest_jerk<const D: usize>(layout: &Layout<'_, D>) -> f64 {
    let style = layout.style;
    let slowest_j = style
        .priced_jerk(layout.path)
        .into_iter()
        .fold(f64::INFINITY, f64::min);
    // There is a third difference a knot, but an offset a period.
    let per_period = style.period_t / style.grid.knot_t;
    style.jerk * per_period / (slowest_j * slowest_j)
}
