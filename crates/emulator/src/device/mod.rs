//! An emulated device: what its registers do when they are read and written, and when time passes.

mod history;
mod motion;
mod probing;
mod simple;
mod time;
mod watchdog;

use crate::cable::Passage;
use crate::clock::{ClockKind, DeviceClock};
use crate::coe::{Mailbox, NO_ACCESS, NOT_MAPPABLE, OUT_OF_RANGE, READ_ONLY, TOO_LONG};
use crate::dictionary::{
    Dictionary, INPUTS_ASSIGNED, Mapped, OUTPUTS_ASSIGNED, Object, SYNC_INPUTS, SYNC_OUTPUTS,
};
use crate::drive::Drive;
use crate::eeprom::{self, MAILBOX, MAILBOX_OUT};
use crate::injected_fault::InjectedFault;
use crate::long_objects::LongObjects;
use crate::memory::{
    AL_CODE, AL_CONTROL, AL_STATUS, CLOCK, EEPROM_CONTROL, Memory, PORT_TIMES, SPEED_START,
    STATION_ADDRESS, SYNC_ACTIVATION, SYNC_MANAGER, SYSTEM_TIME, WATCHDOG_DIVIDER,
    WATCHDOG_OUTPUTS, WATCHDOG_STATUS,
};
use crate::pins::Pins;
use crate::position_loop::OffsetAccess;
use crate::process;
use crate::settings::{DriveSettings, ImageAccess, Maps, OutputWatchdog, SyncType};
use crate::states::{self, ERROR, INIT, OP, PRE_OP, SAFE_OP};

/// The record of what a drive did at one SYNC0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SyncRecord {
    /// When it was, by the clock of the host, ns.
    pub at_ns: u64,
    /// The number of the datagram that brought the outputs.
    pub index: u8,
    /// The target that took effect.
    pub target: i32,
    /// What was told beside it: 0x60B1 and 0x60B2.
    pub offsets: (i32, i16),
    /// Where the motor was then.
    pub actual: i32,
    /// The statusword from then on.
    pub status: u16,
    /// Whether the target counted: in OP, with power.
    pub follows: bool,
}

#[derive(Debug, Clone)]
pub(crate) struct Device {
    settings: DriveSettings,
    passage: Passage,
    memory: Memory,
    eeprom: Vec<u8>,
    objects: Dictionary,
    mailbox: Mailbox,
    clock: DeviceClock,
    pub(crate) drives: Vec<Drive>,
    outputs: Vec<Mapped>,
    inputs: Vec<Mapped>,
    /// When the next SYNC0 is, by the system time; `None` without.
    next_sync: Option<f64>,
    stepped_ns: u64,
    followed_ns: u64,
    /// When outputs came last.
    heard_ns: u64,
    index: u8,
    /// By axis.
    pub(crate) records: Option<Vec<Vec<SyncRecord>>>,
    pub(crate) pins: Pins,
    /// No frame reaches it.
    pub(crate) is_unplugged: bool,
}

