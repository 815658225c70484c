//! The file `drives.toml`: what hangs on the bus, and which joint each drive moves.
//!
//! Read like a configuration: names first, values second, every diagnostic at once, with its place.

mod bus;
mod config;
mod device;
mod encoder;
mod feed_forward;
mod found;
mod gears;
mod judge;
mod raw;
mod raw_device;
mod source;
mod spindle;
mod tables;
#[cfg(test)]
mod tests;
mod touch_probe;
mod words;
mod written;
mod written_probe;

pub use config::DrivesConfig;
pub use found::{Found, FoundProbe};
pub(crate) use judge::joint_velocities;
pub use source::DrivesSource;
pub use written::written;

use crate::config::{ConfigError, MachineConfig, parse_as};
use crate::text_file;
use std::path::Path;

/// Largest file, bytes.
const MOST_BYTES: u64 = 1 << 20;

/// Reads a file for a machine.
///
/// # Errors
/// It cannot be read, or something in it has to be mended.
pub fn load(path: &Path, machine: &MachineConfig) -> Result<DrivesConfig, ConfigError> {
    let name = path.display().to_string();
    match text_file::read(path, MOST_BYTES) {
        Ok(text) => parse(&name, &text, machine),
        Err(source) => Err(ConfigError::Unreadable { path: name, source }),
    }
}

/// Judges a text for a machine; `path` is only used in reports.
///
/// # Errors
/// Everything in the text that has to be mended.
pub fn parse(path: &str, text: &str, machine: &MachineConfig) -> Result<DrivesConfig, ConfigError> {
    let mut config: DrivesConfig = parse_as(path, text, "docs/drives.md", |raw, found| {
        judge::judge(raw, found, machine)
    })?;
    (config.source.path, config.source.text) = (path.to_owned(), text.to_owned());
    Ok(config)
}
