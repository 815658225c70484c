//! Frames: how a program shifts, turns, mirrors and scales its coordinates.
//!
//! ```text
//! coordinates in front of the frame = shift + M · program coordinates
//! ```
//!
//! M acts on X, Y and Z. A frame that is added acts on the program's coordinates first, so that it
//! counts in the coordinates that are in force.

use glidepath_geometry::{Axis, AxisVector, Plane};
use nalgebra::Vector3;

/// Parts of a length below this are rounding.
const ROUNDING: f64 = 1e-9;

/// A matrix of the coordinates X, Y and Z, by rows.
pub(crate) type Matrix = [[f64; 3]; 3];

const UNIT: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// What a program has made of its coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Frame {
    matrix: Matrix,
    /// Its inverse.
    inverse: Matrix,
    pub(crate) shift: AxisVector,
    /// The matrix is another than the unit matrix.
    is_turned: bool,
}

/// Where the arcs of a plane are once a frame has been at work.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PlaneImage {
    pub(crate) plane: Plane,
    /// How much longer radii are.
    pub(crate) scale: f64,
    /// Clockwise is the other way round.
    pub(crate) is_mirrored: bool,
}

impl PlaneImage {
    /// The plane itself.
    pub(crate) const fn of(plane: Plane) -> Self {
        Self {
            plane,
            scale: 1.0,
            is_mirrored: false,
        }
    }
}

impl Default for Frame {
    fn default() -> Self {
        Self {
            matrix: UNIT,
            inverse: UNIT,
            shift: AxisVector::zeros(),
            is_turned: false,
        }
    }
}

impl Frame {
    /// A frame that shifts.
    pub(crate) fn shifted(shift: AxisVector) -> Self {
        Self {
            shift,
            ..Self::default()
        }
    }

    /// A frame that turns by the angles about X, Y and Z in degrees: about Z first, then about the
    /// new Y, then about the new X.
    pub(crate) fn turned(degrees: [f64; 3]) -> Self {
        let [about_x, about_y, about_z] = [0, 1, 2].map(|axis| rotation(axis, degrees[axis]));
        let matrix = product(&product(&about_z, &about_y), &about_x);
        Self {
            matrix,
            // Turned back, which is exact.
            inverse: transposed(&matrix),
            is_turned: matrix != UNIT,
            ..Self::default()
        }
    }

    /// A frame with the directions of its X and Z, which are of length one and at right angles.
    pub(crate) fn of_axes(x: &Vector3<f64>, z: &Vector3<f64>) -> Self {
        let y = z.cross(x);
        let matrix = [0, 1, 2].map(|axis| [x[axis], y[axis], z[axis]]);
        Self {
            matrix,
            // Turned back, which is exact.
            inverse: transposed(&matrix),
            is_turned: matrix != UNIT,
            ..Self::default()
        }
    }

    /// A frame that makes coordinates longer or shorter, or mirrors them with a factor of −1; no
    /// factor is zero.
    pub(crate) fn scaled(factors: [f64; 3]) -> Self {
        let (mut matrix, mut inverse) = (UNIT, UNIT);
        for (axis, factor) in factors.into_iter().enumerate() {
            matrix[axis][axis] = factor;
            inverse[axis][axis] = 1.0 / factor;
        }
        Self {
            matrix,
            inverse,
            is_turned: matrix != UNIT,
            ..Self::default()
        }
    }

    /// This frame, and inside of it the other one.
    pub(crate) fn with(&self, inner: &Self) -> Self {
        let matrix = product(&self.matrix, &inner.matrix);
        Self {
            matrix,
            inverse: product(&inner.inverse, &self.inverse),
            shift: self.shift + self.turn(inner.shift),
            is_turned: matrix != UNIT,
        }
    }

    /// The frame that undoes it.
    pub(crate) fn inverse(&self) -> Self {
        let back = Self {
            matrix: self.inverse,
            inverse: self.matrix,
            shift: AxisVector::zeros(),
            is_turned: self.is_turned,
        };
        Self {
            shift: -back.turn(self.shift),
            ..back
        }
    }

    /// The angles of [`Frame::turned`]; `None` where it mirrors or scales.
    pub(crate) fn angles_deg(&self) -> Option<[f64; 3]> {
        if !self.only_turns() {
            return None;
        }
        let [row_x, row_y, row_z] = self.matrix;
        let about_y = (-row_z[0]).clamp(-1.0, 1.0).asin();
        // At a right angle about Y the other two are about one axis.
        let (about_x, about_z) = if about_y.cos() > ROUNDING {
            (row_z[1].atan2(row_z[2]), row_y[0].atan2(row_x[0]))
        } else {
            (0.0, (-row_x[1]).atan2(row_y[1]))
        };
        Some([about_x, about_y, about_z].map(f64::to_degrees))
    }

