//! The test of a whole life with the mouse alone: off, home, jog, zero, upload, check, run, tool change,
//! hold, jog away, return, back along the path and on, abort, and from a line to the end. Then another client does the
//! same, and the page follows.
#![allow(
    clippy::print_stderr,
    reason = "a test that fails tells what it pressed in vain"
)]

use std::time::Duration;

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Operated, Watchdog};

use super::other_client::lives_the_same;
use super::{Live, PATIENCE};

pub(super) const HALF: Duration = Duration::from_millis(800);
pub(super) const WHOLE: Duration = Duration::from_millis(1400);
const PRESSES: u32 = 5;
/// Behind which a press is taken for lost.
const LOST: Duration = Duration::from_secs(15);
/// What the page says where a press is to be done again.
const AGAIN: [&str; 2] = ["came late", "changed under the finger"];

/// Presses a key for long enough, as soon as it can be pressed; and again, as a person would, where the page says that
/// the order came late, or that the key changed, which it does on a busy host.
pub(super) fn press(browser: &mut Browser, selector: &str, long: Duration) {
    for nth in 1.. {
        assert!(nth <= PRESSES, "{selector} was pressed {PRESSES} times");
        browser.wait(&format!(
            "document.querySelector('{selector}:not([aria-disabled=true])')"
        ));
        browser.evaluate("S.refused_at = 0");
        browser.press_for(selector, long);
        // Every order that is answered sets the time, and what is refused.
        let answered = "new Promise(done => { const from = performance.now(), look = () => \
                        S.refused_at ? done(S.refusal) : performance.now() - from > 1000 ? done('') : setTimeout(look, 30); look(); })";
        let refusal = browser.evaluate(answered);
        // The page forgets it, and a test that fails later by it would not say why.
        if refusal.as_str().is_some_and(|text| !text.is_empty()) {
            eprintln!("{selector}: {refusal}");
        }
        let is_again = |text: &str| AGAIN.iter().any(|words| text.contains(words));
        if !refusal.as_str().is_some_and(is_again) {
            return;
        }
    }
}

/// Presses a key that brings the machine to a state, and again where nothing came of it: on a busy host a press may be lost,
/// and a person would press anew.
fn press_for_state(
    browser: &mut Browser,
    operated: &Operated<'_>,
    selector: &str,
    state: MachineState,
) {
    for nth in 1.. {
        assert!(nth <= PRESSES, "nothing came of {selector}");
        press(browser, selector, HALF);
        if operated.comes_to(state, LOST) {
            return;
        }
        eprintln!("{selector}: nothing came of press {nth}");
    }
}

/// A program that asks for a tool, and then goes on for long.
fn program() -> String {
    let mut text = "G21 G90 F6000\nT2 M6\n".to_owned();
    // Long moves, so that it takes long and is soon planned on a busy host, too.
    for _ in 0..40 {
        text.push_str("G1 X160 Y80\nX0 Y0\n");
    }
    text + "(LAST CUT)\nG0 X1\nG1 X160 Y80\nX0 Y0\nM2\n"
}

/// The line of the program that its last section begins with, some seconds before its end.
pub(super) const NEAR_THE_END: u32 = 84;

/// Shows another part of the page.
fn go_to(browser: &mut Browser, view: &str) {
    browser.press(&format!("#tabs [data-v={view}]"));
    browser.wait(&format!("S.view === '{view}'"));
}

/// Power and home.
fn power_and_home(browser: &mut Browser, operated: &Operated<'_>) {
    go_to(browser, "setup");
    press(browser, "#rail [data-do=power]", Duration::ZERO);
    std::thread::sleep(HALF);
    let _still_off = operated.wait_for(MachineState::Off);
    let power = "#rail [data-do=power]";
    press_for_state(browser, operated, power, MachineState::NotHomed);
    browser.wait("S.state === 'not-homed'");
    let home = "#rail [data-do=home]";
    press_for_state(browser, operated, home, MachineState::Idle);
    browser.wait("S.state === 'idle' && !document.querySelector('.jog[aria-disabled]')");
}

/// A finger on X+, for as long as it is down. On a busy host the page may lose it: then it comes down anew.
fn jog(browser: &mut Browser, operated: &Operated<'_>) {
    let before = operated.position()[0];
    let key = ".jog[aria-label=\"move X+\"]";
    while operated.position()[0] < before + 2.0 {
        let place = browser.finger_down(key);
        std::thread::sleep(HALF);
        browser.finger_up(&place);
        std::thread::sleep(HALF);
    }
    let after = operated.position()[0];
    std::thread::sleep(Duration::from_millis(300));
    assert_eq!(operated.position()[0].to_bits(), after.to_bits());
}

/// Zero by touching the number: the origin is where the machine stands, however far the finger moved it.
fn zero(browser: &mut Browser, operated: &Operated<'_>) {
    let stands = operated.position()[0];
    browser.press("#sX");
    press(browser, "#sheet [data-do=zero]", Duration::ZERO);
    browser.wait("S.status.offset && document.querySelector('#sX').textContent === '0.000'");
    browser.wait(&format!(
        "SETUP.systems && Math.abs(SETUP.systems[0].origin.X - ({stands})) < 1e-3"
    ));
}

