//! Tests of LinuxCNC's HAL as consumer: what comes out of its pins is what was recorded, row by
//! row, and its enable chain opens when lines stay away.

use std::fs::File;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use glidepath_link::servo::{JointState, quintic};
use glidepath_link::{MachineState, Power, Setpoint, Status, Transport};
use glidepath_realtime::{Clock as _, Monotonic};
use glidepath_testing::{Pulse, is_crowded, skip};
use glidepath_tests::{Instance, Process, Watchdog, of_this_test};
use rustix::process::Signal;

const PATIENCE: Duration = Duration::from_secs(240);
/// Of HAL's thread, ns.
const PERIOD_NS: u64 = 1_000_000;
/// Lines that HAL's FIFO holds back, and how much later than due setpoints are played: a busy host
/// stands still for so many milliseconds.
const PREFILL: u64 = 100;
const WAIT_US: &str = "60000";
/// A host that lets a thread wait for longer may let HAL's FIFO run empty.
const IN_TIME: Duration = Duration::from_millis(20);
/// Rows that are to be compared.
const ROWS: usize = 10_000;
/// What is left of a position in halsampler's text, mm.
const TEXT: f64 = 1e-6;

/// To and fro, for about eleven seconds.
const PROGRAM: &str = "\
G21 G90 G64 P0.02 F2400
G1 X40 Y10 Z5
G3 X60 Y30 I0 J20
G1 X-30 Y-20
X50 Y25 Z0
G2 X30 Y5 I-20 J0
G1 X-40 Y-10 Z8
X0 Y0 Z0
M2
";

/// HAL under way.
#[derive(Debug)]
struct Hal {
    halrun: Child,
    sampler: Child,
    rows: String,
}

fn example(name: &str) -> String {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../crates/glidepath/examples/hal"
    );
    std::fs::read_to_string(Path::new(path).join(name)).unwrap()
}

fn replaced(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "no {from:?} in {text}");
    text.replace(from, to)
}

/// A program of HAL. As root HAL drops to another user, and wants to be told which.
fn program(instance: &Instance, name: &str) -> Command {
    let mut command = Command::new(name);
    of_this_test(&mut command)
        .env("HOME", instance.path("home"))
        .env("RTAPI_UID", "65534")
        .current_dir(instance.directory());
    command
}

fn is_there() -> bool {
    Command::new("halrun").arg("-h").output().is_ok()
}

/// Where the test's sampler writes.
const ROWS_FILE: &str = "rows.txt";

fn halrun(instance: &Instance, file: &str) -> Child {
    let log = File::create(instance.path("halrun.log")).unwrap();
    program(instance, "halrun")
        .args(["-I", "-f", file])
        .stdin(Stdio::piped())
        .stdout(log.try_clone().unwrap())
        .stderr(log)
        .spawn()
        .unwrap()
}

fn sampler(instance: &Instance) -> Child {
    let child = program(instance, "halsampler")
        .args(["-c", "1", "-t"])
        .stdin(Stdio::null())
        .stdout(File::create(instance.path(ROWS_FILE)).unwrap())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(300));
    child
}

impl Hal {
    /// The example, with a sampler of the test's own beside that of the machine.
    fn start(instance: &Instance) -> Self {
        let hal = example("mill.hal");
        let hal = replaced(
            &hal,
            "depth=4096 cfg=usbbfffbbb",
            "depth=4096,32768 cfg=usbbfffbbb,ufffbb",
        );
        let own = "net tick => sampler.1.pin.0\n\
                   net j0-cmd => sampler.1.pin.1\n\
                   net j1-cmd => sampler.1.pin.2\n\
                   net j2-cmd => sampler.1.pin.3\n\
                   net drives-enable => sampler.1.pin.4\n\
                   net lines-missing => sampler.1.pin.5\n\
                   addf sampler.1 servo-thread\nstart\n";
        let hal = instance.file(
            "test.hal",
            &replaced(&hal, "\nstart\n", &format!("\n{own}")),
        );
        let home = instance.path("home");
        std::fs::create_dir(&home).unwrap();
        // Whoever HAL runs as puts a socket there.
        std::os::unix::fs::chown(&home, Some(65534), None).ok();
        let mut started = Self {
            halrun: halrun(instance, &hal),
            sampler: sampler(instance),
            rows: instance.path(ROWS_FILE),
        };
        let since = Instant::now();
        // It ends at once as long as HAL is not there.
        while started.sampler.try_wait().unwrap().is_some() {
            assert!(
                since.elapsed() < PATIENCE / 4,
                "{}",
                std::fs::read_to_string(instance.path("halrun.log")).unwrap()
            );
            started.sampler = sampler(instance);
        }
        // Its thread runs from the last line of the file on, and a bridge gives up on one that does not.
        while std::fs::metadata(&started.rows).unwrap().len() == 0 {
            assert!(since.elapsed() < PATIENCE / 4, "HAL's thread does not run");
            std::thread::sleep(Duration::from_millis(10));
        }
        started
    }

