//! Tests of a gamepad at a page: it moves axes by a stick while a shoulder button is pressed, and holds.
#![allow(
    clippy::float_cmp,
    reason = "axes that rest stay where they are to the bit"
)]

use std::time::{Duration, Instant};

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Services, Watchdog};

use super::PATIENCE;
use super::operated_page::operated_page;

/// A pad of the layout that browsers know. A stick in a hand tells something new all the time.
const PAD: &str = "(() => { window.PADDED = { connected: true, mapping: 'standard', still: false, \
    get timestamp() { return this.still ? 1 : performance.now(); }, axes: [0, 0, 0, 0], \
    buttons: Array.from({ length: 17 }, () => ({ pressed: false })) }; \
    Object.defineProperty(navigator, 'getGamepads', { value: () => [PADDED] }); \
    dispatchEvent(new Event('gamepadconnected')); })()";
/// Shorter than a jog that is asked for takes to begin on a busy host.
const NOTHING: Duration = Duration::from_millis(400);

fn stick(browser: &mut Browser, place: usize, out: f64) {
    browser.evaluate(&format!("PADDED.axes[{place}] = {out}"));
}

fn button(browser: &mut Browser, number: usize, is_down: bool) {
    browser.evaluate(&format!("PADDED.buttons[{number}].pressed = {is_down}"));
}

/// Pushes a stick until an axis has gone so far: behind a page that a busy host has stopped, it goes through its middle
/// and is pushed again.
fn push(
    (browser, services): (&mut Browser, &Services<'_>),
    (place, out): (usize, f64),
    is_there: impl Fn(&[f64]) -> bool,
) {
    loop {
        stick(browser, place, out);
        let begun = Instant::now();
        while begun.elapsed() < Duration::from_secs(4) {
            if is_there(&services.wait(|_| true).position) {
                return;
            }
        }
        stick(browser, place, 0.0);
        std::thread::sleep(NOTHING);
    }
}

/// The axes rest, and stay where they are.
fn rests(services: &Services<'_>) -> [f64; 3] {
    let rest = services.wait_for(MachineState::Idle).position;
    std::thread::sleep(NOTHING);
    let later = services.wait(|_| true).position;
    assert_eq!(rest.map(f64::to_bits), later.map(f64::to_bits));
    [later[0], later[1], later[2]]
}

#[test]
fn a_stick_moves_axes_while_a_shoulder_button_is_pressed() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let page = operated_page(&instance, (1024, 768), &[], &[]);
    let Some((mut browser, live, service, services)) = page else {
        return;
    };
    browser.focus();
    browser.evaluate("setView('setup')");
    browser.evaluate(PAD);
    browser.wait("document.querySelector('#padwords').textContent.startsWith('Gamepad')");
    let begin = rests(&services);

    // Not without the button, and not with a stick that was out before it.
    stick(&mut browser, 0, 0.9);
    std::thread::sleep(NOTHING);
    button(&mut browser, 4, true);
    assert_eq!(rests(&services), begin);
    stick(&mut browser, 0, 0.0);
    std::thread::sleep(NOTHING);
    push((&mut browser, &services), (0, 0.9), |at| {
        at[0] > begin[0] + 1.0
    });
    // The other way without an end between, and up with the other stick.
    push((&mut browser, &services), (0, -0.9), |at| {
        at[0] < begin[0] - 1.0
    });
    stick(&mut browser, 0, 0.0);
    let after = rests(&services);
    assert!((after[1] - begin[1]).abs() < 1e-9 && (after[2] - begin[2]).abs() < 1e-9);
    push((&mut browser, &services), (3, -1.0), |at| {
        at[2] > begin[2] + 0.5
    });
    // Hold, which is let go before the stick: that goes through its middle before it moves again.
    button(&mut browser, 1, true);
    let held = rests(&services);
    button(&mut browser, 1, false);
    assert_eq!(rests(&services), held);
    stick(&mut browser, 3, 0.0);
    std::thread::sleep(NOTHING);

    // A pad that tells nothing new is gone; so is one that is told to be.
    for ends in [
        "PADDED.still = true",
        "PADDED.connected = false; dispatchEvent(new Event('gamepaddisconnected'))",
    ] {
        let x = rests(&services)[0];
        push((&mut browser, &services), (0, 0.6), |at| at[0] > x + 0.5);
        browser.evaluate(ends);
        let _rest = rests(&services);
        browser.evaluate("PADDED.still = false");
        let _stays = rests(&services);
        stick(&mut browser, 0, 0.0);
        std::thread::sleep(NOTHING);
    }
    drop((live, service));
}
