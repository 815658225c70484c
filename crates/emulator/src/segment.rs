//! A segment of the bus: devices in a row, and the frames that pass them.

use crate::cable::{Cable, passages};
use crate::contact::{Contact, Probe};
use crate::device::Device;
use crate::encoder::{Encoder, EncoderAtWork};
use crate::frame::{Datagram, datagrams};
use crate::gearbox::{Gearbox, GearboxAtWork};
use crate::injected_fault::InjectedFault;
use crate::load_encoder::{LoadEncoder, LoadEncoderAtWork};
use crate::pins::OutputRecord;
use crate::settings::DriveSettings;
use core::ops::Range;

pub use crate::device::SyncRecord;

/// Time from a device to the next one in a row, ns.
const HOP_NS: u64 = 500;

/// Devices in a row, or a tree of them, from the master on.
#[derive(Debug, Clone)]
pub struct Segment {
    devices: Vec<Device>,
    contacts: Vec<Contact>,
    encoders: Vec<EncoderAtWork>,
    gearboxes: Vec<GearboxAtWork>,
    load_encoders: Vec<LoadEncoderAtWork>,
}

impl Segment {
    /// Drives that have just been switched on.
    #[must_use]
    pub fn new(drives: &[DriveSettings]) -> Self {
        Self::new_at(drives, 0)
    }

    /// The same, at a time of the host, ns.
    #[must_use]
    pub fn new_at(drives: &[DriveSettings], now_ns: u64) -> Self {
        let from_port_1 = |from| Cable {
            from,
            port: 1,
            into: 0,
            way_ns: HOP_NS,
        };
        let cables: Vec<_> = (1..drives.len()).map(|nth| from_port_1(nth - 1)).collect();
        // A row is always in order.
        Self::branched(drives, &cables, now_ns).unwrap_or(Self {
            devices: Vec::new(),
            contacts: Vec::new(),
            encoders: Vec::new(),
            gearboxes: Vec::new(),
            load_encoders: Vec::new(),
        })
    }

    /// Devices that hang by cables: the second one by the first cable, and so on. `None` if a device
    /// hangs nowhere, or they are not in the order in which they read a frame.
    #[must_use]
    pub fn branched(drives: &[DriveSettings], cables: &[Cable], now_ns: u64) -> Option<Self> {
        let passages = passages(drives.len(), cables)?;
        let devices = drives.iter().zip(passages);
        Some(Self {
            devices: devices
                .map(|(drive, passage)| Device::new(drive, passage, now_ns))
                .collect(),
            contacts: Vec::new(),
            encoders: Vec::new(),
            gearboxes: Vec::new(),
            load_encoders: Vec::new(),
        })
    }

    /// Puts a probe on the machine.
    pub fn add_probe(&mut self, probe: Probe) {
        self.devices.iter_mut().for_each(Device::keep_ways);
        self.contacts.push(Contact::new(probe));
    }

    /// Puts an encoder on a spindle.
    pub fn add_encoder(&mut self, encoder: Encoder) {
        self.devices.iter_mut().for_each(Device::keep_ways);
        self.encoders.push(EncoderAtWork::new(encoder));
    }

    /// Puts a gearbox between a spindle and its motor.
    pub fn add_gearbox(&mut self, gearbox: Gearbox) {
        self.devices.iter_mut().for_each(Device::keep_ways);
        self.gearboxes.push(GearboxAtWork::new(gearbox));
    }

    /// The gears of all gearboxes do not come in any more, or they do again.
    pub fn stick_gears(&mut self, is_stuck: bool) {
        for gearbox in &mut self.gearboxes {
            gearbox.stick(is_stuck);
        }
    }

    /// The gears that are in come out by themselves, and none comes in any more.
    pub fn drop_gears(&mut self) {
        for gearbox in &mut self.gearboxes {
            gearbox.fall_out();
        }
    }

    /// How many gears were changed while their motor turned too fast.
    #[must_use]
    pub fn broken_gears(&self) -> u32 {
        self.gearboxes.iter().map(GearboxAtWork::broken).sum()
    }

    /// How far the spindle behind a gearbox has turned, revolutions; `None` where there is none.
    #[must_use]
    pub fn spindle_revolutions(&self, spindle: (usize, usize)) -> Option<f64> {
        let mut gearboxes = self.gearboxes.iter();
        let gearbox = gearboxes.find(|gearbox| gearbox.is_of(spindle))?;
        Some(gearbox.revolutions())
    }

