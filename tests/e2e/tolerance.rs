//! Tests of a run with another tolerance than its own.

use std::path::Path;
use std::time::Duration;

use glidepath_link::{MachineState, Setpoint};
use glidepath_tests::{Instance, Process, Services, Watchdog};
use rustix::process::Signal;
use serde_json::Value;

const PATIENCE: Duration = Duration::from_secs(240);

/// Corners, in its own tolerance and in that of the configuration.
fn corners() -> String {
    let mut text = "G21 G90 G64 P0.02 F6000\n".to_owned();
    for row in 0..12 {
        let x = if row % 2 == 0 { 60 } else { 10 };
        text.push_str(&format!("G1 X{x} Y{}\n", 2 * row));
        text.push_str(&format!("Y{}\n", 2 * row + 2));
        if row == 6 {
            text.push_str("G64\n");
        }
    }
    text.push_str("G0 X0 Y0\nM2\n");
    text
}

/// What a recording of something tells of its motion.
fn recorded(instance: &Instance, name: &str, done: impl FnOnce()) -> Value {
    let file = instance.path(name);
    let record = Process::join(instance, &["record", &file, "--json"]);
    while !Path::new(&format!("{file}.part")).exists() {
        std::thread::sleep(Duration::from_millis(5));
    }
    done();
    let _report = record.end().expect(0);
    let verdict = Process::start(instance, &["audit", &file, "--json"]).wait();
    verdict.expect(0).json()
}

/// How far a recorded motion stays away from a corner at X60, mm: from the chords between its setpoints. With Y12 it is in the
/// tolerance that the program says, with Y20 in that of the configuration.
fn away_from_corner(instance: &Instance, name: &str, y: f64) -> f64 {
    let (setpoints, _) = crate::recordings::read(Path::new(&instance.path(name)));
    let from_corner = |at: &Setpoint| [at.position[0] - 60.0, at.position[1] - y];
    let distance = |pair: &[Setpoint]| {
        let (from, to) = (from_corner(&pair[0]), from_corner(&pair[1]));
        let along = [to[0] - from[0], to[1] - from[1]];
        let length2 = along[0].mul_add(along[0], along[1] * along[1]);
        let back = -from[0].mul_add(along[0], from[1] * along[1]);
        let share = if length2 > 0.0 {
            (back / length2).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let nearest = [
            share.mul_add(along[0], from[0]),
            share.mul_add(along[1], from[1]),
        ];
        nearest[0].hypot(nearest[1])
    };
    setpoints
        .windows(2)
        .map(distance)
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn a_run_uses_the_tolerance_that_is_asked_for_alone_and_goes_on_with_it() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let part = instance.file("part.ngc", &corners());
    let services = Services::start(&instance);
    let service = Process::join(&instance, &["planner", "--listen"]);
    let run = |more: &[&str]| {
        let command = [&["run-file", &part], more].concat();
        Process::join(&instance, &command).wait()
    };
    let deviation = |verdict: &Value| {
        assert_eq!(verdict["finding_count"], 0, "{verdict:#}");
        verdict["max_deviation_mm"].as_f64().unwrap()
    };
    for wrong in ["0", "11", "nan"] {
        let refused = run(&["--tolerance-ratio", wrong]).expect(2);
        assert!(refused.stderr.contains("from 0.1 to 10"), "{refused:#?}");
    }
    let four = recorded(&instance, "four.mcap", || {
        drop(run(&["--tolerance-ratio", "4"]).expect(0));
    });
    let used = deviation(&four);
    assert!(used > 0.04 && used <= 0.08, "{used}");
    // Nothing of it is left for the next run.
    let own = recorded(&instance, "own.mcap", || drop(run(&[]).expect(0)));
    let used = deviation(&own);
    assert!(used > 0.01 && used <= 0.02, "{used}");

    // What goes on does so with what it began with.
    let rest = recorded(&instance, "rest.mcap", || {
        let before = services.wait_for(MachineState::Idle).epoch;
        let running = Process::join(&instance, &["run-file", &part, "--tolerance-ratio", "4"]);
        let _moving = services.wait(|status| status.epoch > before && status.line > 8);
        drop(Process::join(&instance, &["abort"]).wait().expect(0));
        let _ended = running.wait();
        let _idle = services.wait_for(MachineState::Idle);
        drop(run(&["--resume"]).expect(0));
    });
    assert_eq!(rest["finding_count"], 0, "{rest:#}");
    // And so does what begins at a line.
    let behind = recorded(&instance, "behind.mcap", || {
        let more = ["--from-line", "12", "--yes", "--tolerance-ratio", "4"];
        drop(run(&more).expect(0));
    });
    assert_eq!(behind["finding_count"], 0, "{behind:#}");
    for y in [12.0, 20.0] {
        let away = |name: &str| away_from_corner(&instance, name, y);
        let (four, own) = (away("four.mcap"), away("own.mcap"));
        assert!(own < 0.021 && four > 0.04, "Y{y}: {own} {four}");
        for name in ["rest.mcap", "behind.mcap"] {
            let away = away(name);
            assert!((away - four).abs() < 0.002, "{name}, Y{y}: {away} {four}");
        }
    }
    drop((service.end(), services.end()));
}

/// Another service, of a machine that keeps what its programs began with, or does not.
#[test]
fn a_service_that_takes_over_knows_the_tolerance_of_what_goes_on() {
    for keeps in [true, false] {
        let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
        let printed = Process::start(&instance, &["config", "--default"]).wait();
        let mut config = printed.expect(0).stdout;
        if keeps {
            let folder = format!("directory = \"{}\"", instance.path("kept"));
            config = config.replace("# directory = \"state\"", &folder);
            assert!(config.contains(&folder));
        }
        let config = instance.file("own.toml", &config);
        let part = instance.file("part.ngc", &corners());
        let services = Services::start(&instance);
        let service = || Process::join(&instance, &["planner", "--listen", "--config", &config]);
        let first = service();
        let begun = recorded(&instance, "begun.mcap", || {
            let command = ["run-file", &part, "--tolerance-ratio", "4"];
            let running = Process::join(&instance, &command);
            let _moving = services.wait(|status| status.line > 8);
            first.signal(Signal::KILL);
            let _killed = first.wait();
            let _left = services.wait_for(MachineState::Faulted);
            let _ended = running.wait();
            drop(Process::join(&instance, &["reset"]).wait().expect(0));
            let _idle = services.wait_for(MachineState::Idle);
        });
        assert_eq!(begun["finding_count"], 0, "{begun:#}");
        let second = service();
        let rest = recorded(&instance, "rest.mcap", || {
            // A line in between changes nothing of it.
            drop(Process::join(&instance, &["mdi", "G90"]).wait().expect(0));
            let resumed = Process::join(&instance, &["run-file", &part, "--resume"]).wait();
            drop(resumed.expect(0));
        });
        assert_eq!(rest["finding_count"], 0, "{rest:#}");
        for y in [12.0, 20.0] {
            let used = away_from_corner(&instance, "rest.mcap", y);
            assert!(used > 0.04 && used < 0.081, "{keeps}, Y{y}: {used}");
        }
        drop((second.end(), services.end()));
    }
}
