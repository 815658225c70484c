//! Tests of the ribbon as a shuttle: back along the path and onward, for as long as a finger is down.

use std::time::{Duration, Instant};

use glidepath_link::{MachineState, Status};
use glidepath_tests::{Browser, Instance, Process, Services, Watchdog};
use serde_json::json;

use super::hands::Page;
use super::life::{HALF, press};
use super::{Live, PATIENCE};

fn program() -> String {
    let lines = (1..200).map(|n| format!("G1 X{} Y{}\n", n % 2 * 10, n % 3 * 5));
    format!("G21 G90 F600\n{}M2\n", lines.collect::<String>())
}

/// A finger that is down for a while.
struct Finger<'l>(&'l Page<'l>, u64, Instant);

impl Finger<'_> {
    fn pulls(&self, speed: f64, long: Duration, numbers: &mut u64) {
        let begun = Instant::now();
        while begun.elapsed() < long {
            *numbers += 1;
            let at_ms = self.2.elapsed().as_secs_f64() * 1e3;
            let order = json!({ "kind": "shuttle", "gesture": self.1, "number": *numbers, "at_ms": at_ms, "speed": speed });
            let _said = self.0.accepted(&order);
            std::thread::sleep(Duration::from_millis(30));
        }
    }
}

fn is_held_at(services: &Services<'_>, override_r: f64) -> Status {
    services.wait(|status| {
        status.state == MachineState::Held.code()
            && (status.feed_override - override_r).abs() < 1e-9
    })
}

#[test]
fn the_machine_goes_back_for_as_long_as_a_finger_is_down() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &program());
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let live = Live::start(&instance, &["--may", "operate"]);
    let page = Page(&live, 1);
    let _far = services
        .wait(|status| status.state == MachineState::Running.code() && status.path_s > 40.0);
    let _slower = page.accepted(&json!({ "kind": "feed-override", "value": 0.8 }));
    // What is not held is not moved.
    let wrong = Finger(&page, 1, Instant::now());
    wrong.pulls(-1.0, Duration::from_millis(100), &mut 0);
    let told = live.told(|status| status["shuttle"]["troubles"] == 1);
    assert_eq!(told["shuttle"]["trouble"], "the path is not held");
    let _held = page.accepted(&json!({ "kind": "hold" }));
    let held = is_held_at(&services, 0.8);

    // On a busy host what is sent may come late, and the gesture be over: then the finger comes down anew.
    let mut gesture = 1;
    let mut back = held;
    while back.path_s > held.path_s - 5.0 {
        gesture += 1;
        let mut numbers = 0;
        let finger = Finger(&page, gesture, Instant::now());
        finger.pulls(-1.0, Duration::from_millis(900), &mut numbers);
        // Nothing more is heard of it: the machine holds by itself, with the override that was.
        back = is_held_at(&services, 0.8);
        // A gesture that is over moves nothing any more.
        finger.pulls(-1.0, Duration::from_millis(200), &mut numbers);
        let still = is_held_at(&services, 0.8);
        assert!((still.path_s - back.path_s).abs() < 1e-9);
    }
    // Onward it goes to where it was held, and no further than it takes to come to rest there.
    let begun = Instant::now();
    let mut there = back;
    while there.path_s < held.path_s - 1e-6 {
        assert!(
            begun.elapsed() < Duration::from_secs(60),
            "{} {}",
            there.path_s,
            held.path_s
        );
        gesture += 1;
        Finger(&page, gesture, Instant::now()).pulls(0.5, Duration::from_millis(900), &mut 0);
        there = is_held_at(&services, 0.8);
    }
    assert!(
        there.path_s < held.path_s + 3.0,
        "{} {}",
        there.path_s,
        held.path_s
    );

    // A hold ends it for good, whatever the finger still says.
    gesture += 1;
    let (finger, mut numbers) = (Finger(&page, gesture, Instant::now()), 0);
    finger.pulls(-0.5, Duration::from_millis(300), &mut numbers);
    let _held = page.order(&json!({ "kind": "hold" }));
    let rests = is_held_at(&services, 0.8);
    finger.pulls(-0.5, Duration::from_millis(300), &mut numbers);
    assert!((is_held_at(&services, 0.8).path_s - rests.path_s).abs() < 1e-9);
    let _aborted = page.accepted(&json!({ "kind": "abort" }));
    let _idle = services.wait_for(MachineState::Idle);
    drop((live, planner.wait()));
    drop(services.end());
}

#[test]
fn the_ribbon_is_pressed_and_dragged() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1024, 768) else {
        return;
    };
    let program = instance.file("program.ngc", &program());
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let live = Live::start(&instance, &["--may", "operate"]);
    browser.open(&live.url);
    browser.wait("typeof S !== 'undefined' && S.operates && S.state === 'running' && S.status.program_is_shown && PLAN && S.status.line > 8");
    browser.press("[data-c=hold]");
    browser.wait("S.state === 'held' && canShuttle()");
    let held = services.wait_for(MachineState::Held).path_s;
    // A touch moves nothing: neither does one that is dragged at once.
    let place = browser.finger_down("#ribbon");
    browser.finger_moved(&place, -200.0);
    std::thread::sleep(Duration::from_millis(200));
    browser.finger_up(&place);
    std::thread::sleep(HALF);
    assert!((services.wait_for(MachineState::Held).path_s - held).abs() < 1e-9);
    // Pressed for half a second, it takes the tool back; let go, it holds.
    let mut back = held;
    while back > held - 4.0 {
        let place = browser.finger_down("#ribbon");
        std::thread::sleep(HALF);
        for step in 1..10 {
            browser.finger_moved(&place, -12.0 * f64::from(step));
            std::thread::sleep(Duration::from_millis(60));
        }
        std::thread::sleep(WAIT);
        browser.finger_up(&place);
        back = services.wait_for(MachineState::Held).path_s;
    }
    browser.wait("S.state === 'held' && SHUTTLE.gesture === null && S.status.feed_override === 1");
    // Hold is where it was, and acts at once; what is let go does not go on.
    let place = browser.finger_down("#ribbon");
    std::thread::sleep(HALF);
    browser.finger_moved(&place, -150.0);
    browser.evaluate("press(BAR.hold)");
    browser.wait("SHUTTLE.gesture === null");
    let rests = services.wait_for(MachineState::Held).path_s;
    std::thread::sleep(HALF);
    browser.finger_up(&place);
    assert!((services.wait_for(MachineState::Held).path_s - rests).abs() < 1.0);
    // Resume goes on from there to the end.
    press(&mut browser, "[data-c=go]", HALF);
    let _onward = services.wait(|status| status.path_s > held + 1.0);
    drop((live, planner));
    drop(services.end());
}

/// How long a finger stays where it was dragged to.
const WAIT: Duration = Duration::from_millis(700);