    /// Puts an encoder on a joint.
    pub fn add_load_encoder(&mut self, encoder: LoadEncoder) {
        self.devices.iter_mut().for_each(Device::keep_ways);
        self.load_encoders.push(LoadEncoderAtWork::new(encoder));
    }

    /// The load of the encoder at a terminal slips on its motor.
    pub fn slip_load(&mut self, device: usize, counts: f64) {
        let mut encoders = self.load_encoders.iter_mut();
        if let Some(encoder) = encoders.find(|encoder| encoder.device() == device) {
            encoder.slip(counts);
        }
    }

    /// How far a spindle has turned at a time that is not before the last frame; `None` where there is none.
    #[must_use]
    pub fn revolutions(&self, (device, axis): (usize, usize), now_ns: u64) -> Option<f64> {
        self.devices
            .get(device)?
            .drives
            .get(axis)?
            .revolutions(now_ns)
    }

    /// The encoder at a terminal loses counts, or counts what is not there.
    pub fn slip_encoder(&mut self, device: usize, counts: i64) {
        let mut encoders = self.encoders.iter_mut();
        if let Some(encoder) = encoders.find(|encoder| encoder.device() == device) {
            encoder.slip(counts);
        }
    }

    /// Takes all probes from the machine.
    pub fn remove_probes(&mut self) {
        self.contacts.clear();
    }

    /// Something comes to a digital input of a drive of a device (0x60FD).
    pub fn set_drive_input(&mut self, (device, axis): (usize, usize), bit: u8, is_high: bool) {
        if let Some(device) = self.devices.get_mut(device) {
            device.show_at_drive(axis, bit, is_high);
        }
    }

    /// Keeps a record of every SYNC0 from here on.
    pub fn keep_records(&mut self) {
        for device in &mut self.devices {
            let axes = device.drives.len();
            device.records.get_or_insert_with(|| vec![Vec::new(); axes]);
            device.pins.records.get_or_insert_default();
        }
    }

    /// What a drive did since this was asked last: the first one of a device.
    pub fn take_records(&mut self, drive: usize) -> Vec<SyncRecord> {
        self.take_axis_records(drive, 0)
    }

    /// The same of any of its drives, from 0.
    pub fn take_axis_records(&mut self, device: usize, axis: usize) -> Vec<SyncRecord> {
        let device = self.devices.get_mut(device);
        let records = device.and_then(|device| device.records.as_mut());
        let records = records.and_then(|records| records.get_mut(axis));
        records.map(core::mem::take).unwrap_or_default()
    }

    /// Something goes wrong with a device and all drives of it, or right again.
    pub fn inject(&mut self, drive: usize, upset: InjectedFault, now_ns: u64) {
        self.advance(now_ns);
        if let Some(device) = self.devices.get_mut(drive) {
            device.inject(upset, now_ns);
        }
    }

    /// Something goes wrong with one of the drives of a device, or right again.
    pub fn upset_axis(&mut self, device: usize, axis: usize, upset: InjectedFault, now_ns: u64) {
        self.advance(now_ns);
        let device = self.devices.get_mut(device);
        if let Some(drive) = device.and_then(|device| device.drives.get_mut(axis)) {
            drive.inject(upset);
        }
    }

    /// Takes devices from the wire, or puts them back: no frame reaches them meanwhile.
    pub fn unplug(&mut self, devices: Range<usize>, is_away: bool, now_ns: u64) {
        self.advance(now_ns);
        for device in self.devices.get_mut(devices).unwrap_or_default() {
            device.is_unplugged = is_away;
        }
    }

    /// Something comes to an input of a device: a bit of its inputs, in their order.
    pub fn set_input(&mut self, device: usize, bit: usize, is_high: bool) {
        if let Some(device) = self.devices.get_mut(device) {
            device.change_inputs(|pins| pins.set_bit(bit, is_high));
        }
    }

    /// The same for whole bytes of them, from one on.
    pub fn set_input_bytes(&mut self, device: usize, from: usize, bytes: &[u8]) {
        if let Some(device) = self.devices.get_mut(device) {
            device.change_inputs(|pins| pins.set_inputs(from, bytes));
        }
    }

    /// What the outputs of a device are, in the order of its windows; nothing of a drive.
    #[must_use]
    pub fn outputs(&self, device: usize) -> &[u8] {
        let device = self.devices.get(device);
        device.map_or(&[][..], |device| &device.pins.outputs)
    }

