//! Gauss-Legendre quadrature.

/// Nodes and weights of the twelve-point rule on [-1, 1], positive half (the rule is symmetric).
const GAUSS_12: [(f64, f64); 6] = [
    (0.125_233_408_511_468_9, 0.249_147_045_813_402_77),
    (0.367_831_498_998_180_2, 0.233_492_536_538_354_8),
    (0.587_317_954_286_617_5, 0.203_167_426_723_065_92),
    (0.769_902_674_194_304_7, 0.160_078_328_543_346_22),
    (0.904_117_256_370_474_9, 0.106_939_325_995_318_43),
    (0.981_560_634_246_719_2, 0.047_175_336_386_511_83),
];

/// Integral of `f` from `a` to `b`: exact for polynomials up to degree 23.
pub(crate) fn gauss_12(a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let sum: f64 = GAUSS_12
        .iter()
        .map(|&(node, weight)| weight * (f(middle - half * node) + f(middle + half * node)))
        .sum();
    half * sum
}

/// Number of panels of [`graded_half`].
pub(crate) const PANELS: usize = 12;

/// Panel boundaries on [0, 1] that halve towards 1, where a sharp corner turns fast: boundary 0 is
/// 0, boundary [`PANELS`] is 1.
pub(crate) fn graded_boundary(index: usize) -> f64 {
    if index >= PANELS {
        1.0
    } else {
        1.0 - 0.5_f64.powi(i32::try_from(index).unwrap_or(0))
    }
}

/// Integral of `f` over [0, 1] on panels that halve towards 1.
pub(crate) fn graded_half(f: impl Fn(f64) -> f64) -> f64 {
    (0..PANELS)
        .map(|i| gauss_12(graded_boundary(i), graded_boundary(i + 1), &f))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_to_degree_23() {
        for degree in 0..=23 {
            let got = gauss_12(0.0, 2.0, |x| x.powi(degree));
            let want = 2.0_f64.powi(degree + 1) / f64::from(degree + 1);
            assert!(
                (got / want - 1.0).abs() < 4e-15,
                "degree {degree}: {got} {want}"
            );
        }
    }

    #[test]
    fn panels_cover_the_interval() {
        assert!((graded_half(|x| x * x) - 1.0 / 3.0).abs() < 1e-15);
    }
}
