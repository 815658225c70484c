//! S-curves along pieces of path, from one given speed to another.

mod course;
mod limit_boosting;
mod run;
mod valley_first;

pub(crate) use course::{Course, Leg};
pub(crate) use limit_boosting::{boost_leg, boost_limits, drive_together};
pub(crate) use run::Run;
