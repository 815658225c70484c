//! The configuration of what hangs on the bus, judged.

use super::source::DrivesSource;
use glidepath_ethercat::{BusSettings, DigitalInput, DriveSettings, TerminalSettings};

/// The content of `drives.toml`.
#[derive(Debug, Clone, PartialEq)]
pub struct DrivesConfig {
    /// The network interface.
    pub interface: String,
    /// The bus.
    pub bus: BusSettings,
    /// The drives, one for each joint of the machine.
    pub drives: Vec<DriveSettings>,
    /// Their inputs, by the number of the drive.
    pub drive_inputs: Vec<(usize, DigitalInput)>,
    /// All other devices that are led.
    pub terminals: Vec<TerminalSettings>,
    /// Where all that is said.
    pub source: DrivesSource,
}
