//! Tests of the mirror by a stock program of iceoryx2 (the example `onlooker`): it hears what private
//! subscribers hear, whoever ends and starts again, and nothing that is done to the mirror reaches the
//! machine.

mod command_line;
mod intruder;

use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use glidepath_link::{MachineState, Setpoint};
use glidepath_testing::{is_crowded, leave_out};
use glidepath_tests::{Instance, Output, Process, Services, Tape, Watchdog, onlooker};
use rustix::process::Signal;

use bytemuck::bytes_of;
use command_line::Recording;

use crate::programs::{PROGRAM, long_program};

const PATIENCE: Duration = Duration::from_secs(240);
/// How long a command may take, from its start to its answer.
const ANSWER: Duration = Duration::from_millis(2500);
/// Likewise, on a host that has more to do than it can.
const ANSWER_CROWDED: Duration = Duration::from_secs(6);
/// Readers for which the mirror has room.
const READERS: usize = 16;

/// An instance, with both programs at hand: they can take long where they have to be built.
fn begin() -> (Instance, Watchdog) {
    let (instance, _reader) = (Instance::for_processes(), onlooker());
    (instance, Watchdog::new(PATIENCE))
}

fn root(instance: &Instance) -> String {
    instance.path("iceoryx2")
}

fn start(instance: &Instance) -> Process {
    let root = root(instance);
    Process::join(instance, &["mirror", "--root", &root, "--json"])
}

/// A mirror that hears the machine.
fn mirror(instance: &Instance) -> Process {
    let mut mirror = start(instance);
    let hears = |mirror: &Process| {
        let receivers = instance.connect().setpoint_receivers().unwrap();
        receivers.contains(&i32::try_from(mirror.id()).unwrap())
    };
    let begun = Instant::now();
    while !hears(&mirror) {
        let is_under_way = mirror.runs() && begun.elapsed() < PATIENCE / 4;
        assert!(is_under_way, "the mirror does not hear the machine");
        std::thread::sleep(Duration::from_millis(5));
    }
    mirror
}

/// A stock reader, once it has the service.
fn reader(instance: &Instance) -> Process {
    let name = &instance.config().instance;
    let reader = Process::start_other(onlooker(), instance, &[name, &root(instance)]);
    reader.wait_until_it_says("ready");
    reader
}

/// The same in Python, where iceoryx2's package for it is installed.
fn python_reader(instance: &Instance) -> Option<Process> {
    let mut import = Command::new("python3");
    let imported = import.args(["-c", "import iceoryx2"]).output();
    if !imported.is_ok_and(|import| import.status.success()) {
        leave_out("the mirror read by Python", "python3 has no iceoryx2");
        return None;
    }
    let program = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../crates/link/examples/onlooker.py"
    );
    let arguments = [program, &instance.config().instance, &root(instance)];
    let reader = Process::start_other(Path::new("python3"), instance, &arguments);
    reader.wait_until_it_says("ready");
    Some(reader)
}

/// A tape that has begun, of a machine at rest.
fn at_rest(instance: &Instance) -> Tape {
    let tape = Tape::start(instance);
    while tape.length() == 0 {
        std::thread::sleep(Duration::from_millis(5));
    }
    tape
}

/// What a reader printed: numbers with line and position, and gaps.
#[derive(Debug, Default)]
struct Seen {
    setpoints: Vec<(u64, u32, [f64; 3])>,
    gaps: Vec<String>,
}

impl Seen {
    fn of(output: &Output) -> Self {
        let mut seen = Self::default();
        for line in output.stdout.lines().skip(1) {
            if line.starts_with("gap") {
                seen.gaps.push(line.to_owned());
                continue;
            }
            let words: Vec<&str> = line.split(' ').collect();
            let position = [2, 3, 4].map(|word: usize| words[word].parse().unwrap());
            let (number, line) = (words[0].parse().unwrap(), words[1].parse().unwrap());
            seen.setpoints.push((number, line, position));
        }
        seen
    }

    fn is_gapless(&self) -> bool {
        let mut pairs = self.setpoints.windows(2);
        self.gaps.is_empty() && pairs.all(|pair| pair[1].0 == pair[0].0 + 1)
    }
}

