//! The touch probes of drives (CiA 402): each drive keeps where its joint was at an edge of the probe, to
//! the count, where a frame tells it a period later.
//!
//! ```text
//!  Off ──off is seen──► Arming ──on is seen──► Armed ──an edge, told or not──► Off
//! ```
//!
//! A unit keeps the first edge and no later one, so it is off and on again after each. It is on long before
//! a search begins, and what comes while it is not is left to the samples of the joints, as without drives
//! that can do this.
//!
//! While a joint looks for the index pulse of its encoder, its unit is lent for that, and keeps the zero impulse.

mod index;
mod plausible;
mod probing;
mod settings;
mod unit;

pub(crate) use index::IndexSearches;
pub(crate) use probing::{Probing, Seen};
pub use settings::{ProbeUse, TouchProbe};
pub use unit::ProbeInputs;
