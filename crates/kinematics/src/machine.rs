//! The trait of every mechanism (axes to joints and back, conditioning, admission), and its
//! vectors.

use crate::KinematicsError;
use glidepath_geometry::number::{Number, Series};
use glidepath_geometry::{AXES, Axis, AxisVector};
use nalgebra::{SMatrix, SVector};

/// Most joints a mechanism has: those a setpoint has room for.
pub const JOINTS: usize = 9;

/// One value per joint, mm or degrees (and their time derivatives); 0 beyond the mechanism's
/// joints.
pub type JointVector = SVector<f64, JOINTS>;

/// The nine axes along one parameter.
pub type AxisSeries<const N: usize, T = f64> = [Series<N, T>; AXES];

/// The joints along one parameter.
pub type JointSeries<const N: usize, T = f64> = [Series<N, T>; JOINTS];

/// Joints with their first two derivatives by time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointMotion {
    /// mm or degrees.
    pub position: JointVector,
    /// mm/s or °/s.
    pub velocity: JointVector,
    /// mm/s² or °/s².
    pub acceleration: JointVector,
}

/// The conditioning of a pose, which says how well the joints hold the tool: singular values of the
/// Jacobian ∂q/∂x, in which rotations are divided by a length of the mechanism so that all its
/// entries are pure numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conditioning {
    /// Largest over smallest; infinite at a singularity.
    pub condition: f64,
    /// The smallest.
    pub smallest: f64,
}

impl Conditioning {
    /// Of a mechanism whose joints are lengths along orthogonal directions, or as good.
    pub const PERFECT: Self = Self {
        condition: 1.0,
        smallest: 1.0,
    };

    /// From the singular values of a scaled Jacobian.
    pub(crate) fn of(singular_values: &[f64]) -> Self {
        let largest = singular_values.iter().copied().fold(0.0, f64::max);
        let smallest = singular_values.iter().copied().fold(largest, f64::min);
        Self {
            condition: largest / smallest,
            smallest,
        }
    }
}

/// A mechanism: the map from axes to joints, its inverse, and where it must not go.
pub trait Kinematics {
    /// Number of joints, 1 to [`JOINTS`].
    fn joints(&self) -> usize;

    /// Joints along any curve of the axes (mm, degrees), as truncated Taylor series, of whatever the
    /// axes are series of: of numbers that carry derivatives it gives the derivatives of the joints.
    ///
    /// Bounded work, no allocation.
    ///
    /// # Errors
    /// A position out of reach.
    fn inverse_series<const N: usize, T: Number>(
        &self,
        axes: &AxisSeries<N, T>,
    ) -> Result<JointSeries<N, T>, KinematicsError>;

    /// The position of the axes that belongs to joints. Where there are several, the one next to
    /// `near`, which should be the last known position. Axes the mechanism does not use are zero.
    ///
    /// Bounded work, no allocation.
    ///
    /// # Errors
    /// No position fits, or none was found.
    fn forward(
        &self,
        joints: &JointVector,
        near: &AxisVector,
    ) -> Result<AxisVector, KinematicsError>;

    /// How well the joints hold the tool at a position.
    ///
    /// # Errors
    /// A position out of reach.
    fn conditioning(&self, axes: &AxisVector) -> Result<Conditioning, KinematicsError>;

    /// Whether the mechanism may go to a position: in reach, far from singularities, and inside
    /// whatever else its build allows. Ranges of single joints are judged by
    /// [`JointLimits`](crate::JointLimits).
    ///
    /// # Errors
    /// What forbids the position.
    fn admit(&self, axes: &AxisVector) -> Result<(), KinematicsError> {
        let Conditioning { condition, .. } = self.conditioning(axes)?;
        // Not a number is no condition either.
        if condition < MAX_CONDITION {
            Ok(())
        } else {
            Err(KinematicsError::Singular { condition })
        }
    }

    /// Joints at a position.
    ///
    /// # Errors
    /// A position out of reach.
    fn inverse(&self, axes: &AxisVector) -> Result<JointVector, KinematicsError> {
        let series = core::array::from_fn(|i| Series::<1>::new([axes[i]]));
        let joints = self.inverse_series(&series)?;
        Ok(JointVector::from_fn(|i, _| joints[i].value()))
    }

    /// Joints at a position that the mechanism may go to: [`admit`](Self::admit) and
    /// [`inverse`](Self::inverse) at once, where they have work in common.
    ///
    /// # Errors
    /// What forbids the position.
    fn admitted(&self, axes: &AxisVector) -> Result<JointVector, KinematicsError> {
        self.admit(axes)?;
        self.inverse(axes)
    }

    /// Joints with rates and accelerations at one moment of a motion.
    ///
    /// # Errors
    /// A position out of reach.
    fn motion(
        &self,
        position: &AxisVector,
        velocity: &AxisVector,
        acceleration: &AxisVector,
    ) -> Result<JointMotion, KinematicsError> {
        let series = axis_series::<3>(&[*position, *velocity, *acceleration]);
        let joints = self.inverse_series(&series)?;
        let derivative = |k| JointVector::from_fn(|i, _| joints[i].derivative(k));
        Ok(JointMotion {
            position: derivative(0),
            velocity: derivative(1),
            acceleration: derivative(2),
        })
    }

    /// Derivative of every joint by every axis (per mm, per degree).
    ///
    /// # Errors
    /// A position out of reach.
    fn jacobian(&self, axes: &AxisVector) -> Result<SMatrix<f64, JOINTS, AXES>, KinematicsError> {
        let mut jacobian = SMatrix::zeros();
        for axis in Axis::ALL {
            let mut direction = AxisVector::zeros();
            direction[axis.index()] = 1.0;
            let joints = self.inverse_series(&axis_series::<2>(&[*axes, direction]))?;
            for (row, joint) in joints.iter().enumerate() {
                jacobian[(row, axis.index())] = joint.derivative(1);
            }
        }
        Ok(jacobian)
    }
}

/// Largest condition of the scaled Jacobian at which a mechanism is moved.
pub(crate) const MAX_CONDITION: f64 = 100.0;

/// Axes along a parameter from position and derivatives; those that are not given are zero.
#[must_use]
pub fn axis_series<const N: usize>(derivatives: &[AxisVector]) -> AxisSeries<N> {
    let mut reciprocal = 1.0;
    let mut coefficients = [[0.0; N]; AXES];
    for (k, derivative) in derivatives.iter().take(N).enumerate() {
        if k > 1 {
            #[allow(clippy::cast_precision_loss, reason = "a handful of coefficients")]
            let order = k as f64;
            reciprocal /= order;
        }
        for (axis, values) in coefficients.iter_mut().enumerate() {
            values[k] = derivative[axis] * reciprocal;
        }
    }
    coefficients.map(Series::new)
}