    /// The factors of [`Frame::scaled`]; `None` where it turns and scales.
    pub(crate) fn factors(&self) -> Option<[f64; 3]> {
        if self.only_turns() {
            return Some([1.0; 3]);
        }
        let is_diagonal = (0..3).all(|row| {
            (0..3).all(|column| row == column || self.matrix[row][column].abs() <= ROUNDING)
        });
        is_diagonal.then(|| [0, 1, 2].map(|axis| self.matrix[axis][axis]))
    }

    /// True where it does more than shift.
    pub(crate) const fn is_turned(&self) -> bool {
        self.is_turned
    }

    /// True where it does anything.
    pub(crate) fn is_in_force(&self) -> bool {
        *self != Self::default()
    }

    /// The smallest factor by which it makes lengths along an axis of the program longer.
    pub(crate) fn least_scale(&self) -> f64 {
        let lengths = [0, 1, 2].map(|axis| length(column(&self.matrix, axis)));
        lengths.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// The factor by which it makes lengths along X, Y or Z of the program longer.
    pub(crate) fn scale_along(&self, axis: Axis) -> f64 {
        match axis.index() {
            linear @ 0..3 => length(column(&self.matrix, linear)),
            _ => 1.0,
        }
    }

    /// The greatest one.
    pub(crate) fn greatest_scale(&self) -> f64 {
        let lengths = [0, 1, 2].map(|axis| length(column(&self.matrix, axis)));
        lengths.into_iter().fold(0.0, f64::max)
    }

    /// True where it turns and shifts, and does not mirror or scale.
    pub(crate) fn only_turns(&self) -> bool {
        let [u, v, w] = [0, 1, 2].map(|axis| column(&self.matrix, axis));
        let is_unit = |a: [f64; 3]| (dot(a, a) - 1.0).abs() <= ROUNDING;
        let across = [
            u[1] * v[2] - u[2] * v[1],
            u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0],
        ];
        is_unit(u)
            && is_unit(v)
            && dot(u, v).abs() <= ROUNDING
            && (0..3).all(|axis| (across[axis] - w[axis]).abs() <= ROUNDING)
    }

    /// A way in the program's coordinates, in those in front of the frame.
    pub(crate) fn turn(&self, way: AxisVector) -> AxisVector {
        self.by(&self.matrix, way)
    }

    /// A place in the program's coordinates, in those in front of the frame.
    pub(crate) fn apply(&self, program: AxisVector) -> AxisVector {
        self.shift + self.turn(program)
    }

    /// The way back.
    pub(crate) fn undo(&self, place: AxisVector) -> AxisVector {
        self.by(&self.inverse, place - self.shift)
    }

    fn by(&self, matrix: &Matrix, mut way: AxisVector) -> AxisVector {
        if self.is_turned {
            let old = [way[0], way[1], way[2]];
            for (axis, row) in matrix.iter().enumerate() {
                way[axis] = row[0] * old[0] + row[1] * old[1] + row[2] * old[2];
            }
        }
        way
    }

    /// True where circles of a plane stay circles.
    pub(crate) fn keeps_circles(&self, plane: Plane) -> bool {
        let (first, second) = plane.axes();
        let (i, j) = (first.index(), second.index());
        if i >= 3 || j >= 3 {
            return true;
        }
        let (u, v) = (column(&self.matrix, i), column(&self.matrix, j));
        let rounding = ROUNDING * length(u);
        (length(v) - length(u)).abs() <= rounding && dot(u, v).abs() <= rounding * length(u)
    }

    /// Where arcs of a plane are; `outer` is a rotation about Z in degrees that follows. `None` if
    /// they are no arcs of a plane of the machine any more.
    pub(crate) fn plane(&self, plane: Plane, outer_deg: f64) -> Option<PlaneImage> {
        let (first, second) = plane.axes();
        let normal = plane.normal();
        let axes = [first, second, normal].map(Axis::index);
        if axes.iter().any(|axis| *axis >= 3) {
            return Some(PlaneImage::of(plane));
        }
        let matrix = product(&rotation(2, outer_deg), &self.matrix);
        let [u, v, w] = axes.map(|axis| column(&matrix, axis));
        let (scale, rounding) = (length(u), ROUNDING * length(u));
        let is_round = (length(v) - scale).abs() <= rounding && dot(u, v).abs() <= rounding * scale;
        let image = [Plane::Xy, Plane::Zx, Plane::Yz].into_iter().find(|image| {
            let (a, b) = image.axes();
            let out = image.normal().index();
            let along = ROUNDING * length(w);
            u[out].abs() <= rounding
                && v[out].abs() <= rounding
                && w[a.index()].abs() <= along
                && w[b.index()].abs() <= along
        });
        let image = image.filter(|_| is_round)?;
        let (a, b) = image.axes();
        let (a, b) = (a.index(), b.index());
        Some(PlaneImage {
            plane: image,
            scale,
            is_mirrored: u[a] * v[b] - u[b] * v[a] < 0.0,
        })
    }
}

