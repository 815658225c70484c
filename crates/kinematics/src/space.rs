//! Points and rotations in space whose coordinates are series.

use glidepath_geometry::number::{Number, Series};
use nalgebra::Vector3;

/// A point along a parameter.
pub(crate) type Point<const N: usize, T = f64> = [Series<N, T>; 3];

/// Degrees to radians.
pub(crate) const RAD: f64 = core::f64::consts::PI / 180.0;

/// Sum of two vectors.
pub(crate) fn add<const N: usize, T: Number>(a: Point<N, T>, b: Point<N, T>) -> Point<N, T> {
    core::array::from_fn(|i| a[i] + b[i])
}

/// A vector and a constant one.
pub(crate) fn offset<const N: usize, T: Number>(a: Point<N, T>, b: &Vector3<f64>) -> Point<N, T> {
    core::array::from_fn(|i| a[i] + Series::constant(b[i]))
}

/// A constant vector.
pub(crate) fn constant<const N: usize, T: Number>(a: &Vector3<f64>) -> Point<N, T> {
    core::array::from_fn(|i| Series::constant(a[i]))
}

/// A constant vector times a series.
pub(crate) fn stretched<const N: usize, T: Number>(
    a: &Vector3<f64>,
    by: Series<N, T>,
) -> Point<N, T> {
    core::array::from_fn(|i| by.scale(a[i]))
}

/// Length squared.
pub(crate) fn norm_squared<const N: usize, T: Number>(a: Point<N, T>) -> Series<N, T> {
    a[0].square() + a[1].square() + a[2].square()
}

/// What a rotation is about.
#[derive(Debug, Clone, Copy)]
enum About {
    /// One of the axes of space, 0 for x.
    Axis(usize),
    /// A direction of length 1.
    Direction(Vector3<f64>),
}

/// A rotation by an angle in degrees.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Turn<const N: usize, T = f64> {
    about: About,
    sin: Series<N, T>,
    cos: Series<N, T>,
}

impl<const N: usize, T: Number> Turn<N, T> {
    /// About one of the axes of space, 0 for x.
    pub(crate) fn new(axis: usize, angle_deg: Series<N, T>) -> Self {
        Self::by(About::Axis(axis), angle_deg)
    }

    /// About a direction of length 1.
    pub(crate) fn about(direction: Vector3<f64>, angle_deg: Series<N, T>) -> Self {
        Self::by(About::Direction(direction), angle_deg)
    }

    fn by(about: About, angle_deg: Series<N, T>) -> Self {
        let (sin, cos) = angle_deg.scale(RAD).sin_cos();
        Self { about, sin, cos }
    }

    /// Right-handed about the axis.
    pub(crate) fn apply(&self, a: Point<N, T>) -> Point<N, T> {
        let axis = match &self.about {
            About::Axis(axis) => axis,
            About::Direction(direction) => return self.about_direction(direction, a),
        };
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut turned = a;
        turned[i] = self.cos * a[i] - self.sin * a[j];
        turned[j] = self.sin * a[i] + self.cos * a[j];
        turned
    }

    /// By Rodrigues' formula: a cos + (d × a) sin + d (d · a) (1 − cos).
    fn about_direction(&self, d: &Vector3<f64>, a: Point<N, T>) -> Point<N, T> {
        let along = a[0].scale(d.x) + a[1].scale(d.y) + a[2].scale(d.z);
        let kept = along - along * self.cos;
        core::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let across = a[k].scale(d[j]) - a[j].scale(d[k]);
            self.cos * a[i] + self.sin * across + kept.scale(d[i])
        })
    }

    /// The other way round.
    pub(crate) fn undo(&self, a: Point<N, T>) -> Point<N, T> {
        Self {
            sin: -self.sin,
            ..*self
        }
        .apply(a)
    }
}

impl Turn<1> {
    /// Of a plain vector.
    pub(crate) fn of(&self, a: &Vector3<f64>) -> Vector3<f64> {
        self.apply(constant(a)).map(|s| s.value()).into()
    }
}

/// The lower of the two points at the same distance from three centres, by trilateration: a closed form, as
/// exact as its square root. It loses digits where that is near 0, with the point in the plane of the
/// centres, which is a singularity of the mechanism.
pub(crate) fn below_three([a, b, c]: [Vector3<f64>; 3], distance_mm: f64) -> Option<Vector3<f64>> {
    // A frame with a at its origin, b on its first axis and c in its first plane.
    let ab = b - a;
    let d = ab.norm();
    let ex = ab / d;
    let ac = c - a;
    let i = ex.dot(&ac);
    let across = ac - ex * i;
    let j = across.norm();
    let ey = across / j;
    let ez = ex.cross(&ey);
    // Equal distances from a and b, then from a and c: with equal radii these do not depend on the radius.
    let x = 0.5 * d;
    let y = 0.5 * (i * i + j * j - 2.0 * i * x) / j;
    let square = distance_mm * distance_mm - x * x - y * y;
    let down = if ez.z > 0.0 { -1.0 } else { 1.0 };
    (square >= 0.0).then(|| a + ex * x + ey * y + ez * (down * square.sqrt()))
}
