//! What a circle asks of the axes at its feed.

use glidepath_geometry::Axis;
use glidepath_program::Limits;

/// A circle is run at the feed if that asks for no more than this share of what an axis can do.
const BOUND_R: f64 = 0.9;

/// True if the axes' limits leave room to what the feed asks of them on a circle. Where they do not,
/// speed differs by its direction, and so does jerk.
pub(crate) fn is_bound_by_feed(
    feed_v: f64,
    radius_mm: f64,
    axes: [Axis; 2],
    limits: &Limits,
) -> bool {
    let asked_a = feed_v * feed_v / radius_mm;
    let asked_j = asked_a * feed_v / radius_mm;
    axes.into_iter().map(Axis::index).all(|i| {
        feed_v <= BOUND_R * limits.velocity[i]
            && asked_a <= BOUND_R * limits.acceleration[i]
            && asked_j <= BOUND_R * limits.jerk[i]
    })
}
