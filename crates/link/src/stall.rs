//! How late a look is that says that its process stood still.

use std::time::Duration;

/// A process that looks for what others ask later than it meant to, by more than this, stood still. What it hears
/// then may have waited since, so nothing begins to move by it. Busy hosts are late by less.
pub const STALL: Duration = Duration::from_millis(500);
