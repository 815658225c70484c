//! Symmetric positive matrices of blocks, four blocks to either side of the diagonal: Cholesky.
//!
//! A row that acts on at most five consecutive control points couples only those, so the matrix of
//! the normal equations has this shape, and factoring it costs time linear in the number of points.

/// A block: one control point against another.
pub(super) type Block<const D: usize> = [[f64; D]; D];

/// Blocks on and left of the diagonal.
const WIDTH: usize = 5;

/// The lower half: `rows[i][d]` is the block of points `i` and `i − d`. After [`Band::factor`] it
/// is that of the factor, with the inverse on the diagonal of diagonal blocks.
#[derive(Debug, Clone)]
pub(super) struct Band<const D: usize> {
    rows: Vec<[Block<D>; WIDTH]>,
}

impl<const D: usize> Band<D> {
    pub(super) const fn new() -> Self {
        Self { rows: Vec::new() }
    }

    /// All zero, for some number of points.
    pub(super) fn clear(&mut self, points: usize) {
        self.rows.clear();
        self.rows.resize(points, [[[0.0; D]; D]; WIDTH]);
    }

    /// Adds to the coupling of one axis of point `i` and point `i − d`.
    #[inline]
    pub(super) fn add_axis(&mut self, i: usize, d: usize, axis: usize, value: f64) {
        self.rows[i][d][axis][axis] += value;
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
    pub(super) fn pin(&mut self, i: usize, axis: usize) {
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
            for j in first..i {
                let mut block = row[i - j];
                for k in first.max(j.saturating_sub(WIDTH - 1))..j {
                    subtract_product(&mut block, &row[i - k], &done[j][j - k]);
                }
                divide(&mut block, &done[j][0]);
                row[i - j] = block;
            }
            let mut block = row[0];
            for k in first..i {
                subtract_product(&mut block, &row[i - k], &row[i - k]);
            }
            root(&mut block);
            row[0] = block;
        }
    }

    /// Solves for the right-hand side `x`, in place.
    pub(super) fn solve(&self, range: core::ops::Range<usize>, x: &mut [[f64; D]]) {
        for i in range.clone() {
            let row = &self.rows[i];
            let mut value = x[i];
            for j in range.start.max(i.saturating_sub(WIDTH - 1))..i {
                for a in 0..D {
                    for b in 0..D {
                        value[a] -= row[i - j][a][b] * x[j][b];
                    }
                }
            }
            for a in 0..D {
                for b in 0..a {
                    value[a] -= row[0][a][b] * value[b];
                }
                value[a] *= row[0][a][a];
            }
            x[i] = value;
        }
        for i in range.clone().rev() {
            let row = &self.rows[i];
            let mut value = x[i];
            for a in (0..D).rev() {
                for b in a + 1..D {
                    value[a] -= row[0][b][a] * value[b];
                }
                value[a] *= row[0][a][a];
            }
            x[i] = value;
            for j in range.start.max(i.saturating_sub(WIDTH - 1))..i {
                for a in 0..D {
                    for b in 0..D {
                        x[j][b] -= row[i - j][a][b] * value[a];
                    }
                }
            }
        }
    }
}

/// `a` − `b`·`c`ᵀ
#[inline]
fn subtract_product<const D: usize>(a: &mut Block<D>, b: &Block<D>, c: &Block<D>) {
    for (a_row, b_row) in a.iter_mut().zip(b) {
        for (value, c_row) in a_row.iter_mut().zip(c) {
            let mut sum = 0.0;
            for k in 0..D {
                sum += b_row[k] * c_row[k];
            }
            *value -= sum;
        }
    }
}

/// `a`·`l`⁻ᵀ for a triangular `l` with inverse diagonal.
#[inline]
fn divide<const D: usize>(a: &mut Block<D>, l: &Block<D>) {
    for row in a {
        for k in 0..D {
            let mut value = row[k];
            for m in 0..k {
                value -= row[m] * l[k][m];
            }
            row[k] = value * l[k][k];
        }
    }
}

/// The triangular root of a block, with inverse diagonal. A direction in which rounding has left
/// nothing is frozen.
#[inline]
fn root<const D: usize>(a: &mut Block<D>) {
    for r in 0..D {
        for c in 0..=r {
            let mut value = a[r][c];
            for k in 0..c {
                value -= a[r][k] * a[c][k];
            }
            a[r][c] = if c < r {
                value * a[c][c]
            } else if value > 0.0 {
                1.0 / value.sqrt()
            } else {
                0.0
            };
        }
    }
}
