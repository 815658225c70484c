//! The fingerprints of a machine, to which its coordinates belong, and of files.

use crate::config::MachineConfig;
use core::hash::Hasher as _;
use twox_hash::XxHash64;

/// A number that a machine with other axes or other kinematics does not have. Limits and dimensions
/// may change without making coordinates meaningless.
pub(crate) fn fingerprint(config: &MachineConfig) -> u64 {
    let mut hash = XxHash64::with_seed(0);
    hash.write(config.kinematics().as_bytes());
    for axis in config.axis_names() {
        hash.write(axis.to_string().as_bytes());
    }
    hash.finish()
}

/// The fingerprint of a file's bytes; 0, which stands for no file, for none.
pub(crate) fn fingerprint_of(bytes: &[u8]) -> u64 {
    let mut hash = XxHash64::with_seed(0);
    hash.write(bytes);
    hash.finish().max(1)
}
