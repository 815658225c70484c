//! The places and states that a printer's program keeps by number or name.

use std::collections::BTreeMap;

use glidepath_geometry::AxisVector;

use crate::execute::state::extruder::ExtruderMode;
use crate::execute::state::modal::Modal;

/// A place that G60 kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct KeptPlace {
    /// Machine coordinates.
    pub(crate) place: AxisVector,
    /// Program coordinate of the extruder, mm.
    pub(crate) extruder_mm: f64,
}

/// What SAVE_GCODE_STATE kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct KeptState {
    pub(crate) modal: Modal,
    pub(crate) extruder: ExtruderMode,
    pub(crate) shift: AxisVector,
    pub(crate) gcode_offset: [f64; 3],
    /// Machine coordinates.
    pub(crate) place: AxisVector,
}

/// What a printer's program has kept.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct KeptByPrinter {
    /// By the number of G60.
    pub(crate) places: BTreeMap<u32, KeptPlace>,
    /// By the name of SAVE_GCODE_STATE.
    pub(crate) states: BTreeMap<Vec<u8>, KeptState>,
}
