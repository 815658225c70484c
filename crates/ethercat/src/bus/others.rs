//! Devices that are no drives on their way into operation: couplers, inputs, outputs.
//!
//! A device without a mailbox says in its EEPROM what is in which of its windows. One with CoE is asked,
//! after it was given its parameters and told which maps to take.

use super::mapping::{self, INPUT_ASSIGNMENT, OUTPUT_ASSIGNMENT, mapped};
use super::parameters;
use super::state::{self, PRE_OP};
use super::watchdog;
use super::windows::{WATCHED, manager, window};
use crate::coe::{object, write};
use crate::device::{Device, SyncManager, Window};
use crate::entry::{Mapping, bytes};
use crate::error::BusError;
use crate::exchange::Exchange;
use crate::registers::{FMMU, SYNC_MANAGER};
use crate::segments;
use crate::terminal::{SpindleSettings, TerminalSettings, Wiring};
use crate::wire::Wire;

/// Windows onto the memory of a device that it has: fewer than 8 at some, and then fewer are used.
const MOST_WINDOWS: usize = 8;

/// All devices that are no drives and that the file names, in its order.
#[derive(Debug, Clone, Default)]
pub(super) struct Others {
    pub(super) devices: Vec<Device>,
    /// What is in the windows of each, without those that are empty.
    windows: Vec<Vec<Window>>,
    /// Where it is in the image.
    pub(super) wiring: Wiring,
    /// Devices with outputs, and devices with inputs.
    pub(super) counts: (u16, u16),
    /// Those that work with SYNC0.
    pub(super) with_sync: Vec<Device>,
}

fn unfit(device: &Device, what: String) -> BusError {
    BusError::Unfit {
        device: device.position,
        name: device.name.clone(),
        what,
    }
}

impl Others {
    /// Brings a device to PRE-OP, gives it what the file has for it, and takes it in.
    pub(super) fn add<W: Wire>(
        &mut self,
        bus: &mut Exchange<'_, W>,
        device: &Device,
        settings: &TerminalSettings,
        period_ns: u64,
    ) -> Result<(), BusError> {
        if device.mailbox.is_none() {
            state::request(bus, device, PRE_OP)?;
        }
        let has_dictionary = device.mailbox.is_some() && device.has_coe;
        let is_set = !settings.parameters.is_empty()
            || settings.assign_outputs.is_some()
            || settings.assign_inputs.is_some()
            || settings.spindle.is_some();
        if is_set && !has_dictionary {
            let what = "it has no mailbox with CoE: leave parameters, assign_outputs, assign_inputs and \
                        spindle out of its table in drives.toml";
            return Err(unfit(device, what.to_owned()));
        }
        let has_data = device.windows.iter().any(|w| !w.entries.is_empty());
        if !has_dictionary && device.has_sync_modes && has_data {
            let what =
                "it works with SYNC0 alone (oversampling, time stamps), which is not supported";
            return Err(unfit(device, what.to_owned()));
        }
        for parameter in &settings.parameters {
            let bytes = parameter.value.to_le_bytes();
            let bytes = bytes.get(..parameter.size.into()).unwrap_or(&bytes);
            segments::write(bus, device, (parameter.index, parameter.sub), bytes)?;
        }
        if let Some(spindle) = &settings.spindle {
            lead_spindle(bus, device, spindle, period_ns)?;
        }
        let windows = if has_dictionary {
            assign(
                bus,
                device,
                OUTPUT_ASSIGNMENT,
                settings.assign_outputs.as_deref(),
            )?;
            assign(
                bus,
                device,
                INPUT_ASSIGNMENT,
                settings.assign_inputs.as_deref(),
            )?;
            told_windows(bus, device)?
        } else {
            device.windows.clone()
        };
        let filled: Vec<_> = windows
            .into_iter()
            .filter(|window| !window.entries.is_empty())
            .collect();
        if filled.len() > MOST_WINDOWS {
            return Err(unfit(
                device,
                "it has more windows than can be led".to_owned(),
            ));
        }
        self.wiring.add(settings, &filled).map_err(|why| {
            let (at, is_output) = why.at();
            BusError::Unwired {
                device: device.position,
                name: device.name.clone(),
                at,
                is_output,
                what: why.to_string(),
            }
        })?;
        if let Some(spindle) = &settings.spindle {
            self.keep_outputs(bus, device, &filled)?;
            if spindle.mode.is_cyclic() {
                self.with_sync.push(device.clone());
            }
        }
        self.counts.0 += u16::from(filled.iter().any(|window| window.is_output));
        self.counts.1 += u16::from(filled.iter().any(|window| !window.is_output));
        self.devices.push(device.clone());
        self.windows.push(filled);
        Ok(())
    }