impl Device {
    pub(crate) fn new(settings: &DriveSettings, passage: Passage, host_ns: u64) -> Self {
        let mut memory = Memory::new();
        memory.put(0, &[0x11, 0, 0, 0, 8, 8, 8, 0x0f]);
        let features: u16 = match settings.clock {
            ClockKind::None => 0,
            // As an EK1914 has it: the flags tell nothing.
            ClockKind::ReceiveTimes => 0x00fc,
            ClockKind::Bits32 => 0x0184,
            ClockKind::Bits64 => 0x010c,
        };
        let lacks_lrw = settings.image == ImageAccess::NoLrwByFeatures;
        let features = features | u16::from(lacks_lrw) << 9;
        memory.put(8, &features.to_le_bytes());
        passage.put(&mut memory);
        memory.put(WATCHDOG_DIVIDER, &2498_u16.to_le_bytes());
        memory.put(WATCHDOG_OUTPUTS, &1000_u16.to_le_bytes());
        memory.put(WATCHDOG_STATUS, &[1]);
        memory.put(AL_STATUS, &[INIT]);
        let ramp = 1_000_000_000;
        let (identity, axes) = (settings.identity, settings.axes);
        let axes = u16::try_from(axes).unwrap_or(1);
        let mut objects = match &settings.channels {
            Some(channels) => Dictionary::of_channels(identity, channels),
            None => Dictionary::new(identity, axes, settings.following_counts, ramp),
        };
        if let Maps::Fixed { outputs, inputs } = &settings.maps {
            objects.fix_maps(outputs, inputs);
        }
        if settings.offsets != OffsetAccess::None {
            objects.add_offsets(axes);
        }
        if let Some(range) = settings.range {
            objects.add_range(axes, range);
        }
        objects.remove(&settings.lacks);
        if settings.has_history {
            objects.add_history();
        }
        if let Some(probe) = settings.touch_probe {
            objects.add_touch_probes(axes, probe.has_sources);
        }
        let long = LongObjects::new(&settings.long_objects, settings.segment_fault);
        Self {
            eeprom: eeprom::image(settings),
            objects,
            mailbox: Mailbox::new(settings.drops_repeats, long),
            clock: DeviceClock::new(host_ns, 0.0, settings.drift_ppm),
            drives: (0..settings.axes)
                .map(|axis| Drive::new(settings, axis))
                .collect(),
            outputs: Vec::new(),
            inputs: Vec::new(),
            next_sync: None,
            stepped_ns: host_ns,
            followed_ns: host_ns,
            heard_ns: host_ns,
            index: 0,
            records: None,
            pins: Pins::default(),
            is_unplugged: false,
            settings: settings.clone(),
            passage,
            memory,
        }
    }

    /// When it reads a frame, ns since the first device did.
    pub(crate) const fn read_ns(&self) -> u64 {
        self.passage.read_ns
    }

    /// The bytes of one of its long objects.
    pub(crate) fn long_object(&self, object: Object) -> Option<&[u8]> {
        self.mailbox.long.get(object)
    }

    pub(crate) fn station_address(&self) -> u16 {
        self.memory.word(STATION_ADDRESS)
    }

    fn state(&self) -> u8 {
        self.memory.byte(AL_STATUS) & 15
    }

    fn set_state(&mut self, state: u8, code: u16) {
        self.memory.put(AL_STATUS, &[state, 0]);
        self.memory.put(AL_CODE, &code.to_le_bytes());
    }

    /// Something goes wrong, or right again.
    pub(crate) fn inject(&mut self, upset: InjectedFault, now_ns: u64) {
        match upset {
            InjectedFault::Emergency(code) => self.mailbox.emergency(&mut self.memory, code),
            InjectedFault::Drop(code) if self.state() == OP => {
                self.set_state(SAFE_OP | ERROR, code);
                self.lose_bus();
                self.settle_pins(now_ns);
            }
            InjectedFault::Reboot => {
                let (records, pins) = (self.records.take(), core::mem::take(&mut self.pins));
                let drives = self
                    .drives
                    .iter()
                    .map(|drive| drive.rebooted(&self.settings));
                let drives = drives.collect();
                *self = Self::new(&self.settings, self.passage, now_ns);
                (self.drives, self.records, self.pins) = (drives, records, pins);
                self.settle_pins(now_ns);
            }
            upset => {
                if let InjectedFault::Fault(code) = upset {
                    self.note_fault(code, now_ns);
                }
                self.drives.iter_mut().for_each(|drive| drive.inject(upset));
            }
        }
    }

    /// Lets time pass: what is due until then happens, in order.
    pub(crate) fn advance(&mut self, now_ns: u64) {
        loop {
            let sync_ns = self
                .next_sync
                .map(|sync| self.clock.host_at(sync - self.offset_ns()))
                .filter(|at| *at <= now_ns);
            let watchdog_ns = Some(self.heard_ns + self.watchdog_ns())
                .filter(|at| *at <= now_ns && self.state() == OP && self.watchdog_ns() > 0);
            match (sync_ns, watchdog_ns) {
                (None, None) => return,
                (sync, Some(dog)) if sync.is_none_or(|sync| dog < sync) => {
                    self.expire(dog);
                }
                (Some(sync), _) => self.sync(sync),
                (None, Some(_)) => return,
            }
        }
    }

