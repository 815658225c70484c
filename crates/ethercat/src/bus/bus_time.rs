//! The time of the bus, as the reference tells it.

use crate::device::ClockKind;

/// The time of the reference. Where its clock has 32 bits, which begin anew every 4.3 s, the rest is
/// counted here: it is heard far more often.
#[derive(Debug, Clone, Copy)]
pub(super) struct BusTime {
    kind: ClockKind,
    now_ns: u64,
}

impl BusTime {
    /// The time of a reference that is set to about `near_ns`, to 2 s.
    pub(super) const fn new(kind: ClockKind, near_ns: u64) -> Self {
        Self {
            kind,
            now_ns: near_ns,
        }
    }

    /// What it was when the reference told it last, ns.
    pub(super) const fn now_ns(self) -> u64 {
        self.now_ns
    }

    /// The reference tells the time: its register.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        reason = "the low half, which wraps"
    )]
    pub(super) const fn hear(&mut self, register: [u8; 8]) {
        let told = u64::from_le_bytes(register);
        self.now_ns = match self.kind {
            ClockKind::Bits32 => {
                let since = (told as u32).wrapping_sub(self.now_ns as u32) as i32;
                self.now_ns.wrapping_add_signed(since as i64)
            }
            _ => told,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_of_32_bits_goes_on_where_its_register_begins_anew() {
        let mut time = BusTime::new(ClockKind::Bits32, 0x7_ffff_fff0);
        let mut hear = |low: u32, above: u32| {
            let told = u64::from(low) | u64::from(above) << 32;
            time.hear(told.to_le_bytes());
            time.now_ns()
        };
        assert_eq!(hear(0xffff_fe00, 0), 0x7_ffff_fe00);
        assert_eq!(hear(0x20, 0), 0x8_0000_0020);
        // What is above is not of the clock.
        assert_eq!(hear(0x7000_0000, 99), 0x8_7000_0000);
        let mut time = BusTime::new(ClockKind::Bits64, 5);
        time.hear(77_u64.to_le_bytes());
        assert_eq!(time.now_ns(), 77);
    }
}
