//! The test of a whole life that commands in a terminal drive, and a page that follows it without leave to do anything.

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Operated, Watchdog};

use super::life::{NEAR_THE_END, program};
use super::{Live, PATIENCE};

/// Waits until the page says that the machine is in a state, in the words of that state.
fn shows(browser: &mut Browser, state: MachineState) {
    let name = state.name();
    browser.wait(&format!(
        "S.state === '{name}' && document.querySelector('#word').firstChild.textContent === wordsNow()[1]"
    ));
}

/// Waits until the page shows where X is.
fn shows_x(browser: &mut Browser, machine_mm: f64, origin_mm: f64) {
    browser.wait(&format!(
        "Math.abs(parseFloat(document.querySelector('#sX').textContent.replace('\u{2212}', '-').replace(/[^-.0-9]/g, '')) - ({})) < 6e-4",
        machine_mm - origin_mm
    ));
}

fn prepares(operated: &Operated<'_>, browser: &mut Browser) {
    operated.operate(&["enable"]);
    shows(browser, MachineState::NotHomed);
    operated.operate(&["home"]);
    shows(browser, MachineState::Idle);
    operated.operate(&["jog", "X2", "--feed", "600"]);
    let [x, ..] = operated.position();
    shows_x(browser, x, 0.0);
    operated.operate(&["offsets", "set", "G54", "X1.25"]);
    shows_x(browser, x, 1.25);
    operated.operate(&["offsets", "set", "G54", "X0"]);
}

fn runs(operated: &Operated<'_>, browser: &mut Browser, file: &str) {
    let job = operated.process(&["run-file", file]);
    shows(browser, MachineState::Awaiting);
    browser.wait("document.querySelector('#attn').textContent.includes('T2')");
    operated.operate(&["acknowledge"]);
    browser.wait("S.state === 'running' && S.status.program_is_shown && PLAN && S.status.active_program.name === 'life.ngc'");
    operated.operate(&["override", "110"]);
    browser.wait("S.status.feed_override === 1.1 && document.querySelector('[data-ov=feed-override]').textContent.includes('110')");
    browser.wait("S.status.line > 5");
    operated.operate(&["hold"]);
    shows(browser, MachineState::Held);
    operated.operate(&["jog", "Z3", "--feed", "600"]);
    browser.wait("document.querySelector('[data-c=go] small').textContent === 'return first'");
    operated.operate(&["return"]);
    browser.wait("document.querySelector('[data-c=go] small').textContent !== 'return first'");
    let held = browser.evaluate("S.p").as_f64().unwrap();
    operated.operate(&["reverse"]);
    browser.wait(&format!(
        "S.state === 'running' && S.p < {held} && document.querySelector('#word').textContent.includes('backwards')"
    ));
    operated.operate(&["hold"]);
    shows(browser, MachineState::Held);
    operated.operate(&["forward"]);
    browser.wait(&format!("S.state === 'running' && S.p > {held}"));
    operated.operate(&["abort"]);
    let _aborted = job.wait();
    shows(browser, MachineState::Idle);
    browser.wait("S.status.day.some(job => job.name === 'life.ngc' && job.end === 'aborted')");

    let line = NEAR_THE_END.to_string();
    let job = operated.process(&["run-file", file, "--from-line", &line, "--yes"]);
    browser.wait(&format!(
        "S.state === 'running' && S.status.line >= {NEAR_THE_END}"
    ));
    let _done = job.wait().expect(0);
    shows(browser, MachineState::Idle);
    browser.wait("S.status.day.some(job => job.name === 'life.ngc' && job.end === 'done')");
}

#[test]
fn a_page_follows_a_life_that_commands_drive() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1280, 800) else {
        return;
    };
    let state = instance.path("state");
    std::fs::create_dir(&state).unwrap();
    let kept = format!("directory = \"{state}\"");
    let changes = [
        ("homing = \"none\"", "homing = \"drive\""),
        ("# directory = \"state\"", kept.as_str()),
    ];
    let operated = Operated::new(&instance, &changes, "\n[m_codes.M6]\ntimeout_s = 120\n");
    let _interpolator = operated.process(&["interpolator", "--best-effort"]);
    let _servo = operated.process(&["servo", "--best-effort"]);
    let _service = operated.service();
    let _off = operated.wait_for_drives();
    let live = Live::start(&instance, &["--config", operated.config()]);
    browser.open(&live.url);
    browser.wait("typeof S !== 'undefined' && S.state === 'off'");
    shows(&mut browser, MachineState::Off);

    prepares(&operated, &mut browser);
    let file = instance.file("life.ngc", &program());
    runs(&operated, &mut browser, &file);
    // Power goes, and the page says so.
    operated.operate(&["disable"]);
    shows(&mut browser, MachineState::Off);
    drop(live);
}
