//! Tests of the spindle on the page: how fast it turns, its load, and what the operator makes of its speed.

use std::time::Duration;

use glidepath_link::{MachineState, Status};
use glidepath_tests::{Browser, Instance, Operated, Watchdog};
use serde_json::json;

use super::life::{HALF, press};
use super::{Live, PATIENCE};

const MORE: &str = "[data-ov=spindle-override] button:last-child";
const LESS: &str = "[data-ov=spindle-override] button:first-child";
const WHOLE: &str = "[data-ov=spindle-override] .mid";

/// A program that has the spindle for itself, and goes on for long.
const LOCKED: &str = "G21 G90 F300\nM49\nS1000 M3\nG1 X100\nM2\n";

fn has(ratio: f64) -> impl Fn(&Status) -> bool {
    move |status| (status.spindle_override - ratio).abs() < 1e-9
}

/// The page shows an override, and a spindle that turns by it.
fn shows(browser: &mut Browser, percent: u32, rpm: &str) {
    browser.wait(&format!(
        "document.querySelector('[data-ov=spindle-override] [data-v]').textContent === '{percent}%' && \
         document.querySelector('#spin').textContent === '{rpm}'"
    ));
}

/// The second line of the tile of the spindle.
fn second_line(browser: &mut Browser) -> String {
    let text = browser.evaluate("document.querySelector('#spinof').textContent");
    text.as_str().unwrap().to_owned()
}

#[test]
fn the_operator_makes_the_spindle_slower_and_faster_unless_a_program_keeps_it() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1024, 768) else {
        return;
    };
    let operated = Operated::new(&instance, &[], "");
    let _interpolator = operated.process(&["interpolator", "--best-effort"]);
    let _servo = operated.process(&["servo", "--best-effort"]);
    let _service = operated.service();
    let _off = operated.wait_for_drives();
    let _on = operated.operate(&["enable"]);
    let _idle = operated.wait_for(MachineState::Idle);
    let config = ["--may", "operate", "--config", operated.config()];
    let live = Live::start(&instance, &config);
    browser.open(&live.url);
    browser.wait("typeof S !== 'undefined' && S.operates && S.state === 'idle' && SETUP.jog");

    // By hand: the speed of the field, without the override.
    browser.evaluate("setView('setup'); showTable('spindle')");
    press(&mut browser, "[data-do=spindle-cw]", HALF);
    browser.evaluate("setView('operate')");
    shows(&mut browser, 100, "1 000");
    assert_eq!(second_line(&mut browser), "of 1 000, M3");
    // Of two presses, the second before the first was told, both count.
    browser.evaluate("[0, 1].forEach(DEEDS['spindle-override-less'])");
    let _slower = operated.wait(has(0.9));
    browser.press(LESS);
    let _slower = operated.wait(has(0.85));
    shows(&mut browser, 85, "850");
    assert_eq!(second_line(&mut browser), "of 850, M3");
    // Started anew, the override counts once.
    browser.evaluate("setView('setup'); showTable('spindle')");
    assert_eq!(
        browser.evaluate("document.querySelector('#speed').value"),
        "1000"
    );
    press(&mut browser, "[data-do=spindle-ccw]", HALF);
    browser.evaluate("setView('operate')");
    browser.wait("document.querySelector('#spinof').textContent === 'of 850, M4'");
    shows(&mut browser, 85, "850");
    // As far as the machine allows, and nothing is refused there.
    for (key, end) in [("less", 0.5), ("more", 1.2)] {
        for _ in 0..20 {
            browser.evaluate(&format!("DEEDS['spindle-override-{key}']()"));
        }
        let _end = operated.wait(has(end));
    }
    shows(&mut browser, 120, "1 200");
    assert_eq!(browser.evaluate("S.refusal"), "");
    browser.press(WHOLE);
    let _whole = operated.wait(has(1.0));
    shows(&mut browser, 100, "1 000");
    // The load, where a drive tells it.
    browser.evaluate(
        "window.heardNow = heard; heard = (kind, payload) => { if (kind !== 1) return heardNow(kind, payload); \
         const status = { ...JSON.parse(new TextDecoder().decode(payload)), spindle_load: 0.4512 }; \
         return heardNow(1, new TextEncoder().encode(JSON.stringify(status)).buffer); }",
    );
    browser.wait("document.querySelector('#spinof').textContent === 'of 1 000, M4\\nload 45 %'");

    // What a program keeps cannot be pressed, and what it makes of it is shown.
    browser.press(LESS);
    let _slower = operated.wait(has(0.95));
    let program = instance.file("locked.ngc", LOCKED);
    let running = operated.process(&["run-file", &program]);
    let _moving = operated.wait_for(MachineState::Running);
    browser
        .wait("document.querySelector('[data-ov=spindle-override] .by').textContent === 'by M49'");
    shows(&mut browser, 100, "1 000");
    let keys = "[...document.querySelectorAll('[data-ov=spindle-override] button')].map(b => b.getAttribute('aria-disabled'))";
    assert_eq!(browser.evaluate(keys), json!(["true", "true", "true"]));
    browser.press(MORE);
    std::thread::sleep(Duration::from_millis(300));
    assert!(has(0.95)(&operated.wait(|_| true)));
    // The operator has the feed all the same.
    browser.press("[data-ov=feed-override] button:last-child");
    let _faster = operated.wait(|status| (status.feed_override - 1.05).abs() < 1e-9);
    let _aborted = operated.operate(&["abort"]);
    let _idle = operated.wait_for(MachineState::Idle);
    let _ended = running.wait();
    browser.wait("document.querySelector('[data-ov=spindle-override] .by').textContent === ''");
    assert_eq!(browser.evaluate(keys), json!([null, null, null]));
    drop(live);
}
