//! Enclosures of curvature and its derivative on a piece of the rational half.
//!
//! With homogeneous coordinates H = (X, Y, w), planar and of unit d, V = N'w − Nw' (N = (X, Y)),
//! M = |V|² and D = det(H, H', H''), the quotient rule gives
//!
//! ```text
//! |r'| = M^½ / w²     k = D·w³ / M^(3/2)     dk/ds = w⁴·Q / M³,   Q = D'wM + 3Dw'M − (3/2)DwM'
//! ```
//!
//! All are polynomials; their Bernstein hulls on the piece enclose k and dk/ds.

use super::half::HalfCurve;
use crate::bernstein::{differences, halve};
use crate::transition::constant_speed::{Enclosure, Half, Point};

/// Bernstein coefficients of the polynomials above on a piece, in their true degrees.
#[derive(Debug, Clone)]
pub(super) struct PairPiece {
    w: [f64; 4],
    v: [[f64; 5]; 2],
    m: [f64; 9],
    d: [f64; 4],
    q: [f64; 14],
}

/// The first half as a set of pieces.
pub(super) struct PairHalf {
    whole: PairPiece,
}

impl PairHalf {
    pub(super) fn new(half: &HalfCurve) -> Self {
        let [x, y, w] = half.homogeneous();
        let x = x.map(|x| x * half.turn.cb);
        let y = y.map(|y| y * half.turn.sb);
        let v = [wronskian(&w, &x), wronskian(&w, &y)];
        let m: [f64; 9] = add(
            &product::<5, 5, 9>(&v[0], &v[0]),
            &product::<5, 5, 9>(&v[1], &v[1]),
        );
        let d = double_wronskian(&x, &y, &w);
        let w1: [f64; 3] = differences::<f64, 4, 3>(&w).map(|e| 3.0 * e);
        let m1: [f64; 8] = differences::<f64, 9, 8>(&m).map(|e| 8.0 * e);
        let d1: [f64; 3] = differences::<f64, 4, 3>(&d).map(|e| 3.0 * e);
        // D'w + 3Dw' is of degree five.
        let dw: [f64; 6] = add(
            &product::<3, 4, 6>(&d1, &w),
            &product::<4, 3, 6>(&d, &w1).map(|e| 3.0 * e),
        );
        let q = sub(
            &product::<6, 9, 14>(&dw, &m),
            &product::<7, 8, 14>(&product::<4, 4, 7>(&d, &w), &m1).map(|e| 1.5 * e),
        );
        Self {
            whole: PairPiece { w, v, m, d, q },
        }
    }
}

impl Half for PairHalf {
    type Piece = PairPiece;

    fn root(&self) -> PairPiece {
        self.whole.clone()
    }

    fn halve(&self, piece: &PairPiece) -> [PairPiece; 2] {
        let (w, m, d, q) = (
            halve(&piece.w),
            halve(&piece.m),
            halve(&piece.d),
            halve(&piece.q),
        );
        let (vx, vy) = (halve(&piece.v[0]), halve(&piece.v[1]));
        [
            PairPiece {
                w: w.0,
                v: [vx.0, vy.0],
                m: m.0,
                d: d.0,
                q: q.0,
            },
            PairPiece {
                w: w.1,
                v: [vx.1, vy.1],
                m: m.1,
                d: d.1,
                q: q.1,
            },
        ]
    }

    fn enclose(&self, piece: &PairPiece) -> Enclosure {
        let (w, d, q) = (range(&piece.w), range(&piece.d), range(&piece.q));
        let m = range(&piece.m);
        // Where a hull has no positive lower bound the quotient has no upper one: infinite.
        let m = [m[0].max(0.0), m[1]];
        let d = [d[0].max(0.0), d[1]];
        let k = [
            d[0] * w[0].powi(3) / m[1].powf(1.5),
            d[1] * w[1].powi(3) / m[0].powf(1.5),
        ];
        let (w4_m3_low, w4_m3_high) = (w[0].powi(4) / m[1].powi(3), w[1].powi(4) / m[0].powi(3));
        let k1 = [
            q[0] * if q[0] < 0.0 { w4_m3_high } else { w4_m3_low },
            q[1] * if q[1] > 0.0 { w4_m3_high } else { w4_m3_low },
        ];
        Enclosure {
            k,
            k1,
            ends: [piece.end(0), piece.end(1)],
        }
    }
}

