//! Symmetric positive matrices of blocks, three blocks to either side of the diagonal: L·D·Lᵀ.
//!
//! A row that acts on at most four consecutive control points couples only those, so the matrix of
//! the normal equations has this shape, and factoring it costs time linear in the number of points.

use super::problem::{SPAN, dot};

/// A block: one control point against another.
pub(super) type Block<const D: usize> = [[f64; D]; D];

/// Blocks on and left of the diagonal.
const WIDTH: usize = SPAN;

/// The lower half: `rows[i][d]` is the block of points `i` and `i − d`. After [`Band::factor`] it
/// is that of L, whose diagonal is one, and there is 1/D instead. Roots would be as safe, but each
/// number of the diagonal waits for the one before it, and a root takes as long as ten products.
#[derive(Debug, Clone)]
pub(super) struct Band<const D: usize> {
    rows: Vec<[Block<D>; WIDTH]>,
}

impl<const D: usize> Band<D> {
    pub(super) const fn new() -> Self {
        Self { rows: Vec::new() }
    }

    /// Starts from couplings of each axis with itself, by point and points before it.
    pub(super) fn start(&mut self, of_axes: &[[[f64; D]; WIDTH]]) {
        self.rows.clear();
        self.rows.extend(of_axes.iter().map(|of_point| {
            let mut row = [[[0.0; D]; D]; WIDTH];
            for (block, values) in row.iter_mut().zip(of_point) {
                for a in 0..D {
                    block[a][a] = values[a];
                }
            }
            row
        }));
    }

    /// Adds a multiple of a symmetric block.
    #[inline]
    pub(super) fn add_block(&mut self, i: usize, d: usize, block: &Block<D>, factor: f64) {
        for (row, other) in self.rows[i][d].iter_mut().zip(block) {
            for (value, add) in row.iter_mut().zip(other) {
                *value += factor * add;
            }
        }
    }

    /// Takes one axis of point `i` out: nothing acts on it, and it acts on nothing.
    pub(super) fn fix(&mut self, i: usize, axis: usize) {
        let Self { rows } = self;
        for block in &mut rows[i] {
            block[axis] = [0.0; D];
        }
        for d in 0..WIDTH.min(rows.len() - i) {
            for row in &mut rows[i + d][d] {
                row[axis] = 0.0;
            }
        }
        rows[i][0][axis][axis] = 1.0;
    }

    /// Factors the part of points `range`; what couples it to other points is ignored.
    pub(super) fn factor(&mut self, range: core::ops::Range<usize>) {
        for i in range.clone() {
            let first = range.start.max(i.saturating_sub(WIDTH - 1));
            let (done, rest) = self.rows.split_at_mut(i);
            let Some(row) = rest.first_mut() else { return };
            // Blocks of the row become those of L·D, then those of L: the diagonal takes both.
            for j in first..i {
                let mut block = row[i - j];
                for k in first.max(j.saturating_sub(WIDTH - 1))..j {
                    subtract_product(&mut block, &row[i - k], &done[j][j - k]);
                }
                divide(&mut block, &done[j][0]);
                row[i - j] = block;
            }
            let mut diagonal = row[0];
            for k in first..i {
                let (product, per_d) = (row[i - k], &done[k][0]);
                let mut block = product;
                for values in &mut block {
                    for a in 0..D {
                        values[a] *= per_d[a][a];
                    }
                }
                subtract_product(&mut diagonal, &product, &block);
                row[i - k] = block;
            }
            factor(&mut diagonal);
            row[0] = diagonal;
        }
    }

    /// Solves for the right-hand side `x`, in place.
    pub(super) fn solve(&self, range: core::ops::Range<usize>, x: &mut [[f64; D]]) {
        for i in range.clone() {
            let row = &self.rows[i];
            let mut value = x[i];
            for j in range.start.max(i.saturating_sub(WIDTH - 1))..i {
                for a in 0..D {
                    value[a] -= dot(&row[i - j][a], &x[j]);
                }
            }
            for a in 1..D {
                for b in 0..a {
                    value[a] -= row[0][a][b] * value[b];
                }
            }
            x[i] = value;
        }
        for i in range.clone().rev() {
            let row = &self.rows[i];
            let mut value = x[i];
            for a in 0..D {
                value[a] *= row[0][a][a];
            }
            for j in i + 1..range.end.min(i + WIDTH) {
                for (values, x) in self.rows[j][j - i].iter().zip(x[j]) {
                    for a in 0..D {
                        value[a] -= values[a] * x;
                    }
                }
            }
            for a in (0..D).rev() {
                for b in a + 1..D {
                    value[a] -= row[0][b][a] * value[b];
                }
            }
            x[i] = value;
        }
    }
}

/// `a` − `b`·`c`ᵀ
#[inline]
fn subtract_product<const D: usize>(a: &mut Block<D>, b: &Block<D>, c: &Block<D>) {
    for (a_row, b_row) in a.iter_mut().zip(b) {
        for (value, c_row) in a_row.iter_mut().zip(c) {
            *value -= dot(b_row, c_row);
        }
    }
}

/// `a`·`l`⁻ᵀ for a triangular `l` whose diagonal is one.
#[inline]
fn divide<const D: usize>(a: &mut Block<D>, l: &Block<D>) {
    for row in a {
        for k in 1..D {
            for m in 0..k {
                row[k] -= row[m] * l[k][m];
            }
        }
    }
}

/// Factors a block, with 1/D on the diagonal. A direction in which rounding has left nothing is
/// frozen: 1/D = 0 makes its step zero, where a pivot made positive would make it huge.
#[inline]
fn factor<const D: usize>(a: &mut Block<D>) {
    for r in 0..D {
        let mut product = a[r];
        let mut rest = a[r][r];
        for c in 0..r {
            for k in 0..c {
                product[c] -= product[k] * a[c][k];
            }
            a[r][c] = product[c] * a[c][c];
            rest -= product[c] * a[r][c];
        }
        a[r][r] = if rest > 0.0 { 1.0 / rest } else { 0.0 };
    }
}
