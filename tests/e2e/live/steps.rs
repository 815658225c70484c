//! Tests of the steps of a page's jog pad: each is told by its own result, whatever other clients do meanwhile.

use std::time::{Duration, Instant};

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Process, Services, Watchdog};
use serde_json::{Value, json};

use super::hands::{Page, x};
use super::{Live, PATIENCE};

fn step(page: &Page<'_>, by: f64, feed: f64) -> u64 {
    let order = json!({ "kind": "jog-step", "axes": { "X": by }, "feed": feed });
    page.accepted(&order)["number"].as_u64().unwrap()
}

/// The end of a step, as pages are told it.
fn end_of(live: &Live, number: u64) -> Value {
    let of = |status: &Value| {
        let steps = status["page_steps"].as_array().cloned().unwrap_or_default();
        steps.into_iter().find(|step| step["number"] == number)
    };
    let is_over = |status: &Value| of(status).is_some_and(|step| step["state"] != "under-way");
    of(&live.told(is_over)).unwrap()
}

#[test]
fn a_step_is_told_by_its_own_result() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    let live = Live::start(&instance, &["--may", "operate"]);
    let page = Page(&live, 1);
    let first = step(&page, 1.0, 600.0);
    let end = end_of(&live, first);
    assert_eq!((&end["state"], &end["text"]), (&"done".into(), &"".into()));
    assert!((x(&services.wait_for(MachineState::Idle)) - 1.0).abs() < 1e-9);
    // Those that come while one moves add up, and each is told.
    let quick: Vec<u64> = (0..3).map(|_| step(&page, 0.5, 300.0)).collect();
    for number in quick {
        assert_eq!(end_of(&live, number)["state"], "done", "{number}");
    }
    assert!((x(&services.wait_for(MachineState::Idle)) - 2.5).abs() < 1e-9);

    // Another client moves: the step of the page is not done, and nothing of what moves is its result.
    let other = Process::join(&instance, &["jog", "X20", "--feed", "300"]);
    let _moving =
        services.wait(|status| status.state == MachineState::Jogging.code() && x(status) > 3.0);
    let refused = end_of(&live, step(&page, 20.0, 300.0));
    assert_eq!(refused["state"], "not", "{refused}");
    let why = refused["text"].as_str().unwrap();
    assert!(why.starts_with("another client jogs"), "{refused}");
    let _done = other.wait().expect(0);
    let rests = x(&services.wait_for(MachineState::Idle));
    assert!((rests - 22.5).abs() < 1e-9, "{rests}");
    assert_eq!(end_of(&live, refused["number"].as_u64().unwrap()), refused);

    // A hold ends one before its end: how much of it was not moved is said.
    let long = step(&page, -20.0, 600.0);
    let _moving = services.wait(|status| x(status) < rests - 1.0);
    let _held = page.order(&json!({ "kind": "hold" }));
    let end = end_of(&live, long);
    assert_eq!(end["state"], "not", "{end}");
    assert!(
        end["text"].as_str().unwrap().contains("was not moved"),
        "{end}"
    );
    drop(live);
    drop(services.end());
}

#[test]
fn the_jog_pad_says_what_became_of_its_step() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1024, 768) else {
        return;
    };
    let services = Services::start(&instance);
    let live = Live::start(&instance, &["--may", "operate"]);
    browser.open(&live.url);
    browser.wait("typeof S !== 'undefined' && S.operates && S.state === 'idle' && SETUP.jog");
    browser.evaluate("setView('setup')");
    browser.press("#steps [data-step=\"1\"]");
    browser.wait("JOG.step === 1");
    let press = ".jog[aria-label=\"move X+\"]";
    browser.press(press);
    browser.wait("document.querySelector('#jogslip').textContent === 'X+ 1: done.'");
    // While another client moves, the page says so of its own step, and nothing of the other one.
    let other = Process::join(&instance, &["jog", "Y6", "--feed", "120"]);
    browser.wait("S.state === 'jogging'");
    browser.press(press);
    browser.wait("document.querySelector('#jogslip').textContent.startsWith('X+ 1: not done')");
    browser.wait("document.querySelector('#mode').textContent.includes('X+ 1: ')");
    let _done = other.wait().expect(0);
    let _idle = services.wait_for(MachineState::Idle);
    let begun = Instant::now();
    while begun.elapsed() < Duration::from_millis(500) {
        let says = browser.evaluate("document.querySelector('#jogslip').textContent");
        assert!(
            says.as_str().unwrap().starts_with("X+ 1: not done"),
            "{says}"
        );
    }
    drop(live);
    drop(services.end());
}