    fn has(&self, address: u16, length: usize) -> bool {
        let is_there = match self.settings.clock {
            ClockKind::None => !CLOCK.contains(&address),
            ClockKind::ReceiveTimes => !CLOCK.contains(&address) || address < SYSTEM_TIME,
            ClockKind::Bits32 | ClockKind::Bits64 => true,
        };
        is_there && self.memory.get(address, length).is_some()
    }

    /// Reads for the master; `None` if the device does not answer.
    pub(crate) fn read(&mut self, address: u16, length: usize, now_ns: u64) -> Option<Vec<u8>> {
        if !self.has(address, length) {
            return None;
        }
        if address <= SYSTEM_TIME && usize::from(SYSTEM_TIME) < usize::from(address) + length {
            let time = self.system_register(now_ns).to_le_bytes();
            self.memory.put(SYSTEM_TIME, &time);
        }
        let mailbox = self.memory.sync_manager(1);
        let is_mailbox = mailbox.is_enabled && address == mailbox.start;
        if is_mailbox && !Mailbox::is_full(&self.memory) {
            return None;
        }
        let bytes = self.memory.get(address, length)?.to_vec();
        if mailbox.is_completed_by(address, length) {
            self.mailbox.taken(&mut self.memory);
        }
        Some(bytes)
    }

    /// Writes for the master; false if the device does not answer.
    pub(crate) fn write(&mut self, address: u16, bytes: &[u8], now_ns: u64) -> bool {
        if !self.has(address, bytes.len()) {
            return false;
        }
        let end = usize::from(address) + bytes.len();
        let touches = |register: u16| address <= register && usize::from(register) < end;
        match address {
            PORT_TIMES => self.latch_times(now_ns),
            SYSTEM_TIME => self.follow(bytes, now_ns),
            SPEED_START => self.clock.forget(now_ns),
            AL_STATUS..0x0136 => return false,
            _ => self.memory.put(address, bytes),
        }
        if self.settings.watchdog == OutputWatchdog::Never && touches(self.output_control()) {
            self.refuse_watchdog();
        }
        self.clear_managers(address, end);
        if touches(AL_CONTROL) {
            self.request(self.memory.byte(AL_CONTROL), now_ns);
        }
        if touches(EEPROM_CONTROL + 1) {
            eeprom::serve(&mut self.memory, &self.eeprom);
        }
        if touches(SYNC_ACTIVATION) {
            self.activate_sync(now_ns);
        }
        let mailbox = self.memory.sync_manager(0);
        if self.settings.has_mailbox && mailbox.is_completed_by(address, bytes.len()) {
            let message = self.memory.get(MAILBOX_OUT, MAILBOX.into());
            let message = message.unwrap_or_default().to_vec();
            let is_fixed = self.state() > PRE_OP;
            let is_told = self.settings.sync_type == SyncType::Written;
            let (maps, is_drive) = (&self.settings.maps, self.settings.channels.is_none());
            let touch_probe = self.settings.touch_probe;
            let mappable = (touch_probe, self.settings.offsets);
            let refusal = |objects: &Dictionary, object: Object, value: u32| match object {
                (0x1600..=0x1bff | 0x1c12 | 0x1c13, _) if is_fixed => Some(NO_ACCESS),
                (0x1c12 | 0x1c13, _) if matches!(maps, Maps::Fixed { .. }) => Some(READ_ONLY),
                (0x1600..=0x1bff, _) if !is_drive => Some(READ_ONLY),
                (0x1600..=0x1bff, 1..) if !process::is_mappable(mappable, value) => {
                    Some(NOT_MAPPABLE)
                }
                (0x1600..=0x1bff, 1..)
                    if *maps == Maps::Short && !objects.is_short(object, value) =>
                {
                    Some(TOO_LONG)
                }
                _ if process::is_refused(touch_probe, object, value) => Some(OUT_OF_RANGE),
                (0x1c32 | 0x1c33, 1) if !is_told => Some(READ_ONLY),
                _ => None,
            };
            self.mailbox
                .receive(&mut self.memory, &mut self.objects, &message, refusal);
        }
        true
    }

