//! One half of a pair, by its parameter and by arc length.

use super::shape::PairShape;
use crate::Turn;
use crate::transition::constant_speed::PlanarJet;

/// First half of a pair in the planar frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HalfCurve {
    pub(super) d: f64,
    pub(super) shape: PairShape,
    pub(super) turn: Turn,
}

impl HalfCurve {
    /// Homogeneous Bézier points: weighted coordinates along and across, and the weight.
    pub(super) const fn homogeneous(&self) -> [[f64; 4]; 3] {
        let PairShape { s1, s2 } = self.shape;
        let d = self.d;
        [
            [-d * s1, -0.5 * d, -0.25 * d, 0.0],
            [d * s1, 0.5 * d, 0.25 * d, 0.25 * d * s2],
            [s1, 1.0, 1.0, s2],
        ]
    }

    /// Coordinates and three derivatives by the parameter.
    pub(super) fn by_parameter(&self, t: f64) -> PlanarJet {
        let [x, y, w] = self.homogeneous().map(|c| cubic(&c, t));
        let mut jet = [[0.0; 2]; 4];
        for (axis, n) in [x, y].into_iter().enumerate() {
            let r0 = n[0] / w[0];
            let r1 = (n[1] - r0 * w[1]) / w[0];
            let r2 = (n[2] - 2.0 * r1 * w[1] - r0 * w[2]) / w[0];
            let r3 = (n[3] - 3.0 * r2 * w[1] - 3.0 * r1 * w[2] - r0 * w[3]) / w[0];
            for (order, value) in [r0, r1, r2, r3].into_iter().enumerate() {
                jet[order][axis] = value;
            }
        }
        jet
    }

    pub(super) fn dot(&self, a: [f64; 2], b: [f64; 2]) -> f64 {
        let Turn { sb, cb } = self.turn;
        cb * cb * a[0] * b[0] + sb * sb * a[1] * b[1]
    }

    /// |r'| = |N'·w − N·w'| / w².
    pub(super) fn speed(&self, t: f64) -> f64 {
        let [x, y, w] = self.homogeneous().map(|c| cubic(&c, t));
        let velocity = [x[1] * w[0] - x[0] * w[1], y[1] * w[0] - y[0] * w[1]];
        self.dot(velocity, velocity).sqrt() / (w[0] * w[0])
    }

    /// Coordinates and three derivatives by arc length, at a parameter.
    pub(super) fn by_arc_length(&self, t: f64) -> PlanarJet {
        let [r0, r1, r2, r3] = self.by_parameter(t);
        // With v = |r'|: t' = 1/v, t'' = −v'/v³, t''' = (3v'² − v·v'')/v⁵.
        let v = self.dot(r1, r1).sqrt();
        let v_1 = self.dot(r1, r2) / v;
        let v_v2 = self.dot(r2, r2) + self.dot(r1, r3) - v_1 * v_1;
        let t1 = 1.0 / v;
        let t2 = -v_1 / v.powi(3);
        let t3 = (3.0 * v_1 * v_1 - v_v2) / v.powi(5);
        let mut jet = [r0, [0.0; 2], [0.0; 2], [0.0; 2]];
        for axis in 0..2 {
            jet[1][axis] = r1[axis] * t1;
            jet[2][axis] = r2[axis] * t1 * t1 + r1[axis] * t2;
            jet[3][axis] = r3[axis] * t1 * t1 * t1 + 3.0 * r2[axis] * t1 * t2 + r1[axis] * t3;
        }
        jet
    }
}

/// Value and three derivatives of a cubic in Bernstein form.
fn cubic(c: &[f64; 4], t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    let d = [c[1] - c[0], c[2] - c[1], c[3] - c[2]];
    let e = [d[1] - d[0], d[2] - d[1]];
    [
        c[0] * s * s * s + 3.0 * t * s * (c[1] * s + c[2] * t) + c[3] * t * t * t,
        3.0 * (d[0] * s * s + 2.0 * d[1] * s * t + d[2] * t * t),
        6.0 * (e[0] * s + e[1] * t),
        6.0 * (e[1] - e[0]),
    ]
}
