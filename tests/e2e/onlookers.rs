//! Tests of a recorder, a page and telemetry beside a machine that moves: they miss nothing, cost
//! little, and the tick does not notice.
//!
//! Three seconds by default. Ten minutes without and ten with them, where the recorder has to be
//! content with two per cent of a core:
//!
//! ```text
//! GLIDEPATH_ONLOOKERS=600 cargo test --release -p glidepath-tests --test e2e onlookers -- \
//!     --nocapture
//! ```

#![allow(clippy::print_stderr, reason = "the figures of a long run")]

use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::path::Path;
use std::time::{Duration, Instant};

use glidepath_link::{MachineState, Quantiles, Status};
use glidepath_testing::{Pulse, leave_out};
use glidepath_tests::{Instance, Process, Services, Watchdog};

use crate::live::Live;
use crate::recordings::{is_gapless, read, time_of};
use crate::telemetry;

/// How much of a core a recorder may take at 4 ms.
const MOST_OF_A_CORE: f64 = 0.02;

/// Back and forth for so long, and some seconds more.
fn program(seconds: u64) -> String {
    "G21 G90 F3000\n".to_owned()
        + &"G1 X50 Y10\nX0 Y0\n".repeat(usize::try_from(seconds).unwrap() / 2 + 20)
}

/// What a process has used of all cores.
fn used(process: u32) -> Duration {
    let tasks = std::fs::read_dir(format!("/proc/{process}/task")).unwrap();
    let used_ns = tasks.map(|task| {
        let text = std::fs::read_to_string(task.unwrap().path().join("schedstat"));
        // A thread that has just ended is gone.
        let text = text.unwrap_or_default();
        text.split(' ')
            .next()
            .and_then(|ns| ns.parse().ok())
            .unwrap_or(0)
    });
    Duration::from_nanos(used_ns.sum())
}

/// Takes what a page would be sent, as a page that keeps up does, until the server ends; gives how
/// many bytes that were.
fn follow(live: &Live) -> std::thread::JoinHandle<usize> {
    let mut stream = TcpStream::connect(("127.0.0.1", live.port)).unwrap();
    let head = format!(
        "GET /api/stream HTTP/1.1\r\nHost: localhost:{}\r\n{}\r\n",
        live.port,
        live.token()
    );
    stream.write_all(head.as_bytes()).unwrap();
    std::thread::spawn(move || {
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        bytes.len()
    })
}

/// Those who look.
struct Onlookers {
    file: String,
    record: Process,
    live: Live,
    page: std::thread::JoinHandle<usize>,
    telemetry: Option<(Process, telemetry::Ended)>,
}

impl Onlookers {
    fn start(instance: &Instance) -> Self {
        let file = instance.path("run.mcap");
        let record = Process::join(instance, &["record", &file, "--json"]);
        while !Path::new(&format!("{file}.part")).exists() {
            std::thread::sleep(Duration::from_millis(5));
        }
        let live = Live::start(instance, &[]);
        let page = follow(&live);
        if !telemetry::is_there() {
            leave_out("telemetry beside a machine", telemetry::NO_BROKER);
        }
        let telemetry = telemetry::is_there().then(|| {
            let port = telemetry::free_port();
            let broker = telemetry::broker(instance, port);
            let address = format!("127.0.0.1:{port}");
            (
                Process::join(instance, &["telemetry", "--broker", &address]),
                broker,
            )
        });
        Self {
            file,
            record,
            live,
            page,
            telemetry,
        }
    }

    /// What recorder, page and telemetry have used.
    fn used(&self) -> [Duration; 3] {
        let telemetry = self.telemetry.as_ref();
        let telemetry = telemetry.map_or(Duration::ZERO, |(process, _)| used(process.id()));
        [used(self.record.id()), used(self.live.id()), telemetry]
    }

    /// Ends them; asserts that nothing was missed.
    fn end(self, at_least: Duration, held_up: Duration) {
        let report = self.record.end().expect(0).json();
        assert_eq!(report["lost_setpoints"], 0, "{report}");
        let (setpoints, is_cut) = read(Path::new(&self.file));
        assert!(!is_cut && is_gapless(&setpoints));
        let there = time_of(&setpoints);
        assert!(
            there + Duration::from_millis(500) + 4 * held_up > at_least,
            "{there:?} of {at_least:?}, on a host that stood still for {held_up:?}"
        );
        if let Some((process, _broker)) = self.telemetry {
            drop(process.end().expect(0));
        }
        drop(self.live);
        let bytes = self.page.join().unwrap();
        assert!(bytes > setpoints.len(), "the page was sent {bytes} bytes");
    }
}

/// A machine that moves for so long, watched or not: its status at the end, and how much of a core
/// recorder, page and telemetry took.
fn life(seconds: u64, is_watched: bool) -> (Status, [f64; 3]) {
    let instance = Instance::for_processes();
    let program = instance.file("program.ngc", &program(seconds));
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait_for(MachineState::Running);
    let onlookers = is_watched.then(|| Onlookers::start(&instance));
    let used = || {
        onlookers
            .as_ref()
            .map_or([Duration::ZERO; 3], Onlookers::used)
    };
    let (begun, before, pulse) = (Instant::now(), used(), Pulse::start());
    std::thread::sleep(Duration::from_secs(seconds));
    let (took, after) = (begun.elapsed(), used());
    let status = services.wait_for(MachineState::Running);
    let shares = [0, 1, 2].map(|who| (after[who] - before[who]).div_duration_f64(took));
    if let Some(onlookers) = onlookers {
        onlookers.end(took, pulse.worst());
    }
    drop(planner);
    drop(services.end());
    (status, shares)
}

fn told(status: &Status) -> String {
    let told = |of: &Quantiles| format!("{}/{}/{} ns", of.p50_ns, of.p99_ns, of.p999_ns);
    format!(
        "{} ticks, {} missed, {} late; work {}, lateness {}",
        status.ticks,
        status.missed_ticks,
        status.late_ticks,
        told(&status.work),
        told(&status.lateness)
    )
}

#[test]
fn whoever_looks_misses_nothing_and_is_not_felt() {
    let asked = std::env::var("GLIDEPATH_ONLOOKERS").ok();
    let asked: Option<u64> = asked.and_then(|text| text.parse().ok());
    let seconds = asked.unwrap_or(3);
    let _watchdog = Watchdog::new(Duration::from_secs(300 + 3 * seconds));
    if asked.is_some() {
        let (status, _) = life(seconds, false);
        eprintln!("nobody looks: {}", told(&status));
    }
    let (status, [record, live, telemetry]) = life(seconds, true);
    if asked.is_some() {
        eprintln!("all of them look: {}", told(&status));
        eprintln!("of a core: record {record:.4}, live {live:.4}, telemetry {telemetry:.4}");
        assert!(record <= MOST_OF_A_CORE, "{record}");
    }
}