    /// Ends the test's sampler; gives what it wrote.
    fn end_sampler(&mut self) -> String {
        let pid = i32::try_from(self.sampler.id()).unwrap();
        let pid = rustix::process::Pid::from_raw(pid).unwrap();
        rustix::process::kill_process(pid, Signal::TERM).unwrap();
        self.sampler.wait().unwrap();
        std::fs::read_to_string(&self.rows).unwrap()
    }
}

impl Drop for Hal {
    fn drop(&mut self) {
        let _ = self.sampler.kill();
        let _ = self.sampler.wait();
        // At the end of its input it unloads everything.
        drop(self.halrun.stdin.take());
        let _ = self.halrun.wait();
    }
}

/// One period of HAL.
#[derive(Debug, Clone, Copy)]
struct Row {
    time_ns: u64,
    place: [f64; 3],
    has_power: bool,
    is_empty: bool,
}

/// Rows of the test's sampler. None is missing, and ticks never go back.
fn read(text: &str, near_ns: u64) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut next = None;
    for line in text.lines().filter(|line| line.ends_with(' ')) {
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        assert_eq!(words.len(), 7, "{line}");
        let number: u64 = words[0].parse().unwrap();
        assert!(
            next.is_none_or(|next| next == number),
            "a row is missing: {line}"
        );
        next = Some(number + 1);
        let tick: u64 = words[1].parse().unwrap();
        // Ticks are of 31 bits: the time is that which is nearest.
        let turn = 1 << 31;
        let turns = near_ns / PERIOD_NS / turn;
        let place = [words[2], words[3], words[4]].map(|word| word.parse().unwrap());
        rows.push(Row {
            time_ns: (turns * turn + tick) * PERIOD_NS,
            place,
            has_power: words[5] == "1",
            is_empty: words[6] == "1",
        });
    }
    rows
}

/// A recorder of setpoints, by the transport itself.
struct Recorder {
    is_over: Arc<AtomicBool>,
    thread: JoinHandle<Vec<Setpoint>>,
}

impl Recorder {
    fn start(instance: &Instance) -> Self {
        let is_over = Arc::new(AtomicBool::new(false));
        let (flag, config) = (Arc::clone(&is_over), instance.config().clone());
        let thread = std::thread::spawn(move || {
            let link = glidepath_link::Ipc::connect(&config).unwrap();
            let mut source = link.setpoint_source().unwrap();
            let mut all: Vec<Setpoint> = Vec::new();
            loop {
                let ends = flag.load(Ordering::Relaxed);
                while let Some(setpoint) = source.take().unwrap() {
                    assert!(
                        all.last()
                            .is_none_or(|last| last.number + 1 == setpoint.number)
                    );
                    all.push(setpoint);
                }
                if ends {
                    return all;
                }
                std::thread::sleep(Duration::from_millis(5));
            }
        });
        Self { is_over, thread }
    }

    fn end(self) -> Vec<Setpoint> {
        self.is_over.store(true, Ordering::Relaxed);
        self.thread.join().unwrap()
    }
}

fn joint(setpoint: &Setpoint, joint: usize) -> JointState {
    JointState {
        position: setpoint.joint_position[joint],
        velocity: setpoint.joint_velocity[joint],
        acceleration: setpoint.joint_acceleration[joint],
    }
}

#[derive(Debug, Default)]
struct Compared {
    rows: usize,
    moving: usize,
    different: usize,
    worst: f64,
}

