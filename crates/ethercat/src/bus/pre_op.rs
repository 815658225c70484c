//! The bus in PRE-OP: parameters, and where process data goes.

use super::clocks;
use super::mapping;
use super::others::{self, Others};
use super::parameters;
use super::safe_op::SafeOp;
use super::state::{self, SAFE_OP};
use super::watchdog::{self, OutputWatchdog};
use super::windows::process;
use crate::coe::{self, Object};
use crate::device::{Device, Window};
use crate::error::BusError;
use crate::exchange::Exchange;
use crate::layout::{Drives, LedAxis};
use crate::registers::{FMMU, SYNC_MANAGER};
use crate::segments;
use crate::settings::{DriveSettings, Settings};
use crate::wire::{MAX_FRAME, Wire};

/// Bytes of the head of a frame, and of a datagram without its data.
const HEAD: usize = 16;
const DATAGRAM: usize = 12;

/// A bus whose devices can be asked for parameters.
#[derive(Debug)]
pub struct PreOp<'w, W> {
    bus: Exchange<'w, W>,
    devices: Vec<Device>,
}

impl<'w, W: Wire> PreOp<'w, W> {
    pub(super) const fn new(bus: Exchange<'w, W>, devices: Vec<Device>) -> Self {
        Self { bus, devices }
    }

    /// The devices, in the order of the cable.
    #[must_use]
    pub fn devices(&self) -> &[Device] {
        &self.devices
    }

    /// Reads a parameter of a device.
    ///
    /// # Errors
    ///
    /// There is no such device, or it refuses or does not answer.
    pub fn read(&mut self, position: usize, object: Object) -> Result<u32, BusError> {
        let device = self.devices.get(position).ok_or(BusError::Missing {
            position,
            found: self.devices.len(),
        })?;
        coe::read(&mut self.bus, device, object)
    }

    /// Reads a parameter of any length, of `most` bytes at most.
    ///
    /// # Errors
    ///
    /// There is no such device, or it refuses, does not answer, or does not give it as a whole.
    pub fn read_bytes(
        &mut self,
        position: usize,
        (index, sub): (u16, u8),
        most: usize,
    ) -> Result<Vec<u8>, BusError> {
        let found = self.devices.len();
        let device = self.devices.get(position);
        let device = device.ok_or(BusError::Missing { position, found })?;
        segments::read(&mut self.bus, device, (index, sub), most)
    }

    /// Writes a parameter of any length.
    ///
    /// # Errors
    ///
    /// There is no such device, or it refuses, does not answer, or does not take it as a whole.
    pub fn write_bytes(
        &mut self,
        position: usize,
        (index, sub): (u16, u8),
        bytes: &[u8],
    ) -> Result<(), BusError> {
        let found = self.devices.len();
        let device = self.devices.get(position);
        let device = device.ok_or(BusError::Missing { position, found })?;
        segments::write(&mut self.bus, device, (index, sub), bytes)
    }

    /// What is in the process data of a device, as far as it tells: a simple one by its EEPROM, one with
    /// CoE when it is asked.
    ///
    /// # Errors
    ///
    /// There is no such device, or it does not answer.
    pub fn windows(&mut self, position: usize) -> Result<Vec<Window>, BusError> {
        let found = self.devices.len();
        let device = self.devices.get(position);
        let device = device.ok_or(BusError::Missing { position, found })?;
        if device.mailbox.is_some() && device.has_coe {
            return others::told_windows(&mut self.bus, device);
        }
        Ok(device.windows.clone())
    }

    /// How a device watches its outputs.
    ///
    /// # Errors
    ///
    /// There is no such device, or it does not answer.
    pub fn watchdog(&mut self, position: usize) -> Result<OutputWatchdog, BusError> {
        watchdog::read(&mut self.bus, position)
    }

    /// The device at a place, if it is the one that is expected there: vendor, product and alias.
    fn expected(&self, position: usize, ids: [u32; 3]) -> Result<&Device, BusError> {
        let found = self.devices.len();
        let device = self.devices.get(position);
        let device = device.ok_or(BusError::Missing { position, found })?;
        let own = &device.identity;
        let own = [own.vendor, own.product, device.alias.into()];
        let named = ["vendor", "product", "alias"].into_iter();
        for ((what, wanted), found) in named.zip(ids).zip(own) {
            if wanted != 0 && wanted != found {
                return Err(BusError::Other {
                    position,
                    what,
                    wanted,
                    found,
                });
            }
        }
        Ok(device)
    }

    /// The device that is to be a drive, if it is the one that is expected there.
    fn drive(&self, wanted: &DriveSettings) -> Result<Device, BusError> {
        let position = wanted.position;
        let ids = [wanted.vendor, wanted.product, wanted.alias.into()];
        let device = self.expected(position, ids)?;
        let device = device.clone().or_process_at(wanted.process_at);
        let lacks = if !device.may_be_drive() {
            "it has no mailbox with CoE: it is no drive that this master knows"
        } else if device.process.is_none() {
            "its EEPROM does not say where its process data is: give outputs_at and inputs_at in its table \
             in drives.toml, the start addresses of its sync managers 2 and 3 by the manufacturer's ESI file"
        } else if !device.clock.is_clock() {
            "it has no distributed clock, and setpoints could not be given it in time"
        } else {
            return Ok(device);
        };
        Err(BusError::Unfit {
            device: position,
            name: device.name,
            what: lacks.to_owned(),
        })
    }

