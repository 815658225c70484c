//! What a client says of its job while it waits: what is being done, now and then, and once what the program should say and
//! does not.

use crate::output;
use crate::report::WARNING;
use std::time::{Duration, Instant};

/// When it is said for the first time what is being done; each time after that, twice as much later.
const TELL_INTERVAL: Duration = Duration::from_secs(1);

/// What was said of the job.
pub(super) struct Told {
    /// Which job it is.
    job: String,
    has_warned: bool,
    last: String,
    since: Instant,
    interval: Duration,
}

impl Told {
    pub(super) fn new(job: &str) -> Self {
        Self {
            job: job.to_owned(),
            has_warned: false,
            last: String::new(),
            since: Instant::now(),
            interval: TELL_INTERVAL,
        }
    }

    /// Says what the planner tells of the job: what is being done, and, at once, the warnings in the lines behind that.
    pub(super) fn tell_of_job(&mut self, text: &str) {
        let (doing, warnings) = text.split_once('\n').unwrap_or((text, ""));
        if !self.has_warned {
            for warning in warnings.lines().filter(|line| line.starts_with(WARNING)) {
                output::note(&format!("{}: {warning}", self.job));
                self.has_warned = true;
            }
        }
        self.tell(doing);
    }

    /// Says what is being done, now and then, if it takes long enough to be read.
    pub(super) fn tell(&mut self, doing: &str) {
        let is_news = !doing.is_empty() && self.last != doing;
        if is_news && self.since.elapsed() >= self.interval {
            output::note(doing);
            doing.clone_into(&mut self.last);
            (self.since, self.interval) = (Instant::now(), self.interval * 2);
        }
    }

    pub(super) fn wait_for(&mut self, whom: &str, started: Instant) {
        if started.elapsed() >= TELL_INTERVAL {
            self.tell(&format!("waiting for {whom}"));
        }
    }
}