/// Every row with power against the setpoints before and after its time.
fn compare(rows: &[Row], setpoints: &[Setpoint]) -> Compared {
    let mut compared = Compared::default();
    let mut last_ns = 0;
    for row in rows.iter().filter(|row| row.has_power) {
        if row.time_ns == last_ns {
            continue;
        }
        last_ns = row.time_ns;
        let after = setpoints.partition_point(|setpoint| setpoint.apply_ns <= row.time_ns);
        let around = after
            .checked_sub(1)
            .and_then(|at| setpoints.get(at..=after));
        let Some([from, to]) = around else { continue };
        // From the hand-over on.
        if from.state == MachineState::Off.code() || from.reference != to.reference {
            continue;
        }
        #[allow(clippy::cast_precision_loss, reason = "a period")]
        let seconds = |later: u64| (later - from.apply_ns) as f64 * 1e-9;
        let mut off = 0.0_f64;
        for (index, place) in row.place.iter().enumerate() {
            let (from, to_joint) = (joint(from, index), joint(to, index));
            let wanted = quintic(&from, &to_joint, seconds(to.apply_ns), seconds(row.time_ns));
            off = off.max((wanted.position - place).abs());
        }
        compared.rows += 1;
        compared.moving += usize::from(from.joint_velocity.iter().any(|v| v.abs() > 0.1));
        compared.different += usize::from(off > TEXT);
        compared.worst = compared.worst.max(off);
    }
    compared
}

fn config(instance: &Instance) -> String {
    let text = example("mill.toml");
    // A busy host stands still for tenths of a second, and its drives with it.
    let text = replaced(&text, "stale_s = 0.05", "stale_s = 0.9");
    let text = replaced(&text, "off_s = 0.2", "off_s = 2.0");
    // Home in a second: feedback is so old that the joints go on for two millimetres.
    let text = replaced(&text, "search_velocity = -20.0", "search_velocity = -10.0");
    let text = replaced(&text, "latch_velocity = -1.0", "latch_velocity = -4.0");
    instance.file("machine.toml", &text)
}

struct Machine<'a> {
    instance: &'a Instance,
    config: String,
}

