//! The colours of a plot: a scale for the feed, and the greys of the frame.

pub(super) const INK: &str = "#1f2933";
pub(super) const QUIET: &str = "#6b7785";
pub(super) const GRID: &str = "#e6eaee";
pub(super) const FRAME: &str = "#b8c1ca";
pub(super) const LIMIT: &str = "#c0392b";
/// The programmed path, under the motion.
pub(super) const PROGRAM: &str = "#ffe0b2";
/// The curve of the deviation.
pub(super) const DEVIATION: &str = "#0b8a5f";
/// Where a motion may be.
pub(super) const BAND: &str = "#e3f4e8";
pub(super) const RAPID: &str = "#a9b3bd";

/// Curves of velocity, acceleration and jerk.
pub(super) const CURVES: [&str; 3] = ["#1864ab", "#2b8a3e", "#862e9c"];

/// Number of feed colours.
pub(super) const SHADES: usize = 20;

/// From slow to fast: dark to bright, with lightness rising evenly and no shade too pale for white
/// paper.
const ANCHORS: [(f64, f64, f64); 6] = [
    (26.0, 18.0, 110.0),
    (93.0, 1.0, 166.0),
    (156.0, 23.0, 158.0),
    (204.0, 71.0, 120.0),
    (237.0, 121.0, 83.0),
    (246.0, 170.0, 40.0),
];

/// The shade, 0…[`SHADES`]−1, of a share of the largest feed.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "a small count, and a share clamped to 0…1"
)]
pub(super) fn shade(share: f64) -> usize {
    ((share.clamp(0.0, 1.0) * SHADES as f64) as usize).min(SHADES - 1)
}

/// A shade as `#rrggbb`.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "small counts, and channels between two anchors of 0…255"
)]
pub(super) fn hex(shade: usize) -> String {
    let at = shade as f64 / (SHADES - 1) as f64 * (ANCHORS.len() - 1) as f64;
    let index = (at as usize).min(ANCHORS.len() - 2);
    let (low, high) = (ANCHORS[index], ANCHORS[index + 1]);
    let mix = |low: f64, high: f64| ((high - low).mul_add(at - index as f64, low)).round() as u8;
    format!(
        "#{:02x}{:02x}{:02x}",
        mix(low.0, high.0),
        mix(low.1, high.1),
        mix(low.2, high.2)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_spans_its_anchors() {
        assert_eq!(hex(0), "#1a126e");
        assert_eq!(hex(SHADES - 1), "#f6aa28");
        assert_eq!(
            (shade(-1.0), shade(0.0), shade(1.0), shade(9.0)),
            (0, 0, 19, 19)
        );
        assert_eq!(shade(0.5), 10);
    }
}
