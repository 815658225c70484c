//! The playthrough of a ramp: what it would publish, tick by tick.

use crate::real_time::differences::{Allowed, Differences};
use crate::real_time::program_time::ProgramTime;
use crate::real_time::ramp::Ramp;
use crate::real_time::track::Track;

/// Ticks past the end of a ramp that are played: a third difference reaches back over three ticks, so from
/// there on nothing of the ramp is in it.
const AFTER_END: f64 = 3.0;

/// What playing a ramp through has shown.
#[derive(Debug, Clone, Copy)]
#[allow(
    clippy::large_enum_variant,
    reason = "it lives on the stack for a moment; no boxes here"
)]
pub(super) enum PlaythroughOutcome {
    /// The ramp keeps the limits. It ends here, at a whole tick.
    Passed(PlaybackPosition),
    /// A limit would be broken, or a frame is missing.
    Barred,
    /// There was no time to play it to its end.
    OutOfBudget,
}

/// What a ramp is played from.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlaybackPosition {
    pub(super) time: ProgramTime,
    /// The positions published before it.
    pub(super) published: Differences,
    /// Whether the frame that holds the motion now holds the ramp, too. A stop in reserve is for
    /// the time after that, and is not held.
    pub(super) is_held: bool,
}

impl PlaybackPosition {
    /// The position of a search that has not begun.
    pub(super) const NONE: Self = Self {
        time: ProgramTime::at(0),
        published: Differences::NONE,
        is_held: false,
    };

    /// Goes on by so much of program time, in a tick; returns whether that is within the limits, and
    /// within the frames at hand.
    pub(super) fn go_on(&mut self, by: f64, track: &Track, allowed: &Allowed) -> bool {
        self.time = self.time.after(by);
        track.append_to(&mut self.published, self.time, allowed)
    }
}

/// A ramp that is being played through, to three ticks past its end. It can pause between any two
/// samples.
#[derive(Debug, Clone, Copy)]
pub(super) struct Playthrough {
    ramp: Ramp,
    from: ProgramTime,
    is_held: bool,
    /// Ticks played, whole, and the positions up to there.
    t: f64,
    published: Differences,
    /// The end of the ramp, once it was played so far.
    after: PlaybackPosition,
}

impl Playthrough {
    pub(super) const fn new(ramp: Ramp, playback: PlaybackPosition) -> Self {
        Self {
            ramp,
            from: playback.time,
            is_held: playback.is_held,
            t: 0.0,
            published: playback.published,
            after: playback,
        }
    }

    pub(super) const fn ramp(&self) -> &Ramp {
        &self.ramp
    }

    #[allow(clippy::float_cmp, reason = "both are whole numbers")]
    pub(super) fn go_on(
        &mut self,
        track: &Track,
        allowed: &Allowed,
        budget: &mut u32,
    ) -> PlaythroughOutcome {
        let holding_frame = track.holding_frame().filter(|_| self.is_held);
        let (whole, end) = (
            self.ramp.duration().ceil(),
            self.ramp.duration() + AFTER_END,
        );
        while self.t < end {
            if *budget == 0 {
                return PlaythroughOutcome::OutOfBudget;
            }
            *budget -= 1;
            self.t += 1.0;
            let elapsed = self.ramp.elapsed_at(self.t);
            let time = self.from.after(elapsed).held_at(holding_frame);
            if !track.append_to(&mut self.published, time, allowed) {
                return PlaythroughOutcome::Barred;
            }
            if self.t == whole {
                (self.after.time, self.after.published) = (time, self.published);
            }
        }
        PlaythroughOutcome::Passed(self.after)
    }
}
