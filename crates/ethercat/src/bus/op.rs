//! The bus in OP: one frame a cycle.
//!
//! ```text
//! FRMW 0x0910 │ LRW: drives │ LRW: all others │ FPRD 0x0130 of each │ one mailbox
//! ```
//!
//! A device that does not know LRW gets LWR and LRD in its place, and then all do. What there is not
//! has no datagram: of a machine without terminals, theirs.
//!
//! The time of the reference goes to all clocks, process data is exchanged, and every device says in
//! what state it is and why. The last datagram looks whether a mailbox is full, of one device after the
//! other, and if one is, takes the message out: emergencies come that way.

use super::aside::Asides;
use super::bus_time::BusTime;
use super::group::Group;
use super::mailbox::Mailbox;
use super::others::Others;
use super::probe_mail::ProbeMail;
use super::state::{ERROR, INIT};
use crate::bus_clock::{BusClock, FrameTimes};
use crate::device_state::DeviceState;
use crate::diagnosis::Diagnosis;
use crate::error::BusError;
use crate::exchange::{Exchange, station};
use crate::frame::{Address, Command, Frame, Slot};
use crate::image::{Inputs, Outputs};
use crate::layout::Drives;
use crate::registers::{AL_CONTROL, AL_STATUS, SYSTEM_TIME};
use crate::state;
use crate::terminal::{Answered, Wiring, at_rest};
use crate::wire::{MAX_FRAME, Wire};
use glidepath_link::DriveState;
use std::io;

/// The outcome of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reception {
    /// It came back, and every drive took part.
    Good(FrameTimes),
    /// It came back, and not every drive took part: the working counter is too low.
    Short {
        /// What was counted.
        counted: u16,
        /// What should have been.
        expected: u16,
    },
    /// It did not come back in time.
    Lost,
}

/// A bus in operation.
#[derive(Debug)]
pub struct Op<'w, W> {
    wire: &'w mut W,
    frame: Frame,
    received: Vec<u8>,
    index: u8,
    time: Option<Slot>,
    drives_group: Group,
    /// All others; `None` if they have no process data.
    others_group: Option<Group>,
    status: Vec<Slot>,
    asides: Asides,
    reference: u16,
    bus_time: BusTime,
    /// Drives first, then all others.
    stations: Vec<u16>,
    /// Of each drive, and of each other device.
    states: Vec<DeviceState>,
    /// Of each device.
    of_devices: Vec<DeviceState>,
    drives: Drives,
    others: Others,
    /// Which of all have failed, as states are told.
    failed: Vec<bool>,
    /// What the others are to put out, and what they told last.
    others_outputs: Vec<u8>,
    others_inputs: Vec<u8>,
    are_others_whole: bool,
    sent_ns: u64,
    /// Frames that came back when they were not waited for any more.
    stale: u64,
    clock: Option<BusClock>,
}

impl<'w, W: Wire> Op<'w, W> {
    pub(super) fn new(
        bus: Exchange<'w, W>,
        drives: Drives,
        others: Others,
        (reference, bus_time): (usize, BusTime),
    ) -> Self {
        let of_drives = || drives.devices.iter().map(|led| &led.device);
        let devices = || of_drives().chain(&others.devices);
        let lacks_lrw = devices().any(|device| device.lacks_lrw);
        let sizes = drives.sizes();
        let count = u16::try_from(drives.devices.len()).unwrap_or(u16::MAX);
        let (out, back) = others.wiring.sizes;
        let behind = u32::try_from(sizes.0 + sizes.1).unwrap_or(u32::MAX);
        let others_group =
            (out + back > 0).then(|| Group::new(behind, (out, back), others.counts, lacks_lrw));
        // By the first axis of a device.
        let first = |nth| drives.axes.iter().position(|axis| axis.device == nth);
        let of_drives = (0..).map_while(first);
        let of_others = (0..).map(|nth| drives.axes.len() + nth);
        let numbers = of_drives.chain(of_others);
        let mailboxes = numbers.zip(devices());
        let mailboxes = mailboxes.filter_map(|(nth, device)| Mailbox::of(nth, device));
        let mailboxes: Vec<Mailbox> = mailboxes.collect();
        let number = |station| bus.last_number(station);
        let mail = ProbeMail::new(&drives, &mailboxes, number);
        let stations: Vec<u16> = devices().map(|device| station(device.position)).collect();
        Self {
            wire: bus.wire,
            frame: Frame::default(),
            received: vec![0; MAX_FRAME],
            index: 0,
            time: None,
            drives_group: Group::new(0, sizes, (count, count), lacks_lrw),
            are_others_whole: others_group.is_none(),
            others_group,
            status: Vec::with_capacity(stations.len()),
            asides: Asides::new(mailboxes, mail),
            reference: station(reference),
            bus_time,
            states: vec![DeviceState::default(); drives.axes.len() + others.devices.len()],
            failed: vec![false; drives.axes.len() + others.devices.len()],
            of_devices: vec![DeviceState::default(); stations.len()],
            stations,
            drives,
            others_outputs: at_rest(&others.wiring),
            others_inputs: vec![0; back],
            others,
            sent_ns: 0,
            stale: 0,
            clock: None,
        }
    }

