//! Symmetric positive definite systems of half bandwidth three, one right side per axis.

use super::vector::add_scaled;

/// A system under construction, solved in place.
#[derive(Debug, Clone)]
pub(super) struct Banded<const D: usize> {
    /// Diagonal and the three elements to the right of it, row by row.
    pub(super) rows: Vec<[f64; 4]>,
    /// Right sides; the solution after [`Banded::solve`].
    pub(super) right: Vec<[f64; D]>,
}

impl<const D: usize> Banded<D> {
    pub(super) const fn new() -> Self {
        Self {
            rows: Vec::new(),
            right: Vec::new(),
        }
    }

    /// Makes the unknown `i` zero.
    pub(super) fn fix(&mut self, i: usize) {
        if let (Some(row), Some(right)) = (self.rows.get_mut(i), self.right.get_mut(i)) {
            *row = [1.0, 0.0, 0.0, 0.0];
            *right = [0.0; D];
        }
        for above in 1..=3.min(i) {
            if let Some(row) = self.rows.get_mut(i - above) {
                row[above] = 0.0;
            }
        }
    }

    /// Solves by LDLᵀ without pivoting, which a positive definite matrix does not need. One pass takes the
    /// right sides of all axes along.
    #[inline]
    pub(super) fn solve(&mut self) {
        let count = self.rows.len().min(self.right.len());
        let (rows, right) = (&mut self.rows[..count], &mut self.right[..count]);
        for i in 0..count {
            let row = rows[i];
            let value = right[i];
            let inverse = 1.0 / row[0];
            for j in 1..4.min(count - i) {
                let factor = row[j] * inverse;
                for k in j..4 {
                    rows[i + j][k - j] -= factor * row[k];
                }
                right[i + j] = add_scaled(&right[i + j], -factor, &value);
            }
        }
        for i in (0..count).rev() {
            let row = rows[i];
            let mut value = right[i];
            for j in 1..4.min(count - i) {
                value = add_scaled(&value, -row[j], &right[i + j]);
            }
            let inverse = 1.0 / row[0];
            right[i] = value.map(|x| x * inverse);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_system_made_from_its_solution() {
        let count = 12;
        let solution: Vec<[f64; 2]> = (0..count)
            .map(|i| [f64::from(i).sin(), 3.0 - f64::from(i)])
            .collect();
        let rows: Vec<[f64; 4]> = (0..count)
            .map(|i| [10.0 + f64::from(i), -2.0, 0.5, 0.25 * f64::from(i % 3)])
            .collect();
        let mut right = vec![[0.0; 2]; 12];
        for i in 0..12 {
            for (j, element) in rows[i].iter().enumerate().take(12 - i) {
                right[i] = add_scaled(&right[i], *element, &solution[i + j]);
                if j > 0 {
                    right[i + j] = add_scaled(&right[i + j], *element, &solution[i]);
                }
            }
        }
        let mut system = Banded { rows, right };
        system.solve();
        for (x, y) in system.right.iter().zip(&solution) {
            assert!((x[0] - y[0]).abs() < 1e-13 && (x[1] - y[1]).abs() < 1e-13);
        }
    }
}
