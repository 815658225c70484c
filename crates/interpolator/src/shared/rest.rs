//! The definition of rest, and of the same position, for both threads.

use glidepath_link::SetpointFrame;

/// How far the first frame of an epoch may be from where the machine stands, mm or degrees.
pub(crate) const SAME_POSITION: f64 = 1e-9;

/// Whether the planned motion is at rest at a frame.
pub(crate) fn is_at_rest(frame: &SetpointFrame) -> bool {
    /// mm/s and mm/s²; what is left of a planned stop after rounding.
    const REST: f64 = 1e-6;
    frame
        .velocity
        .iter()
        .chain(&frame.acceleration)
        .all(|value| value.abs() <= REST)
}
