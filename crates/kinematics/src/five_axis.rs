//! Five-axis kinematics: two rotary axes with control of the tool's centre point.
//!
//! The program gives the tip of the tool in the coordinates of the work, X Y Z, and the two angles;
//! the linear joints follow the work (turned by tables) and the tip (swung by heads):
//!
//! ```text
//!   table-table   q = a₀ + Rt(θ) [(c₀ − a₀) + Rz(γ)(w − c₀)] + L ẑ
//!   head-head     q = w − Rz(γ) [d_c + Rt(θ)(d_t − L ẑ)] + (d_c + d_t − L ẑ)
//!   table, head   q = c₀ + Rz(γ)(w − c₀) + L (Rt(θ) ẑ − ẑ)
//! ```
//!
//! θ and γ are the programmed angles times the sign of their axis; Rt turns about x, y or a direction of the machine's
//! own ([`Tilt`]). In all of them q is w, shifted
//! by constants, when both angles are zero. Signs, order, pivots and offsets are data of the
//! machine.
//!
//! The map from axes to joints is regular everywhere. What has a pole is the way from a
//! *direction* of the tool to the two angles: with the tool along the rotary axis every γ will do
//! ([`FiveAxis::angles_deg`]).

use crate::machine::{AxisSeries, Conditioning, JointSeries, JointVector, Kinematics};
use crate::space::{Point, Turn, add, offset, stretched};
use crate::tilt::{SkewedTilt, Tilt};
use crate::{JOINTS, KinematicsError};
use glidepath_geometry::number::{Number, Series};
use glidepath_geometry::{Axis, AxisVector};
use nalgebra::Vector3;

/// What the rotary axes carry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rotaries {
    /// The tilting table carries the rotary table, which carries the work.
    TableTable {
        /// A point on the tilt axis, mm, in work coordinates at zero.
        tilt_point: Vector3<f64>,
        /// A point on the rotary axis, mm, likewise.
        rotary_point: Vector3<f64>,
    },
    /// The rotary head carries the tilting head, which carries the tool.
    HeadHead {
        /// From the rotary axis to the tilt axis at zero, mm.
        rotary_to_tilt: Vector3<f64>,
        /// From the tilt axis to the spindle's axis at zero, mm.
        tilt_to_spindle: Vector3<f64>,
    },
    /// The rotary table carries the work, the tilting head the tool.
    TableHead {
        /// A point on the rotary axis, mm, in work coordinates at zero.
        rotary_point: Vector3<f64>,
    },
}

/// A five-axis machine. J0…J2 are its linear joints, mm, J3 the tilt (A or B) and J4 the rotary
/// axis C, degrees as programmed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FiveAxis {
    /// What the rotary axes carry.
    pub rotaries: Rotaries,
    /// The axis that tilts.
    pub tilt: Tilt,
    /// True if a positive angle of the tilt turns its table or head the left-handed way, as the
    /// primed axes of ISO 841 do.
    pub tilt_reversed: bool,
    /// The same of C.
    pub rotary_reversed: bool,
    /// Length of the tool, mm: from the spindle's reference point on tables, from the pivot of a
    /// head to the tip.
    pub tool_mm: f64,
}

/// The sine of the angle to the rotary axis below which a tool counts as along it: whatever C is, its
/// direction is off by no more.
const POLE_R: f64 = 1e-9;

impl FiveAxis {
    /// The axis that tilts.
    #[must_use]
    pub const fn tilt_axis(&self) -> Axis {
        self.tilt.axis()
    }

    fn signs(&self) -> (f64, f64) {
        let sign = |reversed| if reversed { -1.0 } else { 1.0 };
        (sign(self.tilt_reversed), sign(self.rotary_reversed))
    }

    fn turns<const N: usize, T: Number>(
        &self,
        tilt: Series<N, T>,
        rotary: Series<N, T>,
    ) -> (Turn<N, T>, Turn<N, T>) {
        let (t, r) = self.signs();
        (self.tilt.turn(tilt.scale(t)), Turn::new(2, rotary.scale(r)))
    }

