//! Tests of moving by hand, with the processes: by steps, by keys, and what happens when a client
//! is lost.

use std::fs::File;
use std::io::Write as _;
use std::process::Stdio;
use std::time::{Duration, Instant};

use glidepath_geometry::AxisVector;
use glidepath_link::{JogDemand, JogMode, MachineState, Setpoint, Transport};
use glidepath_realtime::{Clock as _, Monotonic};
use glidepath_testing::{Pulse, leave_out};
use glidepath_tests::{Instance, Process, Services, Watchdog};
use rustix::process::Signal;
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};

use crate::programs::PROGRAM;

const PATIENCE: Duration = Duration::from_secs(240);
const PERIOD_T: f64 = 0.004;
const RIGHT: &[u8] = b"\x1b[C";
/// A host that is not later than this lets everybody run within a tick.
const IN_TIME: Duration = Duration::from_millis(1);
/// Of the built-in machine.
const LIMITS: [f64; 3] = [200.0, 2_000.0, 40_000.0];

/// Asserts that every axis is inside its limits, by differences of what the servo got.
fn assert_limits(positions: &[AxisVector]) {
    let mut differences = positions.to_vec();
    for (order, limit) in (1..).zip(LIMITS) {
        differences = differences.windows(2).map(|w| w[1] - w[0]).collect();
        let most = differences.iter().map(AxisVector::amax).fold(0.0, f64::max);
        let allowed = limit * PERIOD_T.powi(order) * (1.0 + 1e-6) + 1e-12;
        assert!(most <= allowed, "{most} above {allowed}, order {order}");
    }
}

fn bits(position: [f64; 9]) -> [u64; 9] {
    position.map(f64::to_bits)
}

/// The terminal of a process, and where its keys come from.
fn terminal() -> (File, File) {
    let keys = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC).unwrap();
    grantpt(&keys).unwrap();
    unlockpt(&keys).unwrap();
    let name = ptsname(&keys, Vec::new()).unwrap();
    let terminal = File::options()
        .read(true)
        .write(true)
        .open(name.to_str().unwrap());
    (File::from(keys), terminal.unwrap())
}

/// Holds a key down for a time, as a terminal repeats it.
fn hold_down(keys: &mut File, time: Duration) {
    let begun = Instant::now();
    while begun.elapsed() < time {
        keys.write_all(RIGHT).unwrap();
        std::thread::sleep(Duration::from_millis(30));
    }
}

#[test]
fn steps_move_the_axes_and_a_program_goes_on_from_there() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    let jog = |words: &[&str]| Process::join(&instance, &[&["jog"], words].concat()).wait();
    let report = jog(&["X10", "Y-5", "--feed", "1200", "--json"])
        .expect(0)
        .json();
    assert_eq!(report["state"], "idle");
    assert_eq!(
        (&report["position"]["X"], &report["position"]["Y"]),
        (&10.0.into(), &(-5.0).into())
    );
    let text = jog(&["Z2.5"]).expect(0).stdout;
    assert!(
        text.contains("idle at X 10.0000  Y -5.0000  Z 2.5000"),
        "{text}"
    );
    assert!(jog(&["A5"]).expect(5).stderr.contains("no axis A"));
    // Cut short, and at the end already: a script has to know.
    let report_of_way = jog(&["Z1000", "--json"]).expect(7).json();
    assert_eq!(report_of_way["at_end_of_travel"][0], "Z");
    let report = jog(&["Z1", "--json"]).expect(7).json();
    assert!(report["error"].as_str().unwrap().contains("travel ends"));
    let back = report_of_way["not_moved"]["Z"].as_f64().unwrap() - 1000.0;
    let _back = jog(&[&format!("Z{back}")]).expect(0);
    assert!(jog(&["Q5"]).expect(2).stderr.contains("such as X10"));
    assert!(jog(&[]).expect(5).stderr.contains("need a terminal"));
    let nowhere = Process::join(&instance, &["return"]).wait().expect(5);
    assert!(
        nowhere.stderr.contains("no path to return to"),
        "{nowhere:?}"
    );

    // A program begins where the jog ended; held, it is left and returned to.
    let program = instance.file("program.ngc", PROGRAM);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait(|status| status.frames_executed > 60);
    assert!(
        jog(&["X1"])
            .expect(5)
            .stderr
            .contains("while no program runs")
    );
    let _held = Process::join(&instance, &["hold"]).wait().expect(0);
    let held = services.wait_for(MachineState::Held);
    let away = jog(&["Z10", "--feed", "3000", "--json"]).expect(0).json();
    assert_eq!(
        (&away["state"], &away["away"]["Z"]),
        (&"held".into(), &10.0.into())
    );
    let refused = Process::join(&instance, &["resume"]).wait().expect(5);
    assert!(refused.stderr.contains("return first"), "{refused:?}");
    let _back = Process::join(&instance, &["return"]).wait().expect(0);
    let back = services.wait(|s| s.state == MachineState::Held.code() && bits(s.away) == [0; 9]);
    assert_eq!(bits(back.position), bits(held.position));
    let _resumed = Process::join(&instance, &["resume"]).wait().expect(0);
    let _planner = planner.wait().expect(0);
    let _idle = services.wait_for(MachineState::Idle);
    assert_limits(&services.end().0.positions());
}

