//! A program that is planned with something changed, to see what it would bring: tolerance, jerk, feed. What runs
//! stays as it is.

use crate::config::MachineConfig;
use glidepath_link::TOLERANCE_RATIOS;
use glidepath_motion::PlanError;
use glidepath_planner::{FileSource, InputResult, ItemSource, Refusal, Settled, Supply};
use glidepath_program::{ItemKind, Rate};

/// What is changed: each is so many times what it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Change {
    pub(crate) tolerance: f64,
    pub(crate) jerk: f64,
    pub(crate) feed: f64,
}

impl Change {
    /// Nothing.
    pub(crate) const NONE: Self = Self {
        tolerance: 1.0,
        jerk: 1.0,
        feed: 1.0,
    };

    /// Whether it is one that is planned.
    pub(crate) fn is_in_range(&self) -> bool {
        let all = [self.tolerance, self.jerk, self.feed];
        all.iter().all(|ratio| TOLERANCE_RATIOS.contains(ratio))
    }

    /// Changes what a machine gives a plan.
    pub(crate) fn machine(&self, config: &mut MachineConfig) {
        config.use_tolerance_ratio(config.program.tolerance_ratio * self.tolerance);
        config.path.bounds.jerk_j *= self.jerk;
        for axis in &mut config.axes {
            axis.max_jerk *= self.jerk;
        }
        for joint in &mut config.joint_limits.0 {
            joint.jerk *= self.jerk;
        }
    }

    /// Changes what a program gives a plan. A move that follows the spindle stays: it would be another thread.
    fn item(&self, kind: &mut ItemKind) {
        let ItemKind::Move { rate, .. } = kind else {
            return;
        };
        match rate {
            Rate::Feed(feed_v)
            | Rate::FeedUpTo { feed_v, .. }
            | Rate::PerRevolution { feed_v, .. } => *feed_v *= self.feed,
            Rate::Rapid | Rate::RapidUpTo(_) | Rate::Synchronised(_) => {}
        }
    }
}

/// The items of a program, changed.
#[derive(Debug)]
pub(crate) struct Changed {
    pub(crate) source: FileSource,
    pub(crate) change: Change,
}

impl ItemSource for Changed {
    fn next_item(&mut self) -> Supply {
        let mut supply = self.source.next_item();
        if let Supply::Item(item) = &mut supply {
            self.change.item(&mut item.kind);
        }
        supply
    }

    fn is_silent(&mut self) -> bool {
        self.source.is_silent()
    }

    fn unplannable(&mut self, error: &PlanError) {
        self.source.unplannable(error);
    }

    fn settle(&mut self, known: Option<InputResult>) -> Result<Settled, Refusal> {
        self.source.settle(known)
    }

    fn lines_read(&self) -> u64 {
        self.source.lines_read()
    }

    fn fingerprint(&self) -> u64 {
        self.source.fingerprint()
    }

    fn is_on_contour(&self) -> bool {
        self.source.is_on_contour()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_geometry::{AxisVector, Line, Segment};
    use glidepath_program::PathMode;

    fn moved(rate: Rate) -> ItemKind {
        let mut end = AxisVector::zeros();
        end[0] = 1.0;
        ItemKind::Move {
            segment: Segment::Line(Line {
                start: AxisVector::zeros(),
                end,
            }),
            rate,
            mode: PathMode::Continuous { tolerance_mm: None },
        }
    }

    #[test]
    fn what_a_program_says_itself_is_changed_too() {
        let change = Change {
            tolerance: 2.0,
            jerk: 3.0,
            feed: 1.5,
        };
        for (rate, changed) in [
            (Rate::Feed(10.0), Rate::Feed(15.0)),
            (Rate::Rapid, Rate::Rapid),
            (Rate::Synchronised(4.0), Rate::Synchronised(4.0)),
        ] {
            let mut kind = moved(rate);
            change.item(&mut kind);
            assert_eq!(kind, moved(changed));
        }
        let mut config = crate::config::load(None).unwrap();
        let before = config.clone();
        change.machine(&mut config);
        let ratio = |now: f64, then: f64| (now / then * 1e6).round() / 1e6;
        assert_eq!(
            ratio(config.path.tolerance_mm, before.path.tolerance_mm).to_bits(),
            2.0_f64.to_bits()
        );
        let said = config.program_options(config.start()).tolerance_ratio;
        assert_eq!(said.to_bits(), 2.0_f64.to_bits());
        for (now, then) in config.axes.iter().zip(&before.axes) {
            assert_eq!(
                ratio(now.max_jerk, then.max_jerk).to_bits(),
                3.0_f64.to_bits()
            );
        }
    }

    #[test]
    fn a_change_out_of_range_is_none() {
        assert!(Change::NONE.is_in_range());
        for ratio in [0.0, -1.0, 0.09, 10.1, f64::NAN, f64::INFINITY] {
            let change = Change {
                feed: ratio,
                ..Change::NONE
            };
            assert!(!change.is_in_range(), "{ratio}");
        }
    }
}
