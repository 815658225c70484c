//! The helpers of the planner's tests: an interpolator that only keeps time, and sources of items.
#![allow(dead_code, reason = "every test file uses a part of it")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "test code, which clippy does not see as such"
)]

pub(crate) mod family;
pub(crate) mod interpolator;
pub(crate) mod items;
pub(crate) mod random;

use std::cell::RefCell;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use glidepath_planner::{Control, Notice};

/// Runs `work` with a control whose pauses let `world` pass; returns its result and the notices.
pub(crate) fn attended<R>(
    stop: &AtomicBool,
    mut world: impl FnMut(Duration),
    work: impl FnOnce(&mut Control<'_>) -> R,
) -> (R, Vec<String>) {
    let notices = RefCell::new(Vec::new());
    let mut notify = |notice: &Notice<'_>| {
        if !matches!(notice, Notice::Progress(_)) {
            notices.borrow_mut().push(format!("{notice:?}"));
        }
    };
    let mut turns = 0_u64;
    let mut pause = |time| {
        turns += 1;
        assert!(turns < 2_000_000, "the planner waits for ever");
        world(time);
    };
    let result = work(&mut Control {
        stop,
        pause: &mut pause,
        notify: &mut notify,
    });
    (result, notices.into_inner())
}
