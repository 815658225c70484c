//! The errors of calibration: why points give no dimensions.

use crate::KinematicsError;
use thiserror::Error;

/// The reason why points give no dimensions.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum CalibrationError {
    /// The joints are the axes, or nearly.
    #[error("the mechanism has no dimensions that points could tell")]
    NoDimensions,
    /// There are fewer numbers than dimensions.
    #[error("{numbers} measured numbers cannot tell {dimensions} dimensions")]
    TooFew {
        /// How many numbers were measured.
        numbers: usize,
        /// How many dimensions are looked for.
        dimensions: usize,
    },
    /// No place of the tool fits the joints of a point, with nominal dimensions.
    #[error(
        "with the dimensions of the configuration no position of the tool fits these joints: {error}"
    )]
    Unreachable {
        /// The point, from 0.
        point: usize,
        /// Why.
        error: KinematicsError,
    },
    /// The points tell none of the dimensions.
    #[error("the points tell none of the dimensions")]
    NothingTold,
    /// The search did not come to an end.
    #[error("no dimensions were found that fit: the search did not settle")]
    NotSettled,
}