    /// The changes of the outputs of a device since this was asked last; none before
    /// [`Segment::keep_records`].
    pub fn take_output_records(&mut self, device: usize) -> Vec<OutputRecord> {
        let device = self.devices.get_mut(device);
        let records = device.and_then(|device| device.pins.records.as_mut());
        records.map(core::mem::take).unwrap_or_default()
    }

    /// The bytes of an object of more than four of a device.
    #[must_use]
    pub fn long_object(&self, device: usize, object: (u16, u8)) -> Option<&[u8]> {
        self.devices.get(device)?.long_object(object)
    }

    /// Lets time pass without a frame.
    pub fn advance(&mut self, now_ns: u64) {
        for device in &mut self.devices {
            device.advance(now_ns);
        }
        for contact in &mut self.contacts {
            contact.watch(&mut self.devices, now_ns);
        }
        for gearbox in &mut self.gearboxes {
            gearbox.watch(&mut self.devices, now_ns);
        }
        for encoder in &mut self.encoders {
            let behind = self
                .gearboxes
                .iter()
                .find(|gearbox| gearbox.is_of(encoder.spindle()));
            let turned = behind.map(GearboxAtWork::revolutions);
            encoder.watch(&mut self.devices, turned, now_ns);
        }
        for encoder in &self.load_encoders {
            encoder.watch(&mut self.devices, now_ns);
        }
    }

    /// A frame passes, at a time of the host that is not before that of any call so far. It comes
    /// back with the answers in it; a frame that is not EtherCAT's comes back as it is.
    pub fn pass(&mut self, frame: &mut [u8], now_ns: u64) {
        self.advance(now_ns);
        let found = datagrams(frame);
        if found.is_empty() {
            return;
        }
        // The first device marks frames that were on the wire.
        frame[6] |= 2;
        for mut datagram in found {
            let counted = self.answer(&mut datagram, frame, now_ns);
            datagram.close(frame, counted);
        }
    }

    fn answer(&mut self, datagram: &mut Datagram, frame: &mut [u8], now_ns: u64) -> u16 {
        let Some(data) = frame.get_mut(datagram.data.clone()) else {
            return 0;
        };
        let mut counted = 0_u16;
        for device in self
            .devices
            .iter_mut()
            .filter(|device| !device.is_unplugged)
        {
            let at_ns = now_ns + device.read_ns();
            counted += pass_device(device, datagram, data, at_ns);
        }
        counted
    }
}

/// A datagram passes a device. Returns what it adds to the working counter.
fn pass_device(device: &mut Device, datagram: &mut Datagram, data: &mut [u8], at_ns: u64) -> u16 {
    let address = datagram.address;
    // APRD…APRW and ARMW count devices, FPRD…FPRW and FRMW name one, BRD…BRW are for all.
    let is_meant = match datagram.command {
        1..=3 | 13 => {
            let is_meant = datagram.device == 0;
            datagram.device = datagram.device.wrapping_add(1);
            is_meant
        }
        7..=9 => {
            datagram.device = datagram.device.wrapping_add(1);
            true
        }
        4..=6 | 14 => datagram.device == device.station_address(),
        10..=12 => {
            let ways = (datagram.command != 11, datagram.command != 10);
            return device.exchange(datagram.logical(), data, ways, datagram.index, at_ns);
        }
        _ => return 0,
    };
    let multiple = matches!(datagram.command, 13 | 14);
    if multiple && !is_meant {
        return u16::from(device.write(address, data, at_ns));
    }
    if !is_meant {
        return 0;
    }
    let sent = data.to_vec();
    let mut counted = 0;
    if matches!(datagram.command, 1 | 3 | 4 | 6 | 7 | 9 | 13 | 14)
        && let Some(read) = device.read(address, data.len(), at_ns)
    {
        let is_broadcast = matches!(datagram.command, 7 | 9);
        for (place, byte) in data.iter_mut().zip(read) {
            *place = if is_broadcast { *place | byte } else { byte };
        }
        counted += 1;
    }
    if matches!(datagram.command, 2 | 3 | 5 | 6 | 8 | 9) && device.write(address, &sent, at_ns) {
        let is_both = matches!(datagram.command, 3 | 6 | 9);
        counted += if is_both { 2 } else { 1 };
    }
    counted
}
