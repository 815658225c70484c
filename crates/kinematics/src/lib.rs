//! From the axes of a program to the joints of a mechanism and back.
//!
//! A program speaks of the tool: X Y Z of its tip, A B C of its orientation. A drive moves a *joint*:
//! the length of a strut, the height of a carriage, the angle of a table. This crate holds the maps
//! between the two, one file for each mechanism, all behind one trait, [`Kinematics`].
//!
//! ```text
//!   axes x(t) ──inverse──▶ joints q(t)        every tick: bounded, without allocation
//!   joints q  ──forward──▶ axes x             for status and tests: closed form or bounded Newton
//! ```
//!
//! **Rates are exact.** An inverse is written once, for [`Series`](glidepath_geometry::number::Series):
//! truncated Taylor series. Fed with positions it gives positions; fed with position, velocity and
//! acceleration along time it gives q, q̇ = J ẋ and q̈ = J ẍ + J̇ ẋ without J ever being formed; fed
//! with unit directions it gives the columns of J. One formula, nothing to keep in step with it.
//!
//! Lengths are in mm, angles in degrees at interfaces and radians inside. Joints that a mechanism
//! does not have are zero. Axes that a mechanism does not use are ignored.

mod axes;
mod axis_share;
mod core_xy;
mod error;
mod five_axis;
mod hexapod;
mod joint_limits;
mod linear_delta;
mod machine;
mod mechanism;
mod path_caps;
mod rotary_delta;
mod scara;
mod space;
mod speed_caps;
mod translational;
mod trivial;
mod watch;

pub use axes::AxisList;
pub use axis_share::{AxisRates, AxisShare};
pub use core_xy::CoreXy;
pub use error::KinematicsError;
pub use five_axis::{FiveAxis, Rotaries, Tilt};
pub use hexapod::{Guards, Hexapod};
pub use joint_limits::{JointLimit, JointLimits, JointViolation, Quantity};
pub use linear_delta::LinearDelta;
pub use machine::{
    AxisSeries, Conditioning, JOINTS, JointMotion, JointSeries, JointVector, Kinematics,
    axis_series,
};
pub use mechanism::Mechanism;
pub use path_caps::{Heading, PathCaps, PlaceCaps};
pub use rotary_delta::RotaryDelta;
pub use scara::{Elbow, Scara};
pub use speed_caps::{PathRates, SpeedCaps};
pub use translational::TranslationalHexapod;
pub use trivial::Trivial;
pub use watch::{JointFault, JointWatch};
