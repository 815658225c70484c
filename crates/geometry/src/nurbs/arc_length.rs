//! A NURBS by path position: the parameter u(s) at bounded cost.
//!
//! The curve is cut into pieces, by halving knot spans, until on each
//!
//! * one panel of Gauss quadrature gives its length to 1e-13 mm (compared with two half panels),
//!   and
//! * the quintic polynomial through u, du/ds, d²u/ds² of both ends is within 1e-6 mm of u(s).
//!
//! Evaluation finds the piece by bisection of a table, takes the quintic's value, and corrects it
//! by one Newton step on s(u) − s = 0, s(u) by one panel from the start of the piece. Newton
//! squares the relative error, so what is left is rounding, and nothing drifts: every value stands
//! for itself. Where the curve stands still (a cusp) du/ds is infinite; pieces shrink towards it,
//! 2⁻⁴⁰ of the span the smallest, and the last has a straight line in place of the quintic and
//! more Newton steps.

use super::{Nurbs, Span};
use crate::quadrature::gauss_12;
use crate::{Jet, LINEAR_XYZ};

/// Largest error of a piece's quintic before correction, mm. Newton's step leaves about the square of it
/// over the length on which |C′| changes. With more, one step is not enough; with less, there are more
/// pieces.
const SEED_MM: f64 = 1e-6;
/// The same as a share of the piece's length, for curves of micrometres.
const SEED_R: f64 = 1e-4;
/// Largest difference of the length of a piece from the sum of its halves, mm and relative: thousands of
/// pieces come to less than a picometre together. Rounding alone is some 1e-16 of a length.
const LENGTH_MM: f64 = 1e-13;
/// Halvings of a knot span after which a piece is taken as it is, next to where the curve stands still.
const MAX_HALVINGS: u32 = 40;
/// Newton steps on a piece next to a point where the curve stands still; there they only halve the
/// error.
const STEPS_AT_STANDSTILL: u32 = 16;

/// A curve with its arc length: a path of position `s`, from 0 to [`NurbsPath::length`].
#[derive(Debug, Clone, PartialEq)]
pub struct NurbsPath {
    curve: Nurbs,
    pieces: Vec<LengthPiece>,
    length: f64,
    /// No other axes than X, Y, Z move.
    is_in_space: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct LengthPiece {
    span: usize,
    from_s: f64,
    length: f64,
    from_u: f64,
    to_u: f64,
    /// u − from_u as a polynomial of (s − from_s)/length.
    seed: [f64; 6],
    newton_steps: u32,
}

impl NurbsPath {
    /// Measures a curve.
    #[must_use]
    pub fn new(curve: Nurbs) -> Self {
        let mut pieces = Vec::new();
        for (index, span) in curve.spans().iter().enumerate() {
            let whole = gauss_12(span.from_u(), span.to_u(), |u| span.speed(u));
            cut(
                &MeasuredPart {
                    index,
                    span,
                    from_u: span.from_u(),
                    to_u: span.to_u(),
                    length: whole,
                    halvings: MAX_HALVINGS,
                },
                &mut pieces,
            );
        }
        let mut length = Sum::default();
        for piece in &mut pieces {
            piece.from_s = length.value();
            length.add(piece.length);
        }
        Self {
            is_in_space: is_in_space(&curve),
            curve,
            pieces,
            length: length.value(),
        }
    }

    /// The curve.
    #[must_use]
    pub const fn curve(&self) -> &Nurbs {
        &self.curve
    }

    /// True if no other axes than X, Y, Z move.
    #[must_use]
    pub const fn is_in_space(&self) -> bool {
        self.is_in_space
    }

    /// Feed length, > 0.
    #[must_use]
    pub const fn length(&self) -> f64 {
        self.length
    }

    /// Path position of a parameter; both are clamped to the curve.
    #[must_use]
    pub fn s_at(&self, u: f64) -> f64 {
        let index = self.pieces.partition_point(|piece| piece.from_u <= u);
        let Some(piece) = self.pieces.get(index.saturating_sub(1)) else {
            return 0.0;
        };
        let u = u.clamp(piece.from_u, piece.to_u);
        piece.from_s + piece.s_to(&self.curve.spans()[piece.span], u)
    }

    /// Parameter of a path position; both are clamped to the curve.
    #[must_use]
    pub fn u_at(&self, s: f64) -> f64 {
        self.find(s).1
    }

    /// Position and derivatives by path position at `s`, which is clamped to the curve. At a knot
    /// the derivatives are those of one of its sides. Never allocates; the cost does not depend on
    /// `s`.
    #[must_use]
    pub fn jet(&self, s: f64) -> Jet {
        let (span, u) = self.find(s);
        span.jet(u).by_path_position(self.curve.feed_axes())
    }

    fn find(&self, s: f64) -> (&Span, f64) {
        let index = self.pieces.partition_point(|piece| piece.from_s <= s);
        let piece = &self.pieces[index.saturating_sub(1)];
        let span = &self.curve.spans()[piece.span];
        if s >= self.length {
            return (span, piece.to_u);
        }
        (span, piece.u_at(span, s - piece.from_s))
    }
}

fn is_in_space(curve: &Nurbs) -> bool {
    let points = curve.control_points();
    let moves = |axis: usize| {
        points
            .iter()
            .any(|p| p[axis].to_bits() != points[0][axis].to_bits())
    };
    curve.feed_axes() == LINEAR_XYZ && !(LINEAR_XYZ.end..points[0].len()).any(moves)
}

impl LengthPiece {
    /// Length from the start of the piece to `u`.
    fn s_to(&self, span: &Span, u: f64) -> f64 {
        gauss_12(self.from_u, u, |u| span.speed(u))
    }

