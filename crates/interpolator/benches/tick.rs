//! The benchmark of one tick with nine axes at their limits: `cargo bench -p
//! glidepath-interpolator`.
//!
//! Prints quantiles by the clock. `--count N` runs N ticks of steady motion and nothing else, for a
//! count of instructions: `valgrind --tool=callgrind target/release/deps/tick-… --count 10000`.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    clippy::cast_possible_wrap,
    clippy::print_stdout,
    unreachable_pub,
    reason = "a measurement, and what tests share"
)]

#[path = "../tests/synthetic/mod.rs"]
mod synthetic;

use glidepath_geometry::{AxisVector, Segment};
use glidepath_interpolator::{Config, Stepped, stepped};
use glidepath_link::{Command, SetpointFrame};
use glidepath_motion::Planner;
use glidepath_program::{Effort, Frame, Item, ItemKind, PathMode, Rate, Settings, Smoothing};
use glidepath_realtime::{Clock as _, Histogram, Monotonic};
use rustix::time::{ClockId, clock_gettime};
use std::hint::black_box;
use synthetic::{lines, mill, plan, records};

const HORIZON: u64 = 150;

/// A planner that keeps its horizon.
struct Feed {
    frames: Vec<SetpointFrame>,
    sent: usize,
}

impl Feed {
    fn new(frames: &[Frame]) -> Self {
        Self {
            frames: records(frames, 1, 4_000_000),
            sent: 0,
        }
    }

    fn publish(&mut self, stepped: &mut Stepped<'_>, executed: u64) {
        while let Some(frame) = self.frames.get(self.sent)
            && frame.sequence < executed + HORIZON
            && stepped.offer(frame)
        {
            self.sent += 1;
        }
    }
}

/// Processor time of this thread: other load does not count. Reading it takes some of it.
fn cpu_ns() -> u64 {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    now.tv_sec.unsigned_abs() * 1_000_000_000 + now.tv_nsec.unsigned_abs()
}

/// More than the processor's own caches hold: walking through it leaves nothing else in them, as 4
/// ms of other work do.
struct Evictor(Vec<u64>);

impl Evictor {
    fn new() -> Self {
        Self(vec![1; 4 << 20])
    }

    fn evict(&mut self) {
        for line in self.0.iter_mut().step_by(8) {
            *line = black_box(line.wrapping_add(1));
        }
    }
}

/// Times ticks that find cold caches. By the clock on the wall: processor time is read by the
/// kernel, which would be cold as well.
fn measure_cold(name: &str, frames: &[Frame]) {
    let mut histogram = Histogram::new();
    let (clock, mut feed, mut evictor) = (Monotonic, Feed::new(frames), Evictor::new());
    stepped(&Config::new(mill(), 4_000_000), |stepped| {
        let mut executed = 0;
        for _ in 0..frames.len() {
            feed.publish(stepped, executed);
            evictor.evict();
            let started = clock.now_ns();
            executed = black_box(stepped.tick()).sequence;
            histogram.record(clock.now_ns() - started);
        }
    });
    print(&format!("{name}, cold caches"), &histogram);
}

fn print(name: &str, histogram: &Histogram) {
    let q = histogram.quantiles();
    println!(
        "{name}, {} ticks: p50 {} ns, p99 {} ns, p99.9 {} ns, max {} ns",
        q.count, q.p50_ns, q.p99_ns, q.p999_ns, q.max_ns
    );
}

/// Times every tick; `command` may give a command before a tick.
fn measure(name: &str, frames: &[Frame], mut command: impl FnMut(usize) -> Option<Command>) {
    let mut histogram = Histogram::new();
    let (mut feed, ticks) = (Feed::new(frames), frames.len());
    stepped(&Config::new(mill(), 4_000_000), |stepped| {
        let mut executed = 0;
        for tick in 0..ticks {
            feed.publish(stepped, executed);
            if let Some(command) = command(tick) {
                stepped.command(command);
            }
            let started = cpu_ns();
            executed = black_box(stepped.tick()).sequence;
            histogram.record(cpu_ns() - started);
        }
    });
    print(name, &histogram);
}

/// A rounded zigzag as the planner makes it.
fn planned() -> Vec<Frame> {
    let settings = Settings {
        limits: mill(),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Sextic,
        corners: glidepath_program::Corners::default(),
        period_t: 0.004,
        effort: Effort::Fast,
    };
    let mut planner = Planner::new(settings, AxisVector::zeros());
    let mut at = AxisVector::zeros();
    for line in 1..=20_000 {
        let mut to = at;
        let step = f64::from(line);
        (to[0], to[1]) = (
            at[0] + 3.0 * (0.7 * step).cos(),
            at[1] + 3.0 * (0.9 * step).sin(),
        );
        let kind = ItemKind::Move {
            segment: Segment::line(at, to),
            rate: Rate::Feed(100.0),
            mode: PathMode::Continuous { tolerance_mm: None },
        };
        if planner
            .push(&Item {
                block: 0,
                line,
                kind,
            })
            .is_err()
        {
            break;
        }
        at = to;
    }
    planner.finish();
    std::iter::from_fn(|| planner.pop_frame().ok().flatten()).collect()
}

fn count(ticks: usize) {
    let mut feed = Feed::new(&lines(1, 9, ticks, &mill(), 0.004));
    stepped(&Config::new(mill(), 4_000_000), |stepped| {
        let mut executed = 0;
        for _ in 0..ticks {
            feed.publish(stepped, executed);
            executed = black_box(stepped.tick()).sequence;
        }
    });
}

fn main() {
    let mut arguments = std::env::args()
        .skip_while(|argument| argument != "--count")
        .skip(1);
    if let Some(ticks) = arguments.next().and_then(|n| n.parse().ok()) {
        count(ticks);
        return;
    }
    let mut reading = Histogram::new();
    for _ in 0..100_000 {
        let started = cpu_ns();
        reading.record(black_box(cpu_ns()) - started);
    }
    println!(
        "reading the clock, included below: p50 {} ns",
        reading.quantiles().p50_ns
    );
    // Every 0.8 s a hold, a resume, or an override: far more than any operator.
    let operator = |tick: usize| match (tick % 200, tick / 200 % 4) {
        (0, 0) => Some(Command::Hold),
        (0, 1) => Some(Command::Resume),
        (0, 2) => Some(Command::FeedOverride(0.4)),
        (0, _) => Some(Command::FeedOverride(1.0)),
        _ => None,
    };
    for axes in [3, 9] {
        let path = lines(1, axes, 100_000, &mill(), 0.004);
        measure(&format!("{axes} axes along lines"), &path, |_| None);
        measure(
            &format!("{axes} axes along lines, operator"),
            &path,
            operator,
        );
    }
    measure_cold("9 axes along lines", &lines(1, 9, 3_000, &mill(), 0.004));
    let planned = planned();
    measure("planned zigzag", &planned, |_| None);
    measure("planned zigzag, operator", &planned, operator);
    let worst = plan(1, 9, 100_000, &mill(), 0.004, AxisVector::zeros());
    measure("9 axes, each at its own limits", &worst, |_| None);
    measure("9 axes, each at its own limits, operator", &worst, operator);
}
