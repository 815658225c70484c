//! The events of frames that have been published, and the time in its period at which each happens.
//!
//! ```text
//!  frames      │      a    b  │        c     │         program time
//!  setpoints      │    ▲    ▲     ▲  │         at a rate below 1: a, b and c in one period or in two
//! ```
//!
//! An event happens when program time comes to it. In the period of the setpoint that is the part of
//! the way from the program time before to the present one; at a steady rate of 1 it is what the frame
//! says, to the nanosecond. Each is published once, however often the motion goes back over it.

use crate::real_time::program_time::ProgramTime;
use crate::real_time::track::Track;
use glidepath_link::{EventRecord, Setpoint, SetpointFrame};

/// Frames behind the present one whose events may not have had room yet.
const BEHIND: u64 = 4;

/// The events that were published.
#[derive(Debug)]
pub(crate) struct EventsTold {
    period_ns: f64,
    /// The next event: its frame, and its place among those of the frame.
    next: (u64, usize),
    /// Program time at the setpoint before.
    before: ProgramTime,
    /// There was no room for all of them.
    is_behind: bool,
}

impl EventsTold {
    pub(crate) fn new(period_t: f64) -> Self {
        Self {
            period_ns: (period_t * 1e9).round(),
            next: (0, 0),
            before: ProgramTime::at(0),
            is_behind: false,
        }
    }

    /// An epoch begins: its frames are others, so their events are new.
    pub(crate) const fn begin_epoch(&mut self) {
        self.next = (0, 0);
        self.before = ProgramTime::at(0);
        self.is_behind = false;
    }

    /// Program time goes on: puts what happens meanwhile into a setpoint that has no events.
    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "every tick does it, and hardly one has an event"
    )]
    pub(crate) fn go_on(&mut self, now: ProgramTime, track: &Track, setpoint: &mut Setpoint) {
        let has_events = |sequence| {
            let frame = track.frame(sequence);
            frame.is_some_and(|frame| frame.event_count != 0)
        };
        let is_between = now.fraction > 0.0;
        if has_events(now.sequence)
            || (is_between && has_events(now.sequence + 1))
            || self.is_behind
        {
            self.tell(now, track, setpoint);
        }
        self.before = now;
    }

    /// Tells all that was not told yet, up to now.
    #[cold]
    #[inline(never)]
    fn tell(&mut self, now: ProgramTime, track: &Track, setpoint: &mut Setpoint) {
        self.is_behind = false;
        let last = now.sequence + u64::from(now.fraction > 0.0);
        for sequence in now.sequence.saturating_sub(BEHIND)..=last {
            let frame = track.kept_frame(sequence);
            // Another one may have been written over it.
            let Some(frame) = frame.filter(|frame| frame.sequence == sequence) else {
                continue;
            };
            if !self.tell_of(frame, now, setpoint) {
                self.is_behind = true;
                return;
            }
        }
    }

    /// Tells what of the period of a frame was not told yet. Returns whether there was room.
    fn tell_of(
        &mut self,
        frame: &SetpointFrame,
        now: ProgramTime,
        setpoint: &mut Setpoint,
    ) -> bool {
        // Of the frame that is still to come, what lies before the present time.
        let up_to_ns = if frame.sequence > now.sequence {
            now.fraction * self.period_ns
        } else {
            f64::INFINITY
        };
        for (place, event) in frame.events().iter().enumerate() {
            if (frame.sequence, place) < self.next {
                continue;
            }
            let frame_ns = f64::from(event.offset_ns);
            if frame_ns > up_to_ns {
                return true;
            }
            let offset_ns = self.offset_ns((frame.sequence, frame_ns), now);
            let earliest_ns = setpoint.events().last().map_or(0, |last| last.offset_ns);
            let told = EventRecord {
                offset_ns: offset_ns.max(earliest_ns),
                ..*event
            };
            // What is answered is known by its setpoint: one at a time.
            let is_second = event.is_at_rest() && setpoint.rest_event().is_some();
            if is_second || !setpoint.tell(told) {
                return false;
            }
            self.next = (frame.sequence, place + 1);
        }
        true
    }

    /// When in the period up to now program time came to a time in the period of a frame.
    #[allow(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "differences of a few periods, and parts of one"
    )]
    fn offset_ns(&self, (sequence, frame_ns): (u64, f64), now: ProgramTime) -> u32 {
        let since = |frames: u64| frames as f64 - self.before.sequence as f64;
        let way = since(now.sequence) + now.fraction - self.before.fraction;
        let passed = since(sequence) - 1.0 + frame_ns / self.period_ns - self.before.fraction;
        let part = if way > 0.0 { passed / way } else { 1.0 };
        (part.clamp(0.0, 1.0) * self.period_ns).round() as u32
    }
}
