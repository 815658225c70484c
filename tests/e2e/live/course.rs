//! Tests of the course of a program on the page: its sections by name, and when it needs a person.

use std::time::Duration;

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Watchdog};
use serde_json::json;

use super::PATIENCE;
use super::life::{HALF, press};
use super::operated_page::operated_page;
use super::screens::{CUT, HOLD_IS_IN_ITS_CORNER, resize};

const LONG_NAME: &str =
    "FINISH OF ALL WALLS AND OF THE FLOOR WITH A NAME THAT NO COLUMN HAS ROOM FOR AT ANY SIZE";

/// Moves of ten seconds each.
fn program() -> String {
    format!(
        "G21 G90 F600\n(POCKET ROUGH)\nT1 M6\nG0 X0\nG1 X100\nX0\nM0\nX100\nX0\n({LONG_NAME})\nT3 M6\nG0 X1\n\
         G1 X100\nX0\nM2\n"
    )
}

/// Looks whether every text can be read on every screen, and Hold be pressed.
fn fits(browser: &mut Browser, view: &str) {
    for screen in [(1440, 900), (800, 480), (390, 844), (1024, 768)] {
        resize(browser, screen);
        if browser.evaluate("S.phone") != true {
            browser.evaluate(&format!("setView('{view}')"));
        }
        let shown = browser.evaluate(&format!("[{HOLD_IS_IN_ITS_CORNER}, {CUT}]"));
        assert_eq!(shown, json!([true, ""]), "{view} {screen:?}");
    }
}

/// The seconds until it needs a person, by the page's words and by plan and override, and what it needs.
fn needs(browser: &mut Browser) -> (String, f64, f64) {
    let told = browser.evaluate(
        "(() => { const next = nextMoment(S.p); \
         return [document.querySelector('#needs').textContent, (next.place - S.p) * DT() / S.status.feed_override]; })()",
    );
    let words = told[0].as_str().unwrap().to_owned();
    let (what, time) = words.split_once(" in ").unwrap();
    let parts: Vec<&str> = time.split(' ').collect();
    let seconds = parts.chunks(2).map(|part| {
        let number: f64 = part[0].parse().unwrap();
        if part[1] == "min" {
            60.0 * number
        } else {
            number
        }
    });
    (what.to_owned(), seconds.sum(), told[1].as_f64().unwrap())
}

#[test]
fn a_program_tells_its_sections_and_when_it_needs_somebody() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = program();
    let page = operated_page(&instance, (1024, 768), &[("course.ngc", &program)], &[]);
    let Some((mut browser, live, service, services)) = page else {
        return;
    };
    browser.evaluate("setView('programs')");
    browser.wait("document.querySelector('[data-name=\"course.ngc\"]')");
    browser.press("[data-name=\"course.ngc\"]");
    browser.wait("LOOK.info && LOOK.info.report && document.querySelector('.sections')");
    let rows = browser.evaluate(
        "$$('.sections tr').slice(1).map(row => [...row.cells].slice(1, 4).map(cell => cell.textContent))",
    );
    let expected = json!([["POCKET ROUGH", "T1", "3"], [LONG_NAME, "T3", "11"]]);
    assert_eq!(rows, expected);
    let title = browser.evaluate("$$('.sections .name')[2].title");
    assert_eq!(title, format!("{LONG_NAME}, T3"));
    let needed = browser.evaluate("document.querySelector('.needs-list').textContent");
    for what in ["M6 T1", "M0", "M6 T3"] {
        assert!(needed.as_str().unwrap().contains(what), "{needed}");
    }
    fits(&mut browser, "programs");

    // From line: each of them is a line that can be pressed.
    browser.press("#runkeys [data-do=from-line]");
    browser.wait("document.querySelectorAll('.section-keys [data-do=take-line]').length === 2");
    fits(&mut browser, "programs");
    browser.picture("from-line-1024x768");
    browser.press(".section-keys [data-line=\"11\"]");
    let taken = browser.evaluate("[$('#fromline').value, $('#pass').value]");
    assert_eq!(taken, json!(["11", "1"]));
    browser.press("#found [data-do=from-line]");

    press(&mut browser, "#chosen [data-do=run]", HALF);
    let _asks = services.wait_for(MachineState::Awaiting);
    browser.wait("S.view === 'operate' && S.state === 'awaiting' && PLAN && INFO.report");
    // What it waits for now is not what comes next.
    browser.wait("document.querySelector('#needs').textContent.startsWith('M0')");
    press(&mut browser, "#attn [data-do=done]", HALF);
    browser.wait("S.state === 'running' && S.p > 20");
    let (what, told, planned) = needs(&mut browser);
    assert_eq!(what, "M0");
    assert!(
        planned > 5.0 && (told - planned).abs() < 1.5,
        "{told} {planned}"
    );
    // As the time left: twice as long with half the feed.
    browser.evaluate("order('feed-override', { value: 0.5 })");
    browser.wait("S.status.feed_override === 0.5");
    // The words come a moment behind the status.
    loop {
        let (_, slower, planned) = needs(&mut browser);
        // Nearer to the stop, half of it would be as near.
        assert!(planned > 4.0, "{slower} {planned}");
        if (slower - planned).abs() < 2.0 {
            break;
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    fits(&mut browser, "operate");
    fits(&mut browser, "tune");
    browser.evaluate("setView('operate')");

    // On the ribbon: what is cut there is whole in its title.
    let titles = browser.evaluate(
        "(() => { const [, second] = courseNow().sections, stop = courseNow().moments[1], at = p => { const ribbon = document.querySelector('#ribbon'), \
         r = ribbon.querySelector('canvas').getBoundingClientRect(); ribbon.querySelector('canvas').dispatchEvent(new PointerEvent('pointermove', \
         { bubbles: true, clientX: r.left + RIBBON.left + p / (PLAN.samples - 1) * RIBBON.width, clientY: r.top + 20 })); return ribbon.title; }; \
         return [at(second.place + 500), at(stop.place)]; })()",
    );
    assert_eq!(titles[0], format!("{LONG_NAME}, T3"));
    assert!(
        titles[1].as_str().unwrap().contains("M0, line 7"),
        "{titles}"
    );
    assert_eq!(
        browser.evaluate("sectionAt(S.p).name"),
        "POCKET ROUGH",
        "the one that is being executed"
    );
    // A telephone tells it, too.
    resize(&mut browser, (390, 844));
    browser.wait("document.querySelector('#g-needs').textContent.startsWith('M0 in ')");
    resize(&mut browser, (1024, 768));
    browser.evaluate("order('abort')");
    let _idle = services.wait_for(MachineState::Idle);
    browser.wait("document.querySelector('#needs').textContent === ''");
    drop((live, service));
    drop(services.end());
}
