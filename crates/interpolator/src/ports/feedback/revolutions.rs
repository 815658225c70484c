//! Feed per revolution (G95): the motion goes on as fast as the spindle turns.
//!
//! Such a move is planned for the speed that the spindle was told. While one is under way, the
//! measured speed in parts of that is a factor of the overrides, as an adaptive feed is; never above
//! 1, since the plan is the fastest that was judged. The factor goes in steps, or the search for a
//! ramp would never come to rest.

use crate::shared::message::TickReport;
use crate::shared::message::observation::Turn;
use glidepath_link::EventRecord;
use glidepath_program::{Event, FrameFlags};

/// Least change of the factor, in parts of it, but for those to 0 and 1: half of what a feed per
/// revolution may be off.
const STEP: f64 = 0.01;
/// As much below its speed the spindle is taken to have it.
const NEAR: f64 = 0.01;
/// A spindle that is slower than this part of what it was told stands.
const STANDING: f64 = 0.05;

/// Follows the speed of the spindle.
#[derive(Debug)]
pub(super) struct RevolutionWatch {
    stale_ns: u64,
    /// The speed that the spindle was told, rev/s.
    told_v: f64,
    /// The motion is at a feed per revolution.
    is_on: bool,
    factor: f64,
    /// Why the motion is held, as long as nobody was told.
    news: Option<&'static str>,
}

impl RevolutionWatch {
    pub(super) const fn new(stale_ns: u64) -> Self {
        Self {
            stale_ns,
            told_v: 0.0,
            is_on: false,
            factor: 1.0,
            news: None,
        }
    }

    /// Takes note of a setpoint: what it tells the spindle, and whether it is of such a move.
    pub(super) fn note(&mut self, report: &TickReport) {
        let setpoint = &report.setpoint;
        for event in setpoint.events().iter().flat_map(EventRecord::event) {
            if let Event::SpindleSpeed(per_min) = event {
                self.told_v = per_min / 60.0;
            }
        }
        self.is_on = setpoint.has(FrameFlags::PER_REV);
    }

    /// The factor of the rate of program time now, 0 to 1. Back along the path nothing is cut, and
    /// the spindle may stand.
    pub(super) fn factor(&mut self, turn: &Turn, is_back: bool, now_ns: u64) -> f64 {
        if is_back || !self.is_on {
            self.factor = 1.0;
            return 1.0;
        }
        let held = |why| (0.0, Some(why));
        let age_ns = now_ns.saturating_sub(turn.sample_ns);
        let (wanted, why) = if self.told_v <= 0.0 {
            held("the feed per revolution (G95) waits: the spindle was told no speed (S)")
        } else if age_ns > self.stale_ns || !turn.is_settled {
            held("the feed per revolution (G95) waits: nobody tells the angle of the spindle")
        } else if turn.speed.abs() < STANDING * self.told_v {
            held("the feed per revolution (G95) waits for the spindle, which stands")
        } else {
            let part = turn.speed.abs() / self.told_v;
            (if part > 1.0 - NEAR { 1.0 } else { part }, None)
        };
        let is_end = wanted <= 0.0 || wanted >= 1.0;
        if is_end || (wanted - self.factor).abs() >= STEP * wanted {
            if self.factor > 0.0 && why.is_some() {
                self.news = why;
            }
            self.factor = wanted;
        }
        self.factor
    }

    /// Why the motion is held, once.
    pub(super) const fn take_news(&mut self) -> Option<&'static str> {
        self.news.take()
    }

    /// The factor as it was told last.
    pub(super) const fn told(&self) -> f64 {
        self.factor
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: u64 = 1_000_000;

    fn watch(per_min: f64) -> RevolutionWatch {
        let mut watch = RevolutionWatch::new(12 * MS);
        let mut report = TickReport::blank();
        report.setpoint.silence();
        let speed = EventRecord::new(Event::SpindleSpeed(per_min), 0);
        assert!(report.setpoint.tell(speed));
        watch.note(&report);
        report = TickReport::blank();
        report.setpoint.flags = FrameFlags::PER_REV.0;
        watch.note(&report);
        watch
    }

    fn turning(speed: f64) -> Turn {
        Turn {
            sample_ns: 100 * MS,
            speed,
            is_settled: true,
            ..Turn::NONE
        }
    }

    fn factor(per_min: f64, turn: Turn, ms: u64) -> (f64, bool) {
        let mut watch = watch(per_min);
        (
            watch.factor(&turn, false, ms * MS),
            watch.take_news().is_some(),
        )
    }

    #[test]
    fn the_speed_is_a_factor_and_silence_a_hold_that_is_told_of() {
        let near = |(found, is_told): (f64, bool), wanted: f64| {
            assert!((found - wanted).abs() < 1e-12, "{found}, {wanted}");
            assert_eq!(is_told, wanted <= 0.0, "{wanted}");
        };
        near(factor(600.0, turning(7.0), 101), 0.7);
        near(factor(600.0, turning(-7.0), 101), 0.7);
        near(factor(600.0, turning(9.95), 101), 1.0);
        near(factor(600.0, turning(12.0), 101), 1.0);
        near(factor(600.0, turning(0.4), 101), 0.0);
        near(factor(0.0, turning(7.0), 101), 0.0);
        near(factor(600.0, turning(7.0), 113), 0.0);
        let unsettled = Turn {
            is_settled: false,
            ..turning(7.0)
        };
        near(factor(600.0, unsettled, 101), 0.0);
        near(factor(600.0, Turn::NONE, 101), 0.0);
    }

    #[test]
    fn noise_is_no_change_and_what_is_no_such_move_is_left_alone() {
        let mut watch = watch(600.0);
        let mut changes = 0;
        let mut before = 1.0;
        for k in 0..1000 {
            let noise = 0.0005 * f64::from((k * 7919) % 100 - 50);
            let factor = watch.factor(&turning(7.0 + noise), false, 101 * MS);
            changes += u32::from((factor - before).abs() > 0.0);
            before = factor;
        }
        assert_eq!(changes, 1);
        assert!(watch.take_news().is_none());
        // Nor does the way back wait for it.
        assert!((watch.factor(&turning(0.0), true, 101 * MS) - 1.0).abs() < 1e-12);
        watch.note(&TickReport::blank());
        assert!((watch.factor(&turning(1.0), false, 101 * MS) - 1.0).abs() < 1e-12);
    }
}