    /// A sync manager that is configured anew has an empty mailbox.
    fn clear_managers(&mut self, address: u16, end: usize) {
        for manager in 0..8 {
            let at = SYNC_MANAGER + 8 * manager;
            if usize::from(at) < end && address < at + 8 {
                self.memory.put(at + 5, &[0]);
            }
        }
    }

    fn has_odd_length(&self) -> bool {
        let length = |assigned| self.objects.mapped(assigned).1;
        [OUTPUTS_ASSIGNED, INPUTS_ASSIGNED]
            .into_iter()
            .any(|assigned| length(assigned) % 2 == 1)
    }

    /// The master asks for a state.
    fn request(&mut self, control: u8, now_ns: u64) {
        let (wanted, present) = (control & 15, self.state());
        let has_error = self.memory.byte(AL_STATUS) & ERROR != 0;
        if has_error && control & ERROR == 0 && wanted >= present {
            return;
        }
        let has_sync = self.next_sync.is_some();
        let is_odd = self.settings.maps == Maps::Short && self.has_odd_length();
        let objection = if self.settings.has_mailbox {
            states::objection(&self.memory, &self.objects, has_sync, wanted, present)
        } else {
            let channels = self.settings.channels.as_ref();
            states::simple_objection(&self.memory, channels, wanted, present)
        };
        let code = match objection {
            0 if wanted == SAFE_OP && is_odd => 0x1e,
            code => code,
        };
        if code != 0 {
            self.set_state(present | ERROR, code);
            return;
        }
        if present == OP && wanted != OP {
            self.lose_bus();
        }
        if wanted <= PRE_OP {
            self.mailbox.clear();
            self.next_sync = None;
        }
        if wanted == SAFE_OP && self.settings.channels.is_some() {
            self.show_inputs();
        } else if wanted == SAFE_OP {
            let sync_type = match self.settings.sync_type {
                SyncType::Written => None,
                SyncType::Follows => Some(if has_sync { 2 } else { 1 }),
                SyncType::Fixed(fixed) => Some(fixed),
            };
            if let Some(sync_type) = sync_type {
                self.objects.set(SYNC_OUTPUTS, sync_type.into());
                self.objects.set(SYNC_INPUTS, sync_type.into());
            }
            (self.outputs, _) = self.objects.mapped(OUTPUTS_ASSIGNED);
            (self.inputs, _) = self.objects.mapped(INPUTS_ASSIGNED);
            self.show_drives();
        }
        self.heard_ns = now_ns;
        self.set_state(wanted, 0);
        self.settle_pins(now_ns);
    }

    /// A datagram of the logical address space passes. Returns what is to be counted.
    pub(crate) fn exchange(
        &mut self,
        at: u32,
        data: &mut [u8],
        ways: (bool, bool),
        index: u8,
        now_ns: u64,
    ) -> u16 {
        let is_unknown = ways == (true, true) && self.settings.image != ImageAccess::Both;
        if self.state() < SAFE_OP || is_unknown {
            return 0;
        }
        // A device that fell out of OP does not take outputs any more.
        let takes_outputs = self.memory.byte(AL_STATUS) & ERROR == 0;
        let (was_read, was_written) =
            process::exchange(&mut self.memory, at, data, ways, takes_outputs);
        if was_written {
            (self.heard_ns, self.index) = (now_ns, index);
            self.memory.put(WATCHDOG_STATUS, &[1]);
            self.settle_pins(now_ns);
            if self.memory.byte(SYNC_ACTIVATION) & 3 != 3 {
                // Without SYNC0 a drive works with the frame.
                self.step(now_ns);
            }
        }
        let both = if ways.0 { 2 } else { 1 };
        u16::from(was_read) + if was_written { both } else { 0 }
    }
}