    /// What a drive's own maps have besides stays as it is there: a limit of torque is not to become none.
    fn keep_outputs<W: Wire>(
        &mut self,
        bus: &mut Exchange<'_, W>,
        device: &Device,
        windows: &[Window],
    ) -> Result<(), BusError> {
        let outputs = windows.iter().filter(|window| window.is_output);
        let entries: Vec<_> = outputs
            .flat_map(|window| &window.entries)
            .copied()
            .collect();
        let image = &mut self.wiring.unwired;
        let from = image.len().saturating_sub(bytes(&entries));
        let own = image.get_mut(from..).unwrap_or_default();
        mapping::keep(bus, device, &entries, own)
    }

    /// Writes where the process data of all is, in an image that begins at a logical address, and how
    /// long outputs may stay away.
    pub(super) fn place<W: Wire>(
        &self,
        bus: &mut Exchange<'_, W>,
        image_at: usize,
        watchdog_ns: u64,
    ) -> Result<(), BusError> {
        let action = "to the place of its process data";
        let (mut outputs_at, mut inputs_at) = (image_at, image_at + self.wiring.sizes.0);
        for (device, windows) in self.devices.iter().zip(&self.windows) {
            let nth = device.position;
            let mut fmmus = Vec::new();
            for own in windows {
                let sized = sized(own);
                let register = SYNC_MANAGER + 8 * u16::from(own.number);
                bus.write(nth, register, &manager(sized), action)?;
                let (at, kind) = if own.is_output {
                    (&mut outputs_at, 2)
                } else {
                    (&mut inputs_at, 1)
                };
                let logical = u32::try_from(*at).unwrap_or(u32::MAX);
                fmmus.extend_from_slice(&window(logical, sized, kind));
                *at += usize::from(sized.length);
                if own.is_output {
                    watchdog::set(bus, device, own.number, watchdog_ns)?;
                }
            }
            if !fmmus.is_empty() {
                bus.write(nth, FMMU, &fmmus, action)?;
            }
        }
        Ok(())
    }
}

/// Maps the process data of the drive of the spindle, and gives it its mode.
fn lead_spindle<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    spindle: &SpindleSettings,
    period_ns: u64,
) -> Result<(), BusError> {
    if spindle.mode.is_cyclic() && !device.clock.is_clock() {
        let what = "it has no distributed clock, without which there is no cyclic velocity: give it mode = \
                    \"profile-velocity\" or \"velocity\"";
        return Err(unfit(device, what.to_owned()));
    }
    if spindle.orientation.is_some() && !parameters::round_of(bus, device, 0x607b)?.is_whole() {
        let what = "its position does not go round at 32 bits but in the range of 0x607B, and an angle is taken \
                    from the whole of it: set both of its ends to 0, or leave orientation out of its table in \
                    drives.toml";
        return Err(unfit(device, what.to_owned()));
    }
    if spindle.mapping == Mapping::Written {
        let (outputs, inputs) = spindle.entries();
        mapping::map_entries(bus, device, (outputs.as_slice(), inputs.as_slice()))?;
    }
    parameters::write_spindle(bus, device, period_ns, spindle.mode)
}

/// The sync manager of a window, as long as what is in it.
fn sized(window: &Window) -> SyncManager {
    let length = u16::try_from(bytes(&window.entries)).unwrap_or(u16::MAX);
    let mut manager = SyncManager {
        length,
        ..window.manager
    };
    if window.is_output {
        manager.control |= WATCHED;
    }
    manager
}

/// Tells a device which maps to take.
fn assign<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    assignment: u16,
    maps: Option<&[u16]>,
) -> Result<(), BusError> {
    let Some(maps) = maps else {
        return Ok(());
    };
    write(bus, device, object(assignment, 0, 1), 0)?;
    for (sub, map) in (1..=u8::MAX).zip(maps) {
        write(bus, device, object(assignment, sub, 2), (*map).into())?;
    }
    let count = u32::try_from(maps.len()).unwrap_or(u32::MAX);
    write(bus, device, object(assignment, 0, 1), count)
}

/// What a device with CoE says is in its windows.
pub(super) fn told_windows<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
) -> Result<Vec<Window>, BusError> {
    let mut windows = Vec::new();
    for (is_output, assignment) in [(true, OUTPUT_ASSIGNMENT), (false, INPUT_ASSIGNMENT)] {
        let Some(window) = device.window(is_output) else {
            continue;
        };
        let entries = match mapped(bus, device, assignment) {
            // It has nothing in that way.
            Err(BusError::Object { .. }) => Vec::new(),
            mapped => mapped?,
        };
        windows.push(Window {
            entries,
            ..window.clone()
        });
    }
    Ok(windows)
}
