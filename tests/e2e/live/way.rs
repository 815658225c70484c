//! Tests of the ways of a program on the page: back along the path and on, from a line, and the call for a person.

use std::time::Duration;

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Services, Watchdog};
use serde_json::json;

use super::PATIENCE;
use super::life::{HALF, WHOLE, press};
use super::operated_page::operated_page;

/// Lines that take about a second each, one of them with a text that would be an element.
fn program() -> String {
    let lines = (1..200).map(|n| format!("G1 X{} Y{} (<i id=evil>)\n", n % 2 * 10, n % 3 * 5));
    format!("G21 G90 F600\n{}M2\n", lines.collect::<String>())
}

fn shown_line(browser: &mut Browser) -> u64 {
    browser.evaluate("S.status.line").as_u64().unwrap()
}

fn key_press(browser: &mut Browser, key: &str, code: &str) {
    for kind in ["keyDown", "keyUp"] {
        let event = json!({ "type": kind, "key": key, "code": code });
        let _done = browser.call("Input.dispatchKeyEvent", &event);
    }
}

fn back_and_forward(browser: &mut Browser, services: &Services<'_>) {
    browser.press("[data-name=\"way.ngc\"]");
    press(browser, "#chosen [data-do=run]", HALF);
    browser.wait("S.state === 'running' && S.view === 'operate' && S.status.line > 5");
    browser.press("[data-c=hold]");
    browser.wait("S.state === 'held'");
    let held = shown_line(browser);
    // What begins motion is pressed for half a second.
    browser.wait("document.querySelector('#way [data-do=back]')");
    browser.press("#way [data-do=back]");
    std::thread::sleep(HALF);
    let _still_held = services.wait_for(MachineState::Held);
    press(browser, "#way [data-do=back]", HALF);
    browser.wait(&format!(
        "S.state === 'running' && S.status.mode === 'backwards' && S.status.line < {held} - 1"
    ));
    // The page is painted a moment after its state is known.
    browser.wait("document.querySelector('#word').textContent.includes('backwards')");
    key_press(browser, " ", "Space");
    let _held = services.wait_for(MachineState::Held);
    browser.wait("S.state === 'held' && document.querySelector('[data-c=go] span').textContent === 'Forward'");
    let back = shown_line(browser);
    assert!(back < held, "{back} {held}");
    press(browser, "[data-c=go]", HALF);
    browser.wait(&format!(
        "S.state === 'running' && S.status.mode === 'program' && S.status.line > {held}"
    ));
    press(browser, "[data-c=abort]", WHOLE);
    browser.wait("S.state === 'idle'");
}

/// On the smallest panel: all that has to be known and pressed is in sight.
fn from_a_line(browser: &mut Browser) {
    let size = json!({ "width": 800, "height": 480, "deviceScaleFactor": 1, "mobile": false });
    let _resized = browser.call("Emulation.setDeviceMetricsOverride", &size);
    browser.evaluate("setView('programs')");
    press(browser, "#runkeys [data-do=from-line]", Duration::ZERO);
    browser.evaluate("document.querySelector('#fromline').value = '100'");
    // What is typed stays while keys beside it become possible.
    browser.evaluate(
        "$('#found').kept = ''; $('#fromline').focus(); paintChosen(); $('#found').kept = ''; paintChosen()",
    );
    assert_eq!(
        browser.evaluate("[$('#fromline').value, document.activeElement.id].join()"),
        "100,fromline"
    );
    press(browser, "[data-do=compare]", Duration::ZERO);
    browser.wait("document.querySelectorAll('.agree .around div').length === 5");
    let rows = "$$('.agree tr.differs th').map(th => th.textContent).join()";
    assert!(browser.evaluate(rows).as_str().unwrap().contains('X'));
    let marked = browser.evaluate("document.querySelector('.agree .around .cur').textContent");
    assert!(marked.as_str().unwrap().contains("<i id=evil>"), "{marked}");
    assert!(
        browser
            .evaluate("document.querySelector('#evil')")
            .is_null()
    );
    browser.wait(
        "(() => { const key = document.querySelector('[data-do=begin-there]:not([aria-disabled])'); \
         if (!key) return false; const r = key.getBoundingClientRect(); \
         return key.contains(document.elementFromPoint(r.x + r.width / 2, r.bottom - 3)); })()",
    );
    browser.press_for("[data-do=begin-there]", HALF);
    std::thread::sleep(HALF);
    assert_eq!(
        browser.evaluate("S.state"),
        "idle",
        "it loses work: pressed for a second"
    );
    // What was agreed to is of one text: with another one nothing begins.
    browser.evaluate("S.agree.info = { ...S.agree.info, generation: -1 }");
    press(browser, "[data-do=begin-there]", WHOLE);
    browser.wait("S.refusal.includes('is looked at anew') && S.agree === null");
    assert_eq!(browser.evaluate("S.state"), "idle");
    press(browser, "#runkeys [data-do=from-line]", Duration::ZERO);
    browser.evaluate("document.querySelector('#fromline').value = '100'");
    press(browser, "[data-do=compare]", Duration::ZERO);
    // The key is painted anew with the text around the line.
    browser.wait("document.querySelectorAll('.agree .around div').length === 5");
    press(browser, "[data-do=begin-there]", WHOLE);
    browser.wait("S.state === 'running' && S.status.line >= 100");
    press(browser, "[data-c=abort]", WHOLE);
    browser.wait("S.state === 'idle'");
}

