//! Numbered parameters that outlast a restart of the control.

use std::collections::BTreeMap;

/// The first and the last of them: those that FANUC keeps. A program of any language may assign them.
pub const KEPT_VARIABLES: core::ops::RangeInclusive<u32> = 500..=999;

/// What is in those parameters that something was assigned to, by number.
pub type KeptVariables = BTreeMap<u32, f64>;
