//! The coolant state: what the program has switched on.

use serde::{Deserialize, Serialize};

/// What the coolant was told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(crate) struct Coolant {
    /// M7.
    pub(crate) mist: bool,
    /// M8.
    pub(crate) flood: bool,
}
