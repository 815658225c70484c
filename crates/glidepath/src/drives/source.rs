//! Where in `drives.toml` each device and each of its inputs and outputs is, so that what the bus refuses
//! is told by its place there.

use crate::config::{ConfigDiagnostic, ConfigError};
use core::ops::Range as Span;
use glidepath_ethercat::{BusError, RefusedPart};

/// The file, and the place of each table in it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DrivesSource {
    pub(super) path: String,
    pub(super) text: String,
    pub(super) places: Vec<Place>,
}

/// The place of a table, or of an input or output in it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Place {
    pub(super) part: RefusedPart,
    pub(super) span: Span<usize>,
}

impl DrivesSource {
    /// What the bus refuses, as something to mend in the file; `None` if it is not about what is there.
    #[must_use]
    pub fn refusal(&self, error: &BusError) -> Option<ConfigError> {
        let part = error.refused_part()?;
        let of = |part: RefusedPart| self.places.iter().find(move |place| place.part == part);
        let place = of(part).or_else(|| of(part.of_device()))?;
        Some(ConfigError::Refused {
            path: self.path.clone(),
            text: self.text.clone(),
            diagnostics: vec![ConfigDiagnostic {
                key: "device".to_owned(),
                message: error.to_string(),
                help: None,
                span: Some(place.span.clone()),
            }],
        })
    }
}
