//! The registers of time of a device: what the ports note, its clock, and SYNC0.

use super::Device;
use crate::clock::ClockKind;
use crate::memory::{
    LATCHED_TIME, PORT_TIMES, SYNC_ACTIVATION, SYNC_START, SYNC0_CYCLE, TIME_DELAY,
    TIME_DIFFERENCE, TIME_OFFSET,
};

impl Device {
    #[allow(
        clippy::cast_precision_loss,
        clippy::cast_possible_wrap,
        reason = "times of a session; the offset is a signed number"
    )]
    pub(super) fn offset_ns(&self) -> f64 {
        self.memory.number(TIME_OFFSET, self.clock_bytes()) as i64 as f64
    }

    /// Bytes of its registers of time that it has: the others are zero.
    pub(super) const fn clock_bytes(&self) -> usize {
        match self.settings.clock {
            ClockKind::Bits32 => 4,
            _ => 8,
        }
    }

    pub(super) fn system_ns(&self, now_ns: u64) -> f64 {
        self.clock.local_ns(now_ns) + self.offset_ns()
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a register wraps"
    )]
    pub(super) fn system_register(&self, now_ns: u64) -> u64 {
        self.as_told(self.system_ns(now_ns) as i64 as u64)
    }

    /// A time as a register of this device shows it.
    pub(super) const fn as_told(&self, time_ns: u64) -> u64 {
        match self.settings.clock {
            ClockKind::Bits32 => time_ns & 0xffff_ffff,
            _ => time_ns,
        }
    }

    /// A frame comes by that has every port note when it came in, and the device when it read it.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "registers wrap"
    )]
    pub(super) fn latch_times(&mut self, now_ns: u64) {
        let first_ns = now_ns.saturating_sub(self.passage.read_ns);
        for (at, port_ns) in (PORT_TIMES..).step_by(4).zip(self.passage.ports_ns) {
            if let Some(port_ns) = port_ns {
                let local_ns = self.clock.local_ns(first_ns + port_ns) as u64 as u32;
                self.memory.put(at, &local_ns.to_le_bytes());
            }
        }
        let local_ns = self.as_told(self.clock.local_ns(now_ns) as u64);
        self.memory.put(LATCHED_TIME, &local_ns.to_le_bytes());
    }

    /// The time of the reference clock comes by.
    #[allow(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_possible_wrap,
        reason = "differences of nanoseconds"
    )]
    pub(super) fn follow(&mut self, reference: &[u8], now_ns: u64) {
        // Only the low half of what comes by is compared.
        let Some(low) = reference.first_chunk::<4>() else {
            return;
        };
        let own = self.system_register(now_ns) as u32;
        let told = u32::from_le_bytes(*low).wrapping_add(self.memory.number(TIME_DELAY, 4) as u32);
        let ahead = told.wrapping_sub(own) as i32;
        // Sign and magnitude: bit 31 says that this clock is ahead.
        let sign = u32::from(ahead < 0) << 31;
        let difference = sign | ahead.unsigned_abs().min(0x7fff_ffff);
        self.memory.put(TIME_DIFFERENCE, &difference.to_le_bytes());
        let since_t = now_ns.saturating_sub(self.followed_ns) as f64 * 1e-9;
        self.followed_ns = now_ns;
        self.clock.follow(now_ns, ahead.into(), since_t);
    }

    /// SYNC0 begins at its start time: never, for hundreds of years, if that is past; with a clock of 32
    /// bits when that has gone round.
    #[allow(clippy::cast_precision_loss, reason = "times of a session")]
    pub(super) fn activate_sync(&mut self, now_ns: u64) {
        let is_active = self.memory.byte(SYNC_ACTIVATION) & 3 == 3;
        let start = self.memory.number(SYNC_START, self.clock_bytes());
        let has_cycle = self.memory.number(SYNC0_CYCLE, 4) > 0;
        let ahead_ns = start
            .wrapping_sub(self.system_register(now_ns))
            .cast_signed();
        let ahead_ns = match self.settings.clock {
            ClockKind::Bits32 => ahead_ns & 0xffff_ffff,
            _ => ahead_ns,
        };
        self.next_sync = (is_active && has_cycle && ahead_ns > 0)
            .then(|| self.system_ns(now_ns).floor() + ahead_ns as f64);
        self.stepped_ns = now_ns;
    }
}
