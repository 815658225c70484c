//! Tests of many subscribers of setpoints: some keep up, one stalls, others come and go. None of
//! them may disturb the interpolator, or what the others receive.
//!
//! A short run by default. A million ticks at 250 µs, in real time where the user may, about four
//! minutes and a half:
//!
//! ```text
//! GLIDEPATH_TICKS=1000000 cargo test --release -p glidepath-tests subscribers -- --nocapture
//! ```

#![allow(clippy::print_stderr, reason = "the figures of a long run")]

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::time::Duration;

use glidepath_interpolator::{Config, RealTime};
use glidepath_link::servo::{Servo, ServoCounts, ServoSettings};
use glidepath_link::{Ipc, LinkConfig, Quantiles, Setpoint, Status, Transport};
use glidepath_realtime::{Clock as _, Mode, Monotonic, Request};
use glidepath_tests::{Instance, Watchdog, settings};

/// Between two looks of a subscriber that keeps up.
const POLL: Duration = Duration::from_millis(1);

/// Setpoints a subscriber may be behind: half a second at 250 µs. A busy host may not run an
/// ordinary thread for that long.
const QUEUE: usize = 2_048;

struct Scale {
    ticks: u64,
    period_ns: u64,
    /// Subscribers that keep up.
    readers: usize,
    /// Connections made and ended meanwhile.
    churn: u32,
    real_time: RealTime,
}

fn short() -> Scale {
    Scale {
        ticks: 3_000,
        period_ns: 1_000_000,
        readers: 7,
        churn: 100,
        real_time: RealTime::none(),
    }
}

fn long(ticks: u64, readers: usize, churn: u32) -> Scale {
    let request = Request {
        priority: Some(80),
        cpu: Some(1),
        lock_memory: true,
        prefault_stack: true,
        hold_cpu_awake: true,
    };
    Scale {
        ticks,
        period_ns: 250_000,
        readers,
        churn,
        real_time: RealTime {
            mode: Mode::BestEffort,
            request,
        },
    }
}

/// What the subscribers saw.
struct Seen {
    readers: Vec<ServoCounts>,
    stalled: ServoCounts,
    /// First and last number the stalled one received.
    stalled_span: (u64, u64),
    status: Status,
}

/// Runs an interpolator, the subscribers that keep up, one that stalls, and those that come and go.
fn observe(scale: &Scale, link: &LinkConfig) -> Seen {
    let config = Config {
        real_time: scale.real_time,
        ..Config::new(settings().limits, scale.period_ns)
    };
    let (stop, over) = (AtomicBool::new(false), AtomicBool::new(false));
    let progress = AtomicU64::new(0);
    std::thread::scope(|scope| {
        let (stop, over, progress) = (&stop, &over, &progress);
        let (ready, is_ready) = channel();
        let readers: Vec<_> = (0..scale.readers)
            .map(|_| {
                let ready = ready.clone();
                scope.spawn(move || follow(link, &ready, over, progress))
            })
            .collect();
        let sleeper = scope.spawn(move || {
            let mut servo = subscribe(link);
            ready.send(()).unwrap();
            let first = wait_for_one(&mut servo);
            while !over.load(Ordering::Relaxed) {
                std::thread::sleep(POLL);
            }
            let last = drain(&mut servo).unwrap();
            (*servo.counts(), (first.number, last.number))
        });
        // From here on every setpoint has its subscribers.
        for _ in 0..=scale.readers {
            is_ready.recv().unwrap();
        }
        let interpolator = scope.spawn(move || {
            let connect = || Ipc::connect(link).map(|ipc| Box::new(ipc) as Box<dyn Transport>);
            glidepath_interpolator::run(&config, connect, stop, &mut |_| {}).unwrap()
        });
        for visit in 0..scale.churn {
            // Evenly over the run.
            let due = scale.ticks / u64::from(scale.churn) * u64::from(visit);
            while progress.load(Ordering::Relaxed) < due {
                std::thread::sleep(POLL);
            }
            let _seen = wait_for_one(&mut subscribe(link));
        }
        while progress.load(Ordering::Relaxed) < scale.ticks {
            std::thread::sleep(POLL);
        }
        stop.store(true, Ordering::Relaxed);
        let status = interpolator.join().unwrap();
        over.store(true, Ordering::Relaxed);
        let (stalled, stalled_span) = sleeper.join().unwrap();
        Seen {
            readers: readers.into_iter().map(|r| r.join().unwrap()).collect(),
            stalled,
            stalled_span,
            status,
        }
    })
}

