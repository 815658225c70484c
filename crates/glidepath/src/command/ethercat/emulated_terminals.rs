//! Emulated devices that are no drives: each has what the file names, and nothing to set.

use glidepath_emulator::{Channels, ClockKind, DriveSettings as Emulated};
use glidepath_ethercat::{At, TerminalSettings};

/// Bits of an entry at most.
const MOST_BITS: u32 = 248;
/// Counts of a number of 16 bits.
const SHORT: u32 = 0xffff;

/// A device that has what a file names.
pub(super) fn emulated(settings: &TerminalSettings) -> Emulated {
    let digital = settings.inputs.iter().map(|input| input.at);
    let analog = settings.analog_inputs.iter().map(|input| (input.at, 16));
    let inputs = maps(digital.collect(), analog.collect());
    let digital = settings.outputs.iter().map(|output| output.at);
    let analog = settings.analog_outputs.iter().map(|output| {
        let bits = if output.full_counts > SHORT { 32 } else { 16 };
        (output.at, bits)
    });
    let outputs = maps(digital.collect(), analog.collect());
    let like = Emulated::terminal("EMULATED", ClockKind::ReceiveTimes);
    let or = |id: u32, other: u32| if id == 0 { other } else { id };
    let [vendor, product, revision, serial] = like.identity;
    Emulated {
        identity: [
            or(settings.vendor, vendor),
            or(settings.product, product),
            revision,
            serial,
        ],
        channels: Some(Channels {
            output_windows: 1,
            outputs,
            inputs,
            assigned: None,
        }),
        ..like
    }
}

/// The settings without what an emulated device does not have: other maps, and parameters.
pub(super) fn plain(settings: &TerminalSettings) -> TerminalSettings {
    TerminalSettings {
        parameters: Vec::new(),
        assign_outputs: None,
        assign_inputs: None,
        ..settings.clone()
    }
}

/// Bits without a name.
fn gap(entries: &mut Vec<u32>, bits: u32) {
    entries.extend((0..bits / MOST_BITS).map(|_| MOST_BITS));
    entries.extend(Some(bits % MOST_BITS).filter(|rest| *rest > 0));
}

/// One map: bits that have no name, bits that have, and numbers where a byte begins.
fn maps(digital: Vec<At>, analog: Vec<(At, u32)>) -> Vec<Vec<u32>> {
    let nameless = digital.iter().filter_map(|at| match at {
        At::Bit(bit) => Some(bit + 1),
        At::Object { .. } => None,
    });
    let mut bits = nameless.max().unwrap_or(0);
    let mut entries = Vec::new();
    gap(&mut entries, bits);
    let of = |at: At, bits: u32| match at {
        At::Object { index, sub } => Some(u32::from(index) << 16 | u32::from(sub) << 8 | bits),
        At::Bit(_) => None,
    };
    for at in digital {
        let entry = of(at, 1).filter(|entry| !entries.contains(entry));
        bits += u32::from(entry.is_some());
        entries.extend(entry);
    }
    gap(&mut entries, bits.next_multiple_of(8) - bits);
    entries.extend(analog.into_iter().filter_map(|(at, bits)| of(at, bits)));
    if entries.is_empty() {
        Vec::new()
    } else {
        vec![entries]
    }
}
