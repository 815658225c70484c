//! The bus in INIT: its devices are found.

use super::clocks;
use super::pre_op::PreOp;
use super::state::{self, PRE_OP};
use super::windows::manager;
use crate::device::Device;
use crate::eeprom;
use crate::error::BusError;
use crate::exchange::{Exchange, station};
use crate::frame::{Address, Command};
use crate::registers::{
    AL_CONTROL, CLOCK_LOOP, EEPROM_OWNER, FMMU, STATION_ADDRESS, SYNC_ACTIVATION, SYNC_MANAGER,
    TIME_DELAY, TIME_OFFSET,
};
use crate::wire::Wire;

/// Devices that are looked for at most: process data has to fit into one frame.
const MOST: u16 = 64;

/// A bus whose devices are in INIT, and known.
#[derive(Debug)]
pub struct Init<'w, W> {
    bus: Exchange<'w, W>,
    devices: Vec<Device>,
}

impl<'w, W: Wire> Init<'w, W> {
    /// Looks who is there, and brings everybody to INIT.
    ///
    /// # Errors
    ///
    /// Nobody answers, or somebody does not to the end.
    pub fn find(wire: &'w mut W) -> Result<Self, BusError> {
        let mut bus = Exchange::new(wire);
        let mut kind = [0];
        let answered = bus.ask(Command::Brd, Address::all(0), &mut kind, 3)?;
        let count = answered.map_or(0, |(count, _)| count);
        if count == 0 {
            return Err(BusError::Nobody);
        }
        reset(&mut bus)?;
        let count = usize::from(count.min(MOST));
        for nth in 0..count {
            let position = u16::try_from(nth).unwrap_or(u16::MAX);
            let address = Address::position(position, STATION_ADDRESS);
            let mut data = station(nth).to_le_bytes();
            bus.one(Command::Apwr, address, &mut data, nth, "to its address")?;
        }
        let mut devices = Vec::new();
        for nth in 0..count {
            let clock = clocks::kind(&mut bus, nth)?;
            devices.push(eeprom::read(&mut bus, nth, clock)?);
        }
        Ok(Self { bus, devices })
    }

    /// The devices, in the order of the cable.
    #[must_use]
    pub fn devices(&self) -> &[Device] {
        &self.devices
    }

    /// Gives all clocks one time, that of this host, and brings devices with a mailbox to PRE-OP.
    ///
    /// # Errors
    ///
    /// A device does not go there.
    pub fn into_pre_op(mut self) -> Result<PreOp<'w, W>, BusError> {
        clocks::set(&mut self.bus, &self.devices)?;
        for device in &self.devices {
            let nth = device.position;
            if let Some((out, back)) = device.mailbox {
                let managers = [manager(out), manager(back)].concat();
                let action = "to the place of its mailbox";
                self.bus.write(nth, SYNC_MANAGER, &managers, action)?;
                // The device's own processor reads its EEPROM on the way.
                self.bus.write(nth, EEPROM_OWNER, &[1], action)?;
                state::request(&mut self.bus, device, PRE_OP)?;
            }
        }
        Ok(PreOp::new(self.bus, self.devices))
    }
}

/// Takes everything back that another master, or a life of this one, has left.
fn reset<W: Wire>(bus: &mut Exchange<'_, W>) -> Result<(), BusError> {
    bus.write_all(AL_CONTROL, &[state::INIT | state::ERROR, 0])?;
    for (register, length) in [(FMMU, 128), (SYNC_MANAGER, 64)] {
        bus.write_all(register, &vec![0; length])?;
    }
    // Devices without a clock do not answer to these.
    for (register, bytes) in [
        (SYNC_ACTIVATION, &[0][..]),
        (TIME_OFFSET, &[0; 8]),
        (TIME_DELAY, &[0; 4]),
        // The control loop forgets what it knew of another reference (ETG.1000.4, speed counter).
        (CLOCK_LOOP, &[0x00, 0x10]),
        (CLOCK_LOOP + 4, &[0x00, 0x0c]),
    ] {
        bus.write_all(register, bytes)?;
    }
    Ok(())
}