/// A program is dropped, looked at, and run. The tool is asked for, and answered.
fn run(browser: &mut Browser, operated: &Operated<'_>, file: &str) {
    go_to(browser, "programs");
    browser.drop_file("#list", file);
    browser.wait("FOLDER.chosen === 'life.ngc' && LOOK.info && LOOK.info.report");
    // What was found, and how long it takes: 82 ways of 179 mm at 100 mm/s, and a little for the corners.
    browser.wait("document.querySelector('#found').textContent.includes('No mistakes found')");
    let takes = browser.evaluate("LOOK.info.seconds").as_f64().unwrap();
    assert!((143.0..160.0).contains(&takes), "{takes}");
    let run = "#chosen [data-do=run]";
    press_for_state(browser, operated, run, MachineState::Awaiting);

    // The tool is asked for, and answered.
    browser.wait(
        "S.view === 'operate' && S.state === 'awaiting' && \
         document.querySelector('#attn').textContent.includes('put T2 in the spindle'.replace('put', 'Put'))",
    );
    let done = "#attn [data-do=done]";
    press_for_state(browser, operated, done, MachineState::Running);
    browser.wait("S.state === 'running' && S.status.program_is_shown && PLAN");
    browser.wait("document.querySelector('#blocks .cur').textContent.includes('X')");
    browser.press("[data-ov=feed-override] button:last-child");
    let _faster = operated.wait(|status| (status.feed_override - 1.05).abs() < 1e-9);
}

/// Hold, jog away, return, and on.
fn hold_and_return(browser: &mut Browser, operated: &Operated<'_>) {
    browser.press("[data-c=hold]");
    let _held = operated.wait_for(MachineState::Held);
    go_to(browser, "setup");
    browser.wait("S.state === 'held' && !document.querySelector('.jog[aria-disabled]')");
    let key = ".jog[aria-label=\"move Z+\"]";
    browser.press_for(key, HALF);
    let _away = operated
        .wait(|status| status.state == MachineState::Held.code() && status.away[2].abs() > 0.1);
    go_to(browser, "operate");
    browser.wait("document.querySelector('[data-c=go] small').textContent === 'return first'");
    press(browser, "#attn [data-do=return]", HALF);
    let _back = operated
        .wait(|status| status.state == MachineState::Held.code() && status.away[2].abs() < 1e-9);
    browser.wait("document.querySelector('[data-c=go]').getAttribute('aria-disabled') === null");
    press(browser, "[data-c=go]", HALF);
    let _moving = operated.wait_for(MachineState::Running);
}

/// Seconds that the ribbon takes the tool back.
pub(super) const BACK_S: f64 = 5.0;

/// Hold, the ribbon drags the tool back by the way of some seconds, and Resume goes on from there.
fn shuttle_back_and_on(browser: &mut Browser, operated: &Operated<'_>) {
    // So far that there is as much behind it.
    browser.wait(&format!(
        "S.status.feed_mm_s > 1 && S.p * DT() > {BACK_S} + 1"
    ));
    browser.press("[data-c=hold]");
    browser.wait("S.state === 'held' && canShuttle()");
    let held = operated.wait_for(MachineState::Held).path_s;
    let place_s = |browser: &mut Browser| browser.evaluate("S.p * DT()").as_f64().unwrap();
    let held_s = place_s(browser);
    while place_s(browser) > held_s - BACK_S {
        let place = browser.finger_down("#ribbon");
        std::thread::sleep(HALF);
        for step in 1..10 {
            browser.finger_moved(&place, -20.0 * f64::from(step));
            std::thread::sleep(Duration::from_millis(100));
        }
        std::thread::sleep(WHOLE);
        browser.finger_up(&place);
        browser.wait("S.state === 'held' && SHUTTLE.gesture === null");
    }
    let back = operated.wait_for(MachineState::Held).path_s;
    assert!(back < held, "{back} {held}");
    press(browser, "[data-c=go]", HALF);
    let _beyond = operated
        .wait(|status| status.state == MachineState::Running.code() && status.path_s > held + 1.0);
}

/// From a line near the end, whose state is compared before, to the end.
fn from_a_line_to_the_end(browser: &mut Browser, operated: &Operated<'_>) {
    go_to(browser, "programs");
    press(browser, "#runkeys [data-do=from-line]", Duration::ZERO);
    // Its sections are known once it is planned: anew, because the machine stands elsewhere now.
    let last = format!("#found [data-do=take-line][data-line=\"{NEAR_THE_END}\"]");
    press(browser, &last, Duration::ZERO);
    press(browser, "[data-do=compare]", Duration::ZERO);
    browser.wait("document.querySelectorAll('.agree .around div').length === 5");
    let begin = "[data-do=begin-there]";
    for nth in 1.. {
        assert!(nth <= PRESSES, "nothing came of {begin}");
        press(browser, begin, WHOLE);
        if operated.comes_to(MachineState::Running, LOST) {
            break;
        }
    }
    browser.wait(&format!(
        "S.state === 'running' && S.status.line >= {NEAR_THE_END}"
    ));
    let _end = operated.wait_for(MachineState::Idle);
    browser.wait(
        "S.status.day.filter(job => job.name === 'life.ngc' && job.end === 'done').length === 1",
    );
}

