//! `[stops]`: what stops spindle and coolant together with the motion.

use crate::config::raw::{Optional, RawStops};
use glidepath_interpolator::StopSettings;

/// The settings of a table.
pub(super) fn stopped(raw: &RawStops) -> StopSettings {
    let flag = |value: &Optional<bool>| value.as_ref().is_none_or(|value| *value.get_ref());
    StopSettings {
        abort: flag(&raw.abort),
        fault: flag(&raw.fault),
        disable: flag(&raw.disable),
    }
}
