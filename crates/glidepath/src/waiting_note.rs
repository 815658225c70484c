//! The note of what a command waits for, where that takes longer than a moment.

use crate::output;
use std::sync::mpsc::{Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// What is over sooner needs no word.
const MOMENT: Duration = Duration::from_secs(1);

/// The note of a command that looks again and again.
#[derive(Debug)]
pub(crate) struct WaitingNote {
    since: Instant,
    text: Option<String>,
}

impl WaitingNote {
    pub(crate) fn new(text: String) -> Self {
        Self {
            since: Instant::now(),
            text: Some(text),
        }
    }

    /// Says it once, if the wait has taken so long.
    pub(crate) fn look(&mut self) {
        if self.since.elapsed() >= MOMENT
            && let Some(text) = self.text.take()
        {
            output::note(&text);
        }
    }
}

/// The note of a command that cannot look meanwhile, until dropped.
#[derive(Debug)]
pub(crate) struct BlockedNote {
    over: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl BlockedNote {
    /// Without a thread the command waits in silence.
    pub(crate) fn new(text: String) -> Self {
        let (over, heard) = channel::<()>();
        let thread = thread::Builder::new().name("note".to_owned());
        let thread = thread.spawn(move || {
            if heard.recv_timeout(MOMENT) == Err(std::sync::mpsc::RecvTimeoutError::Timeout) {
                output::note(&text);
            }
        });
        Self {
            over: Some(over),
            thread: thread.ok(),
        }
    }
}

impl Drop for BlockedNote {
    fn drop(&mut self) {
        drop(self.over.take());
        if let Some(thread) = self.thread.take() {
            thread.join().ok();
        }
    }
}
