//! The test of the last two seconds before a fault: they are kept and shown for as long as it stands.

use std::time::Duration;

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Operated, Watchdog};
use rustix::process::Signal;
use serde_json::json;

use super::life::{WHOLE, press};
use super::screens::{CUT, HOLD_IS_IN_ITS_CORNER, resize};
use super::{Live, PATIENCE};
use crate::programs::long_program;

#[test]
fn the_last_seconds_before_a_fault_stay_until_it_is_reset() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1024, 768) else {
        return;
    };
    let operated = Operated::new(&instance, &[], "");
    let interpolator = operated.process(&["interpolator", "--best-effort"]);
    let servo = operated.process(&["servo", "--best-effort", "--stands", "0,0,0"]);
    let service = operated.service();
    let _off = operated.wait_for_drives();
    operated.operate(&["enable"]);
    let _idle = operated.wait_for(MachineState::Idle);
    let live = Live::start(
        &instance,
        &["--may", "operate", "--config", operated.config()],
    );
    browser.open(&live.url);
    browser.wait("typeof S !== 'undefined' && S.operates && S.state === 'idle' && SETUP.jog");
    let part = instance.file("part.ngc", &long_program());
    let running = operated.process(&["run-file", &part]);
    browser.wait("S.state === 'running' && RINGED.count > 100");
    std::thread::sleep(Duration::from_secs(3));
    assert_eq!(browser.evaluate("LAST.taken"), json!(null));
    // Its drives are not heard any more.
    servo.signal(Signal::STOP);
    let _faulted = operated.wait_for(MachineState::Faulted);
    browser.wait("S.state === 'faulted' && LAST.whole && $('#app').dataset.last === '1'");
    servo.signal(Signal::CONT);

    // Two seconds of it, in which X moved, and how it came to rest behind.
    let seen = browser.evaluate(
        "(() => { const { t, axes: [x] } = LAST.taken, before = x.v.filter((_, i) => t[i] < 0); \
         return [t[0], t[t.length - 1], Math.max(...before.map(Math.abs)), Math.max(...x.a.map(Math.abs)), Math.max(...x.j.map(Math.abs)), x.v[x.v.length - 1]]; })()",
    );
    let seen: Vec<f64> = serde_json::from_value(seen).unwrap();
    let [from, to, velocity, acceleration, jerk, at_rest] = seen[..] else {
        panic!("{seen:?}");
    };
    assert!((-2.01..-1.9).contains(&from) && to > 0.3, "{seen:?}");
    assert!(
        velocity > 20.0 && acceleration > 50.0 && jerk > 100.0,
        "{seen:?}"
    );
    assert!(at_rest.abs() < 1e-9, "{seen:?}");
    let says = browser.evaluate("[$('#lastof').textContent, $('#last canvas').getAttribute('aria-label'), $('#last canvas').toDataURL().length > 3000]");
    assert!(
        says[0].as_str().unwrap().starts_with("The last 2.0 s"),
        "{says}"
    );
    assert!(says[1].as_str().unwrap().contains("X: "), "{says}");
    assert_eq!(says[2], true);
    for screen in [(1440, 900), (800, 480), (390, 844), (1024, 768)] {
        resize(&mut browser, screen);
        let shown = browser.evaluate(&format!("[{HOLD_IS_IN_ITS_CORNER}, {CUT}]"));
        assert_eq!(shown, json!([true, ""]), "{screen:?}");
    }

    // Whatever is measured meanwhile does not take its place.
    let sum = "LAST.taken.axes[0].p.reduce((all, x, i) => all + x * i, 0)";
    let before = browser.evaluate(sum);
    browser.evaluate("RINGED.reset()");
    browser.wait("RINGED.count > 300");
    assert_eq!(browser.evaluate(sum), before);
    assert_eq!(browser.evaluate("$('#app').dataset.last"), "1");
    press(&mut browser, "#attn [data-do=reset]", WHOLE);
    let _reset = operated.wait(|status| status.state != MachineState::Faulted.code());
    browser.wait("!LAST.taken && $('#app').dataset.last === '0'");
    let _told = running.wait().expect(5);
    drop(live);
    for process in [service, servo, interpolator] {
        let _ended = process.end();
    }
}
