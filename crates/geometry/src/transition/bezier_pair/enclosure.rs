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

use super::HalfCurve;
use crate::bernstein::{differences, halve};
use crate::transition::constant_speed::{Enclosure, Half, Point};

/// Bernstein coefficients of the polynomials above on a piece.
#[derive(Debug, Clone)]
pub(super) struct PairPiece {
    w: [f64; 4],
    v: [[f64; 6]; 2],
    m: [f64; 11],
    d: [f64; 7],
    q: [f64; 19],
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
        let first = |c: &[f64; 4]| -> [f64; 3] { differences::<f64, 4, 3>(c).map(|e| 3.0 * e) };
        let second = |c: &[f64; 3]| -> [f64; 2] { differences::<f64, 3, 2>(c).map(|e| 2.0 * e) };
        let (x1, y1, w1) = (first(&x), first(&y), first(&w));
        let (x2, y2, w2) = (second(&x1), second(&y1), second(&w1));

        let v: [[f64; 6]; 2] = [(&x, &x1), (&y, &y1)]
            .map(|(n, n1)| sub(&product::<3, 4, 6>(n1, &w), &product::<4, 3, 6>(n, &w1)));
        let m: [f64; 11] = add(
            &product::<6, 6, 11>(&v[0], &v[0]),
            &product::<6, 6, 11>(&v[1], &v[1]),
        );
        let minor = |a1: &[f64; 3], a2: &[f64; 2], b1: &[f64; 3], b2: &[f64; 2]| -> [f64; 4] {
            sub(&product::<3, 2, 4>(a1, b2), &product::<2, 3, 4>(a2, b1))
        };
        let d: [f64; 7] = add(
            &add(
                &product::<4, 4, 7>(&x, &minor(&y1, &y2, &w1, &w2)),
                &product::<4, 4, 7>(&y, &minor(&w1, &w2, &x1, &x2)),
            ),
            &product::<4, 4, 7>(&w, &minor(&x1, &x2, &y1, &y2)),
        );
        let m1: [f64; 10] = differences::<f64, 11, 10>(&m).map(|e| 10.0 * e);
        let d1: [f64; 6] = differences::<f64, 7, 6>(&d).map(|e| 6.0 * e);
        let dw: [f64; 10] = product(&d, &w);
        let q = sub(
            &add(
                &product::<9, 11, 19>(&product::<6, 4, 9>(&d1, &w), &m),
                &product::<9, 11, 19>(&product::<7, 3, 9>(&d, &w1).map(|e| 3.0 * e), &m),
            ),
            &product::<10, 10, 19>(&dw, &m1).map(|e| 1.5 * e),
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

/// Product of two polynomials in Bernstein form; `R` = `N` + `M` − 1.
fn product<const N: usize, const M: usize, const R: usize>(a: &[f64; N], b: &[f64; M]) -> [f64; R] {
    debug_assert_eq!(N + M - 1, R);
    let mut c = [0.0; R];
    for (i, a) in a.iter().enumerate() {
        for (j, b) in b.iter().enumerate() {
            c[i + j] += binomial(N - 1, i) * binomial(M - 1, j) / binomial(R - 1, i + j) * a * b;
        }
    }
    c
}

/// n over k, for the small n above.
fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |value, i| {
        #[expect(clippy::cast_precision_loss, reason = "below 19")]
        let factor = (n - i) as f64 / (i + 1) as f64;
        value * factor
    })
}
