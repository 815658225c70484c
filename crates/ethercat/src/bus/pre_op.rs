//! The bus in PRE-OP: parameters, and where process data goes.

use super::clocks;
use super::mapping;
use super::parameters;
use super::safe_op::SafeOp;
use super::state::{self, SAFE_OP};
use super::windows::{WATCHED, process};
use crate::coe::{self, Object};
use crate::device::Device;
use crate::error::BusError;
use crate::exchange::Exchange;
use crate::layout::Led;
use crate::registers::{FMMU, OUTPUT_WATCHDOG, SYNC_MANAGER};
use crate::settings::{DriveSettings, Settings};
use crate::wire::Wire;

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

    /// The device that is to be a drive, if it is the one that is expected there.
    fn drive(&self, wanted: &DriveSettings) -> Result<Device, BusError> {
        let position = wanted.position;
        let found = self.devices.len();
        let device = self.devices.get(position);
        let device = device.ok_or(BusError::Missing { position, found })?;
        for (what, wanted, found) in [
            ("vendor", wanted.vendor, device.identity.vendor),
            ("product", wanted.product, device.identity.product),
            ("alias", wanted.alias.into(), device.alias.into()),
        ] {
            if wanted != 0 && wanted != found {
                return Err(BusError::Other {
                    position,
                    what,
                    wanted,
                    found,
                });
            }
        }
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

    /// Looks whether a drive will notice that frames stay away.
    fn check_watchdog(&mut self, device: &Device, action: &'static str) -> Result<(), BusError> {
        let [control] = self
            .bus
            .read(device.position, SYNC_MANAGER + 16 + 4, action)?;
        if control & WATCHED != 0 {
            return Ok(());
        }
        Err(BusError::Unfit {
            device: device.position,
            name: device.name.clone(),
            what: "it does not let the watchdog of its outputs be switched on (bit 6 of 0x0814), so \
                   that it would go on when the bus is lost: its manufacturer has to say how it stops"
                .to_owned(),
        })
    }

    /// Writes parameters, maps process data, starts SYNC0, and brings the drives to SAFE-OP.
    ///
    /// # Errors
    ///
    /// A device is not the expected one, refuses something, or the clocks do not agree.
    pub fn into_safe_op(mut self, settings: &Settings) -> Result<SafeOp<'w, W>, BusError> {
        let mut drives = Vec::new();
        for drive in &settings.drives {
            let device = self.drive(drive)?;
            let layout = mapping::set(&mut self.bus, &device, drive)?;
            parameters::write_all(&mut self.bus, &device, &settings.bus, drive)?;
            drives.push((device, layout));
        }
        let drives = Led::in_a_row(drives);
        let (outputs, _) = Led::sizes(&drives);
        let watchdog = u16::try_from(settings.bus.watchdog_ns / 100_000).unwrap_or(u16::MAX);
        for led in &drives {
            let action = "to the place of its process data";
            let at = led.device.position;
            self.bus
                .write(at, OUTPUT_WATCHDOG, &watchdog.to_le_bytes(), action)?;
            let (managers, windows) = process(led, outputs);
            self.bus.write(at, SYNC_MANAGER + 16, &managers, action)?;
            self.check_watchdog(&led.device, action)?;
            self.bus.write(at, FMMU, &windows, action)?;
        }
        let reference = clocks::reference(&self.devices).unwrap_or(0);
        let time = clocks::settle(&mut self.bus, &self.devices, reference)?;
        let period_ns = settings.bus.period_ns;
        let start_ns = clocks::start_sync(&mut self.bus, &drives, time.now_ns(), period_ns)?;
        for led in &drives {
            state::request(&mut self.bus, &led.device, SAFE_OP)?;
            parameters::check_sync(&mut self.bus, &led.device)?;
        }
        Ok(SafeOp::new(self.bus, drives, (reference, time), start_ns))
    }
}
