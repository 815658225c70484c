//! The bus clock: the time of the bus by the clock of this host.
//!
//! SYNC0 comes by the quartz of the reference drive, and the host wakes by its own. Every answer tells
//! what time it was on the bus when the frame passed the reference, which was about the middle between
//! sending and receiving. From that a loop follows offset and rate:
//!
//! ```text
//! offset ← predicted + 1/16 error        rate ← rate + 1/2048 error / period
//! ```
//!
//! A frame that was long under way says little about the middle, so only round trips near to the
//! shortest of late count. What is asked of the clock is when to send and what time the frame takes
//! effect: SYNC0 number n is at the start of SYNC0 plus n periods.
//!
//! Targets are taken at those times, so their jitter is one of the motion: at 150 mm/s and 1 ms the
//! third difference of 2 ns is 1 % of a jerk of 40 000 mm/s³, and what one answer moves the loop by is
//! some hundred. Hence times are told by a follower of the loop, whose rate bends and never jumps:
//!
//! ```text
//! rate' ← rate' + period (ω² (offset − offset') + 2 ω (rate − rate'))       ω = 5 /s
//! ```

use crate::settings::BusSettings;

/// When a frame was sent and received, by the host, and when it passed the reference, by the bus.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FrameTimes {
    /// ns of `CLOCK_MONOTONIC`.
    pub sent_ns: u64,
    /// ns of `CLOCK_MONOTONIC`.
    pub received_ns: u64,
    /// ns of the bus.
    pub bus_ns: u64,
}

/// One cycle: when to send, what for, and how long to wait for the answer. ns of `CLOCK_MONOTONIC`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Beat {
    /// Counts the SYNC0.
    pub number: u64,
    /// When the frame is to be sent.
    pub send_ns: u64,
    /// The SYNC0 at which it takes effect.
    pub sync_ns: u64,
    /// When an answer is not waited for any more.
    pub give_up_ns: u64,
    /// Cycles left out before this one, because they are past.
    pub missed: u64,
}

const OFFSET_SHARE: f64 = 1.0 / 16.0;
const RATE_SHARE: f64 = 1.0 / 2048.0;
/// How far above the shortest of late a round trip may be to count.
const ROUND_TRIP_RATIO: f64 = 1.25;
const ROUND_TRIP_NS: f64 = 10_000.0;
/// How fast the shortest is forgotten, a cycle.
const FORGETTING: f64 = 1.002;
/// Answers after which the loop has found the offset.
const SETTLED: u32 = 100;
/// ω of the follower, 1/ns: what an answer changes is there after some tenths of a second.
const FOLLOWING: f64 = 5e-9;
/// A follower that was left alone for so long, ns, begins anew.
const ALONE_NS: f64 = 1e8;
/// A rate beyond this is no quartz: 0.1 %.
const RATE_MOST: f64 = 1e-3;

/// The time of the bus less that of the host, as far as it is known.
#[derive(Debug, Clone, Copy)]
struct Line {
    offset_ns: f64,
    /// How fast that grows, 1.
    rate: f64,
    /// When that was so, ns of the host.
    at_ns: u64,
}

impl Line {
    fn offset_at(&self, host_ns: u64) -> f64 {
        self.offset_ns + self.rate * difference(host_ns, self.at_ns)
    }

    fn host_of(&self, bus_ns: u64) -> u64 {
        // The rate is so small that the offset of about then is good enough.
        let about = shifted(bus_ns, -self.offset_ns);
        shifted(bus_ns, -self.offset_at(about))
    }
}

/// The loop, its follower, and the grid of SYNC0.
#[derive(Debug, Clone)]
pub struct BusClock {
    period_ns: u64,
    shift_ns: u64,
    start_ns: u64,
    heard_of: Line,
    told: Line,
    shortest_ns: f64,
    heard: u32,
    /// The SYNC0 that was sent for last.
    number: Option<u64>,
}

#[allow(
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    reason = "differences of clocks: minutes at most"
)]
const fn difference(later: u64, earlier: u64) -> f64 {
    later.wrapping_sub(earlier) as i64 as f64
}

