//! The capacity of the track: how many frames the real-time thread owns ahead, and how many it keeps behind.
//!
//! The ports thread keeps as many beginnings of blocks, and tells others how much room there is.

/// Most frames that are owned at a time.
pub(crate) const TRACK_CAPACITY: usize = 512;

/// For so long the motion can go back, s, if the frames of that are no more than [`MOST_KEPT`].
const KEPT_S: f64 = 62.0;
/// Most frames that are kept: 52 MB.
const MOST_KEPT: usize = 1 << 16;

/// How many frames are kept.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "not negative; the cast saturates"
)]
pub(crate) fn frames_kept(period_t: f64) -> usize {
    ((KEPT_S / period_t) as usize + TRACK_CAPACITY).min(MOST_KEPT)
}
