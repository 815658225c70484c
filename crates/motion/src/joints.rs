//! The joints of a mechanism as planning sees them, where they are not the axes.
//!
//! What joints do where the axes go, only the mechanism knows. So whoever knows it implements
//! [`Joints`]. Along a path that is given their limits are kept like those of the axes, at every place
//! ([`JointRows`]). In the tube a window keeps velocity, acceleration and jerk of joints as rows of its problem,
//! which are exact to first order about the last motion ([`JointsOnCurve`]), and no motion is taken that they
//! cannot follow, by differences. Where no such window is found, the motion goes straight to the next vertex, at
//! what joints leave along that.

use core::fmt;
use glidepath_geometry::{AXES, AxisVector, DerivativeBounds, Jet};
use glidepath_program::{Limits, PathBounds, Travel};
use std::sync::Arc;

/// The joints of a mechanism, seen from its axes.
pub trait Joints: fmt::Debug + Send + Sync {
    /// The joints at a place of a curve of the axes in time, from its position (mm, degrees) and first three
    /// derivatives there. `None` where the mechanism cannot be.
    fn at(&self, curve: &[AxisVector; 4]) -> Option<JointsOnCurve>;

    /// True if every joint keeps its limits on the way to the first of four positions that are a
    /// period (s) apart, the newest first.
    fn allow(&self, positions: &[AxisVector; 4], period_t: f64) -> bool;

    /// The joints along a path, J0 first: where they are and their first three derivatives by its
    /// position, from those of the axes. `None` where the mechanism cannot be.
    fn along(&self, path: &Jet) -> Option<Jet>;

    /// Velocity (mm/s, °/s), acceleration and jerk of the joints that a plan may use, J0 first;
    /// [`Limits::UNLIMITED`] where there is no limit.
    fn limits(&self) -> [AxisVector; 3];
}

/// The joints at a place of a curve of the axes, and how they change if the curve does.
#[derive(Debug, Clone, PartialEq)]
pub struct JointsOnCurve {
    /// Positions of the joints (mm, degrees) and their first three derivatives by time, J0 first.
    pub derivatives: [AxisVector; 4],
    /// The Jacobian along the curve, as Taylor coefficients by time: of each order, the derivatives of every
    /// joint by all axes.
    pub jacobian: [[AxisVector; AXES]; 4],
}

/// Acceleration and jerk that every joint leaves each axis at a place if the others stand: about what the axes can
/// do there. `None` where the mechanism cannot be.
pub(crate) fn alone(joints: &dyn Joints, position: &AxisVector) -> Option<[AxisVector; 2]> {
    let rest = AxisVector::zeros();
    let here = joints.at(&[*position, rest, rest, rest])?;
    let [_, acceleration, jerk] = joints.limits();
    let [rows, ..] = &here.jacobian;
    Some([acceleration, jerk].map(|limits| {
        AxisVector::from_fn(|axis, _| {
            let most = (0..AXES).map(|joint| limits[joint] / rows[joint][axis].abs());
            most.fold(Limits::UNLIMITED, f64::min)
        })
    }))
}

/// The joints that limit a motion, if they do so beside the axes.
pub(crate) type SharedJoints = Option<Arc<dyn Joints>>;

/// The joints as limits along a path: what axes are there, with the derivatives of joints in place of
/// those of axes.
#[derive(Debug, Clone)]
pub(crate) struct JointRows {
    joints: Arc<dyn Joints>,
    /// Of the joints, J0 in the place of X and so on, and along the path.
    pub(crate) limits: Limits,
}

impl JointRows {
    /// Those of a machine with these limits along the path.
    pub(crate) fn new(joints: Arc<dyn Joints>, path: PathBounds) -> Self {
        let [velocity, acceleration, jerk] = joints.limits();
        Self {
            joints,
            limits: Limits {
                velocity,
                acceleration,
                jerk,
                path,
                travel: Travel::unlimited(),
            },
        }
    }

    /// The joints where the path has these derivatives. `None` where the mechanism cannot be.
    pub(crate) fn along(&self, path: &Jet) -> Option<Jet> {
        self.joints.along(path)
    }

    /// Bounds of the joints' derivatives along a part of a path, from so many steps along it: the
    /// largest at the places, and half of what changes between two of them for what is between. With them by which
    /// factor the joint that is worst off moves faster at one place than at another.
    pub(crate) fn bounds(
        &self,
        steps: u32,
        jet_at: impl Fn(f64) -> Jet,
    ) -> Option<(DerivativeBounds, f64)> {
        let mut before = self.along(&jet_at(0.0))?;
        let mut most = [before.d1.abs(), before.d2.abs(), before.d3.abs()];
        let mut change = [AxisVector::zeros(); 3];
        let worst = |jet: &Jet| jet.d1.component_div(&self.limits.jerk).amax();
        let (mut least, mut greatest) = (worst(&before), worst(&before));
        for step in 1..=steps {
            let here = self.along(&jet_at(f64::from(step) / f64::from(steps)))?;
            let derivatives = [
                (here.d1, before.d1),
                (here.d2, before.d2),
                (here.d3, before.d3),
            ];
            for ((most, change), (here, before)) in
                most.iter_mut().zip(&mut change).zip(derivatives)
            {
                *most = most.sup(&here.abs());
                *change = change.sup(&(here - before).abs());
            }
            before = here;
            (least, greatest) = (least.min(worst(&here)), greatest.max(worst(&here)));
        }
        let [d1, d2, d3] = [0, 1, 2].map(|k| most[k] + change[k] * 0.5);
        Some((DerivativeBounds { d1, d2, d3 }, greatest / least))
    }
}

/// What limits a motion along a path: axes, and joints where these are others.
#[derive(Debug, Clone)]
pub(crate) struct MachineLimits {
    pub(crate) axes: Limits,
    pub(crate) joints: Option<JointRows>,
}

impl MachineLimits {
    /// Of a machine whose joints are its axes.
    pub(crate) const fn of_axes(axes: Limits) -> Self {
        Self { axes, joints: None }
    }

    /// The same with joints beside the axes.
    pub(crate) fn with_joints(self, joints: SharedJoints) -> Self {
        let path = self.axes.path;
        Self {
            joints: joints.map(|joints| JointRows::new(joints, path)),
            ..self
        }
    }
}
