//! The overrides as senders change them: by steps, faster than the machine answers.

use std::time::Duration;

use crate::real_time::Change;
use crate::{Act, MachineView};

const LEAST: i32 = 10;
const MOST: i32 = 200;
/// How long what was asked for counts more than what the machine says.
const ASKED: Duration = Duration::from_millis(500);

/// An override in percent, and when it was changed last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Percent {
    value: i32,
    asked: Option<Duration>,
}

impl Percent {
    const WHOLE: Self = Self {
        value: 100,
        asked: None,
    };

    fn follow(&mut self, ratio: f64, now: Duration) {
        let is_open = self
            .asked
            .is_some_and(|asked| now.saturating_sub(asked) < ASKED);
        if !is_open {
            self.asked = None;
            #[allow(
                clippy::cast_possible_truncation,
                reason = "overrides are a few hundred percent"
            )]
            let value = (ratio * 100.0).round() as i32;
            self.value = value;
        }
    }

    fn ask(&mut self, value: i32, now: Duration) -> bool {
        let is_new = self.value != value;
        (self.value, self.asked) = (value, Some(now));
        is_new
    }

    fn ratio(self) -> f64 {
        f64::from(self.value) / 100.0
    }
}

/// The overrides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Overrides {
    feed: Percent,
    rapid: Percent,
    spindle: Percent,
}

impl Overrides {
    pub(crate) const WHOLE: Self = Self {
        feed: Percent::WHOLE,
        rapid: Percent::WHOLE,
        spindle: Percent::WHOLE,
    };

    pub(crate) fn follow(&mut self, machine: &MachineView, now: Duration) {
        self.feed.follow(machine.feed_r, now);
        self.rapid.follow(machine.rapid_r, now);
        self.spindle.follow(machine.spindle_r, now);
    }

    pub(crate) fn change_feed(&mut self, change: Change, now: Duration, acts: &mut Vec<Act>) {
        let value = changed(self.feed.value, change);
        if self.feed.ask(value, now) {
            acts.push(Act::FeedOverride(self.feed.ratio()));
        }
    }

    pub(crate) fn set_rapid(&mut self, percent: u8, now: Duration, acts: &mut Vec<Act>) {
        if self.rapid.ask(percent.into(), now) {
            acts.push(Act::RapidOverride(self.rapid.ratio()));
        }
    }

    /// Inside what the machine allows, which refuses anything else.
    pub(crate) fn change_spindle(
        &mut self,
        change: Change,
        range: (i32, i32),
        now: Duration,
        acts: &mut Vec<Act>,
    ) {
        let value = changed(self.spindle.value, change).clamp(range.0, range.1.max(range.0));
        if self.spindle.ask(value, now) {
            acts.push(Act::SpindleOverride(self.spindle.ratio()));
        }
    }

    /// Puts all of them back to 100 %.
    pub(crate) fn reset(&mut self, now: Duration, acts: &mut Vec<Act>) {
        self.change_feed(Change::Whole, now, acts);
        self.set_rapid(100, now, acts);
        self.change_spindle(Change::Whole, (100, 100), now, acts);
    }

    pub(crate) const fn percents(&self) -> [i32; 3] {
        [self.feed.value, self.rapid.value, self.spindle.value]
    }
}

fn changed(value: i32, change: Change) -> i32 {
    match change {
        Change::Whole => 100,
        Change::By(by) => (value + by).clamp(LEAST, MOST),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spindle_is_asked_for_no_more_than_the_machine_allows() {
        let mut overrides = Overrides::WHOLE;
        let (mut acts, at) = (Vec::new(), Duration::from_millis);
        for _ in 0..4 {
            overrides.change_spindle(Change::By(10), (50, 120), at(0), &mut acts);
        }
        assert_eq!(acts, [Act::SpindleOverride(1.1), Act::SpindleOverride(1.2)]);
        overrides.change_spindle(Change::Whole, (50, 120), at(1), &mut acts);
        overrides.change_spindle(Change::By(-1), (50, 120), at(2), &mut acts);
        assert_eq!(overrides.percents(), [100, 100, 99]);
        // What the machine says counts later.
        let machine = MachineView {
            spindle_r: 0.8,
            ..MachineView::default()
        };
        overrides.follow(&machine, at(600));
        assert_eq!(overrides.percents()[2], 80);
        acts.clear();
        overrides.reset(at(601), &mut acts);
        assert_eq!(acts, [Act::SpindleOverride(1.0)]);
    }

    #[test]
    fn steps_add_up_before_the_machine_has_answered() {
        let mut overrides = Overrides::WHOLE;
        let (machine, mut acts) = (MachineView::default(), Vec::new());
        let at = Duration::from_millis;
        overrides.change_feed(Change::By(10), at(0), &mut acts);
        overrides.follow(&machine, at(1));
        overrides.change_feed(Change::By(1), at(2), &mut acts);
        assert_eq!(acts, [Act::FeedOverride(1.1), Act::FeedOverride(1.11)]);
        for _ in 0..50 {
            overrides.change_feed(Change::By(-10), at(3), &mut acts);
        }
        assert_eq!(overrides.percents()[0], 10);
        // What somebody else has set is what counts later.
        overrides.follow(&machine, at(600));
        assert_eq!(overrides.percents()[0], 100);
    }
}
