//! The planar frame of the transitions by arc length, and the bounds on their derivatives.
//!
//! Such a curve is written in the basis of the corner's tangent and inward normal,
//!
//! ```text
//! m = (T1 + T2)/(2 cos β)    n = (T2 − T1)/(2 sin β)    T1 = (cos β, −sin β), T2 = (cos β, sin β)
//! ```
//!
//! and mirrors about n. With heading φ (−β at the start, 0 in the middle), curvature k and dk/ds:
//!
//! ```text
//! dr/ds = t = cos φ·m + sin φ·n     d²r/ds² = k·(−sin φ·m + cos φ·n)     d³r/ds³ = k'·(…) − k²·t
//! ```
//!
//! An axis sees one linear functional of that. Its largest magnitude is enclosed by branch and
//! bound: a piece of the curve yields intervals for k, k' and φ, hence an upper bound, and its
//! ends yield values that are attained; a piece whose upper bound is not worth more than the best
//! attained value is done, others are halved.

use super::bounds::DerivativeBounds;
use super::error::TransitionError;
use crate::turn::{feed_group, norm_in};
use crate::{AXES, AxisVector, Jet, Turn};

/// Below this cos β (a turn within 0.12° of a reversal) there is no curve at constant speed.
const REVERSAL_CB: f64 = 1e-3;

/// A corner as the curves by arc length see it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    corner: AxisVector,
    /// (T1 + T2)/2, of length cos β.
    along: AxisVector,
    /// (T2 − T1)/2, of length sin β.
    across: AxisVector,
    /// The turn.
    pub(super) turn: Turn,
}

/// Coordinates along `along` and `across`, value and three derivatives by arc length: the lengths
/// of the basis are cos β and sin β, so nothing is ever divided by them.
pub(super) type PlanarJet = [[f64; 2]; 4];

impl Frame {
    pub(super) fn new(
        corner: AxisVector,
        t1: &AxisVector,
        t2: &AxisVector,
    ) -> Result<Self, TransitionError> {
        let axes = feed_group(t1, t2);
        let is_unit = |t: &AxisVector| (norm_in(t, axes.clone()) - 1.0).abs() < 1e-6;
        if !(is_unit(t1) && is_unit(t2)) {
            return Err(TransitionError::MixedFeedAxes);
        }
        let turn = Turn::between(t1, t2);
        if turn.cb < REVERSAL_CB {
            return Err(TransitionError::Reversal);
        }
        Ok(Self {
            corner,
            along: (t1 + t2) * 0.5,
            across: (t2 - t1) * 0.5,
            turn,
        })
    }

    /// The jet over all axes; on the second half, of the mirrored curve.
    pub(super) fn jet(&self, planar: &PlanarJet, second_half: bool) -> Jet {
        // Mirrored and run backwards: odd derivatives of `across` and even ones of `along` flip.
        let sign = if second_half { -1.0 } else { 1.0 };
        let vector = |k: usize, a: f64, b: f64| {
            self.along * (a * planar[k][0]) + self.across * (b * planar[k][1])
        };
        Jet {
            position: self.corner + vector(0, sign, 1.0),
            d1: vector(1, 1.0, sign),
            d2: vector(2, sign, 1.0),
            d3: vector(3, 1.0, sign),
        }
    }

    /// Bounds of a curve whose first half is `half`, `d1` included.
    pub(super) fn bounds(&self, half: &impl Half) -> DerivativeBounds {
        let mut bounds = DerivativeBounds {
            d1: AxisVector::zeros(),
            d2: AxisVector::zeros(),
            d3: AxisVector::zeros(),
        };
        let Turn { sb, cb } = self.turn;
        let mut functionals = [Functional::default(); 2 * AXES];
        for axis in 0..AXES {
            let c_m = self.along[axis] / cb;
            let c_n = if sb > 0.0 {
                self.across[axis] / sb
            } else {
                0.0
            };
            // The tangent turns from −β to β; it is parallel to the axis' own direction on the way
            // if |c_n / c_m| ≤ tan β.
            bounds.d1[axis] = if c_n.abs() * cb <= c_m.abs() * sb {
                c_m.hypot(c_n)
            } else {
                (c_m * cb).abs() + (c_n * sb).abs()
            };
            functionals[2 * axis] = Functional::new(c_m, c_n);
            functionals[2 * axis + 1] = Functional::new(-c_m, c_n);
        }
        if sb > 0.0 {
            let mut search = BoundSearch { functionals };
            search.visit(half, &half.root(), MAX_DEPTH);
            for axis in 0..AXES {
                let pair = [
                    search.functionals[2 * axis],
                    search.functionals[2 * axis + 1],
                ];
                bounds.d2[axis] = pair[0].bound[0].max(pair[1].bound[0]);
                bounds.d3[axis] = pair[0].bound[1].max(pair[1].bound[1]);
            }
        }
        bounds
    }
}

/// Curvature, its derivative by arc length, and heading (cos φ, sin φ) at a point of a curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub(super) k: f64,
    pub(super) k1: f64,
    pub(super) heading: [f64; 2],
}