/// Every setpoint of the motion was seen, as it was published, and none is missing between.
fn judge(seen: &Seen, private: &[Setpoint]) {
    assert!(seen.is_gapless(), "{:?}", seen.gaps);
    let numbers = seen.setpoints.iter().map(|setpoint| setpoint.0);
    let span = numbers.clone().min()..=numbers.max();
    let moving = |it: &&Setpoint| it.state() == Ok(MachineState::Running);
    let mut moving = private.iter().filter(moving);
    assert!(moving.clone().count() > 300);
    assert!(moving.all(|setpoint| span.contains(&Some(setpoint.number))));
    let private: BTreeMap<_, _> = private.iter().map(|it| (it.number, it)).collect();
    for (number, line, position) in &seen.setpoints {
        let setpoint = private[number];
        assert_eq!(setpoint.line, *line);
        assert_eq!(&setpoint.position[..3], position);
    }
}

#[test]
fn a_stock_reader_receives_what_a_private_subscriber_does() {
    let (instance, _watchdog) = begin();
    let program = instance.file("program.ngc", PROGRAM);
    let services = Services::start(&instance);
    let (tape, mirror) = (at_rest(&instance), mirror(&instance));
    let (reader, python) = (reader(&instance), python_reader(&instance));
    let recording = Recording::start(&instance);
    let _planner = Process::join(&instance, &["planner", &program])
        .wait()
        .expect(0);
    let end = services.wait_for(MachineState::Idle);
    let is_told = |tape: &Tape| {
        let last = tape.since(0).last().map(|setpoint| setpoint.tick);
        last.is_some_and(|tick| tick > end.tick + 50)
    };
    while !is_told(&tape) {
        std::thread::sleep(Duration::from_millis(5));
    }
    let recorded = recording.map(Recording::end);
    let report = mirror.end().expect(0).json();
    assert_eq!(
        (&report["lost_setpoints"], &report["refused"]),
        (&0.into(), &0.into()),
        "{report}"
    );
    assert!(report["statuses"].as_u64() > Some(0), "{report}");
    let private = tape.since(0);
    for reader in [Some(reader), python].into_iter().flatten() {
        judge(&Seen::of(&reader.wait().expect(0)), &private);
    }
    if let Some(recorded) = recorded {
        judge(&Seen::of_setpoints(&recorded), &private);
        let mut private = private
            .iter()
            .skip_while(|it| it.number < recorded[0].number);
        let is_same = |it: &Setpoint| {
            private
                .next()
                .is_some_and(|own| bytes_of(own) == bytes_of(it))
        };
        assert!(recorded.iter().all(is_same), "other bytes");
    }
    assert_eq!(tape.judge(), Vec::<String>::new());
    drop(services.end());
}

#[test]
fn mirror_and_reader_outlast_those_that_they_hear() {
    let (instance, _watchdog) = begin();
    let services = Services::start(&instance);
    let first = mirror(&instance);
    let reader = reader(&instance);
    std::thread::sleep(Duration::from_millis(300));
    services.kill_interpolator();
    let services = Services::start(&instance);
    std::thread::sleep(Duration::from_millis(300));
    // Without a chance to clean up, and with a reader that has its service open.
    first.signal(Signal::KILL);
    drop(first.wait());
    std::thread::sleep(Duration::from_millis(100));
    let next = mirror(&instance);
    std::thread::sleep(Duration::from_millis(300));
    let asked = Instant::now();
    let report = next.end().expect(0).json();
    let took = asked.elapsed();
    assert!(took < Duration::from_secs(1) || is_crowded(), "{took:?}");
    assert_eq!(report["lost_setpoints"], 0, "{report}");
    drop(services.end());
    let seen = Seen::of(&reader.wait().expect(0));
    let lives: Vec<_> = seen.setpoints.chunk_by(|a, b| a.0 < b.0).collect();
    assert_eq!(lives.len(), 2, "the other interpolator is not heard");
    // What the dead mirror did not tell, and nothing else.
    assert_eq!(seen.gaps.len(), 1, "{:?}", seen.gaps);
    let numbers = seen.gaps[0].split(' ').skip(1).step_by(2);
    let numbers: Vec<u64> = numbers.map(|number| number.parse().unwrap()).collect();
    let gap = numbers[0]..=numbers[1];
    let second: Vec<u64> = lives[1].iter().map(|setpoint| setpoint.0).collect();
    let whole = second[0]..=second[second.len() - 1];
    let heard = whole.filter(|number| !gap.contains(number));
    assert!(heard.eq(second.iter().copied()), "{gap:?} of {second:?}");
}