#[test]
fn of_two_clients_that_step_in_one_instant_each_is_told_what_its_step_did() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    for round in 0..4 {
        let before = services.wait_for(MachineState::Idle).position[0];
        let both = [(); 2].map(|()| Process::join(&instance, &["jog", "X1.5"]));
        let outputs = both.map(Process::wait);
        let (done, refused): (Vec<_>, Vec<_>) = outputs.iter().partition(|it| it.status.success());
        for refused in refused {
            assert_eq!(refused.status.code(), Some(5), "{refused:?}");
            assert!(
                refused.stderr.contains("another client jogs"),
                "{refused:?}"
            );
        }
        assert!(!done.is_empty(), "round {round}: {outputs:?}");
        let moved = services.wait_for(MachineState::Idle).position[0] - before;
        let told = 1.5 * done.len() as f64;
        assert!(
            (moved - told).abs() < 1e-9,
            "round {round}: {moved} mm, told {told}"
        );
    }
    assert_limits(&services.end().0.positions());
}

#[test]
fn keys_move_while_they_repeat_and_a_killed_client_stops_the_jog() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    let pulse = Pulse::start();
    for is_killed in [false, true] {
        let (mut keys, terminal) = terminal();
        let client = Process::join_with(&instance, &["jog"], Stdio::from(terminal));
        // It has the terminal as soon as a key moves the axis.
        let begun = services.wait_for(MachineState::Idle).position[0];
        let set_out = Instant::now();
        while services.wait(|_| true).position[0] <= begun {
            keys.write_all(RIGHT).unwrap();
            std::thread::sleep(Duration::from_millis(30));
            assert!(set_out.elapsed() < PATIENCE / 4, "no key moved anything");
        }
        hold_down(&mut keys, Duration::from_millis(600));
        let _before = pulse.worst();
        let moving = services.wait(|_| true);
        if is_killed {
            client.signal(Signal::KILL);
        }
        let rest = services.wait_for(MachineState::Idle);
        // A quarter of 50 mm/s, for as long as a press lasts, then the jog time-out, and what the host
        // adds to both.
        let way = rest.position[0] - moving.position[0];
        let held_up_t = pulse.worst().as_secs_f64();
        assert!(
            way < 12.5 * (1.0 + 4.0 * held_up_t),
            "{way} mm after the last key, on a host that stood still for {held_up_t} s"
        );
        if is_killed {
            let _killed = client.wait();
        } else {
            assert!(
                moving.position[0] - begun > 2.0,
                "{}",
                moving.position[0] - begun
            );
            // The terminal hangs up: the client ends, and nothing moves.
            drop(keys);
            let ended = client.wait();
            assert!(ended.status.code().is_some(), "{ended:?}");
        }
        let later = services.wait(|status| status.tick > rest.tick + 50);
        assert_eq!(bits(later.position), bits(rest.position));
    }
    assert_limits(&services.end().0.positions());
}

#[test]
fn a_demand_is_seen_in_the_setpoints_within_two_ticks() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    let transport = instance.connect();
    let mut port = transport.jog_sink().unwrap();
    let mut setpoints = transport.setpoint_source().unwrap();
    let mut demand = JogDemand {
        client: 1,
        number: 0,
        sent_ns: 0,
        asked_ns: 0,
        mode: JogMode::None.code(),
        mask: 1,
        by_joint: 0,
        reserved: 0,
        velocity_v: 0.0,
        scale: 0.0,
        value: [5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    };
    // The interpolator learns of the port.
    for _ in 0..20 {
        port.publish(&demand).unwrap();
        std::thread::sleep(Duration::from_millis(10));
    }
    let (mut reactions, mut tries) = (Vec::new(), 0);
    let pulse = Pulse::start();
    while reactions.len() < 15 && tries < 100 {
        tries += 1;
        let _idle = services.wait_for(MachineState::Idle);
        while setpoints.take().unwrap().is_some() {}
        let before = services.wait(|_| true).position[0];
        let _before = pulse.worst();
        (demand.mode, demand.number) = (JogMode::Continuous.code(), demand.number + 1);
        demand.sent_ns = Monotonic.now_ns();
        port.publish(&demand).unwrap();
        let first: Setpoint = loop {
            if let Some(setpoint) = setpoints.take().unwrap()
                && setpoint.position[0] > before
            {
                break setpoint;
            }
            std::thread::sleep(Duration::from_millis(1));
        };
        let after_ns = first.scheduled_ns.saturating_sub(demand.sent_ns);
        if pulse.worst() < IN_TIME {
            reactions.push(after_ns.div_ceil(4_000_000));
        }
        (demand.mode, demand.number) = (JogMode::None.code(), demand.number + 1);
        port.publish(&demand).unwrap();
    }
    // The ports may be kept waiting where the pulse was not, but not every other time.
    reactions.sort_unstable();
    match reactions.get(reactions.len() / 2) {
        Some(median) if reactions.len() == 15 => {
            assert!(*median <= 2, "ticks from demand to motion: {reactions:?}");
        }
        _ => leave_out("a jog within two ticks", "the host was in time too seldom"),
    }
    let _end = services.end();
}