/// A turn about an axis, right-handed; quarters of a turn are exact.
fn rotation(axis: usize, degrees: f64) -> Matrix {
    let quarters = (degrees / 90.0).round();
    let (sin, cos) = if (degrees - 90.0 * quarters).abs() <= 0.0 {
        match quarters.rem_euclid(4.0) {
            1.0 => (1.0, 0.0),
            2.0 => (0.0, -1.0),
            3.0 => (-1.0, 0.0),
            _ => (0.0, 1.0),
        }
    } else {
        degrees.to_radians().sin_cos()
    };
    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut matrix = UNIT;
    (matrix[a][a], matrix[a][b]) = (cos, -sin);
    (matrix[b][a], matrix[b][b]) = (sin, cos);
    matrix
}

fn product(left: &Matrix, right: &Matrix) -> Matrix {
    let mut matrix = [[0.0; 3]; 3];
    for (row, out) in left.iter().zip(&mut matrix) {
        for (axis, slot) in out.iter_mut().enumerate() {
            *slot = dot(*row, column(right, axis));
        }
    }
    matrix
}

fn transposed(matrix: &Matrix) -> Matrix {
    [0, 1, 2].map(|axis| column(matrix, axis))
}

fn column(matrix: &Matrix, axis: usize) -> [f64; 3] {
    matrix.map(|row| row[axis])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point(x: f64, y: f64, z: f64) -> AxisVector {
        let mut p = AxisVector::zeros();
        (p[0], p[1], p[2]) = (x, y, z);
        p
    }

    #[test]
    fn what_is_added_counts_in_the_coordinates_in_force() {
        let outer = Frame::shifted(point(10.0, 0.0, 0.0));
        let turned = outer.with(&Frame::turned([0.0, 0.0, 90.0]));
        let all = turned.with(&Frame::shifted(point(1.0, 0.0, 5.0)));
        assert_eq!(all.apply(point(2.0, 1.0, 0.0)), point(9.0, 3.0, 5.0));
        assert_eq!(all.undo(point(9.0, 3.0, 5.0)), point(2.0, 1.0, 0.0));
    }

    #[test]
    fn the_order_of_turns_is_z_new_y_new_x() {
        // About Z: X goes to Y. The new Y then is −X; a turn about it takes Z to the new X, which
        // is Y.
        let frame = Frame::turned([0.0, 90.0, 90.0]);
        assert_eq!(frame.turn(point(0.0, 0.0, 1.0)), point(0.0, 1.0, 0.0));
        assert_eq!(frame.turn(point(1.0, 0.0, 0.0)), point(0.0, 0.0, -1.0));
    }

    #[test]
    fn planes_are_followed_where_they_stay_planes() {
        let image = |frame: Frame, plane| {
            let found = frame.plane(plane, 0.0);
            found.map(|image| (image.plane, image.scale, image.is_mirrored))
        };
        let mirror = Frame::scaled([-1.0, 1.0, 1.0]);
        assert_eq!(image(mirror, Plane::Xy), Some((Plane::Xy, 1.0, true)));
        assert_eq!(image(mirror, Plane::Yz), Some((Plane::Yz, 1.0, false)));
        let tilted = Frame::turned([90.0, 0.0, 0.0]);
        assert_eq!(image(tilted, Plane::Xy), Some((Plane::Zx, 1.0, true)));
        let double = Frame::scaled([2.0, 2.0, 1.0]);
        assert_eq!(image(double, Plane::Xy), Some((Plane::Xy, 2.0, false)));
        assert_eq!(image(double, Plane::Zx), None);
        assert_eq!(image(Frame::turned([30.0, 0.0, 0.0]), Plane::Xy), None);
        let flat = Frame::turned([0.0, 0.0, 30.0]);
        let found = image(flat, Plane::Xy).map(|(plane, ..)| plane);
        assert_eq!((found, image(flat, Plane::Zx)), (Some(Plane::Xy), None));
        assert_eq!(image(flat, Plane::Uv), Some((Plane::Uv, 1.0, false)));
    }

    proptest! {
        #[test]
        fn the_way_back_leads_back(
            angles in prop::array::uniform3(-360.0_f64..360.0),
            factors in prop::array::uniform3(0.1_f64..10.0),
            mirrored in prop::array::uniform3(prop::bool::ANY),
            shift in prop::array::uniform3(-100.0_f64..100.0),
            at in prop::array::uniform3(-100.0_f64..100.0),
        ) {
            let signs = mirrored.map(|m| if m { -1.0 } else { 1.0 });
            let frame = Frame::shifted(point(shift[0], shift[1], shift[2]))
                .with(&Frame::turned(angles))
                .with(&Frame::scaled(signs))
                .with(&Frame::scaled(factors))
                .with(&Frame::turned([angles[1], angles[2], angles[0]]));
            let place = point(at[0], at[1], at[2]);
            prop_assert!((frame.undo(frame.apply(place)) - place).norm() < 1e-9);
        }
    }
}
