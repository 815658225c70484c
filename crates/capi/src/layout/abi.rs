//! The version of the ABI, and all structures that it is about.

use super::structure::Structure;
use super::{demands, digest, own, records};

/// The version of the ABI: functions and structures. It rises with every change of either.
pub(crate) const ABI: u32 = 12;

/// All structures, each after those it is made of.
pub(super) const STRUCTURES: &[&Structure] = &[
    &records::QUANTILES,
    &records::EVENT_ID,
    &records::CODE_WORDS,
    &records::LATCH,
    &records::EVENT,
    &records::SETPOINT,
    &records::STATUS,
    &records::FEEDBACK,
    &records::REPLY,
    &demands::JOG,
    &demands::SEGMENT,
    &demands::SEGMENT_REPLY,
    &own::JOINT,
    &own::STOP_LIMITS,
    &own::JUMP_LIMITS,
    &own::SERVO_SETTINGS,
    &own::JUMP,
    &own::SERVO_STATE,
];

/// A number that changes with every name, type, offset and size of a structure.
pub(crate) const LAYOUT: u64 = digest::digest(STRUCTURES);

/// The library is not built beside a header that describes another one. Tests are: one of them
/// writes the header.
#[cfg(not(test))]
const _: () = {
    const HEADER: &[u8] = include_bytes!("../../include/glidepath.h");
    assert!(
        digest::hexadecimal_after(HEADER, b"#define GP_LAYOUT UINT64_C(0x") == LAYOUT,
        "include/glidepath.h describes other structures: after a new version of the ABI, write it \
         with GLIDEPATH_BLESS=1 cargo test -p glidepath-capi --lib"
    );
};