#[allow(clippy::cast_possible_truncation, reason = "an offset of clocks")]
const fn shifted(time_ns: u64, by_ns: f64) -> u64 {
    time_ns.saturating_add_signed(by_ns as i64)
}

impl BusClock {
    /// A clock of a bus whose SYNC0 begins at `start_ns` by its own time, which was set by that of
    /// the host.
    #[must_use]
    pub const fn new(settings: &BusSettings, start_ns: u64, now_ns: u64) -> Self {
        let line = Line {
            offset_ns: 0.0,
            rate: 0.0,
            at_ns: now_ns,
        };
        Self {
            period_ns: settings.period_ns,
            shift_ns: settings.shift_ns,
            start_ns,
            heard_of: line,
            told: line,
            shortest_ns: f64::INFINITY,
            heard: 0,
            number: None,
        }
    }

    /// Time between two SYNC0, ns.
    #[must_use]
    pub const fn period_ns(&self) -> u64 {
        self.period_ns
    }

    /// Whether the loop has found the offset.
    #[must_use]
    pub const fn is_settled(&self) -> bool {
        self.heard >= SETTLED
    }

    /// Deviation of the reference's quartz from the clock of the host, 1.
    #[must_use]
    pub const fn rate(&self) -> f64 {
        self.heard_of.rate
    }

    /// Takes in an answer.
    #[allow(clippy::cast_precision_loss, reason = "a period")]
    pub fn hear(&mut self, times: FrameTimes) {
        let trip_ns = difference(times.received_ns, times.sent_ns).max(1.0);
        self.shortest_ns = (self.shortest_ns * FORGETTING).min(trip_ns);
        if trip_ns > self.shortest_ns * ROUND_TRIP_RATIO + ROUND_TRIP_NS {
            return;
        }
        let middle_ns = times.sent_ns.midpoint(times.received_ns);
        let predicted = self.heard_of.offset_at(middle_ns);
        let error = difference(times.bus_ns, middle_ns) - predicted;
        self.heard = self.heard.saturating_add(1);
        // The first ones say nearly all; then it is a matter of averaging.
        let share = (1.0 / f64::from(self.heard)).max(OFFSET_SHARE);
        self.heard_of.offset_ns = predicted + share * error;
        if self.is_settled() {
            let rate = self.heard_of.rate + RATE_SHARE * error / self.period_ns as f64;
            self.heard_of.rate = rate.clamp(-RATE_MOST, RATE_MOST);
        }
        self.heard_of.at_ns = middle_ns;
    }

    /// What is told follows what is known, up to now.
    fn follow(&mut self, now_ns: u64) {
        let since_ns = difference(now_ns, self.told.at_ns);
        if !self.is_settled() || since_ns > ALONE_NS {
            self.told = self.heard_of;
            return;
        }
        let offset_ns = self.told.offset_at(now_ns);
        let bend = FOLLOWING * (self.heard_of.offset_at(now_ns) - offset_ns)
            + 2.0 * (self.heard_of.rate - self.told.rate);
        self.told = Line {
            offset_ns,
            rate: self.told.rate + FOLLOWING * since_ns * bend,
            at_ns: now_ns,
        };
    }