impl PairPiece {
    /// The first (0) or last (1) point.
    fn end(&self, which: usize) -> Point {
        let pick = |c: &[f64]| if which == 0 { c[0] } else { c[c.len() - 1] };
        let (w, d, q, m) = (pick(&self.w), pick(&self.d), pick(&self.q), pick(&self.m));
        let speed = m.sqrt();
        Point {
            k: d * w.powi(3) / (m * speed),
            k1: w.powi(4) * q / m.powi(3),
            heading: [pick(&self.v[0]) / speed, pick(&self.v[1]) / speed],
        }
    }
}

/// Smallest and largest coefficient.
fn range(c: &[f64]) -> [f64; 2] {
    [
        c.iter().copied().fold(f64::INFINITY, f64::min),
        c.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    ]
}

fn add<const N: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; N] {
    core::array::from_fn(|i| a[i] + b[i])
}

fn sub<const N: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; N] {
    core::array::from_fn(|i| a[i] - b[i])
}

/// a·b' − a'·b of two cubics. The basis gives Bᵢ·Bⱼ' − Bᵢ'·Bⱼ = CᵢCⱼ·(j−i)·t^(i+j−1)·(1−t)^(5−i−j),
/// so the degree is four, not five.
fn wronskian(a: &[f64; 4], b: &[f64; 4]) -> [f64; 5] {
    let mut c = [0.0; 5];
    for i in 0..4 {
        for j in i + 1..4 {
            let k = i + j - 1;
            let weight = BINOMIAL[3][i] * BINOMIAL[3][j] * step(i, j) / BINOMIAL[4][k];
            c[k] += weight * (a[i] * b[j] - a[j] * b[i]);
        }
    }
    c
}

/// det(H, H', H'') of three cubics, likewise; of degree three.
fn double_wronskian(x: &[f64; 4], y: &[f64; 4], w: &[f64; 4]) -> [f64; 4] {
    let mut c = [0.0; 4];
    for i in 0..4 {
        for j in i + 1..4 {
            for k in j + 1..4 {
                let m = i + j + k - 3;
                let weight = BINOMIAL[3][i]
                    * BINOMIAL[3][j]
                    * BINOMIAL[3][k]
                    * step(i, j)
                    * step(i, k)
                    * step(j, k)
                    / BINOMIAL[3][m];
                let minor = |a: &[f64; 4], b: &[f64; 4]| a[j] * b[k] - a[k] * b[j];
                c[m] += weight * (x[i] * minor(y, w) - y[i] * minor(x, w) + w[i] * minor(x, y));
            }
        }
    }
    c
}

#[expect(clippy::cast_precision_loss, reason = "below 4")]
const fn step(from: usize, to: usize) -> f64 {
    (to - from) as f64
}

/// Product of two polynomials in Bernstein form; `R` = `N` + `M` − 1.
fn product<const N: usize, const M: usize, const R: usize>(a: &[f64; N], b: &[f64; M]) -> [f64; R] {
    debug_assert_eq!(N + M - 1, R);
    let mut c = [0.0; R];
    for (i, a) in a.iter().enumerate() {
        for (j, b) in b.iter().enumerate() {
            c[i + j] += BINOMIAL[N - 1][i] * BINOMIAL[M - 1][j] / BINOMIAL[R - 1][i + j] * a * b;
        }
    }
    c
}

/// n over k at \[n\]\[k\], for the degrees above.
const BINOMIAL: [[f64; 14]; 14] = {
    let mut table = [[0.0; 14]; 14];
    let mut n = 0;
    while n < 14 {
        table[n][0] = 1.0;
        let mut k = 1;
        while k <= n {
            table[n][k] = table[n - 1][k - 1] + table[n - 1][k];
            k += 1;
        }
        n += 1;
    }
    table
};
