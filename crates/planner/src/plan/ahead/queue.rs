//! The frame queue between the planning thread and the publishing thread, and what the two tell
//! each other.

use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use glidepath_program::{Frame, Override};

use crate::run::refusal::Refusal;
use crate::run::statistics::Statistics;

/// The answer of the queue to the publishing thread.
#[allow(clippy::large_enum_variant, reason = "nearly every one is a frame")]
#[derive(Debug)]
pub(crate) enum Next {
    /// The next frame.
    Frame(Frame),
    /// None yet: it is being planned.
    Busy,
    /// None yet: the source has no items.
    Pending,
    /// There are no more.
    End(Result<(), Refusal>),
    /// The planning thread died.
    Died,
}

/// The next work of the planning thread.
#[derive(Debug)]
pub(crate) enum Work {
    /// Plan on. So many frames were given out.
    Plan {
        /// They will not be planned again.
        given: u64,
        /// No frame waits to be given out, and what was given out is executed soon.
        is_dry: bool,
    },
    /// Plan again what follows after so many frames.
    Replan {
        /// How many were given out.
        given: u64,
        /// The override to plan with.
        wanted: Override,
        /// The error that stood at the end of the frames dropped.
        told: Option<Refusal>,
    },
    /// No more frames are wanted.
    Stop,
}

/// What the planning thread is at.
#[derive(Debug)]
enum Activity {
    Planning,
    /// The source has nothing; it is asked again when the publishing thread says so.
    Pending {
        /// What was taken is planned to a rest.
        rests: bool,
    },
    Ended(Result<(), Refusal>),
    Died,
}

#[derive(Debug)]
struct Shared {
    frames: VecDeque<Frame>,
    given: u64,
    activity: Activity,
    /// What to plan anew with, from the frame given out last.
    wanted: Option<Override>,
    is_closed: bool,
    statistics: Statistics,
    /// The publishing thread sleeps until there is news.
    is_awaited: bool,
    /// The planning thread sleeps until only so many frames wait.
    room_at: Option<usize>,
    /// Frames are given out.
    has_begun: bool,
    /// What was given out is executed soon.
    runs_out: bool,
}

impl Shared {
    /// True if there may be frames without anything else happening before.
    const fn is_busy(&self) -> bool {
        self.wanted.is_some() || matches!(self.activity, Activity::Planning)
    }

    /// True if no frame is given out until something else happens.
    fn is_awaiting_frames(&self, head_start: usize) -> bool {
        let least = if self.has_begun { 1 } else { head_start };
        self.frames.len() < least && self.is_busy()
    }
}

/// A bounded queue of planned frames.
#[derive(Debug)]
pub(crate) struct FrameQueue {
    capacity: usize,
    /// The first frame is given out when so many are planned, or no more are for now.
    head_start: usize,
    shared: Mutex<Shared>,
    /// For the publishing thread.
    news: Condvar,
    /// For the planning thread.
    work: Condvar,
}

impl FrameQueue {
    /// An empty queue of at most so many frames, at least 1.
    ///
    /// A program often begins with a few frames at rest, which are planned at once, before motion
    /// that takes longer. A machine that was given those alone would use them up and starve. So
    /// nothing is given out before there is a `head_start` of frames, or all that can be had.
    pub(crate) fn new(capacity: usize, head_start: usize) -> Self {
        Self {
            capacity: capacity.max(1),
            head_start,
            shared: Mutex::new(Shared {
                frames: VecDeque::new(),
                given: 0,
                activity: Activity::Planning,
                wanted: None,
                is_closed: false,
                statistics: Statistics::default(),
                is_awaited: false,
                room_at: None,
                has_begun: false,
                runs_out: true,
            }),
            news: Condvar::new(),
            work: Condvar::new(),
        }
    }

