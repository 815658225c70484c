//! The suite of promises that every transport keeps. Each function is one promise, checked through
//! the ports alone.

mod frames;
mod requests;
mod topics;

pub(crate) use frames::*;
pub(crate) use requests::*;
pub(crate) use topics::*;

use bytemuck::Zeroable;
use core::time::Duration;
use glidepath_link::{Capacity, LinkConfig, SetpointFrame, Subscriber, Transport};
use std::path::PathBuf;
use std::time::Instant;

/// Small, so that queues fill soon.
pub(crate) const CAPACITY: Capacity = Capacity {
    frames: 8,
    setpoints: 4,
    subscribers: 3,
};

/// Far longer than anything here takes on a loaded machine: only a hang reaches it.
pub(crate) const WATCHDOG: Duration = Duration::from_secs(60);

/// One instance, and as many ways to it as there would be processes.
pub(crate) trait Fixture {
    type Transport: Transport;
    fn connect(&self) -> Self::Transport;
}

pub(crate) fn frame(sequence: u64) -> SetpointFrame {
    SetpointFrame {
        epoch: 1,
        sequence,
        ..SetpointFrame::zeroed()
    }
}

/// Repeats until there is something.
pub(crate) fn wait_for<T>(mut poll: impl FnMut() -> Option<T>) -> T {
    let started = Instant::now();
    loop {
        if let Some(found) = poll() {
            return found;
        }
        assert!(
            started.elapsed() < WATCHDOG,
            "nothing within the watchdog's time"
        );
        std::thread::sleep(Duration::from_millis(1));
    }
}

pub(crate) fn take<R>(source: &mut dyn Subscriber<R>) -> R {
    wait_for(|| source.take().unwrap())
}

/// Everything that is there now.
pub(crate) fn drain<R>(source: &mut dyn Subscriber<R>) -> Vec<R> {
    core::iter::from_fn(|| source.take().unwrap()).collect()
}

/// What an instance has: its directory, if there is anything.
pub(crate) fn files_of(config: &LinkConfig) -> Vec<PathBuf> {
    let root = &config.root;
    root.exists().then(|| root.clone()).into_iter().collect()
}