    /// Gives all drives their parameters and maps their process data, a device at a time.
    fn drives(&mut self, settings: &Settings) -> Result<Drives, BusError> {
        let mut drives = Drives::default();
        let mut axes: Vec<Option<LedAxis>> = vec![None; settings.drives.len()];
        for (nth, first) in settings.drives.iter().enumerate() {
            if axes.get(nth).is_some_and(Option::is_some) {
                continue;
            }
            let mut device = self.drive(first)?;
            let numbered = settings.drives.iter().enumerate();
            let of_device: Vec<_> = numbered
                .filter(|(_, drive)| drive.position == first.position)
                .collect();
            for (_, drive) in &of_device {
                device = self.drive(drive)?;
            }
            let own: Vec<_> = of_device.iter().map(|(_, drive)| *drive).collect();
            for drive in &own {
                parameters::write_all(&mut self.bus, &device, &settings.bus, drive)?;
            }
            let mapped = mapping::set(&mut self.bus, &device, &own)?;
            for ((nth, _), layout) in of_device.into_iter().zip(mapped.layouts) {
                axes[nth] = Some(LedAxis {
                    device: drives.devices.len(),
                    layout,
                });
            }
            drives.add(device, mapped.rest, mapped.input_bytes);
        }
        drives.axes = axes.into_iter().flatten().collect();
        Ok(drives)
    }

    /// Writes parameters, maps process data, starts SYNC0, and brings the drives to SAFE-OP.
    ///
    /// # Errors
    ///
    /// A device is not the expected one, refuses something, or the clocks do not agree.
    pub fn into_safe_op(mut self, settings: &Settings) -> Result<SafeOp<'w, W>, BusError> {
        let drives = self.drives(settings)?;
        let (outputs, inputs) = drives.sizes();
        for led in &drives.devices {
            let action = "to the place of its process data";
            let at = led.device.position;
            let (managers, windows) = process(led, outputs);
            self.bus.write(at, SYNC_MANAGER + 16, &managers, action)?;
            watchdog::set(&mut self.bus, &led.device, 2, settings.bus.watchdog_ns)?;
            self.bus.write(at, FMMU, &windows, action)?;
        }
        let mut others = Others::default();
        for wanted in &settings.terminals {
            let ids = [wanted.vendor, wanted.product, wanted.alias.into()];
            let device = self.expected(wanted.position, ids)?.clone();
            others.add(&mut self.bus, &device, wanted, settings.bus.period_ns)?;
        }
        others.place(&mut self.bus, outputs + inputs, settings.bus.watchdog_ns)?;
        check_room(&drives, &others)?;
        let reference = clocks::reference(&self.devices).unwrap_or(0);
        let time = clocks::settle(&mut self.bus, &self.devices, reference)?;
        let period_ns = settings.bus.period_ns;
        let with_sync: Vec<&Device> = drives
            .devices
            .iter()
            .map(|led| &led.device)
            .chain(&others.with_sync)
            .collect();
        let start_ns = clocks::start_sync(&mut self.bus, &with_sync, time.now_ns(), period_ns)?;
        for led in &drives.devices {
            state::request(&mut self.bus, &led.device, SAFE_OP)?;
            parameters::check_sync(&mut self.bus, &led.device)?;
        }
        for device in &others.devices {
            state::request(&mut self.bus, device, SAFE_OP)?;
        }
        for device in &others.with_sync {
            parameters::check_sync(&mut self.bus, device)?;
        }
        let reference = (reference, time);
        Ok(SafeOp::new(self.bus, (drives, others), reference, start_ns))
    }
}

/// Looks whether the datagrams of a cycle fit into one frame.
fn check_room(drives: &Drives, others: &Others) -> Result<(), BusError> {
    let of_drives = || drives.devices.iter().map(|led| &led.device);
    let devices = || of_drives().chain(&others.devices);
    let (out, back) = drives.sizes();
    let (others_out, others_back) = others.wiring.sizes;
    let longest = devices().filter_map(|device| Some(device.mailbox?.1.length));
    let mailbox = longest.map(usize::from).max().unwrap_or(1);
    // The head of the frame, the time, two datagrams of process data for each way, the states.
    let states = devices().count() * (DATAGRAM + 6);
    let data = out + back + others_out + others_back + 4 * DATAGRAM;
    let needed = HEAD + (DATAGRAM + 8) + data + states + (DATAGRAM + mailbox);
    if needed <= MAX_FRAME {
        return Ok(());
    }
    Err(BusError::Room {
        needed,
        most: MAX_FRAME,
    })
}
