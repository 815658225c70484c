//! The publishing of frames: onto the link, paced, and each job under its claim on the machine.
//!
//! * `frame_publisher` owns what speaks to the interpolator. It hands frames on, no further ahead of the machine than its
//!   pace says, and says how far they are.
//! * `claim` is the job that the interpolator was told of, and `claiming` the work on it while the job is prepared.
//! * `epoch` are the books of one epoch, and `epochs` is a program of several, one more behind each probing move.
//!
//! It may know `exchange`, `plan`, `source` and `run`. Who wants a program executed it knows by a trait.

pub(crate) mod claim;
pub(crate) mod claiming;
pub(crate) mod epoch;
pub(crate) mod epochs;
pub(crate) mod frame_publisher;