fn subscribe(link: &LinkConfig) -> Servo {
    let source = Ipc::connect(link).unwrap().setpoint_source().unwrap();
    Servo::new(source, ServoSettings::default())
}

fn drain(servo: &mut Servo) -> Option<Setpoint> {
    let mut last = None;
    while let Some(setpoint) = servo.receive(Monotonic.now_ns()).unwrap() {
        last = Some(setpoint);
    }
    last
}

fn wait_for_one(servo: &mut Servo) -> Setpoint {
    loop {
        if let Some(setpoint) = servo.receive(Monotonic.now_ns()).unwrap() {
            return setpoint;
        }
        std::thread::sleep(POLL);
    }
}

/// Keeps up until it is over.
fn follow(
    link: &LinkConfig,
    ready: &Sender<()>,
    over: &AtomicBool,
    progress: &AtomicU64,
) -> ServoCounts {
    let mut servo = subscribe(link);
    ready.send(()).unwrap();
    loop {
        // Asked first, so that nothing published before the end is missed.
        let ending = over.load(Ordering::Relaxed);
        if let Some(last) = drain(&mut servo) {
            progress.fetch_max(last.number, Ordering::Relaxed);
        }
        if ending {
            return *servo.counts();
        }
        std::thread::sleep(POLL);
    }
}

fn show(name: &str, q: &Quantiles) {
    let us = |ns: u64| Duration::from_nanos(ns).as_secs_f64() * 1e6;
    eprintln!(
        "  {name:12} p50 {:.2}, p99 {:.2}, p99.9 {:.2}, max {:.2} µs",
        us(q.p50_ns),
        us(q.p99_ns),
        us(q.p999_ns),
        us(q.max_ns)
    );
}

fn judge(scale: &Scale, seen: &Seen) {
    let Seen {
        readers,
        stalled,
        stalled_span: (first, last),
        status,
    } = seen;
    eprintln!(
        "{} ticks of {} ns, {} subscribers that keep up, one stalled, {} coming and going: {} missed, \
         {} lost by the stalled one",
        status.ticks,
        scale.period_ns,
        scale.readers,
        scale.churn,
        status.missed_ticks,
        stalled.lost
    );
    show("waking", &status.latency);
    show("lateness", &status.lateness);
    show("published", &status.response);
    show("work", &status.work);
    assert_eq!(status.setpoints_lost, 0, "the ports thread was disturbed");
    assert_eq!(status.setpoints_published, status.ticks);
    assert!(status.ticks > scale.ticks, "{status:#?}");
    for counts in readers {
        assert_eq!((counts.lost, counts.duplicates, counts.refused), (0, 0, 0));
        assert_eq!(counts.received, status.ticks);
    }
    assert_eq!(last + 1, status.ticks, "the newest setpoint was not kept");
    assert_eq!(stalled.received + stalled.lost, last - first + 1);
    // What it found in its queue, and the one before it stalled.
    assert_eq!(stalled.received, QUEUE as u64 + 1);
}

fn ticks_from_environment() -> Option<u64> {
    std::env::var("GLIDEPATH_TICKS").ok()?.parse().ok()
}

#[test]
fn many_subscribers_do_not_disturb_each_other() {
    run(ticks_from_environment().map_or_else(short, |ticks| long(ticks, 7, 100)));
}

#[test]
fn four_subscribers_lose_nothing_but_what_they_leave_lying() {
    let short = || Scale {
        readers: 3,
        churn: 0,
        ..short()
    };
    run(ticks_from_environment().map_or_else(short, |ticks| long(ticks, 3, 0)));
}

fn run(scale: Scale) {
    let instance = Instance::new();
    let _watchdog = Watchdog::new(Duration::from_secs(120 + scale.ticks / 1_000));
    let mut link = instance.config().clone();
    link.capacity.setpoints = QUEUE;
    let seen = observe(&scale, &link);
    judge(&scale, &seen);
}
