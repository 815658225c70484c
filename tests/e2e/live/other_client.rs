//! The life of the machine once more, by another client (the command line): the page, which nobody touches, follows.

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Operated};

use super::life::{BACK_S, NEAR_THE_END};

/// What the page says.
const WORD: &str = "document.querySelector('#word').textContent.toLowerCase()";
const GO: &str = "document.querySelector('[data-c=go] small').textContent";

/// Jobs of the program that have ended like this, as the page lists them.
fn ended(browser: &mut Browser, how: &str, times: u32) {
    browser.wait(&format!(
        "S.status.day.filter(job => job.name === 'life.ngc' && job.end === '{how}').length === {times}"
    ));
}

/// Off, home, jog and zero.
fn sets_up(browser: &mut Browser, operated: &Operated<'_>) {
    operated.operate(&["disable"]);
    browser.wait(&format!("S.state === 'off' && {WORD}.startsWith('off')"));
    operated.operate(&["enable"]);
    browser.wait("S.state !== 'off'");
    operated.operate(&["home"]);
    let home = operated.position();
    operated.operate(&["jog", "X3"]);
    let jogged = operated.position();
    assert!((jogged[0] - home[0] - 3.0).abs() < 1e-9, "{jogged:?}");
    operated.operate(&["mdi", "G21 G54 G10 L20 P1 X0 Y0 Z0"]);
    for axis in ["X", "Y", "Z"] {
        let shown = format!("document.querySelector('#w{axis}').textContent === '0.000'");
        browser.wait(&format!("S.state === 'idle' && {shown}"));
    }
}

/// Hold, jog away, return, and on.
fn holds_and_returns(browser: &mut Browser, operated: &Operated<'_>) {
    operated.operate(&["hold"]);
    browser.wait(&format!("S.state === 'held' && {WORD}.startsWith('held')"));
    operated.operate(&["jog", "Z2"]);
    browser.wait(&format!("{GO} === 'return first'"));
    operated.operate(&["return"]);
    browser.wait(&format!("S.state === 'held' && {GO} !== 'return first'"));
    operated.operate(&["resume"]);
    browser.wait("S.state === 'running'");
}

/// Back along the path by some seconds, and on.
fn goes_back_and_on(browser: &mut Browser, operated: &Operated<'_>) {
    browser.wait(&format!("S.p * DT() > {BACK_S} + 1"));
    operated.operate(&["hold"]);
    browser.wait("S.state === 'held'");
    let held_s = browser.evaluate("S.p * DT()").as_f64().unwrap();
    operated.operate(&["reverse"]);
    operated.operate(&["resume"]);
    browser.wait("document.querySelector('#feedof').textContent === 'back along the path'");
    browser.wait(&format!("S.p * DT() < {held_s} - {BACK_S}"));
    operated.operate(&["hold"]);
    operated.operate(&["forward"]);
    operated.operate(&["resume"]);
    browser.wait(&format!("S.state === 'running' && S.p * DT() > {held_s}"));
}

/// Does with commands what was done with the mouse, with the program of that file, and looks at the page at each step.
pub(super) fn lives_the_same(browser: &mut Browser, operated: &Operated<'_>, file: &str) {
    sets_up(browser, operated);
    let running = operated.process(&["run-file", file]);
    browser.wait(
        "S.state === 'awaiting' && document.querySelector('#attn').textContent.includes('Put T2 in the spindle')",
    );
    operated.operate(&["acknowledge"]);
    browser.wait(
        "S.state === 'running' && S.status.program_is_shown && PLAN && INFO.program.name === 'life.ngc' && \
         document.querySelector('#attn').textContent === '' && \
         document.querySelector('#blocks .cur').textContent.includes('X')",
    );
    holds_and_returns(browser, operated);
    goes_back_and_on(browser, operated);
    operated.operate(&["abort"]);
    ended(browser, "aborted", 2);
    browser.wait("S.state === 'idle'");
    let _aborted = running.wait().expect(5);

    let line = NEAR_THE_END.to_string();
    let from_line = ["run-file", file, "--from-line", &line, "--yes"];
    let running = operated.process(&from_line);
    browser.wait(&format!("S.state === 'running' && S.status.line >= {line}"));
    let _done = running.wait().expect(0);
    let _idle = operated.wait_for(MachineState::Idle);
    ended(browser, "done", 2);
}