/// The files of iceoryx2 that a process has in its memory.
fn memory_of(process: &Process) -> Vec<PathBuf> {
    let maps = std::fs::read_to_string(format!("/proc/{}/maps", process.id())).unwrap();
    let mut files: Vec<_> = maps
        .lines()
        .filter_map(|line| Some(PathBuf::from(&line[line.find("/dev/shm/iox2_")?..])))
        .collect();
    files.sort();
    files.dedup();
    files
}

/// The machine obeys and answers, within the time of an answer.
fn assert_operated(services: &Services<'_>, instance: &Instance, what: &str) {
    for (command, state) in [
        ("hold", MachineState::Held),
        ("status", MachineState::Held),
        ("resume", MachineState::Running),
    ] {
        let asked = Instant::now();
        let _answer = Process::join(instance, &[command]).wait().expect(0);
        let took = asked.elapsed();
        let most = if is_crowded() { ANSWER_CROWDED } else { ANSWER };
        assert!(took < most, "{what}: {command} took {took:?}");
        let _there = services.wait_for(state);
    }
}

/// What any program of the user can do to the stock services, and another user to some of it.
#[test]
fn nothing_done_to_the_mirror_reaches_the_machine() {
    let (instance, _watchdog) = begin();
    let program = instance.file("program.ngc", &long_program());
    let services = Services::start(&instance);
    let tape = at_rest(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait_for(MachineState::Running);
    let victim = mirror(&instance);

    // All places are taken by readers that hold what they have.
    let readers: Vec<_> = (0..READERS).map(|_| reader(&instance)).collect();
    readers.iter().for_each(|it| it.signal(Signal::STOP));
    let name = &instance.config().instance;
    let arguments = [name.as_str(), &root(&instance)];
    let turned_away = Process::start_other(onlooker(), &instance, &arguments).wait();
    let told = turned_away.expect(1).stderr;
    assert!(told.contains("ExceedsMaxSupportedSubscribers"), "{told}");
    assert_operated(&services, &instance, "places taken");

    // Somebody wants to publish in its place.
    let forger = start(&instance).wait().expect(5);
    assert!(
        forger.stdout.contains("publishes there already"),
        "{forger:#?}"
    );
    assert_operated(&services, &instance, "a forger");

    // It hears no more, and its queue at the machine runs over.
    victim.signal(Signal::STOP);
    assert_operated(&services, &instance, "the mirror stopped");
    victim.signal(Signal::CONT);

    // Its memory is taken from under it, which ends it.
    let memory = memory_of(&victim);
    let is_data = |path: &&PathBuf| path.extension().is_some_and(|ending| ending == "data");
    assert!(memory.iter().any(|path| is_data(&path)), "{memory:?}");
    for path in memory.iter().filter(is_data) {
        File::options()
            .write(true)
            .open(path)
            .unwrap()
            .set_len(0)
            .unwrap();
    }
    let ended = victim.wait();
    assert!(!ended.status.success(), "{ended:#?}");
    assert_operated(&services, &instance, "the mirror killed");

    // The next one finds nothing in its way.
    readers.iter().for_each(|it| it.signal(Signal::KILL));
    drop(readers);
    let next = mirror(&instance);
    drop(reader(&instance));
    let asked = Instant::now();
    let _aborted = Process::join(&instance, &["abort"]).wait().expect(0);
    assert!(asked.elapsed() < ANSWER_CROWDED, "{:?}", asked.elapsed());
    let _idle = services.wait_for(MachineState::Idle);
    let _stopped = planner.wait();
    // It cleans up the reader that was dropped.
    std::thread::sleep(Duration::from_millis(500));
    let report = next.end().expect(0).json();
    assert_eq!(report["lost_setpoints"], 0, "{report}");

    let wrong = tape.judge();
    assert_eq!(
        wrong,
        Vec::<String>::new(),
        "setpoints are missing or wrong"
    );
    let (_, report) = services.end();
    assert_eq!(report["lost_setpoints"], 0, "{report}");
    let left: Vec<_> = memory.iter().filter(|path| path.exists()).collect();
    assert_eq!(left, Vec::<&PathBuf>::new(), "left in shared memory");
}
