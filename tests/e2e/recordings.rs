//! Tests of recordings of real processes: whole ones, of recorders that were killed, and of a black
//! box.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use glidepath_link::{MachineState, MotionMode, Setpoint};
use glidepath_recording::{Entry, Reader, Recorder};
use glidepath_testing::Pulse;
use glidepath_tests::{Instance, Process, Services, Watchdog};
use rustix::process::Signal;

use crate::programs::{PROGRAM, long_program};

const PATIENCE: Duration = Duration::from_secs(240);
/// What a recorder that was killed may lose: what came since its last flush, and what it had not yet
/// taken.
const LOST: Duration = Duration::from_secs(1);

/// The setpoints of a recording, and whether it was cut short.
pub(crate) fn read(path: &Path) -> (Vec<Setpoint>, bool) {
    let mut reader = Reader::new(BufReader::new(File::open(path).unwrap())).unwrap();
    let mut setpoints = Vec::new();
    while let Some(entry) = reader.next_entry().unwrap() {
        if let Entry::Setpoint(setpoint) = entry {
            setpoints.push(setpoint);
        }
    }
    (setpoints, reader.is_cut())
}

/// From the tick of the first to that of the last. A host that stands still misses ticks, for which there are no
/// setpoints.
pub(crate) fn time_of(setpoints: &[Setpoint]) -> Duration {
    let (Some(first), Some(last)) = (setpoints.first(), setpoints.last()) else {
        return Duration::ZERO;
    };
    Duration::from_millis(4 * (last.tick - first.tick))
}

pub(crate) fn is_gapless(setpoints: &[Setpoint]) -> bool {
    let mut pairs = setpoints.windows(2);
    pairs.all(|pair| pair[1].number == pair[0].number + 1)
}

/// With a hold in it, and a way back and onward again.
#[test]
fn a_recording_of_what_an_operator_did_is_judged_and_played_again() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", PROGRAM);
    let file = instance.path("run.mcap");
    let services = Services::start(&instance);
    let record = Process::join(
        &instance,
        &["record", &file, "--program", &program, "--json"],
    );
    // Until it listens.
    while !Path::new(&format!("{file}.part")).exists() {
        std::thread::sleep(Duration::from_millis(5));
    }
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait(|status| status.frames_executed > 100);
    let operate = |command| drop(Process::join(&instance, &[command]).wait().expect(0));
    operate("hold");
    let held = services.wait_for(MachineState::Held);
    operate("reverse");
    operate("resume");
    let back = services.wait(|status| status.frames_executed + 30 < held.frames_executed);
    assert_eq!(back.mode(), Ok(MotionMode::Backwards));
    assert!(back.feed_v < 0.0 && back.path_s < held.path_s);
    operate("forward");
    let _planner = planner.wait().expect(0);
    let _idle = services.wait_for(MachineState::Idle);
    let report = record.end().expect(0).json();
    assert_eq!(report["lost_setpoints"], 0, "{report}");
    drop(services.end());
    let (setpoints, is_cut) = read(Path::new(&file));
    assert!(!is_cut && is_gapless(&setpoints));

    let verdict = Process::start(&instance, &["audit", &file, "--json"]).wait();
    let verdict = verdict.expect(0).json();
    assert_eq!(verdict["finding_count"], 0, "{verdict:#}");
    assert_eq!(verdict["notes"], serde_json::json!([]), "{verdict:#}");
    assert!(
        verdict["max_deviation_mm"].as_f64() > Some(0.0),
        "{verdict:#}"
    );

    // Played into a servo stack, which finds nothing to complain about.
    let csv = instance.path("again.csv");
    let servo = Process::join(
        &instance,
        &["servo", "--best-effort", "--setpoints", &csv, "--json"],
    );
    let replay = Process::join(&instance, &["replay", &file, "--json"]).wait_for(PATIENCE);
    let played = replay.expect(0).json();
    assert_eq!(played["setpoints"], setpoints.len(), "{played}");
    let report = servo.end().expect(0).json();
    assert_eq!(report["received"], setpoints.len(), "{report}");
    assert_eq!(
        (&report["lost_setpoints"], &report["refused"]),
        (&0.into(), &0.into()),
        "{report}"
    );
}

