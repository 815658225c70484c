//! Tests of a line that is being typed: what is wrong with it is said before it is run, and nothing comes of that.

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Watchdog};
use serde_json::json;

use super::PATIENCE;
use super::operated_page::operated_page;
use super::screens::{CUT, HOLD_IS_IN_ITS_CORNER, resize};

/// Types a line, faster than anybody does, and waits until all that is asked about it is answered.
fn type_line(browser: &mut Browser, line: &str) {
    browser.evaluate(&format!(
        "(() => {{ const field = document.querySelector('#mdi'); \
         for (let n = 0; n <= {line:?}.length; n++) {{ field.value = {line:?}.slice(0, n); \
         field.dispatchEvent(new Event('input')); }} }})()"
    ));
    browser.wait(&format!("JUDGED.of === {line:?} && !JUDGED.asks"));
}

const FOUND: &str = "document.querySelector('#judged').textContent";

/// Has a line executed.
fn run_line(browser: &mut Browser, line: &str) {
    let run = format!("order('mdi', {{ line: {line:?} }}).then(said => said.accepted)");
    browser.wait("S.state === 'idle'");
    assert_eq!(browser.evaluate(&run), true, "{line}");
    browser.wait(&format!(
        "S.state === 'idle' && S.status.page_jobs[0].name === {line:?} && S.status.page_jobs[0].state === 'done'"
    ));
}

#[test]
fn a_line_is_judged_while_it_is_typed_and_nothing_moves() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some((mut browser, live, service, services)) =
        operated_page(&instance, (1024, 768), &[], &[])
    else {
        return;
    };
    browser.evaluate(
        "window.asked = [0, 0, 0]; window.apiNow = api; api = async (path, kind) => { if (!path.startsWith('/api/judge')) return apiNow(path, kind); \
         asked[0]++; asked[1]++; asked[2] = Math.max(asked[2], asked[1]); try { return await apiNow(path, kind); } finally { asked[1]--; } }",
    );
    browser.evaluate("setView('setup')");
    run_line(&mut browser, "G21 G90 G94 F600");
    let before = services.wait_for(MachineState::Idle);

    // A number is missing: what, where, and how to mend it.
    type_line(&mut browser, "G1 X1 F");
    browser.wait(&format!("{FOUND}.includes('Column 7')"));
    let marked = browser.evaluate("document.querySelector('#judged mark').textContent");
    assert_eq!(marked, "F");
    for screen in [(1440, 900), (800, 480), (1024, 768)] {
        resize(&mut browser, screen);
        let shown = browser.evaluate(&format!("[{HOLD_IS_IN_ITS_CORNER}, {CUT}]"));
        assert_eq!(shown, json!([true, ""]), "{screen:?}");
    }
    // What is said of one text is none of another.
    let other = browser.evaluate(
        "(() => { const field = document.querySelector('#mdi'); field.value += '5'; \
         field.dispatchEvent(new Event('input')); return document.querySelector('#judged').textContent; })()",
    );
    assert_eq!(other, "");
    type_line(&mut browser, "G1 X1");
    assert_eq!(browser.evaluate(FOUND), "");

    // Nothing came of it.
    let after = services.wait(|status| status.updated_ns > before.updated_ns);
    assert_eq!(
        (after.epoch, after.position.map(f64::to_bits)),
        (before.epoch, before.position.map(f64::to_bits))
    );
    let before = browser.evaluate("asked[0]");
    type_line(&mut browser, "G1 X1 Y2 Z3 F100");
    type_line(&mut browser, "G1 X1");
    let asked = browser.evaluate(&format!("[asked[0] - {before}, asked[2]]"));
    assert_eq!(asked, json!([2, 1]), "a burst of keys is one question");

    // With what is in force on the machine: G93 wants a feed in each line.
    run_line(&mut browser, "G93");
    browser.wait(&format!("{FOUND} !== ''"));
    run_line(&mut browser, "G94 F600");
    browser.wait(&format!("{FOUND} === '' && JUDGED.of === 'G1 X1'"));
    // While a program has the machine nobody knows what will be in force.
    browser.evaluate("order('mdi', { line: 'G1 X20' })");
    let _moving = services.wait_for(MachineState::Running);
    type_line_unanswered(&mut browser, "G1 X1 F");
    let _rests = services.wait_for(MachineState::Idle);
    browser.wait(&format!("{FOUND}.includes('Column 7')"));

    // For the page that operates alone, and the seat stays with it.
    let refused = browser.evaluate(
        "fetch('/api/judge?line=G1', { headers: { ...headers('application/json'), 'X-Glidepath-Page': '0000000000000007' } }).then(answer => answer.status)",
    );
    assert_eq!(refused, 409);
    assert_eq!(browser.evaluate("S.operates"), true);
    drop((live, service));
    drop(services.end());
}

/// Types a line of which nothing is said.
fn type_line_unanswered(browser: &mut Browser, line: &str) {
    let said = browser.evaluate(&format!(
        "(async () => {{ const field = document.querySelector('#mdi'); field.value = {line:?}; \
         field.dispatchEvent(new Event('input')); await new Promise(done => setTimeout(done, 600)); \
         return S.state === 'running' ? document.querySelector('#judged').textContent : ''; }})()"
    ));
    assert_eq!(said, "");
}
