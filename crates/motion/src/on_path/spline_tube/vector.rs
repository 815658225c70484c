//! Vectors of a fixed number of axes, so that the kernels of the fit cost no more than the axes
//! that move.

/// Sum of a vector and a multiple of another.
#[inline]
pub(super) fn add_scaled<const D: usize>(a: &[f64; D], factor: f64, b: &[f64; D]) -> [f64; D] {
    core::array::from_fn(|i| a[i] + factor * b[i])
}

/// Difference.
#[inline]
pub(super) fn minus<const D: usize>(a: &[f64; D], b: &[f64; D]) -> [f64; D] {
    core::array::from_fn(|i| a[i] - b[i])
}

/// Scalar product.
#[inline]
pub(super) fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    let mut sum = 0.0;
    for i in 0..D {
        sum += a[i] * b[i];
    }
    sum
}

/// Euclidean length over all axes.
#[inline]
pub(super) fn norm<const D: usize>(a: &[f64; D]) -> f64 {
    dot(a, a).sqrt()
}

/// The point between two others: `a` for 0, `b` for 1.
#[inline]
pub(super) fn between<const D: usize>(a: &[f64; D], b: &[f64; D], share: f64) -> [f64; D] {
    core::array::from_fn(|i| a[i] + share * (b[i] - a[i]))
}

/// The distance that a tolerance bounds, squared: of XYZ, of UVW, or of the rotary axes, a degree of which counts
/// for so many mm, whichever is largest. With fewer than nine axes all of them are linear.
#[inline]
pub(super) fn tolerance_square<const D: usize>(a: &[f64; D], mm_per_deg: f64) -> f64 {
    if D < 9 {
        return dot(a, a);
    }
    let square = |axes: core::ops::Range<usize>| axes.map(|i| a[i] * a[i]).sum::<f64>();
    let rotary = square(3..6) * (mm_per_deg * mm_per_deg);
    square(0..3).max(square(6..9)).max(rotary)
}