    pub(super) fn take_over(&mut self, clock: BusClock) {
        self.clock = Some(clock);
    }

    /// The clock of the bus, as it was found on the way here; `None` the second time.
    pub const fn take_clock(&mut self) -> Option<BusClock> {
        self.clock.take()
    }

    /// The wire.
    pub const fn wire(&mut self) -> &mut W {
        self.wire
    }

    /// In what states the devices were when they answered last: drives first, then all others.
    #[must_use]
    pub fn states(&self) -> &[DeviceState] {
        &self.states
    }

    /// Where the inputs and outputs of all that are no drives are, and their places in the line.
    pub(crate) fn wiring(&self) -> (&Wiring, impl Iterator<Item = usize>) {
        let devices = self.others.devices.iter();
        (&self.others.wiring, devices.map(|device| device.position))
    }

    /// What those have answered.
    pub(crate) fn answered(&self) -> Answered<'_> {
        Answered {
            sent_ns: self.sent_ns,
            is_whole: self.are_others_whole,
            inputs: &self.others_inputs,
            states: self
                .states
                .get(self.drives.axes.len()..)
                .unwrap_or_default(),
        }
    }

    /// What those are to put out with the next frame.
    pub(crate) fn outputs(&mut self) -> &mut [u8] {
        &mut self.others_outputs
    }

    /// Frames that came back when they were not waited for any more.
    #[must_use]
    pub const fn stale(&self) -> u64 {
        self.stale
    }

    /// The emergency that came last, and from which device, drives first; `None` if that was told.
    pub const fn take_emergency(&mut self) -> Option<(usize, u16)> {
        self.asides.take_emergency()
    }

    /// The message of a diagnosis history that came last, and of which device, drives first; `None` if that
    /// was told.
    pub fn take_diagnosis(&mut self) -> Option<(usize, Diagnosis)> {
        self.asides.take_diagnosis()
    }

    /// A device, drives first, has failed: its diagnosis history is asked, beside the cycles.
    pub fn want_history(&mut self, nth: usize) {
        let device = self.drives.axes.get(nth).map(|axis| axis.device);
        let first = self
            .drives
            .axes
            .iter()
            .position(|axis| Some(axis.device) == device);
        self.asides.want_history(first.unwrap_or(nth));
    }

    /// Asks for the histories of those that have failed since the last frame.
    fn watch_failures(&mut self, inputs: &[Inputs]) {
        for nth in 0..self.failed.len() {
            let state = self.states[nth];
            let status = inputs.get(nth).map_or(0, |inputs| inputs.status);
            let is_fault = matches!(
                state::of(status),
                DriveState::Fault | DriveState::FaultReaction
            );
            let has_failed = is_fault || state.has_error;
            let had_failed = core::mem::replace(&mut self.failed[nth], has_failed);
            if has_failed && !had_failed {
                self.want_history(nth);
            }
        }
    }

    /// The number of the datagrams of the frame that was sent last.
    #[must_use]
    pub const fn index(&self) -> u8 {
        self.index
    }

    /// Brings all devices to INIT, which stops SYNC0 and takes all power. Whoever does not hear it has
    /// a watchdog.
    ///
    /// # Errors
    ///
    /// The port is gone.
    pub fn leave(self) -> Result<(), BusError> {
        let mut bus = Exchange::new(self.wire);
        let mut init = [INIT | ERROR, 0];
        bus.ask(Command::Bwr, Address::all(AL_CONTROL), &mut init, 3)?;
        Ok(())
    }

    /// Sends the frame of a cycle.
    ///
    /// # Errors
    ///
    /// The port does not take it.
    pub fn send(&mut self, outputs: &[Outputs]) -> io::Result<()> {
        self.index = self.index.wrapping_add(1);
        let (frame, index) = (&mut self.frame, self.index);
        frame.clear();
        let reference = Address::station(self.reference, SYSTEM_TIME);
        self.time = frame.push(Command::Frmw, index, reference, 8);
        if let Some(data) = self.drives_group.push(frame, index) {
            for led in &self.drives.devices {
                let end = led.outputs_at + led.rest.len();
                if let Some(place) = data.get_mut(led.outputs_at..end) {
                    place.copy_from_slice(&led.rest);
                }
            }
            for (axis, output) in self.drives.axes.iter().zip(outputs) {
                if let Some(led) = self.drives.devices.get(axis.device)
                    && let Some(place) = data.get_mut(led.outputs_at..)
                {
                    output.put(&axis.layout, place);
                }
            }
        }
        if let Some(others) = &mut self.others_group
            && let Some(data) = others.push(frame, index)
        {
            data.copy_from_slice(&self.others_outputs);
        }
        self.status.clear();
        for station in &self.stations {
            let address = Address::station(*station, AL_STATUS);
            self.status
                .extend(frame.push(Command::Fprd, index, address, 6));
        }
        for (nth, output) in outputs.iter().enumerate() {
            self.asides.want(nth, output.probe, output.asks_probe);
        }
        self.asides.push(frame, index);
        self.sent_ns = self.wire.now_ns();
        self.wire.send(self.frame.bytes())
    }

    /// Waits for the frame that was sent last. Others are counted and passed over.
    ///
    /// # Errors
    ///
    /// The port is gone.
    pub fn receive(&mut self, until_ns: u64, inputs: &mut [Inputs]) -> io::Result<Reception> {
        while let Some(length) = self.wire.receive(&mut self.received, until_ns)? {
            let received_ns = self.wire.now_ns();
            let Some(reception) = self.read(length, received_ns, inputs) else {
                self.stale += 1;
                continue;
            };
            self.watch_failures(inputs);
            return Ok(reception);
        }
        Ok(Reception::Lost)
    }

    fn read(
        &mut self,
        length: usize,
        received_ns: u64,
        inputs: &mut [Inputs],
    ) -> Option<Reception> {
        let received = self.received.get(..length)?;
        let time = self.frame.answer(self.time.as_ref()?, received)?;
        let drives = self.drives_group.answer(&self.frame, received)?;
        self.bus_time.hear(*time.data.first_chunk()?);
        for (slot, state) in self.status.iter().zip(&mut self.of_devices) {
            let answer = self.frame.answer(slot, received);
            *state = match answer.map(|answer| (answer.counter, answer.data)) {
                Some((1.., &[status, _, _, _, low, high])) => DeviceState {
                    state: status & 15,
                    has_error: status & ERROR != 0,
                    code: u16::from_le_bytes([low, high]),
                },
                // It does not answer.
                _ => DeviceState::default(),
            };
        }
        let axes = self.drives.axes.iter().map(|axis| axis.device);
        let devices = axes.chain(self.drives.devices.len()..);
        for (state, nth) in self.states.iter_mut().zip(devices) {
            *state = self.of_devices.get(nth).copied().unwrap_or_default();
        }
        if let Some(group) = &self.others_group {
            let others = group.answer(&self.frame, received)?;
            self.are_others_whole = others.counted == others.expected;
            if self.are_others_whole {
                self.others_inputs.copy_from_slice(others.inputs);
            }
        }
        self.asides.hear(&self.frame, received);
        if drives.counted != drives.expected {
            return Some(Reception::Short {
                counted: drives.counted,
                expected: drives.expected,
            });
        }
        for (nth, (axis, input)) in self.drives.axes.iter().zip(inputs).enumerate() {
            let led = self.drives.devices.get(axis.device)?;
            let bytes = drives.inputs.get(led.inputs_at..)?;
            *input = Inputs::take(&axis.layout, bytes, input.actual)?;
            let asked = self.asides.told(nth);
            let asked = asked.map(|asked| asked.near(axis.layout.round, input.actual));
            input.probe = asked.unwrap_or(input.probe);
        }
        Some(Reception::Good(FrameTimes {
            sent_ns: self.sent_ns,
            received_ns,
            bus_ns: self.bus_time.now_ns(),
        }))
    }
}
