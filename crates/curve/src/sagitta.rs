//! The sagitta of a chord, and the chord of a sagitta.
//!
//! ```text
//!        ___---___         h = R − √(R² − L²/4)
//!     .-'    |h   '-.
//!     ───────┴───────      An arc whose curvature is at most 1/R, and which is shorter than half a
//!            L             turn of that circle, stays within h of its chord (Schur).
//! ```

/// Largest distance of an arc of curvature at most `curvature_k` (1/mm) from its chord, mm.
/// Infinite if the chord is not shorter than the circle's diameter.
#[must_use]
pub fn sagitta_mm(curvature_k: f64, chord_mm: f64) -> f64 {
    let half_turn = 0.5 * curvature_k * chord_mm;
    if half_turn.abs() < 1.0 {
        // R − √(R² − L²/4) without the cancellation.
        0.5 * chord_mm * half_turn / (1.0 + (1.0 - half_turn * half_turn).sqrt())
    } else {
        f64::INFINITY
    }
}

/// The longest chord whose arc of curvature at most `curvature_k` (1/mm) stays within `error_mm`;
/// infinite on a straight line. Never longer than the circle's diameter.
#[must_use]
pub fn chord_mm(curvature_k: f64, error_mm: f64) -> f64 {
    let radius = curvature_k.abs().recip();
    if error_mm >= radius {
        return 2.0 * radius;
    }
    2.0 * (error_mm * (2.0 * radius - error_mm)).sqrt()
}

/// Arc of a circle over a chord, in chords: speed along the curve over speed along the chord.
#[must_use]
pub fn arc_over_chord(curvature_k: f64, chord_mm: f64) -> f64 {
    let half_turn = 0.5 * curvature_k * chord_mm;
    if half_turn.abs() < 1e-4 {
        1.0 + half_turn * half_turn / 6.0
    } else {
        half_turn.asin() / half_turn
    }
}
