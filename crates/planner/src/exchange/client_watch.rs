//! The watch on the client of a job or a stream: whether it lives, and whether what it asked for
//! may begin to move.
//!
//! A client shows that it lives by asking again and again. Before the first frame it has to ask once more, so that
//! nothing begins for one that ended while this process could not notice. What is heard right after this process stood
//! still does not count for that: it may have waited since.

use std::time::{Duration, Instant};

use glidepath_link::STALL;

/// A client from which nothing was heard for so long is taken for dead.
pub const CLIENT_SILENCE: Duration = Duration::from_secs(2);

/// A turn counts for so long at most towards that silence.
const LONGEST_TURN: Duration = Duration::from_millis(50);

/// What waits for the client before the first frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Gate {
    /// The first frame is not ready.
    Closed,
    /// It is, and the client has not asked since.
    Ready,
    /// The client has asked since.
    Open,
}

/// What is known of a client.
#[derive(Debug)]
pub(crate) struct ClientWatch {
    /// Since when it was not heard, without what this process slept through.
    silent: Duration,
    /// The last look at that.
    looked: Instant,
    /// This process stood still before that.
    stood_still: bool,
    gate: Gate,
}

impl ClientWatch {
    /// Of a client that was heard just now.
    pub(crate) fn new() -> Self {
        Self {
            silent: Duration::ZERO,
            looked: Instant::now(),
            stood_still: false,
            gate: Gate::Closed,
        }
    }

    /// So long was meant to pass since the last look; on a busy host it was more. A look that is
    /// much too late says that this process stood still, and that says nothing of the client.
    pub(crate) fn wait(&mut self, meant: Duration) {
        let now = Instant::now();
        let passed = now.duration_since(core::mem::replace(&mut self.looked, now));
        self.stood_still = passed > meant.saturating_add(STALL);
        let passed = passed.min(LONGEST_TURN).max(meant);
        self.silent = self.silent.saturating_add(passed);
    }

    /// It asks.
    pub(crate) const fn hear(&mut self) {
        self.silent = Duration::ZERO;
        if matches!(self.gate, Gate::Ready) && !self.stood_still {
            self.gate = Gate::Open;
        }
    }

    /// The first frame is ready. Returns whether it may be published: the client has asked since.
    pub(crate) fn may_begin(&mut self) -> bool {
        if self.gate == Gate::Closed {
            self.gate = Gate::Ready;
        }
        self.has_begun()
    }

    /// Whether the first frame may have been published.
    pub(crate) fn has_begun(&self) -> bool {
        self.gate == Gate::Open
    }

    /// Whether it is taken for dead.
    pub(crate) fn is_silent(&self) -> bool {
        self.silent >= CLIENT_SILENCE
    }

    /// Why what it asked for ends, if it does not begin for want of its client.
    pub(crate) fn why_not_begun(&self) -> Option<&'static str> {
        let is_dead = self.is_silent() && !self.has_begun();
        is_dead.then_some("its client fell silent before anything moved")
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test")]

    use super::*;

    fn looked_before(time: Duration) -> ClientWatch {
        ClientWatch {
            looked: Instant::now().checked_sub(time).unwrap(),
            ..ClientWatch::new()
        }
    }

    #[test]
    fn silence_is_the_time_that_passed_and_not_the_turns_that_were_meant() {
        let meant = Duration::from_millis(1);
        let mut busy = looked_before(Duration::from_millis(8));
        busy.wait(meant);
        assert!(busy.silent >= Duration::from_millis(8), "{busy:?}");
        // A turn that was meant to be long counts as such.
        let mut at_once = looked_before(Duration::ZERO);
        at_once.wait(CLIENT_SILENCE);
        assert!(at_once.why_not_begun().is_some());
    }

    #[test]
    fn a_process_that_stood_still_holds_nothing_against_the_client() {
        let mut stopped = looked_before(Duration::from_secs(60));
        stopped.wait(Duration::from_millis(1));
        assert_eq!(stopped.silent, LONGEST_TURN);
        assert_eq!(stopped.why_not_begun(), None);
    }

    #[test]
    fn what_waited_while_this_process_stood_still_lets_nothing_begin() {
        let mut client = looked_before(Duration::from_secs(60));
        assert!(!client.may_begin());
        client.wait(Duration::from_millis(1));
        client.hear();
        assert!(!client.may_begin());
        client.wait(Duration::from_millis(1));
        client.hear();
        assert!(client.may_begin());
    }

    #[test]
    fn nothing_begins_before_the_client_has_asked_once_more() {
        let mut client = ClientWatch::new();
        client.hear();
        assert!(!client.may_begin());
        assert!(!client.may_begin());
        client.hear();
        assert!(client.may_begin());
        // What has begun goes on without it.
        client.wait(CLIENT_SILENCE);
        assert_eq!((client.is_silent(), client.why_not_begun()), (true, None));
    }
}