    fn seed_at(&self, x: f64) -> f64 {
        let polynomial = self.seed.iter().rev().fold(0.0, |sum, c| sum * x + c);
        (self.from_u + polynomial).clamp(self.from_u, self.to_u)
    }

    fn u_at(&self, span: &Span, s: f64) -> f64 {
        if s <= 0.0 {
            return self.from_u;
        }
        if s >= self.length {
            return self.to_u;
        }
        let mut u = self.seed_at(s / self.length);
        for _ in 0..self.newton_steps {
            let speed = span.speed(u);
            if speed > 0.0 {
                u = (u - (self.s_to(span, u) - s) / speed).clamp(self.from_u, self.to_u);
            }
        }
        u
    }
}

/// A stretch of a span whose length is known by one panel.
struct MeasuredPart<'a> {
    index: usize,
    span: &'a Span,
    from_u: f64,
    to_u: f64,
    length: f64,
    halvings: u32,
}

/// Appends the pieces of a part.
fn cut(part: &MeasuredPart<'_>, pieces: &mut Vec<LengthPiece>) {
    let span = part.span;
    let middle = 0.5 * (part.from_u + part.to_u);
    // |C′| is smooth within a span, so halving makes the error of a panel fall fast (twelve nodes are exact
    // to degree 23): the difference is nearly all the whole's, and the halves' sum is kept.
    let lengths = [(part.from_u, middle), (middle, part.to_u)]
        .map(|(a, b)| gauss_12(a, b, |u| span.speed(u)));
    let settled = (lengths[0] + lengths[1] - part.length).abs() <= LENGTH_MM * (1.0 + part.length);
    if settled || part.halvings == 0 {
        let mut piece = LengthPiece {
            span: part.index,
            from_s: 0.0,
            length: lengths[0] + lengths[1],
            from_u: part.from_u,
            to_u: part.to_u,
            seed: [0.0, part.to_u - part.from_u, 0.0, 0.0, 0.0, 0.0],
            newton_steps: STEPS_AT_STANDSTILL,
        };
        if let Some(seed) = quintic(&piece, span).filter(|_| part.halvings > 0) {
            piece.seed = seed;
            piece.newton_steps = 1;
        }
        if part.halvings == 0 || seed_error_s(&piece, span) <= SEED_MM.min(SEED_R * piece.length) {
            pieces.push(piece);
            return;
        }
    }
    for (from_u, to_u, length) in [
        (part.from_u, middle, lengths[0]),
        (middle, part.to_u, lengths[1]),
    ] {
        let half = MeasuredPart {
            from_u,
            to_u,
            length,
            halvings: part.halvings - 1,
            ..*part
        };
        cut(&half, pieces);
    }
}

/// The polynomial through u and two derivatives by s at both ends; none where the curve stands
/// still.
fn quintic(piece: &LengthPiece, span: &Span) -> Option<[f64; 6]> {
    let length = piece.length;
    let end = |u: f64| {
        let (s1, s2) = span.speed_and_change(u);
        // du/ds = 1/s′, d²u/ds² = −s″/s′³, by the parameter of the seed, from 0 to 1.
        let u1 = 1.0 / s1;
        (u1 * length, -s2 * u1 * u1 * u1 * length * length)
    };
    let ((d0, e0), (d1, e1)) = (end(piece.from_u), end(piece.to_u));
    let dv = piece.to_u - piece.from_u;
    let seed = [
        0.0,
        d0,
        0.5 * e0,
        10.0 * dv - 6.0 * d0 - 4.0 * d1 - 1.5 * e0 + 0.5 * e1,
        -15.0 * dv + 8.0 * d0 + 7.0 * d1 + 1.5 * e0 - e1,
        6.0 * dv - 3.0 * d0 - 3.0 * d1 - 0.5 * e0 + 0.5 * e1,
    ];
    seed.iter().all(|c| c.is_finite()).then_some(seed)
}

/// Largest error of a piece's seed at some points between, mm. The error of a Hermite quintic has
/// the shape x³(1−x)³, largest in the middle.
fn seed_error_s(piece: &LengthPiece, span: &Span) -> f64 {
    [0.25, 0.5, 0.75]
        .map(|x| (piece.s_to(span, piece.seed_at(x)) - x * piece.length).abs())
        .into_iter()
        .fold(0.0, f64::max)
}

/// Kahan's compensated sum: thousands of pieces add up without losing digits.
#[derive(Debug, Default)]
struct Sum {
    sum: f64,
    lost: f64,
}

impl Sum {
    fn add(&mut self, term: f64) {
        let term = term - self.lost;
        let sum = self.sum + term;
        self.lost = (sum - self.sum) - term;
        self.sum = sum;
    }

    const fn value(&self) -> f64 {
        self.sum
    }
}
