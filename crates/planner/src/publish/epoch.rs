//! The books of one epoch under way, from its first frame to its last, as the planner keeps them.

use std::time::Duration;

use glidepath_link::SetpointFrame;
use glidepath_program::Event;

use crate::exchange::machine::Standing;
use crate::run::control::Progress;
use crate::run::interval::Interval;
use crate::run::refusal::Refusal;
use crate::run::statistics::Statistics;

/// Between two signs of life of a planner without frames.
const HEARTBEAT: Duration = Duration::from_millis(200);

/// Frames beyond the horizon for an interpolator that cannot go on with what it has.
const MORE_FRAMES: u64 = 8;

/// How far to plan ahead of what is published. A host whose cores are all taken by others keeps the
/// planner from running for tenths of a second, and a stretch that is hard to plan takes as long:
/// this is many times as much. What is beyond it would be planned for nothing whenever an override
/// changes.
const AHEAD: Duration = Duration::from_secs(10);

/// The same in frames where periods are short: 5 MB.
const MOST_AHEAD: usize = 16 * 1024;

/// The pace of frames.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// Interpolation period, ns; must be the interpolator's.
    pub period_ns: u64,
    /// How far to be ahead of the executed frame, frames, at least 1.
    pub horizon_frames: u64,
}

impl Pace {
    /// A pace of `horizon_t` seconds, rounded up to whole periods.
    #[must_use]
    pub fn new(period_ns: u64, horizon_t: f64) -> Self {
        #[allow(clippy::cast_precision_loss, reason = "periods are below 2^53 ns")]
        let frames = (horizon_t * 1e9 / period_ns as f64).ceil();
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the cast saturates, and a negative or undefined horizon becomes one frame"
        )]
        Self {
            period_ns,
            horizon_frames: (frames as u64).max(1),
        }
    }

    /// How many frames to have before the first is published: with as many, no interpolator waits
    /// for more before it moves.
    pub(crate) fn head_start(&self) -> usize {
        usize::try_from(self.horizon_frames.saturating_mul(3) / 4).unwrap_or(usize::MAX)
    }

    /// How far to plan ahead of what is published, frames.
    pub(crate) fn frames_ahead(&self) -> usize {
        let frames = AHEAD.as_nanos() / u128::from(self.period_ns.max(1));
        usize::try_from(frames).map_or(MOST_AHEAD, |frames| frames.min(MOST_AHEAD))
    }
}

/// The books of an epoch.
#[derive(Debug)]
pub(crate) struct Epoch {
    /// The life of the interpolator that executes it.
    pub(crate) boot_id: u64,
    pub(crate) number: u64,
    /// The program goes on in it, behind another.
    pub(crate) goes_on: bool,
    /// Planned, but not yet in the interpolator's queue.
    pub(crate) in_hand: Option<SetpointFrame>,
    /// The frame delivered last.
    pub(crate) last: Option<SetpointFrame>,
    /// Set when the pipeline has no more frames.
    pub(crate) ended: Option<Result<(), Refusal>>,
    /// Since something was offered.
    pub(crate) since_offer: Interval,
    /// Time waited since the last notice of progress.
    pub(crate) since_progress: Duration,
    horizon_frames: u64,
    delivered: u64,
    standing: Standing,
}

impl Epoch {
    pub(crate) fn new(boot_id: u64, number: u64, horizon_frames: u64) -> Self {
        Self {
            boot_id,
            number,
            goes_on: false,
            in_hand: None,
            last: None,
            ended: None,
            since_offer: Interval::new(HEARTBEAT),
            since_progress: Duration::ZERO,
            horizon_frames,
            delivered: 0,
            standing: Standing::NotStarted,
        }
    }

    /// Learns how the interpolator sees it.
    pub(crate) const fn follow(&mut self, standing: Standing) {
        self.standing = standing;
    }

    /// The frame in hand has arrived.
    pub(crate) fn delivered(&mut self) {
        self.last = self.in_hand.take();
        self.since_offer.restart();
        self.delivered += 1;
    }

    /// Whether every frame at hand was executed, and the last one has an M code at rest.
    pub(crate) fn rests_at_m_code(&self, code: u32) -> bool {
        let Some(last) = self.last.filter(|_| self.in_hand.is_none()) else {
            return false;
        };
        last.event() == Ok(Some(Event::MCode(code))) && self.executed() > last.sequence
    }

    /// Whether any frame was delivered.
    pub(crate) const fn has_begun(&self) -> bool {
        self.delivered > 0
    }

    /// Frames that were delivered and are not executed.
    pub(crate) const fn unexecuted(&self) -> u64 {
        self.delivered.saturating_sub(self.executed())
    }

    /// Whether the interpolator executes it, or has.
    pub(crate) const fn is_known(&self) -> bool {
        !matches!(self.standing, Standing::NotStarted)
    }

    /// Whether the probe has ended it.
    pub(crate) const fn is_tripped(&self) -> bool {
        matches!(self.standing, Standing::Tripped)
    }

    /// Whether every frame was planned, delivered and executed, or need not be.
    pub(crate) const fn is_over(&self) -> bool {
        let is_out = self.in_hand.is_none() && self.ended.is_some();
        self.is_tripped()
            || is_out && (matches!(self.standing, Standing::Completed) || !self.has_begun())
    }

    /// Sequence of the first frame that is too far ahead.
    pub(crate) const fn limit(&self) -> u64 {
        let limit = self.executed().saturating_add(self.horizon_frames);
        match self.standing {
            Standing::Open {
                received,
                starved: true,
                ..
            } if received == self.delivered && received >= limit => {
                received.saturating_add(MORE_FRAMES)
            }
            _ => limit,
        }
    }

    /// What to tell of it. `line` is the source line being executed, `block` the number of the item,
    /// if the machine is on this epoch.
    pub(crate) const fn progress(
        &self,
        planned: Statistics,
        (line, block): (u32, u32),
        period_ns: u64,
    ) -> Progress {
        // The first frame is the state at time 0: n frames are n - 1 periods of motion.
        let periods = self.delivered.saturating_sub(1);
        #[allow(clippy::cast_precision_loss, reason = "for people; far below 2^53 ns")]
        let published_t = (periods.saturating_mul(period_ns)) as f64 * 1e-9;
        Progress {
            planned,
            published: self.delivered,
            executed: self.executed(),
            published_t,
            line,
            block: if self.is_known() { block } else { 0 },
        }
    }

    const fn executed(&self) -> u64 {
        match self.standing {
            Standing::NotStarted => 0,
            Standing::Open { executed, .. } => executed,
            Standing::Completed | Standing::Tripped => self.delivered,
        }
    }
}
