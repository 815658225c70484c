//! Tests of an encoder, frame by frame.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    reason = "tests: a counter wraps"
)]

use super::*;
use bytemuck::Zeroable as _;

const PERIOD_NS: u64 = 2_000_000;
const DELAY_NS: u64 = 3_000_000;

/// An encoder of 1000 counts whose counter has 16 bits; the index is at 300.
struct Bench {
    encoder: Encoder,
    events: Vec<Event>,
    now_ns: u64,
    armed: bool,
    valid: bool,
    kept: i64,
    last: i64,
    slip: i64,
}

fn bench(is_inverted: bool) -> Bench {
    let settings = EncoderSettings {
        counts_per_rev: 1000,
        has_index: true,
        is_inverted,
        near_r: 0.03,
    };
    let index = WiredIndex {
        latch: 24,
        valid: 0,
        arm: 3,
    };
    let wired = WiredEncoder {
        settings,
        nth: 0,
        counter: (8, 16),
        index: Some(index),
    };
    Bench {
        encoder: Encoder::new(wired, DELAY_NS),
        events: Vec::new(),
        now_ns: 1_000_000_000,
        armed: false,
        valid: false,
        kept: 0,
        last: 0,
        slip: 0,
    }
}

impl Bench {
    /// A frame in which the spindle is at so many counts.
    fn frame(&mut self, counts: i64) -> Feedback {
        self.frame_of(counts, self.now_ns - PERIOD_NS / 4)
    }

    /// The same; what is told is of another moment.
    fn frame_of(&mut self, counts: i64, moment_ns: u64) -> Feedback {
        let (from, to) = (self.last.min(counts), self.last.max(counts));
        let pulse = (to - 300).div_euclid(1000) * 1000 + 300;
        if self.armed && !self.valid && pulse > from {
            (self.valid, self.kept) = (true, pulse + self.slip);
        }
        self.last = counts;
        let word = |count: i64| (count as u16).to_le_bytes();
        let (counter, kept) = (word(counts + self.slip), word(self.kept));
        let inputs = [
            u8::from(self.valid),
            counter[0],
            counter[1],
            kept[0],
            kept[1],
        ];
        let events = &mut self.events;
        self.encoder
            .hear(Some(&inputs), self.now_ns, &mut |event| events.push(event));
        let mut image = [0];
        self.encoder.put(&mut image, 10.0);
        self.armed = image[0] == 8;
        self.valid &= self.armed;
        let mut feedback = Feedback {
            sample_ns: moment_ns - DELAY_NS,
            ..Feedback::zeroed()
        };
        self.now_ns += PERIOD_NS;
        self.encoder.tell(&mut feedback, false);
        feedback
    }
}

#[test]
fn the_angle_is_whole_at_the_index_over_wraps_either_way() {
    for way in [20, -20] {
        let mut bench = bench(way < 0);
        let mut counts = 30_000;
        let mut said = bench.frame(counts);
        assert_eq!(said.spindle_flags, 0);
        for _ in 0..20_000 {
            counts += way;
            said = bench.frame(counts);
        }
        assert!(bench.events.is_empty(), "{:?}", bench.events);
        assert!(said.spindle().contains(SpindleFlags::INDEX));
        assert!(said.spindle().contains(SpindleFlags::AT_SPEED));
        assert!((said.spindle_v - 10.0).abs() < 1e-6, "{}", said.spindle_v);
        // A quarter of a period older than the frame, of a spindle that turns clockwise.
        let exact = (counts - way / 4 - 300) as f64 / way.signum() as f64 / 1000.0;
        let off = said.spindle_angle - exact;
        assert!((off - off.round()).abs() < 1e-9, "{off}");
        // 400 revolutions, the first of them without an index.
        let pulses = said.spindle_index_count;
        assert!((398..=400).contains(&pulses), "{pulses}");
    }
}

#[test]
fn frames_that_are_sent_late_change_nothing_of_the_angle() {
    // In turns in time, late by more than the age of what is told, and by almost a period.
    let late_ns = [0, 0, 900_000, 0, 1_900_000, 1_800_000, 0];
    let mut bench = bench(false);
    let mut said = Vec::new();
    for k in 0..1000_u64 {
        let late_ns = late_ns[k as usize % late_ns.len()];
        let meant_ns = bench.now_ns;
        bench.now_ns += late_ns;
        let counts = (k * PERIOD_NS + late_ns) / 100_000;
        let told = bench.frame_of(counts as i64, meant_ns - PERIOD_NS / 4);
        bench.now_ns = meant_ns + PERIOD_NS;
        said.extend((told.spindle_flags != 0).then_some(told));
    }
    assert!(said.len() > 900);
    for pair in said.windows(2) {
        let t = (pair[1].sample_ns - pair[0].sample_ns) as f64 * 1e-9;
        let speed_v = (pair[1].spindle_angle - pair[0].spindle_angle) / t;
        assert!((speed_v - 10.0).abs() < 0.01, "{speed_v}");
    }
}

#[test]
fn a_counter_that_loses_counts_is_told_and_not_followed() {
    let mut bench = bench(false);
    let mut counts = 0;
    for _ in 0..500 {
        counts += 20;
        let _said = bench.frame(counts);
    }
    bench.slip = -3;
    let mut silent = 0;
    for _ in 0..1000 {
        counts += 20;
        silent += u32::from(bench.frame(counts).spindle_flags == 0);
    }
    assert_eq!(bench.events, [Event::EncoderSlipped(-3)]);
    // Half a second, and until the index comes again.
    assert!((250..=320).contains(&silent), "{silent}");
}

#[test]
fn pulses_that_stay_away_are_not_counted() {
    let mut bench = bench(false);
    let mut counts = 0;
    let mut said = bench.frame(counts);
    for _ in 0..500 {
        counts += 20;
        said = bench.frame(counts);
    }
    let before = said.spindle_index_count;
    bench.armed = false;
    for _ in 0..500 {
        counts += 20;
        bench.valid = false;
        bench.armed = false;
        said = bench.frame(counts);
    }
    let more = said.spindle_index_count - before;
    assert!((3..=5).contains(&more), "{more}");
}