impl Machine<'_> {
    fn process(&self, arguments: &[&str]) -> Process {
        Process::join(
            self.instance,
            &[arguments, &["--config", &self.config]].concat(),
        )
    }

    fn operate(&self, arguments: &[&str]) {
        let _done = self.process(arguments).wait().expect(0);
    }

    /// As [`Machine::operate`]; false, and told, if it failed on a host that stood still meanwhile.
    fn operate_in_time(&self, arguments: &[&str], pulse: &Pulse) -> bool {
        let output = self.process(arguments).wait();
        if output.status.code() != Some(0) && (pulse.worst() > IN_TIME || is_crowded()) {
            skip(
                "LinuxCNC's HAL",
                "the host had other things to do, and its FIFO ran empty",
            );
            return false;
        }
        let _done = output.expect(0);
        true
    }

    fn wait(&self, mut wanted: impl FnMut(&Status) -> bool) -> Status {
        let transport = self.instance.connect();
        let mut source = transport.status_source().unwrap();
        let (started, mut last) = (Instant::now(), None);
        loop {
            last = source.take().unwrap().or(last);
            if let Some(status) = last.filter(&mut wanted) {
                return status;
            }
            assert!(started.elapsed() < PATIENCE / 4, "{last:#?}");
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    fn wait_for(&self, state: MachineState) -> Status {
        self.wait(|status| status.state == state.code())
    }
}

#[test]
#[allow(
    clippy::too_many_lines,
    reason = "a recording, from its first row to the last"
)]
fn hal_plays_what_is_recorded_and_opens_its_enable_chain_when_lines_stay_away() {
    if !is_there() {
        skip(
            "LinuxCNC's HAL",
            "halrun is not installed (Debian's package linuxcnc-uspace)",
        );
        return;
    }
    let (instance, _watchdog) = (Instance::alone(), Watchdog::new(PATIENCE));
    let machine = Machine {
        instance: &instance,
        config: config(&instance),
    };
    let mut hal = Hal::start(&instance);
    let interpolator = machine.process(&["interpolator", "--best-effort"]);
    let _off = machine.wait_for(MachineState::Off);
    let recorder = Recorder::start(&instance);
    let prefill = PREFILL.to_string();
    let late = ["--hal-prefill", &prefill, "--hal-wait-us", WAIT_US];
    let mut servo = machine.process(&[&["servo", "--hal", "--json"], &late[..]].concat());
    let _answers = machine.wait(|status| status.feedback_age_ns < 200_000_000 || !servo.runs());
    if !servo.runs() {
        panic!("{:#?}", servo.wait());
    }

    // Power, home and hand-over, from the pins and back.
    let pulse = Pulse::start();
    if !machine.operate_in_time(&["enable"], &pulse) {
        let _setpoints = recorder.end();
        return;
    }
    let status = machine.wait_for(MachineState::NotHomed);
    assert_eq!(status.power(), Ok(Power::On));
    if !machine.operate_in_time(&["home"], &pulse) {
        let _setpoints = recorder.end();
        return;
    }
    let status = machine.wait_for(MachineState::Idle);
    assert_eq!(status.homed, 0b111);
    // The edge of the switch is found in the middle of two rows, 4 µm from each other at 4 mm/s.
    for joint in 0..3 {
        assert!(status.position[joint].abs() < 1e-9, "{status:#?}");
        let edge = -5.0;
        let found = status.joint_actual[joint];
        assert!((found - edge - 5.0).abs() < 0.01, "{status:#?}");
    }

    let program = instance.file("program.ngc", PROGRAM);
    if !machine.operate_in_time(&["planner", &program], &pulse) {
        let _setpoints = recorder.end();
        return;
    }
    let status = machine.wait_for(MachineState::Idle);
    // What the drives say is what they were told, a constant time later.
    assert!(
        status.following_peak[..3].iter().all(|peak| *peak < 2e-6),
        "{status:#?}"
    );

    // The servo stands still in motion for longer than the FIFO lasts.
    let back = instance.file("back.ngc", "G21 G90 G1 X100 Y50 F3000\nM2\n");
    let planner = machine.process(&["planner", &back]);
    let _moving = machine.wait(|status| status.feed_v > 45.0);
    servo.signal(Signal::STOP);
    std::thread::sleep(Duration::from_millis(PREFILL + 200));
    servo.signal(Signal::CONT);
    let status = machine.wait_for(MachineState::Faulted);
    assert!(matches!(status.fault(), Ok(Some(_))), "{status:#?}");
    let _planner = planner.wait().expect(5);
    let _off = machine.wait(|status| status.power() == Ok(Power::Off));

    // Nothing has power again before the operator asks for it. The chain is upset until the lines that
    // ask for power have gone through the FIFO.
    let _calm = machine.wait(|status| status.drive_faults == 0);
    machine.operate(&["reset"]);
    let _off = machine.wait_for(MachineState::Off);
    machine.operate(&["enable"]);
    let status = machine.wait_for(MachineState::Idle);
    assert_eq!(status.power(), Ok(Power::On));

    let report = servo.end().expect(0).json();
    assert_eq!(report["lost_setpoints"], 0, "{report}");
    assert!(report["hal"]["underruns"].as_u64().unwrap() > 0, "{report}");
    let rows = read(&hal.end_sampler(), Monotonic.now_ns());
    let setpoints = recorder.end();
    let _interpolator = interpolator.end().expect(0);

    // The chain opened in the very period without a line, and stayed open.
    let empty = rows
        .windows(2)
        .position(|two| two[0].has_power && two[1].is_empty);
    let empty = empty.expect("the FIFO ran empty with power on") + 1;
    assert!(!rows[empty].has_power);
    let again = rows[empty..].iter().position(|row| row.has_power);
    let again = empty + again.expect("power came again");
    let off_for = again - empty;
    assert!(off_for > 100, "power was off for {off_for} periods");
    assert!(!rows.last().unwrap().has_power, "and it ends without");

    let compared = compare(&rows[..empty], &setpoints);
    eprintln!("HAL: {compared:?}, {report}");
    assert!(compared.rows >= ROWS, "{compared:?}");
    assert!(compared.moving > ROWS / 2, "{compared:?}");
    assert_eq!(compared.different, 0, "{compared:?}");
}
