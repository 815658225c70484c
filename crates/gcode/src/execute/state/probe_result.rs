//! What the last probing move found.

use glidepath_geometry::AxisVector;

/// What `#5061` to `#5070` show.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct ProbeResult {
    /// Program coordinates of the contact, mm and degrees.
    pub(crate) contact: AxisVector,
    /// True if the last probing move made contact.
    pub(crate) made: bool,
}