/// Enclosure of a piece of a curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct Enclosure {
    /// Smallest and largest curvature, ≥ 0.
    pub(super) k: [f64; 2],
    /// Smallest and largest derivative of curvature.
    pub(super) k1: [f64; 2],
    /// The two ends; the heading turns monotonically between them.
    pub(super) ends: [Point; 2],
}

/// First half of a transition, as pieces that can be enclosed and halved.
pub(super) trait Half {
    type Piece;
    fn root(&self) -> Self::Piece;
    fn halve(&self, piece: &Self::Piece) -> [Self::Piece; 2];
    fn enclose(&self, piece: &Self::Piece) -> Enclosure;
}

/// A piece is done when it can raise the result by no more than this.
const WORTH: f64 = 1.03;
/// Pieces get no smaller than 2⁻²⁴ of the half; their enclosure then counts as it is.
const MAX_DEPTH: u32 = 24;

/// One linear functional, c_m·m + c_n·n.
#[derive(Debug, Clone, Copy, Default)]
struct Functional {
    c: [f64; 2],
    /// Largest attained magnitude of the second and the third derivative.
    attained: [f64; 2],
    /// Largest upper bound of pieces that are done.
    bound: [f64; 2],
}

impl Functional {
    const fn new(c_m: f64, c_n: f64) -> Self {
        Self {
            c: [c_m, c_n],
            attained: [0.0; 2],
            bound: [0.0; 2],
        }
    }

    const fn is_zero(&self) -> bool {
        self.c[0] == 0.0 && self.c[1] == 0.0
    }

    /// Tangent and normal components at a heading.
    fn components(&self, heading: [f64; 2]) -> [f64; 2] {
        let [cos, sin] = heading;
        [
            self.c[0] * cos + self.c[1] * sin,
            self.c[1] * cos - self.c[0] * sin,
        ]
    }

    fn attain(&mut self, point: &Point) {
        let [t, n] = self.components(point.heading);
        let values = [
            (point.k * n).abs(),
            (point.k1 * n - point.k * point.k * t).abs(),
        ];
        for (attained, value) in self.attained.iter_mut().zip(values) {
            *attained = attained.max(value);
        }
    }

    /// Upper bounds over a piece whose headings stray at most `bow` (on the unit circle) from the
    /// chord between its ends.
    fn upper(&self, piece: &Enclosure, bow: f64) -> [f64; 2] {
        let slack = bow * self.c[0].hypot(self.c[1]);
        let [t_0, n_0] = self.components(piece.ends[0].heading);
        let [t_1, n_1] = self.components(piece.ends[1].heading);
        let t = [t_0.min(t_1) - slack, t_0.max(t_1) + slack];
        let n = [n_0.min(n_1) - slack, n_0.max(n_1) + slack];
        let second = piece.k[1] * n[0].abs().max(n[1].abs());
        let turning = product(piece.k1, n);
        let centripetal = product([piece.k[0] * piece.k[0], piece.k[1] * piece.k[1]], t);
        let third = (turning[1] - centripetal[0])
            .abs()
            .max((turning[0] - centripetal[1]).abs());
        [second, third]
    }
}

/// Product of two intervals.
fn product(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let all = [a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]];
    [
        all.into_iter().fold(f64::INFINITY, f64::min),
        all.into_iter().fold(f64::NEG_INFINITY, f64::max),
    ]
}

struct BoundSearch {
    functionals: [Functional; 2 * AXES],
}

impl BoundSearch {
    fn visit<H: Half>(&mut self, half: &H, piece: &H::Piece, depth: u32) {
        let enclosure = half.enclose(piece);
        for functional in &mut self.functionals {
            functional.attain(&enclosure.ends[0]);
            functional.attain(&enclosure.ends[1]);
        }
        let [from, to] = [enclosure.ends[0].heading, enclosure.ends[1].heading];
        let chord_squared = (to[0] - from[0]).powi(2) + (to[1] - from[1]).powi(2);
        let bow = 1.0 - (1.0 - 0.25 * chord_squared).max(0.0).sqrt();

        // What an axis needs less than a thousandth of is not worth looking at closely.
        let mut floor = [0.0_f64; 2];
        for functional in &self.functionals {
            for (floor, attained) in floor.iter_mut().zip(functional.attained) {
                *floor = floor.max(1e-3 * attained);
            }
        }
        let mut is_done = true;
        let mut upper = [[0.0; 2]; 2 * AXES];
        for (functional, upper) in self.functionals.iter().zip(&mut upper) {
            if functional.is_zero() {
                continue;
            }
            *upper = functional.upper(&enclosure, bow);
            for which in 0..2 {
                let worth = (functional.attained[which] * WORTH).max(floor[which]);
                is_done &= upper[which] <= worth;
            }
        }
        if is_done || depth == 0 {
            for (functional, upper) in self.functionals.iter_mut().zip(upper) {
                for (bound, upper) in functional.bound.iter_mut().zip(upper) {
                    *bound = bound.max(upper);
                }
            }
            return;
        }
        let [first, second] = half.halve(piece);
        // The middle of the corner first: that is where the large values are.
        self.visit(half, &second, depth - 1);
        self.visit(half, &first, depth - 1);
    }
}
