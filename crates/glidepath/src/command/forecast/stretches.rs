//! The stretches of a plan, each with what its time obeys.

use crate::report::Ahead;
use glidepath_program::{Frame, FrameFlags};

/// What the time of a frame obeys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Obeys {
    /// The feed override.
    Feed,
    /// The rapid override.
    Rapid,
    /// No override: a dwell.
    Clock,
}

/// How many kinds there are of them.
const KINDS: usize = 3;

/// Frames in a row that obey the same.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    /// The sequence of the first.
    from: u64,
    obeys: Obeys,
    /// How many frames of each kind are in front of it.
    before: [u64; KINDS],
}

/// The stretches of a plan, from its beginning.
#[derive(Debug, Default)]
pub(super) struct Stretches(Vec<Stretch>);

impl Stretches {
    /// Takes the next frame.
    pub(super) fn take(&mut self, frame: &Frame) {
        let obeys = if frame.flags.contains(FrameFlags::DWELL) {
            Obeys::Clock
        } else if frame.flags.contains(FrameFlags::RAPID) {
            Obeys::Rapid
        } else {
            Obeys::Feed
        };
        if self.0.last().is_none_or(|last| last.obeys != obeys) {
            self.0.push(Stretch {
                from: frame.sequence,
                obeys,
                before: self.before(frame.sequence),
            });
        }
    }

    /// How many there are.
    pub(super) const fn count(&self) -> usize {
        self.0.len()
    }

    /// How many frames of each kind are in front of one.
    fn before(&self, sequence: u64) -> [u64; KINDS] {
        let at = self
            .0
            .partition_point(|stretch| stretch.from <= sequence)
            .checked_sub(1)
            .and_then(|at| self.0.get(at));
        let Some(stretch) = at else {
            return [0; KINDS];
        };
        let mut before = stretch.before;
        before[stretch.obeys as usize] += sequence - stretch.from;
        before
    }

    /// What is to come from one frame to another one, with the period in s.
    #[allow(clippy::cast_precision_loss, reason = "counts of frames are exact")]
    pub(super) fn ahead(&self, from: u64, to: u64, period_t: f64) -> Ahead {
        let (done, all) = (self.before(from), self.before(to));
        let time = |kind: Obeys| {
            let kind = kind as usize;
            all[kind].saturating_sub(done[kind]) as f64 * period_t
        };
        Ahead {
            feed_t: time(Obeys::Feed),
            rapid_t: time(Obeys::Rapid),
            dwell_t: time(Obeys::Clock),
        }
    }
}
