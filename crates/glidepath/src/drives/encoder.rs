//! The judgement of the spindle's encoder.

use super::raw_device::RawEncoder;
use super::spindle::{NEAR, NEAR_R};
use crate::config::Judge;
use glidepath_ethercat::EncoderSettings;

/// Judges the encoder of the spindle.
pub(super) fn encoder(judge: &mut Judge, raw: &RawEncoder) -> Option<EncoderSettings> {
    let help = "counts of a revolution: four times the lines of the encoder";
    let key = "device.encoder.counts_per_rev";
    let counts_per_rev = judge.whole(key, &raw.counts_per_rev, (4, 100_000_000), help);
    Some(EncoderSettings {
        near_r: judge.number_or("device.encoder.at_speed", &raw.at_speed, &NEAR, NEAR_R),
        counts_per_rev: counts_per_rev?,
        has_index: raw.index,
        is_inverted: raw.invert,
    })
}