    fn lock(&self) -> MutexGuard<'_, Shared> {
        // Nothing is left half done where a thread can panic.
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }

    // For the publishing thread.

    /// The next frame, or why there is none.
    pub(crate) fn next(&self) -> Next {
        let mut shared = self.lock();
        if shared.is_awaiting_frames(self.head_start) {
            return Next::Busy;
        }
        shared.has_begun = true;
        if let Some(frame) = shared.frames.pop_front() {
            shared.given += 1;
            // It is still to be executed: until the next look nobody knows how soon.
            shared.runs_out = false;
            if shared.room_at == Some(shared.frames.len()) {
                shared.room_at = None;
                self.work.notify_one();
            }
            return Next::Frame(frame);
        }
        match &mut shared.activity {
            Activity::Planning => Next::Busy,
            Activity::Pending { .. } => Next::Pending,
            Activity::Ended(end) => Next::End(std::mem::replace(end, Ok(()))),
            Activity::Died => Next::Died,
        }
    }

    /// Waits for news of a planning thread that was busy; false if there was none for so long.
    pub(crate) fn wait(&self, most: Duration) -> bool {
        let mut shared = self.lock();
        shared.is_awaited = true;
        let waited = self.news.wait_timeout_while(shared, most, |shared| {
            shared.is_awaiting_frames(self.head_start)
        });
        let (mut shared, outcome) = waited.unwrap_or_else(PoisonError::into_inner);
        shared.is_awaited = false;
        !outcome.timed_out()
    }

    /// Drops the frames that wait: they are planned again, with another override.
    pub(crate) fn replan(&self, wanted: Override) {
        let mut shared = self.lock();
        shared.frames.clear();
        shared.wanted = Some(wanted);
        self.work.notify_one();
    }

    /// Has a source asked again that had nothing. What was given out `runs_out` soon, or lasts for a while.
    pub(crate) fn ask_again(&self, runs_out: bool) {
        let mut shared = self.lock();
        shared.runs_out = runs_out;
        if matches!(shared.activity, Activity::Pending { .. }) {
            shared.activity = Activity::Planning;
            self.work.notify_one();
        }
    }

    /// Whether the source has nothing, and every frame of what came before was given out, up to a rest.
    pub(crate) fn is_dry(&self) -> bool {
        let shared = self.lock();
        shared.frames.is_empty()
            && shared.wanted.is_none()
            && matches!(shared.activity, Activity::Pending { rests: true })
    }

    /// Frames that wait.
    pub(crate) fn waiting(&self) -> usize {
        self.lock().frames.len()
    }

    /// What the planning thread has done so far.
    pub(crate) fn statistics(&self) -> Statistics {
        self.lock().statistics
    }

    /// No more frames are wanted.
    pub(crate) fn close(&self) {
        let mut shared = self.lock();
        shared.is_closed = true;
        self.work.notify_one();
    }

    // For the planning thread.

    /// Waits until there is something to do, or no longer too much is planned. `is_sated`: more is
    /// planned only for want of frames.
    pub(crate) fn next_work(&self, is_sated: bool) -> Work {
        let mut shared = self.lock();
        let mut has_waited = false;
        loop {
            if shared.is_closed {
                return Work::Stop;
            }
            let given = shared.given;
            if let Some(wanted) = shared.wanted.take() {
                return Work::Replan {
                    given,
                    wanted,
                    told: shared.activity.begin_anew(),
                };
            }
            if matches!(shared.activity, Activity::Planning) {
                let waiting = shared.frames.len();
                let is_full = waiting >= self.capacity;
                if !is_full && (!is_sated || has_waited || waiting == 0) {
                    let is_dry = waiting == 0 && shared.runs_out;
                    return Work::Plan { given, is_dry };
                }
                // Room for some at once, so that the thread does not rise for every frame.
                shared.room_at = Some(waiting - waiting.div_ceil(8));
                if !std::mem::replace(&mut shared.has_begun, true) {
                    // More of a head start cannot be had.
                    self.tell(&shared);
                }
            }
            has_waited = true;
            shared = self
                .work
                .wait(shared)
                .unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// The next frame, unless frames are to be planned anew.
    pub(crate) fn add(&self, frame: &Frame, statistics: Statistics) {
        let mut shared = self.lock();
        if shared.wanted.is_none() {
            shared.frames.push_back(*frame);
            shared.statistics = statistics;
            self.tell(&shared);
        }
    }

    /// The source has nothing; what was taken before is planned to a rest, or not yet.
    pub(crate) fn pending(&self, rests: bool) {
        self.rest(Activity::Pending { rests });
    }

    /// There are no more frames, or no more because of an error.
    pub(crate) fn end(&self, end: Result<(), Refusal>) {
        self.rest(Activity::Ended(end));
    }

    /// The planning thread is gone.
    pub(crate) fn died(&self) {
        self.rest(Activity::Died);
    }

    fn rest(&self, activity: Activity) {
        let mut shared = self.lock();
        shared.activity = activity;
        self.tell(&shared);
    }

    fn tell(&self, shared: &Shared) {
        if shared.is_awaited {
            self.news.notify_one();
        }
    }
}

impl Activity {
    /// Plans again; the error that stood at the end.
    fn begin_anew(&mut self) -> Option<Refusal> {
        match std::mem::replace(self, Self::Planning) {
            Self::Ended(end) => end.err(),
            Self::Planning | Self::Pending { .. } | Self::Died => None,
        }
    }
}
