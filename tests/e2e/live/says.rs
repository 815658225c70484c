//! The test of what a program says: it stands in one place, until somebody has read it.

use glidepath_tests::{Browser, Instance, Watchdog};
use serde_json::json;

use super::PATIENCE;
use super::life::{HALF, WHOLE, press};
use super::operated_page::operated_page;

/// Moves of a second each between what is said. Behind what is said on the way they take long enough for a page that
/// paints late on a busy host: a stop says something else in its place.
const PROGRAM: &str = "G21 G90 F600\n(MSG, look at the clamps)\nG1 X10\nM0\nG1 X0\nX10\nX0\nX10\n\
                       (MSG, second side)\nX0\nX10\nX0\nX10\nX0\nX10\nX0\nX10\nX0\nX10\nX0\nX10\nX0\nX10\nX0\nX10\n\
                       M0 (measure)\nX0\nX10\nX0\nX10\nX0\nM2\n";
/// Where it stops the second time.
const SECOND_STOP: usize = 26;

/// Where a text can be seen beside the text of the program.
fn places(browser: &mut Browser, words: &str) -> serde_json::Value {
    browser.evaluate(&format!(
        "['why', 'says', 'attn'].filter(id => {{ const e = document.getElementById(id); \
         return e.getClientRects().length && e.textContent.includes('{words}'); }})"
    ))
}

#[test]
fn what_a_program_says_is_said_once() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let page = operated_page(&instance, (1024, 768), &[("says.ngc", PROGRAM)], &[]);
    let Some((mut browser, live, service, services)) = page else {
        return;
    };
    browser.evaluate("setView('programs')");
    browser.wait("document.querySelector('[data-name=\"says.ngc\"]')");
    browser.press("[data-name=\"says.ngc\"]");
    press(&mut browser, "#chosen [data-do=run]", HALF);

    // It stops with the words that it has said: they are in the panel alone, and in the band where no panel is.
    browser.wait("S.view === 'operate' && S.state === 'program-stop' && S.status.line === 4");
    browser.wait("document.querySelector('#attn').textContent.includes('look at the clamps')");
    assert_eq!(places(&mut browser, "look at the clamps"), json!(["attn"]));
    browser.evaluate("setView('setup')");
    assert_eq!(places(&mut browser, "look at the clamps"), json!(["why"]));
    browser.evaluate("setView('operate')");
    // Whoever goes on has read it.
    press(&mut browser, "[data-c=go]", HALF);
    browser.wait("S.state === 'running' && S.status.line > 4");
    assert_eq!(places(&mut browser, "look at the clamps"), json!([]));

    // What is said on the way stands above the text until it is read.
    browser.wait("document.querySelector('#says').textContent.includes('second side')");
    assert_eq!(places(&mut browser, "second side"), json!(["says"]));
    browser.press("#says [data-do=read]");
    browser.wait("!document.querySelector('#says').textContent");
    browser.wait(&format!(
        "S.state === 'program-stop' && S.status.line === {SECOND_STOP}"
    ));
    browser.wait("document.querySelector('#attn').textContent.includes('measure')");
    assert_eq!(places(&mut browser, "measure"), json!(["attn"]));
    assert_eq!(places(&mut browser, "second side"), json!([]));
    press(&mut browser, "[data-c=go]", HALF);
    browser.wait(&format!(
        "S.state === 'running' && S.status.line > {SECOND_STOP}"
    ));
    assert_eq!(places(&mut browser, "measure"), json!([]));
    press(&mut browser, "[data-c=abort]", WHOLE);
    browser.wait("S.state === 'idle'");
    drop((live, service));
    drop(services.end());
}
