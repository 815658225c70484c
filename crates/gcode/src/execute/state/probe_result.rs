//! The last probing move: what it searches for, and what it found.

use glidepath_geometry::AxisVector;
use serde::{Deserialize, Serialize};

use crate::diagnostic::span::SourceSpan;
use crate::syntax::modes::Probe;

/// The result of the last probing move, as `#5061` to `#5070` show it.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct ProbeResult {
    /// Program coordinates of the contact, mm and degrees.
    pub(crate) contact: AxisVector,
    /// True if the last probing move made contact.
    pub(crate) made: bool,
}

/// The end of a probing move, in machine coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probed {
    /// Where the axes were when the probe found what it looked for; `None` if it did not.
    pub contact: Option<AxisVector>,
    /// It was so before anything moved.
    pub was_so: bool,
    /// Where the machine came to rest.
    pub stands: AxisVector,
}

/// A probing move whose end is not known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Search {
    pub(crate) probe: Probe,
    pub(crate) span: SourceSpan,
}