    /// The joints' linear part as a function of the tip; with `back`, the other way.
    fn linear<const N: usize, T: Number>(
        &self,
        point: Point<N, T>,
        tilt: Series<N, T>,
        rotary: Series<N, T>,
        back: bool,
    ) -> Point<N, T> {
        let (tilt, rotary) = self.turns(tilt, rotary);
        let one = Series::constant(1.0);
        let up = stretched(&Vector3::new(0.0, 0.0, self.tool_mm), one);
        let minus = |p: Point<N, T>| p.map(|c| -c);
        match &self.rotaries {
            Rotaries::TableTable {
                tilt_point: a,
                rotary_point: c,
            } if back => {
                let tilted = tilt.undo(offset(add(point, minus(up)), &-a));
                offset(rotary.undo(offset(tilted, &(a - c))), c)
            }
            Rotaries::TableTable {
                tilt_point: a,
                rotary_point: c,
            } => {
                let turned = offset(rotary.apply(offset(point, &-c)), &(c - a));
                add(offset(tilt.apply(turned), a), up)
            }
            Rotaries::HeadHead {
                rotary_to_tilt,
                tilt_to_spindle,
            } => {
                let spindle = offset(minus(up), tilt_to_spindle);
                let zero = offset(spindle, rotary_to_tilt);
                let swung = rotary.apply(offset(tilt.apply(spindle), rotary_to_tilt));
                let shift = add(zero, minus(swung));
                add(point, if back { minus(shift) } else { shift })
            }
            Rotaries::TableHead { rotary_point: c } => {
                let shift = add(tilt.apply(up), minus(up));
                if back {
                    offset(rotary.undo(offset(add(point, minus(shift)), &-c)), c)
                } else {
                    add(offset(rotary.apply(offset(point, &-c)), c), shift)
                }
            }
        }
    }

    /// Direction of the tool, from tip to spindle, in work coordinates at two programmed angles.
    #[must_use]
    pub fn tool_axis(&self, tilt_deg: f64, rotary_deg: f64) -> Vector3<f64> {
        let (t, r) = self.signs();
        let tilted = |angle| self.tilt.turn(Series::<1>::new([angle])).of(&Vector3::z());
        let turned = |angle, way| Turn::new(2, Series::<1>::new([angle])).of(&way);
        let (tilt, rotary) = (t * tilt_deg, r * rotary_deg);
        match self.rotaries {
            Rotaries::TableTable { .. } => turned(-rotary, tilted(-tilt)),
            Rotaries::HeadHead { .. } => turned(rotary, tilted(tilt)),
            Rotaries::TableHead { .. } => turned(-rotary, tilted(tilt)),
        }
    }

    /// The programmed angles (tilt, C) that give the tool a direction: of the two branches that
    /// next to `near_deg`, with C unwrapped to it. Along the rotary axis C stays as it is. None if the tool cannot
    /// lean so far.
    #[must_use]
    pub fn angles_deg(&self, tool_axis: &Vector3<f64>, near_deg: (f64, f64)) -> Option<(f64, f64)> {
        let branches = self.branches_deg(tool_axis, near_deg.1)?;
        let far =
            |(tilt, rotary): (f64, f64)| (tilt - near_deg.0).abs().max((rotary - near_deg.1).abs());
        Some(if far(branches[1]) < far(branches[0]) {
            branches[1]
        } else {
            branches[0]
        })
    }