/// The same recording, with each setpoint changed by its number behind the first.
fn falsified(path: &Path, to: &str, change: impl Fn(usize, &mut Setpoint)) {
    let mut reader = Reader::new(BufReader::new(File::open(path).unwrap())).unwrap();
    let mut recorder = Recorder::new(File::create(to).unwrap(), reader.origin()).unwrap();
    let (mut count, mut is_told) = (0, false);
    while let Some(entry) = reader.next_entry().unwrap() {
        if let Some(begun) = reader.begun().filter(|_| !is_told) {
            recorder.begun(begun).unwrap();
            is_told = true;
        }
        match entry {
            Entry::Setpoint(mut setpoint) => {
                change(count, &mut setpoint);
                count += 1;
                recorder.setpoint(&setpoint).unwrap();
            }
            Entry::Status(status) => recorder.status(&status).unwrap(),
        }
    }
    recorder.finish().unwrap();
}

/// Tools, work offsets, parameters, modes, a subroutine in a file and the configuration are those of the machine,
/// and are not there any more when it is judged.
#[test]
fn a_recording_is_judged_by_what_it_carries() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let printed = Process::start(&instance, &["config", "--default"]).wait();
    let slower = printed
        .expect(0)
        .stdout
        .replace("max_velocity = 200.0", "max_velocity = 90.0");
    let config = instance.file("own.toml", &slower);
    let tools = instance.file("tools.tbl", "T3 P3 Z-12.5 D6\n");
    let groove = "o<groove> sub\nG1 X[#1 / 25.4] F[#100]\nG91 Y#<_width>\nG90\no<groove> endsub\n";
    let groove = instance.file("groove.ngc", groove);
    let part = "G55 G43 H3\nG0 X0.1 Y0.1\no<groove> call [20]\nG1 X0 Y0\nM2\n";
    let part = instance.file("part.ngc", part);
    let services = Services::start(&instance);
    let service = [
        "planner",
        "--listen",
        "--config",
        &config,
        "--tool-table",
        &tools,
    ];
    let service = Process::join(&instance, &[&service[..], &["--effort", "fast"]].concat());
    let operate = |command: &[&str]| drop(Process::join(&instance, command).wait().expect(0));
    let lines = ["G20 #100=40", "#<_width>=0.25", "G10 L2 P2 X0.4 Y-0.2 Z0.6"];
    for line in lines {
        operate(&["mdi", line]);
    }
    let file = instance.path("run.mcap");
    // It is told neither configuration nor program.
    let record = Process::join(&instance, &["record", &file, "--json"]);
    while !Path::new(&format!("{file}.part")).exists() {
        std::thread::sleep(Duration::from_millis(5));
    }
    operate(&["run-file", &part]);
    let _report = record.end().expect(0);
    drop((service.end(), services.end()));
    for gone in [&config, &tools, &groove, &part] {
        std::fs::remove_file(gone).unwrap();
    }
    let audit = |file: &str, exit| {
        let verdict = Process::start(&instance, &["audit", file, "--json"]).wait();
        verdict.expect(exit).json()
    };
    let verdict = audit(&file, 0);
    assert_eq!(verdict["notes"], serde_json::json!([]), "{verdict:#}");
    assert_eq!(verdict["finding_count"], 0, "{verdict:#}");
    let (setpoints, _) = read(Path::new(&file));
    let end = setpoints.last().unwrap().position;
    let places = [0.4 * 25.4, -0.2 * 25.4];
    let mut axes = end.iter().zip(places);
    assert!(
        axes.all(|(axis, place)| (axis - place).abs() < 1e-9),
        "{end:?}"
    );

    // A place in the middle of it that is not on the path is found.
    let falsehood = instance.path("falsified.mcap");
    let moving = setpoints.iter().position(|setpoint| setpoint.feed_v > 10.0);
    let middle = moving.unwrap() + 5;
    falsified(Path::new(&file), &falsehood, |at, setpoint| {
        setpoint.position[2] += if at == middle { 0.1 } else { 0.0 };
    });
    let verdict = audit(&falsehood, 5);
    let findings = verdict["findings"].as_array().unwrap();
    let is_found = findings.iter().any(|found| found["kind"] == "deviation");
    assert!(is_found, "{verdict:#}");
    // And the limits are those of the machine.
    let too_fast = instance.path("too-fast.mcap");
    falsified(Path::new(&file), &too_fast, |_, setpoint| {
        for position in &mut setpoint.position {
            *position *= 3.0;
        }
    });
    let verdict = audit(&too_fast, 5);
    let ratio = verdict["max_velocity_ratio"].as_f64().unwrap();
    assert!(ratio > 2.9 && ratio < 3.1, "{verdict:#}");
}

