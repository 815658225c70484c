//! How late does the real-time loop wake on this host?
//!
//! ```text
//! real-time thread   sleep · (tick) · sleep · (tick) ·   SCHED_FIFO, pinned, memory locked
//!                          │ one beat per period, through a ring
//! calling thread     ──────▼───────────┬──────────────┬───
//!                         window 1 s   │   window 1 s │    steal of /proc/stat at each end
//! ```
//!
//! The loop is that of the interpolator: the same timer, the same set-up, and, if asked for, the same
//! work. Lateness is counted from the deadline the thread waited for, as cyclictest counts it, so a
//! wake-up that misses periods counts with all of its delay.
//!
//! On a virtual machine the hypervisor takes the processor away now and then, which no program can
//! do anything about. Seconds in which the kernel counted such *steal* are left out of a second set
//! of figures. The kernel counts steal in ticks of 10 ms, so the set may keep a short theft and lose
//! a good second; both sets are reported.

mod beat;
mod bins;
mod cyclictest;
mod motion;
mod report;
mod windows;

pub use beat::Beat;
pub use bins::{Bin, COARSE, FINE, rebin};
pub use cyclictest::{CyclictestError, Latencies};
pub use motion::Motion;
pub use report::JitterReport;
pub use windows::Windows;

use crate::failure::Failure;
use crate::progress::Progress;
use beat::beat;
use core::sync::atomic::{AtomicBool, Ordering};
use cyclictest::Cyclictest;
use glidepath_interpolator::stepped;
use glidepath_realtime::{
    Clock as _, DeadlineTimer, EventReader, EventWriter, Events, Grants, Host, Item, Mode,
    Monotonic, ProcessorTime, Request, enter, event_ring,
};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

/// Beats under way, one less: 0.8 s at the shortest period.
const BEATS: usize = 16_384;
/// From the end of the preparations to the first deadline.
const LEAD_NS: u64 = 5_000_000;
/// How often the calling thread empties the ring.
const POLL: Duration = Duration::from_millis(20);

/// What to measure.
#[derive(Debug)]
pub struct Setup {
    /// Period, ns.
    pub period_ns: u64,
    /// How long.
    pub seconds: u32,
    /// What the thread asks for; it goes on without what it is not granted.
    pub request: Request,
    /// The motion whose ticks are the work of each period; nothing without.
    pub motion: Option<Motion>,
    /// Run cyclictest beside.
    pub against_cyclictest: bool,
}

/// What was measured.
#[derive(Debug)]
pub struct Measurement {
    /// The beats by windows.
    pub windows: Windows,
    /// What the thread was granted.
    pub grants: Grants,
    /// Beats the calling thread was too slow for; they are in no figure.
    pub lost_beats: u64,
    /// What cyclictest saw in the same time. It refuses to run without the right to `SCHED_FIFO`: then
    /// it is left out.
    pub cyclictest: Option<Latencies>,
}

/// Measures until the time is over or `interrupt` is set; then cyclictest's figures are missing.
///
/// # Errors
/// The thread cannot be started, or cyclictest does not run.
pub fn measure(
    setup: &Setup,
    progress: &Progress,
    interrupt: &AtomicBool,
) -> Result<Measurement, Failure> {
    let mut events = Box::<Events<Beat, BEATS>>::default();
    let (writer, mut reader) = event_ring(&mut events);
    let stop = AtomicBool::new(false);
    thread::scope(|scope| {
        let (tell, told) = mpsc::channel();
        let stop = &stop;
        thread::Builder::new()
            .name("glidepath-rt".to_owned())
            .spawn_scoped(scope, move || real_time(setup, writer, &tell, stop))
            .map_err(Failure::Process)?;
        let measured = told
            .recv()
            .map_err(|_| Failure::Thread("the real-time thread"))
            .and_then(|grants| observe(setup, grants, &mut reader, progress, interrupt));
        stop.store(true, Ordering::Relaxed);
        measured
    })
}

/// The real-time thread: tells what it was granted, then beats until `stop`.
fn real_time(
    setup: &Setup,
    mut writer: EventWriter<'_, Beat>,
    tell: &mpsc::Sender<Grants>,
    stop: &AtomicBool,
) {
    // In best effort mode this never fails; the guard keeps the processors awake.
    let Ok(entered) = enter(&setup.request, Mode::BestEffort) else {
        return;
    };
    let mut run = |work: &mut dyn FnMut() -> bool| {
        let origin_ns = between_seconds(Monotonic.now_ns() + LEAD_NS, setup.period_ns);
        let mut timer = DeadlineTimer::new(Monotonic, origin_ns, setup.period_ns);
        if tell.send(entered.grants).is_ok() {
            beat(&mut timer, &mut writer, stop, work);
        }
    };
    match &setup.motion {
        None => run(&mut || false),
        Some(motion) => stepped(motion.config(), |interpolator| {
            let mut player = motion.player();
            run(&mut || player.tick(interpolator));
        }),
    }
}

/// The first time at or after `earliest_ns` that is half a period off the grid of whole seconds, on which
/// cyclictest wakes.
///
/// A thread that wakes shortly after another may find the processor awake still, and look better than
/// the one before it: at an arbitrary distance the medians of two idle loops differed by up to 18 µs on
/// a virtual machine. Half a period apart neither is favoured.
const fn between_seconds(earliest_ns: u64, period_ns: u64) -> u64 {
    let half_ns = period_ns / 2;
    (earliest_ns + half_ns).div_ceil(period_ns) * period_ns - half_ns
}

/// The calling thread: collects the beats, second by second.
fn observe(
    setup: &Setup,
    grants: Grants,
    reader: &mut EventReader<'_, Beat>,
    progress: &Progress,
    interrupt: &AtomicBool,
) -> Result<Measurement, Failure> {
    let host = Host::here();
    let cpu = setup
        .request
        .cpu
        .filter(|_| grants.is_granted(Item::Affinity));
    let steal = || ProcessorTime::read(&host, cpu).map(|time| time.steal);
    let cyclictest = (setup.against_cyclictest && grants.is_granted(Item::Scheduling))
        .then(|| Cyclictest::start(setup, &grants))
        .transpose()?;
    let mut windows = Windows::new(steal());
    let began = Instant::now();
    for second in 1..=setup.seconds {
        let end = began + Duration::from_secs(second.into());
        while Instant::now() < end && !interrupt.load(Ordering::Relaxed) {
            thread::sleep(POLL.min(end.saturating_duration_since(Instant::now())));
            while let Some(beat) = reader.read() {
                windows.record(&beat);
            }
        }
        windows.close(steal());
        progress.at(second.into());
        if interrupt.load(Ordering::Relaxed) {
            break;
        }
    }
    let cyclictest = cyclictest
        .filter(|_| !interrupt.load(Ordering::Relaxed))
        .map(Cyclictest::finish)
        .transpose()?;
    Ok(Measurement {
        windows,
        grants,
        lost_beats: reader.newly_dropped(),
        cyclictest,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_loop_beats_between_the_beats_of_cyclictest() {
        for earliest_ns in [10_000, 10_001, 11_999, 12_000, 12_001, 13_999] {
            let origin_ns = between_seconds(earliest_ns, 4_000);
            assert_eq!(origin_ns % 4_000, 2_000);
            assert!((earliest_ns..earliest_ns + 4_000).contains(&origin_ns));
        }
    }
}