    /// The next cycle that can still be sent for.
    pub fn next(&mut self, now_ns: u64) -> Beat {
        self.follow(now_ns);
        let bus_now_ns = shifted(now_ns, self.told.offset_at(now_ns));
        let wanted = self.number.map_or(0, |number| number + 1);
        // A frame that is sent late by half of what there is until SYNC0 still gets there.
        let late_ns = self.shift_ns / 2;
        let since_ns = (bus_now_ns + self.shift_ns).saturating_sub(self.start_ns + late_ns);
        let number = wanted.max(since_ns.div_ceil(self.period_ns));
        let missed = self.number.map_or(0, |_| number - wanted);
        self.number = Some(number);
        let sync_ns = self.told.host_of(self.start_ns + number * self.period_ns);
        let send_ns = sync_ns.saturating_sub(self.shift_ns);
        Beat {
            number,
            send_ns,
            sync_ns,
            give_up_ns: send_ns + self.period_ns * 3 / 4,
            missed,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cycles of a bus that runs at another rate, with answers as quick as `trip_ns` says; the
    /// largest error of a beat in the last half.
    fn worst_ns(rate: f64, cycles: u64, trip_ns: impl Fn(u64) -> (u64, u64)) -> f64 {
        let settings = BusSettings::default();
        let start_ns = 9_000_000_000_000;
        #[allow(clippy::cast_precision_loss, reason = "a test of seconds")]
        let bus_of = |host_ns: u64| {
            let since = difference(host_ns, start_ns);
            shifted(start_ns, since * (1.0 + rate) + 300_000.0)
        };
        let mut clock = BusClock::new(&settings, start_ns + 50_000_000, start_ns);
        let (mut now_ns, mut worst) = (start_ns, 0.0_f64);
        for cycle in 0..cycles {
            let beat = clock.next(now_ns);
            let (out_ns, back_ns) = trip_ns(cycle);
            now_ns = beat.send_ns.max(now_ns);
            clock.hear(FrameTimes {
                sent_ns: now_ns,
                received_ns: now_ns + out_ns + back_ns,
                bus_ns: bus_of(now_ns + out_ns),
            });
            now_ns += out_ns + back_ns;
            let sync = start_ns + 50_000_000 + beat.number * settings.period_ns;
            if cycle > cycles / 2 {
                worst = worst.max(difference(bus_of(beat.sync_ns), sync).abs());
            }
        }
        worst
    }

    #[test]
    fn it_follows_a_quartz_that_runs_wrong() {
        for rate in [0.0, 1e-4, -1e-4] {
            let worst = worst_ns(rate, 10_000, |_| (20_000, 20_000));
            assert!(worst < 100.0, "{rate}: {worst} ns");
        }
    }

    #[test]
    fn what_was_long_under_way_does_not_count() {
        let worst = worst_ns(5e-5, 10_000, |cycle| {
            let back = if cycle % 7 == 3 { 900_000 } else { 20_000 };
            (20_000, back)
        });
        assert!(worst < 100.0, "{worst} ns");
    }

    #[test]
    fn the_times_of_sync0_have_no_jitter() {
        // 1 ms, and answers that are as unequally quick as those of a busy host's.
        let settings = BusSettings {
            period_ns: 1_000_000,
            shift_ns: 500_000,
            ..BusSettings::default()
        };
        let start_ns = 9_000_000_000_000;
        let mut clock = BusClock::new(&settings, start_ns, start_ns);
        let (mut now_ns, mut random) = (start_ns, 1_u64);
        let mut times = Vec::new();
        for _ in 0..20_000 {
            let beat = clock.next(now_ns);
            random = random
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            let (out_ns, back_ns) = (
                5_000 + (random >> 33) % 7_000,
                5_000 + (random >> 45) % 7_000,
            );
            now_ns = beat.send_ns.max(now_ns);
            clock.hear(FrameTimes {
                sent_ns: now_ns,
                received_ns: now_ns + out_ns + back_ns,
                bus_ns: now_ns + out_ns + (now_ns - start_ns) / 20_000,
            });
            now_ns += out_ns + back_ns;
            times.push(beat.sync_ns);
        }
        let third = |t: &[u64]| difference(t[3], t[0]) - 3.0 * difference(t[2], t[1]);
        // After two seconds. Whole nanoseconds alone make up to 4.
        let worst = times.windows(4).skip(2_000).map(|t| third(t).abs());
        let worst = worst.fold(0.0, f64::max);
        assert!(worst <= 5.0, "{worst} ns");
    }

    #[test]
    fn cycles_that_are_past_are_left_out() {
        let settings = BusSettings::default();
        let mut clock = BusClock::new(&settings, 100_000_000, 0);
        assert_eq!(clock.next(0).number, 0);
        let late = clock.next(104_300_000);
        assert_eq!((late.number, late.missed), (3, 2));
        assert_eq!((late.send_ns, late.sync_ns), (105_000_000, 106_000_000));
    }
}