/// One in CI; all of them: `GLIDEPATH_KILLS=50`.
#[test]
fn a_recorder_may_be_killed_at_any_time() {
    let kills = std::env::var("GLIDEPATH_KILLS").ok();
    let kills: u64 = kills.and_then(|text| text.parse().ok()).unwrap_or(1);
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE * 4));
    let program = instance.file("program.ngc", &long_program());
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait_for(MachineState::Running);
    for kill in 0..kills {
        let file = instance.path(&format!("run-{kill}.mcap"));
        let part = PathBuf::from(format!("{file}.part"));
        let record = Process::join(&instance, &["record", &file]);
        while !part.exists() {
            std::thread::sleep(Duration::from_millis(5));
        }
        let (begun, pulse) = (Instant::now(), Pulse::start());
        // Anywhere between two flushes.
        std::thread::sleep(Duration::from_millis(1600 + kill * 7919 % 1500));
        let recorded = begun.elapsed();
        record.signal(Signal::KILL);
        drop(record.wait());
        let (setpoints, _) = read(&part);
        assert!(is_gapless(&setpoints), "kill {kill}");
        let there = time_of(&setpoints);
        let held_up = pulse.worst();
        assert!(
            there + LOST + 4 * held_up > recorded,
            "kill {kill}: {there:?} of {recorded:?}, on a host that stood still for {held_up:?}"
        );
        assert!(
            !Path::new(&file).exists(),
            "it is not whole, and not called so"
        );
    }
    drop(planner);
    drop(services.end());
}

#[test]
fn a_black_box_has_the_time_before_a_fault() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    let services = Services::start(&instance);
    let file = instance.path("box.mcap");
    let record = Process::join(&instance, &["record", &file, "--ring", "6s", "--json"]);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait(|status| status.frames_executed > 500);
    planner.signal(Signal::KILL);
    let _faulted = services.wait_for(MachineState::Faulted);
    let is_there = || {
        let files = std::fs::read_dir(instance.directory()).unwrap();
        let mut names = files.map(|file| file.unwrap().file_name().into_string().unwrap());
        names.any(|name| name.starts_with("box-") && name.ends_with(".mcap"))
    };
    let faulted = Instant::now();
    while !is_there() {
        assert!(faulted.elapsed() < PATIENCE / 4, "nothing is saved");
        std::thread::sleep(Duration::from_millis(20));
    }
    let saved = record.end().expect(0).json();
    let saved = saved["recordings"].as_array().unwrap().clone();
    assert_eq!(saved.len(), 1, "{saved:?}");
    let (setpoints, is_cut) = read(Path::new(saved[0].as_str().unwrap()));
    assert!(!is_cut && is_gapless(&setpoints));
    let is = |state: MachineState| setpoints.iter().filter(move |s| s.state == state.code());
    // Six seconds at most, two of them behind the fault.
    let time = time_of(&setpoints);
    let seconds = Duration::from_secs;
    assert!(time >= seconds(4) && time <= 7 * seconds(1), "{time:?}");
    assert!(is(MachineState::Running).count() > 20);
    let faulted: Vec<Setpoint> = is(MachineState::Faulted).copied().collect();
    assert!(time_of(&faulted) >= seconds(1), "{:?}", time_of(&faulted));
    drop((planner, services.end()));
}
