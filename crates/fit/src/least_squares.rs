//! The least-squares spline over given knots: the one nearest to points at given parameters.
//!
//! The ends are kept, the control points between solve the normal equations AᵀA·C = AᵀQ: a band of
//! seven, solved by Cholesky's method in time proportional to points and knots. For these knots and
//! parameters no other control points have a smaller sum of squares.

use crate::point::Point;
use crate::spline::{Spline, basis, span_from};

/// A pivot this small, relative to its row, means that the points do not determine the spline.
const SINGULAR: f64 = 1e-12;

/// The least-squares spline; none if the points do not determine it (Schoenberg and Whitney: every
/// B-spline needs a point of its own).
pub(crate) fn solve(points: &[Point], x: &[f64], knots: &[f64]) -> Option<Spline> {
    let n = knots.len() - 4;
    let (first, last) = (*points.first()?, *points.last()?);
    let mut band = vec![[0.0; 4]; n];
    let mut right = vec![Point::zeros(); n];
    let mut k = 3;
    for (point, &x) in points.iter().zip(x) {
        k = span_from(knots, x, k);
        let values = basis(knots, k, x);
        let mut rest = *point;
        for (j, value) in values.iter().enumerate() {
            match k - 3 + j {
                0 => rest -= first * *value,
                i if i == n - 1 => rest -= last * *value,
                _ => {}
            }
        }
        for (j, value) in values.iter().enumerate() {
            let row = k - 3 + j;
            right[row] += rest * *value;
            for (d, other) in values[j..].iter().enumerate() {
                band[row][d] += value * other;
            }
        }
    }
    detach_ends(&mut band, &mut right);
    if !cholesky(&mut band, &mut right) {
        return None;
    }
    (right[0], right[n - 1]) = (first, last);
    Some(Spline {
        knots: knots.to_vec(),
        control: right,
    })
}

/// Makes the first and last unknown independent of the others.
fn detach_ends(band: &mut [[f64; 4]], right: &mut [Point]) {
    let n = band.len();
    for end in [0, n - 1] {
        band[end] = [1.0, 0.0, 0.0, 0.0];
        right[end] = Point::zeros();
    }
    for d in 1..4 {
        if let Some(row) = band.get_mut(n - 1 - d) {
            row[d] = 0.0;
        }
    }
}

/// Solves in place; `band[i][d]` is the element at row i, column i + d. False if it is singular.
fn cholesky(band: &mut [[f64; 4]], right: &mut [Point]) -> bool {
    let n = band.len();
    for i in 0..n {
        let scale = band[i][0];
        let mut pivot = scale;
        for back in 1..=i.min(3) {
            let factor = band[i - back][back];
            pivot -= factor * factor;
        }
        if !(pivot > SINGULAR * scale && pivot > 0.0) {
            return false;
        }
        let root = pivot.sqrt();
        band[i][0] = root;
        for d in 1..4.min(n - i) {
            let mut sum = band[i][d];
            for back in 1..=i.min(3 - d) {
                sum -= band[i - back][back] * band[i - back][back + d];
            }
            band[i][d] = sum / root;
        }
    }
    for i in 0..n {
        let mut sum = right[i];
        for back in 1..=i.min(3) {
            sum -= right[i - back] * band[i - back][back];
        }
        right[i] = sum / band[i][0];
    }
    for i in (0..n).rev() {
        let mut sum = right[i];
        for d in 1..4.min(n - i) {
            sum -= right[i + d] * band[i][d];
        }
        right[i] = sum / band[i][0];
    }
    true
}

/// True if every B-spline over the knots can be given a parameter of its own, in order (the
/// condition of Schoenberg and Whitney).
pub(crate) fn determined(x: &[f64], knots: &[f64]) -> bool {
    let mut next = 1;
    // The first and the last B-spline have the ends.
    for i in 1..knots.len() - 5 {
        while next + 1 < x.len() && x[next] <= knots[i] {
            next += 1;
        }
        if next + 1 >= x.len() || x[next] >= knots[i + 4] {
            return false;
        }
        next += 1;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::clamped;

    fn wavy(count: usize) -> (Vec<f64>, Spline) {
        let inside: Vec<f64> = (1..=count).map(|i| (i as f64).powf(1.3)).collect();
        let knots = clamped(0.0, &inside, (count as f64 + 1.0).powf(1.3));
        let control = (0..knots.len() - 4)
            .map(|i| Point::new(i as f64, (i as f64).sin() * 9.0, (i % 3) as f64))
            .collect();
        (inside, Spline { knots, control })
    }

    #[test]
    fn a_spline_is_recovered_from_its_samples() {
        let (_, spline) = wavy(12);
        let pieces = spline.pieces();
        let end = spline.knots[spline.knots.len() - 1];
        let x: Vec<f64> = (0..=200).map(|i| end * f64::from(i) / 200.0).collect();
        let points: Vec<Point> = x.iter().map(|&x| pieces.at(pieces.find(x, 0), x)).collect();
        let found = solve(&points, &x, &spline.knots).unwrap();
        for (found, control) in found.control.iter().zip(&spline.control) {
            assert!((found - control).norm() < 1e-10, "{found} for {control}");
        }
    }

    #[test]
    fn points_that_do_not_determine_the_spline_are_refused() {
        let (_, spline) = wavy(12);
        let end = spline.knots[spline.knots.len() - 1];
        // No point in the middle third.
        let x: Vec<f64> = (0..=90)
            .map(|i| f64::from(i) / 90.0)
            .filter(|x| (x - 0.5).abs() > 0.3)
            .map(|x| x * end)
            .collect();
        let points: Vec<Point> = x.iter().map(|x| Point::new(*x, 0.0, 0.0)).collect();
        assert!(!determined(&x, &spline.knots));
        assert!(solve(&points, &x, &spline.knots).is_none());
    }
}
