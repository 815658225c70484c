//! The way back to the path: beside it first, and the tool axis last.

use glidepath_geometry::{Axis, AxisVector};

/// The places that are left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WayBack {
    beside: Option<AxisVector>,
    path: Option<AxisVector>,
}

impl WayBack {
    pub(super) const NONE: Self = Self {
        beside: None,
        path: None,
    };

    /// From a position to where the path was left.
    pub(super) fn to(path: &AxisVector, from: &AxisVector, tool_axis: Axis) -> Self {
        let mut beside = *path;
        let tool = tool_axis.index();
        if let (Some(slot), Some(now)) = (beside.get_mut(tool), from.get(tool)) {
            *slot = *now;
        }
        Self {
            beside: Some(beside),
            path: Some(*path),
        }
    }

    /// Whether no place is left.
    pub(super) const fn is_done(&self) -> bool {
        matches!((&self.beside, &self.path), (None, None))
    }

    /// The place to head for.
    pub(super) const fn next(&self) -> Option<AxisVector> {
        match self.beside {
            Some(place) => Some(place),
            None => self.path,
        }
    }

    /// The axes rest at a position. Places are reached to the bit.
    pub(super) fn reach(&mut self, position: &AxisVector) {
        if self.beside.is_some_and(|place| place == *position) {
            self.beside = None;
        }
        if self.path == Some(*position) && self.beside.is_none() {
            self.path = None;
        }
    }
}
