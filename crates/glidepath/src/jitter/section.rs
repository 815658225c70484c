//! The sections of a measurement: when the loop wakes, and when cyclictest does.
//!
//! Two threads that wake on one processor are not measured alike at any distance. One that wakes
//! shortly after the other finds the processor awake still; one that wakes together with the
//! kernel's own tick (on whole multiples of 1/HZ, 4 ms on many kernels) has to wait for it. At
//! arbitrary distances the medians of two idle loops differed by up to 18 µs on a virtual machine.
//!
//! ```text
//! kernel's tick    |               |               |          first half    second half
//! a quarter        |   ×           |   ×           |          cyclictest    loop
//! three quarters   |           ×   |           ×   |          loop          cyclictest
//! ```
//!
//! So one wakes a quarter of a period after the whole second and its divisions, the other three
//! quarters, half a period apart and neither with the tick, and after half the time they change
//! places. What is left of the difference of the two places counts for both. (With a period that
//! does not divide a second the places drift, but stay half a period apart.)

const NS_PER_S: u64 = 1_000_000_000;

/// A section of the measurement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Section {
    pub(super) seconds: u32,
    /// When the loop wakes and when cyclictest does, from a whole second.
    pub(super) offset_ns: u64,
    pub(super) cyclictest_offset_ns: u64,
}

/// The whole measurement: two halves with cyclictest, one section without.
pub(super) fn sections(seconds: u32, period_ns: u64, against_cyclictest: bool) -> Vec<Section> {
    // cyclictest takes whole µs.
    let quarter_ns = period_ns / 4 / 1_000 * 1_000;
    let (early, late) = (quarter_ns, quarter_ns + period_ns / 2);
    let section = |seconds, offset_ns, cyclictest_offset_ns| Section {
        seconds,
        offset_ns,
        cyclictest_offset_ns,
    };
    if against_cyclictest {
        let half = seconds / 2;
        let halves = [
            section(seconds - half, late, early),
            section(half, early, late),
        ];
        halves.into_iter().filter(|p| p.seconds > 0).collect()
    } else {
        vec![section(seconds, late, early)]
    }
}

impl Section {
    /// The first whole second after a time.
    pub(super) const fn whole_second_after(now_ns: u64) -> u64 {
        (now_ns / NS_PER_S + 1) * NS_PER_S
    }

    /// An origin at or after `earliest_ns` for a timer with a lead, so that the loop wakes at its
    /// place.
    pub(super) const fn origin_ns(&self, earliest_ns: u64, period_ns: u64, lead_ns: u64) -> u64 {
        let place_ns = self.offset_ns + lead_ns;
        // The place by the whole second before, and the periods from there on.
        let second_ns = earliest_ns / NS_PER_S * NS_PER_S;
        let from_place_ns = (earliest_ns + period_ns).saturating_sub(second_ns + place_ns);
        second_ns + place_ns + from_place_ns / period_ns * period_ns
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_wake_half_a_period_apart_and_change_places() {
        let [first, second] = sections(9, 4_000_000, true)[..] else {
            panic!("two halves")
        };
        assert_eq!((first.seconds, second.seconds), (5, 4));
        assert_eq!(first.offset_ns, 3_000_000);
        assert_eq!(first.cyclictest_offset_ns, 1_000_000);
        assert_eq!(
            (second.offset_ns, second.cyclictest_offset_ns),
            (first.cyclictest_offset_ns, first.offset_ns)
        );
        assert_eq!(sections(1, 4_000_000, true).len(), 1);
        assert_eq!(sections(9, 4_000_000, false).len(), 1);
    }

    #[test]
    fn the_loop_rises_at_its_place() {
        let section = Section {
            seconds: 1,
            offset_ns: 3_000,
            cyclictest_offset_ns: 1_000,
        };
        for earliest_ns in [
            5 * NS_PER_S,
            5 * NS_PER_S + 2_345,
            5 * NS_PER_S + 999_999_999,
        ] {
            let origin_ns = section.origin_ns(earliest_ns, 4_000, 100);
            assert_eq!((origin_ns - 100) % 4_000, 3_000);
            assert!((earliest_ns..=earliest_ns + 8_000).contains(&origin_ns));
        }
    }
}
