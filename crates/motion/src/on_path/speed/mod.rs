//! S-curves along pieces of path, from one given speed to another.

mod limit_boosting;
mod piece_sequence;
mod run;
mod valley_first;

pub(crate) use limit_boosting::{boost_leg, boost_limits, drive_together};
pub(crate) use piece_sequence::{Leg, PieceSequence};
pub(crate) use run::Run;
