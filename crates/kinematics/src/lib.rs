//! The maps from the axes of a program to the joints of a mechanism and back.
//!
//! A program speaks of the tool: X Y Z of its tip, A B C of its orientation. A drive moves a
//! *joint*: the length of a strut, the height of a carriage, the angle of a table. This crate
//! holds the maps between the two, one file for each mechanism, all behind one trait,
//! [`Kinematics`].
//!
//! ```text
//!   axes x(t) ──inverse──▶ joints q(t)        every tick: bounded, without allocation
//!   joints q  ──forward──▶ axes x             for status and tests: closed form or bounded Newton
//! ```
//!
//! **Rates are exact.** An inverse is written once, for
//! [`Series`](glidepath_geometry::number::Series): truncated Taylor series. Fed with positions it
//! gives positions; fed with position, velocity and acceleration along time it gives q, q̇ = J ẋ
//! and q̈ = J ẍ + J̇ ẋ without J ever being formed; fed with unit directions it gives the columns
//! of J. Fed with series of numbers that carry partial derivatives it gives J as it changes along the
//! curve ([`CurveRates`]). One formula, nothing to keep in step with it.
//!
//! In the pipeline it is met in three places: the configuration builds a [`Mechanism`] with its
//! [`JointLimits`] (both together a [`LimitedMechanism`]); the planner keeps these along a path by the exact rates
//! of joints ([`PathRates`]), beside it by how they change with a curve ([`CurveRates`]), and judges each plan ([`JointWatch`]); the interpolator maps every setpoint to joints. The mechanisms are [`Trivial`], [`CoreXy`], [`LinearDelta`],
//! [`RotaryDelta`], [`Scara`], [`FiveBar`], [`FiveAxis`], [`Hexapod`] and [`TranslationalHexapod`].
//!
//! The dimensions of a mechanism can be found from points that were measured: [`calibrate`].
//!
//! What always holds:
//!
//! * Lengths are in mm, angles in degrees at interfaces and radians inside.
//! * Joints that a mechanism does not have are zero. Axes that a mechanism does not use are
//!   ignored.
//! * Evaluation takes bounded time and does not allocate, so the real-time thread may do it.
//! * A position that is out of reach or too near a singularity is refused, never approximated.
//!
//! ```
//! use glidepath_geometry::{Axis, AxisVector};
//! use glidepath_kinematics::{Kinematics as _, LinearDelta};
//!
//! let axes = [Axis::X, Axis::Y, Axis::Z];
//! let delta = LinearDelta::new(269.0, 130.25, [90.0, 210.0, 330.0], &axes);
//! let mut tool = AxisVector::zeros();
//! (tool[0], tool[2]) = (40.0, 12.0); // mm
//! let joints = delta.inverse(&tool)?;
//! let back = delta.forward(&joints, &tool)?;
//! assert!((back - tool).amax() < 1e-9);
//!
//! tool[0] = 500.0;
//! assert!(delta.admit(&tool).is_err());
//! # Ok::<(), glidepath_kinematics::KinematicsError>(())
//! ```

mod axes;
mod axis_share;
mod calibration;
mod compensation;
mod core_xy;
mod cross_compensation;
mod curve_rates;
mod direction_gain;
mod error;
mod five_axis;
mod five_bar;
mod hexapod;
mod joint_limits;
mod limited_mechanism;
mod linear_delta;
mod machine;
mod mechanism;
mod rotary_delta;
mod scara;
mod space;
mod speed_caps;
mod tilt;
mod translational;
mod trivial;
mod watch;

pub use axes::AxisList;
pub use axis_share::{AloneLimits, AxisRates, AxisShare};
pub use calibration::{
    Calibration, CalibrationError, CalibrationSettings, DimensionName, DimensionPart, DimensionSum,
    DimensionUnit, FoundDimension, MeasuredPoint, MeasuringAccuracy, PointResiduals, ResidualSize,
    calibrate, dimension_names,
};
pub use compensation::{
    CompensationError, CompensationPoint, JointCompensation, MOST_POINTS, TAKE_UP,
};
pub use core_xy::CoreXy;
pub use cross_compensation::{CrossCompensation, CrossTable};
pub use curve_rates::CurveRates;
pub use error::KinematicsError;
pub use five_axis::{FiveAxis, Rotaries};
pub use five_bar::FiveBar;
pub use hexapod::{Guards, Hexapod};
pub use joint_limits::{JointLimit, JointLimits, JointViolation, Quantity};
pub use limited_mechanism::LimitedMechanism;
pub use linear_delta::LinearDelta;
pub use machine::{
    AxisSeries, Conditioning, JOINTS, JointMotion, JointSeries, JointVector, Kinematics,
    axis_series,
};
pub use mechanism::Mechanism;
pub use rotary_delta::RotaryDelta;
pub use scara::{Elbow, Scara};
pub use speed_caps::{PathRates, SpeedCaps};
pub use tilt::{SkewedTilt, Tilt};
pub use translational::TranslationalHexapod;
pub use trivial::Trivial;
pub use watch::{JointFault, JointWatch};
