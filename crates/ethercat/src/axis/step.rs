//! One cycle of a drive, as each state sees it.

use super::drive_io::{DriveCommand, DriveInputs};
use crate::bus_fault::BusFault;
use crate::feed_forward::Offsets;
use crate::image::{CYCLIC_POSITION, Outputs};
use crate::probe::ProbeUse;
use crate::settings::DriveSettings;

/// One cycle of a drive: its inputs and the command to it, and the outputs that it is to get.
#[derive(Debug)]
pub(super) struct Step<'a> {
    pub(super) settings: &'a DriveSettings,
    pub(super) drive_inputs: &'a DriveInputs,
    pub(super) drive_command: &'a DriveCommand,
    /// As they were told last.
    pub(super) outputs: Outputs,
}

impl Step<'_> {
    /// A controlword, and the target where the joint is.
    pub(super) const fn stand(&mut self, control: u16) {
        self.outputs = Outputs {
            control,
            target: self.drive_inputs.inputs.actual,
            mode: CYCLIC_POSITION,
            offsets: Offsets::NONE,
            probe: ProbeUse::Off,
            asks_probe: false,
        };
    }
}

/// The next state of the drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Next {
    Stay,
    Off,
    Enable,
    /// No power, with the trouble that is the reason.
    Refuse(BusFault),
    Follow,
    Home,
    /// Home was found, and is stayed at.
    Found,
    /// To rest by its own ramp, then without power; with the trouble that is the reason.
    Stop(Option<BusFault>),
    Fault,
}

/// Controlwords.
pub(super) const DISABLE_VOLTAGE: u16 = 0x00;
pub(super) const QUICK_STOP: u16 = 0x02;
pub(super) const SHUTDOWN: u16 = 0x06;
pub(super) const SWITCH_ON: u16 = 0x07;
pub(super) const ENABLE_OPERATION: u16 = 0x0f;
pub(super) const START_HOMING: u16 = 0x1f;
pub(super) const RESET_FAULT: u16 = 0x80;