/// What is wrong is shown where it is.
fn findings(browser: &mut Browser) {
    browser.evaluate("setView('programs')");
    browser.press("[data-name=\"wrong.ngc\"]");
    browser.wait("document.querySelector('.finding mark')");
    let found = browser.evaluate(
        "[document.querySelector('.finding mark').textContent, document.querySelector('.finding pre').textContent, \
         document.querySelector('.finding p').textContent, document.querySelector('#evil')]",
    );
    assert_eq!(
        (&found[0], &found[1]),
        (&"G".into(), &"3G2 X3 Y4 (<i id=evil>)".into())
    );
    assert!(
        found[2].as_str().unwrap().starts_with("line 3, column 1:"),
        "{found}"
    );
    assert!(found[3].is_null());
}

fn a_person_is_called(browser: &mut Browser) {
    let icon = browser.evaluate("document.querySelector('link[rel=icon]').href");
    let before = browser.evaluate("BELL.count").as_u64().unwrap();
    browser.press("[data-name=\"stop.ngc\"]");
    press(browser, "#chosen [data-do=run]", HALF);
    browser.wait(&format!(
        "S.state === 'program-stop' && BELL.count > {before}"
    ));
    assert_eq!(browser.evaluate("BELL.sound.state"), "running");
    browser.wait("document.title.startsWith('Program stop')");
    assert!(browser.evaluate("document.querySelector('link[rel=icon]').href") != icon);
    // Once for one cause, and never again once that is not wanted.
    std::thread::sleep(WHOLE);
    assert_eq!(browser.evaluate("BELL.count").as_u64(), Some(before + 1));
    browser.evaluate("BELL.rang = -1e9");
    browser.wait(&format!("BELL.count === {before} + 2"));
    browser.evaluate("BELL.how = 'all'");
    browser.press("#bell");
    browser
        .wait("BELL.how === 'off' && document.querySelector('#bell').title.includes('not at all')");
    browser.evaluate("BELL.rang = -1e9");
    std::thread::sleep(WHOLE);
    assert_eq!(browser.evaluate("BELL.count").as_u64(), Some(before + 2));
    press(browser, "[data-c=go]", HALF);
    browser.wait("S.state === 'idle' && S.status.day.some(job => job.name === 'stop.ngc' && job.end === 'done')");
}

#[test]
fn a_program_goes_back_and_on_and_from_a_line() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let way = program();
    let programs = [
        ("way.ngc", way.as_str()),
        ("wrong.ngc", "G21 G90\nG0 X5\nG2 X3 Y4 (<i id=evil>)\nM2\n"),
        ("stop.ngc", "G21 G90 F600\nG1 X1\nM0 (look)\nG1 X2\nM2\n"),
    ];
    let page = operated_page(&instance, (1024, 768), &programs, &[]);
    let Some((mut browser, live, service, services)) = page else {
        return;
    };
    browser.evaluate("setView('programs')");
    browser.wait("document.querySelector('[data-name=\"way.ngc\"]')");
    back_and_forward(&mut browser, &services);
    from_a_line(&mut browser);
    findings(&mut browser);
    a_person_is_called(&mut browser);
    drop((live, service));
    drop(services.end());
}