#[test]
fn a_machine_is_run_with_the_mouse_alone() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1440, 900) else {
        return;
    };
    let state = instance.path("state");
    std::fs::create_dir(&state).unwrap();
    let folder = instance.path("programs");
    std::fs::create_dir(&folder).unwrap();
    let kept = format!("directory = \"{state}\"");
    let changes = [
        ("homing = \"none\"", "homing = \"drive\""),
        ("# directory = \"state\"", kept.as_str()),
    ];
    let operated = Operated::new(&instance, &changes, "\n[m_codes.M6]\ntimeout_s = 120\n");
    let _interpolator = operated.process(&["interpolator", "--best-effort"]);
    let _servo = operated.process(&["servo", "--best-effort"]);
    let _service = operated.service();
    let off = operated.wait_for_drives();
    assert!(off.homed & off.joints != off.joints, "nothing is homed yet");
    let config = ["--config", operated.config(), "--programs", &folder];
    let live = Live::start(&instance, &[&["--may", "operate"], &config[..]].concat());
    browser.open(&live.url);
    browser.wait("typeof S !== 'undefined' && S.operates && S.state === 'off' && SETUP.jog");

    power_and_home(&mut browser, &operated);
    jog(&mut browser, &operated);
    zero(&mut browser, &operated);
    run(
        &mut browser,
        &operated,
        &instance.file("life.ngc", &program()),
    );
    hold_and_return(&mut browser, &operated);
    shuttle_back_and_on(&mut browser, &operated);

    // Abort is pressed for a second.
    browser.wait("S.state === 'running'");
    press(&mut browser, "[data-c=abort]", HALF);
    std::thread::sleep(HALF);
    let _still_moving = operated.wait_for(MachineState::Running);
    press(&mut browser, "[data-c=abort]", WHOLE);
    let _idle = operated.wait_for(MachineState::Idle);
    browser.wait("S.status.day.some(job => job.name === 'life.ngc' && job.end === 'aborted')");

    from_a_line_to_the_end(&mut browser, &operated);
    lives_the_same(&mut browser, &operated, &format!("{folder}/life.ngc"));
    drop(live);
}

#[test]
fn a_page_says_whole_words_and_no_more_than_it_knows() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1024, 768) else {
        return;
    };
    let operated = Operated::new(&instance, &[], "");
    let _interpolator = operated.process(&["interpolator", "--best-effort"]);
    let config = ["--config", operated.config()];
    let live = Live::start(&instance, &[&["--may", "operate"], &config[..]].concat());
    browser.open(&live.url);
    browser.wait("typeof S !== 'undefined' && S.operates && S.state === 'off'");
    // States are called as everywhere else.
    for state in MachineState::ALL {
        let name = state.name();
        let word = browser.evaluate(&format!(
            "(() => {{ const was = S.state; S.state = '{name}'; const word = wordsNow()[1]; S.state = was; return word; }})()"
        ));
        let word = word.as_str().unwrap().to_lowercase().replace(' ', "-");
        assert_eq!(word, name);
    }
    // A short length has a number.
    assert_eq!(browser.evaluate("lengthWords(0.0002)"), "200 nm");
    assert_eq!(browser.evaluate("lengthWords(0.05)"), "50 µm");
    assert_eq!(browser.evaluate("lengthWords(2000)"), "2 000 mm");
    // Who operates is said in whole words.
    let fits = "(() => { S.operates = false; S.asks = false; paintBar(); \
                const e = document.querySelector('#mode span'); const text = e.textContent; \
                return [text, e.scrollWidth <= e.clientWidth && e.scrollHeight <= e.clientHeight + 1]; })()";
    let fits = browser.evaluate(fits);
    assert_eq!(fits[0], "Another page operates.");
    assert_eq!(fits[1], true);
    // What was kept back on its way is not taken for what is so now.
    let late = "(() => { const old = { ...S.status, updated_ns: S.status.updated_ns - 5e9 }; \
                heard(1, new TextEncoder().encode(JSON.stringify(old)).buffer); return S.state; })()";
    assert_eq!(browser.evaluate(late), "stale");
    // What was not heard is not known, and a stop is given all the same.
    let unheard = "(() => { S.state = 'stale'; S.heard = 0; paintBar(); \
                   const key = c => document.querySelector(`[data-c=${c}]`); \
                   return [key('hold').textContent, key('hold').ariaDisabled, key('abort').ariaDisabled]; })()";
    let unheard = browser.evaluate(unheard);
    assert_eq!(unheard[0], "Holdstate not known", "{unheard}");
    for key in [1, 2] {
        assert_ne!(unheard[key], "true", "{unheard}");
    }
    drop(live);
}
