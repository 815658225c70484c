//! The devices that a scan of the wire has found, and what they say of themselves.

use glidepath_ethercat::{Device, OutputWatchdog, Window};

/// What a drive has to keep where it was at an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FoundProbe {
    /// Which of its two units have their objects, 1 and 2.
    pub units: [bool; 2],
    /// Whether a source can be chosen (0x60D0).
    pub has_sources: bool,
    /// Whether it tells its digital inputs (0x60FD).
    pub has_inputs: bool,
}

/// A device, and what it says of itself.
#[derive(Debug, Clone)]
pub struct Found {
    /// Who it is.
    pub device: Device,
    /// Counts of a revolution of its motor, if it tells.
    pub counts_per_revolution: Option<f64>,
    /// Whether it can follow positions cycle by cycle, and find its home by itself; `None` if it is
    /// no drive of CiA 402.
    pub modes: Option<(bool, bool)>,
    /// Its drives, 1 where it is none.
    pub axes: u16,
    /// What each of its drives has of a touch probe, and of digital inputs; none where it is no drive.
    pub probes: Vec<FoundProbe>,
    /// What is in its process data.
    pub windows: Vec<Window>,
    /// How it watches its outputs, if it tells.
    pub watchdog: Option<OutputWatchdog>,
}

impl Found {
    /// Whether it is a drive that this master can lead, as far as it tells.
    #[must_use]
    pub fn is_drive(&self) -> bool {
        let follows = self.modes.is_some_and(|(follows, _)| follows);
        follows && self.device.may_be_drive() && self.device.clock.is_clock()
    }

    /// What it is, in words.
    pub(super) fn verdict(&self) -> &'static str {
        match self.modes {
            None if self.windows.iter().all(|window| window.entries.is_empty()) => {
                "no drive, without process data"
            }
            None => "no drive",
            Some((false, _)) => "a drive without cyclic position (mode 8): cannot be led",
            Some(_) if !self.device.clock.is_clock() => {
                "a drive without a distributed clock: cannot be led"
            }
            Some((true, false)) => "a drive; it does not find its home by itself",
            Some((true, true)) => "a drive",
        }
    }
}
