//! The caller's side of a run: it stops the run, follows it, and lends it a way to wait.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use glidepath_gcode::Remark;
use glidepath_link::MachineState;

use crate::run::error::RunError;
use crate::run::statistics::Statistics;

/// A notice that the caller may want to show.
#[derive(Debug)]
pub enum Notice<'a> {
    /// No interpolator has shown itself for a while; the planner goes on waiting.
    NoInterpolator,
    /// The interpolator is not ready for a new program; the planner goes on waiting.
    NotReady(MachineState),
    /// A listening planner waits for a client.
    Listening,
    /// A client opened a stream.
    StreamOpened {
        /// The client's number of it.
        session: u64,
    },
    /// A stream was executed to its end.
    StreamExecuted(Statistics),
    /// A stream ended badly; the listening planner goes on.
    StreamBroken(&'a RunError),
    /// The motion starts.
    Started {
        /// Its epoch.
        epoch: u64,
    },
    /// The machine has come to something that the program says to people.
    Remark(&'a Remark),
    /// How far it has come.
    Progress(Progress),
}

/// The progress of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Progress {
    /// Read and planned.
    pub planned: Statistics,
    /// Frames in the interpolator's queue or executed.
    pub published: u64,
    /// Frames executed.
    pub executed: u64,
    /// Motion published, s.
    pub published_t: f64,
    /// Source line being executed, 0 before the first.
    pub line: u32,
    /// Number of the item being executed, 0 before the first.
    pub block: u32,
}

/// The caller's side of a run.
pub struct Control<'a> {
    /// Set by the caller (a signal handler) to end the run with a controlled stop.
    pub stop: &'a AtomicBool,
    /// Waits for the given time. The library reads no clock: it counts what it asked for here.
    pub pause: &'a mut dyn FnMut(Duration),
    /// Told what happens, at most a few times per second.
    pub notify: &'a mut dyn FnMut(&Notice<'_>),
}

impl std::fmt::Debug for Control<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Control")
            .field("stop", &self.stop)
            .finish_non_exhaustive()
    }
}

impl Control<'_> {
    /// Whether the caller wants the run to end.
    #[must_use]
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}