    /// Both ways (tilt, C) to give the tool a direction, with C unwrapped to `near_rotary_deg`. Along
    /// the rotary axis, where every C will do, C stays as it is. None if the tool cannot lean so far, which is on
    /// machines with a skewed tilt axis alone; at the most that it leans, both are the same but for a turn of the
    /// tilt.
    #[must_use]
    pub fn branches_deg(
        &self,
        tool_axis: &Vector3<f64>,
        near_rotary_deg: f64,
    ) -> Option<[(f64, f64); 2]> {
        if let Tilt::Skewed(skewed) = &self.tilt {
            return self.skewed_branches_deg(skewed, tool_axis, near_rotary_deg);
        }
        let (t, r) = self.signs();
        let flat = tool_axis.x.hypot(tool_axis.y);
        let tilt = flat.atan2(tool_axis.z).to_degrees();
        if flat < POLE_R * tool_axis.norm() {
            return Some([(t * tilt, near_rotary_deg); 2]);
        }
        // Where a small positive tilt leans the tool at C = 0, and which way C then takes it.
        let lean = Self {
            tilt_reversed: false,
            ..*self
        }
        .tool_axis(90.0, 0.0);
        let heading = tool_axis.y.atan2(tool_axis.x) - lean.y.atan2(lean.x);
        let rotary = self.sense() * heading.to_degrees();
        Some([
            (t * tilt, unwrapped(r * rotary, near_rotary_deg)),
            (-t * tilt, unwrapped(r * (rotary + 180.0), near_rotary_deg)),
        ])
    }

    /// Which way C turns the tool against the work.
    const fn sense(&self) -> f64 {
        match self.rotaries {
            Rotaries::HeadHead { .. } => 1.0,
            Rotaries::TableTable { .. } | Rotaries::TableHead { .. } => -1.0,
        }
    }

    /// [`branches_deg`](Self::branches_deg) of a tilt axis that is skewed: the tilt leans the tool to the direction's
    /// height, one way or the other, and C turns it to its heading from where that took it.
    fn skewed_branches_deg(
        &self,
        skewed: &SkewedTilt,
        tool_axis: &Vector3<f64>,
        near_rotary_deg: f64,
    ) -> Option<[(f64, f64); 2]> {
        let (t, r) = self.signs();
        let way = tool_axis.normalize();
        let tilt = skewed.angle_deg(&way)?;
        let is_pole = way.x.hypot(way.y) < POLE_R;
        Some([tilt, -tilt].map(|tilt| {
            let programmed = t * tilt;
            if is_pole {
                return (programmed, near_rotary_deg);
            }
            let lean = self.tool_axis(programmed, 0.0);
            let heading = way.y.atan2(way.x) - lean.y.atan2(lean.x);
            let rotary = r * self.sense() * heading.to_degrees();
            (programmed, unwrapped(rotary, near_rotary_deg))
        }))
    }
}

/// The angle with as many turns as bring it next to another, degrees.
fn unwrapped(angle_deg: f64, near_deg: f64) -> f64 {
    angle_deg + 360.0 * ((near_deg - angle_deg) / 360.0).round()
}

impl Kinematics for FiveAxis {
    fn joints(&self) -> usize {
        5
    }

    fn inverse_series<const N: usize, T: Number>(
        &self,
        axes: &AxisSeries<N, T>,
    ) -> Result<JointSeries<N, T>, KinematicsError> {
        let (tilt, rotary) = (axes[self.tilt_axis().index()], axes[Axis::C.index()]);
        let [x, y, z] = self.linear([axes[0], axes[1], axes[2]], tilt, rotary, false);
        let mut joints = [Series::constant(0.0); JOINTS];
        joints[..5].copy_from_slice(&[x, y, z, tilt, rotary]);
        Ok(joints)
    }

    fn forward(
        &self,
        joints: &JointVector,
        _near: &AxisVector,
    ) -> Result<AxisVector, KinematicsError> {
        let [x, y, z, tilt, rotary] = core::array::from_fn(|i| Series::<1>::constant(joints[i]));
        let tip = self.linear([x, y, z], tilt, rotary, true);
        let mut axes = AxisVector::zeros();
        for (i, coordinate) in tip.into_iter().enumerate() {
            axes[i] = coordinate.value();
        }
        axes[self.tilt_axis().index()] = joints[3];
        axes[Axis::C.index()] = joints[4];
        Ok(axes)
    }

    fn conditioning(&self, _axes: &AxisVector) -> Result<Conditioning, KinematicsError> {
        // At fixed angles the linear joints move as the tip does, only turned.
        Ok(Conditioning::PERFECT)
    }
}
