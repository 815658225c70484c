//! Tests of the queue of programs: a person starts each of them, and the next one is looked at when the present one ended well.

use std::time::Duration;

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Services, Watchdog};
use serde_json::{Value, json};

use super::hands::Page;
use super::life::{HALF, WHOLE, press};
use super::operated_page::operated_page;
use super::{Live, PATIENCE};

/// Waits until the queue has these programs in these states.
fn is(live: &Live, wanted: &[(&str, &str)]) {
    let is_of = |(entry, (name, state)): (&Value, &(&str, &str))| {
        entry["name"] == *name && entry["state"] == *state
    };
    let _told = live.told(|status| {
        let queue = status["queue"].as_array();
        queue
            .is_some_and(|queue| queue.len() == wanted.len() && queue.iter().zip(wanted).all(is_of))
    });
}

const START: &str = "#way [data-do=queue-start]";

/// Starts the first one, which ends well, and the second, which does not.
fn started_by_a_person(browser: &mut Browser, live: &Live, services: &Services<'_>) {
    // It is pressed for half a second, and nothing begins without that.
    browser.evaluate("setView('operate')");
    browser.wait(&format!(
        "document.querySelector('{START}:not([aria-disabled=true])')"
    ));
    browser.press(START);
    std::thread::sleep(HALF);
    let _still_idle = services.wait_for(MachineState::Idle);
    press(browser, START, HALF);
    let _there = services.wait(|status| (status.position[0] - 3.0).abs() < 1e-9);
    // It ended well: the next one is looked at, and waits for a person.
    is(live, &[("b.ngc", "waits")]);
    browser.wait("S.state === 'idle' && queued().length === 1 && QUEUE.info && QUEUE.info.program.name === 'b.ngc' && QUEUE.info.fingerprint");
    browser.wait(&format!(
        "document.querySelector('{START}').textContent.includes('b.ngc')"
    ));
    std::thread::sleep(WHOLE);
    let rests = services.wait_for(MachineState::Idle);
    assert!(
        (rests.position[0] - 3.0).abs() < 1e-9,
        "nothing begins by itself"
    );

    // What stands beside the key may change under the finger: the key is pressed all the same.
    let finger = browser.finger_down(START);
    browser.evaluate("QUEUE.info.seconds += 1; paintWay()");
    std::thread::sleep(HALF);
    browser.finger_up(&finger);
    // What did not end well stays, and says so.
    browser.wait("S.state === 'running' && S.status.program_is_shown");
    is(live, &[("b.ngc", "runs")]);
    browser.wait("S.status.active_program && S.status.active_program.tolerance_ratio === 2");
    press(browser, "[data-c=abort]", WHOLE);
    is(live, &[("b.ngc", "ended")]);
    browser.wait(
        "S.state === 'idle' && document.querySelector('#way').textContent.includes('It has ended')",
    );
}

#[test]
fn programs_of_the_queue_are_started_one_by_one_by_a_person() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let long = format!("G21 G90 F600\n{}M2\n", "G1 X10\nX0\n".repeat(50));
    let programs = [
        ("a.ngc", "G21 G90 F1200\nG1 X3\nM2\n"),
        ("b.ngc", long.as_str()),
        ("c.ngc", "G21 G90 F1200\nG1 X5\nM2\n"),
    ];
    let page = operated_page(&instance, (1024, 768), &programs, &[]);
    let Some((mut browser, live, service, services)) = page else {
        return;
    };

    // Another page, which does not operate, puts nothing there, and starts nothing.
    let other = Page(&live, 77);
    let add = json!({ "kind": "queue-add", "name": "a.ngc" });
    assert_eq!(other.order(&add).0, 409);
    browser.evaluate("setView('programs')");
    for name in ["c.ngc", "a.ngc", "b.ngc"] {
        browser.wait(&format!("document.querySelector('[data-name=\"{name}\"]')"));
        browser.press(&format!("#list [data-name=\"{name}\"]"));
        if name == "b.ngc" {
            browser.wait("LOOK.info && LOOK.info.report && document.querySelector('.tolerances')");
            browser.press("[data-do=try-tolerance][data-ratio=\"2\"]");
        }
        press(
            &mut browser,
            &format!("#runkeys [data-do=queue-add][data-name=\"{name}\"]"),
            Duration::ZERO,
        );
    }
    is(
        &live,
        &[("c.ngc", "waits"), ("a.ngc", "waits"), ("b.ngc", "waits")],
    );
    // In another order, and one less and one more.
    press(
        &mut browser,
        ".queued:nth-of-type(3) [data-do=queue-down]",
        Duration::ZERO,
    );
    is(
        &live,
        &[("a.ngc", "waits"), ("c.ngc", "waits"), ("b.ngc", "waits")],
    );
    browser.wait("queued()[0].name === 'a.ngc' && QUEUE.info && QUEUE.info.fingerprint");
    let second = browser.evaluate("queued()[1].id");
    browser.evaluate(&format!("order('queue-remove', {{ entry: {second} }})"));
    is(&live, &[("a.ngc", "waits"), ("b.ngc", "waits")]);
    browser.wait("queued().length === 2 && queued()[1].name === 'b.ngc'");
    let ratios = browser.evaluate("queued().map(entry => entry.tolerance_ratio)");
    assert_eq!(ratios, json!([1, 2]));
    let told = browser.evaluate("document.querySelector('.queued:last-of-type').textContent");
    assert!(told.as_str().unwrap().contains("tolerance × 2"), "{told}");
    // Only the first is started.
    let refused = browser.evaluate(
        "order('run', { name: 'b.ngc', program: QUEUE.info.fingerprint, queued: queued()[1].id, tolerance_ratio: 2 }).then(said => [said.status, said.reason])",
    );
    assert_eq!(refused[0], 409, "{refused}");
    assert!(
        refused[1]
            .as_str()
            .unwrap()
            .contains("another one is the first"),
        "{refused}"
    );

    started_by_a_person(&mut browser, &live, &services);
    drop((live, service));
    drop(services.end());
}
