//! Tests of why a place is slow, and of what a change would bring: it is said as `plan` says it, planned again, and never run.

use glidepath_link::MachineState;
use glidepath_tests::{Instance, Process, Watchdog};
use serde_json::{Value, json};

use super::PATIENCE;
use super::operated_page::{operated_page, programs_of};

/// Corners of a fine zigzag between long sides: slow in its middle.
fn program() -> String {
    let zigzag = (0..20).map(|n| format!("G1 X{} Y{}\n", 50 + n, n % 2));
    format!(
        "G21 G90 G64 F6000\nG1 X50\n{}X120\nX0\nM2\n",
        zigzag.collect::<String>()
    )
}

/// How long a program takes with options of `plan`, s.
fn planned(instance: &Instance, program: &str, options: &[&str]) -> f64 {
    let arguments = [&["plan", program, "--json"], options].concat();
    let report: Value = Process::start(instance, &arguments).wait().expect(0).json();
    report["cycle_time_s"].as_f64().unwrap()
}

#[test]
fn a_slow_place_says_why_and_what_a_change_would_bring() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let file = format!("{}/slow.ngc", programs_of(&instance));
    let program = program();
    let programs = [("slow.ngc", program.as_str())];
    let page = operated_page(&instance, (1024, 768), &programs, &[&file]);
    let Some((mut browser, live, service, services)) = page else {
        return;
    };
    browser.wait("PLAN && INFO.report");

    // The list, and the ribbon.
    browser.evaluate("setView('tune')");
    browser.wait("document.querySelector('#slowbox tr[data-n]')");
    let slowest = browser.evaluate("INFO.report.slowest[0]");
    browser.press("#slowbox tr[data-n]");
    browser.wait("WHY.place && document.querySelector('#slowbox .what')");
    let says = browser.evaluate("document.querySelector('#slowbox').textContent");
    let says = says.as_str().unwrap();
    let (line, limit) = (&slowest["line"], slowest["limit"].as_str().unwrap());
    assert!(says.contains(&format!("Line {line}: ")), "{says}");
    assert!(says.contains("of 100.0 mm/s programmed"), "{says}");
    let [kind, axis] = [0, 1].map(|part| limit.split(' ').nth(part).unwrap_or_default());
    assert!(
        says.contains(&format!("the {kind} of {axis}")) || axis.is_empty(),
        "{limit}: {says}"
    );
    browser.press("#slowbox [data-box=slow]");
    browser.wait("!WHY.place && document.querySelector('#slowbox tr[data-n]')");
    browser.press("#ribbon");
    browser.wait("WHY.place && document.querySelector('#slowbox .what')");

    // Planned again, as the command line plans it.
    browser.press("[data-box=plan-again]");
    browser.wait("['tolerance 2', 'jerk 2', 'feed 1.2'].every(what => WHY.answers[what] && WHY.answers[what].seconds)");
    let answers = browser.evaluate("WHY.answers");
    let seconds = |what: &str| answers[what]["seconds"].as_f64().unwrap();
    let now = planned(&instance, &file, &[]);
    let twice = planned(&instance, &file, &["--tolerance", "0.04"]);
    assert!(
        (seconds("tolerance 2") - twice).abs() < 0.005,
        "{answers} {twice}"
    );
    assert!(
        twice < now && seconds("jerk 2") < now && seconds("feed 1.2") < now,
        "{answers} {now}"
    );

    // Before a run: the time with another tolerance, which it would run with.
    // It may be asked as soon as the time is known, while the motion is still on its way to the page.
    browser.evaluate(
        "window.fetchNow = window.fetch; window.fetch = async (url, how) => { if (('' + url).includes('preview/path.bin')) await new Promise(done => window.letPass = done); return fetchNow(url, how); }",
    );
    browser.evaluate("setView('programs')");
    browser.wait("document.querySelector('[data-name=\"slow.ngc\"]')");
    browser.press("#list [data-name=\"slow.ngc\"]");
    browser.wait(
        "window.letPass && LOOK.info && (paintChosen(), document.querySelector('.tolerances'))",
    );
    browser.press("[data-do=try-tolerance][data-ratio=\"2\"]");
    browser.evaluate("letPass()");
    browser.wait("LOOK.motion && LOOK.times[2] && LOOK.times[2].seconds");
    let told = browser.evaluate("document.querySelector('.tolerances').textContent");
    assert!(
        told.as_str()
            .unwrap()
            .contains("Run is planned with 0.040 mm, this run alone"),
        "{told}"
    );
    let time = browser.evaluate("LOOK.times[2].seconds").as_f64().unwrap();
    assert!((time - twice).abs() < 0.005, "{time} {twice}");
    // Whoever only looks asks, too, and what is no change is none.
    let of = browser.evaluate("LOOK.info.generation");
    let look = live.token_for("look");
    let known = live.get_with(&look, &format!("/api/preview/what-if?of={of}&tolerance=2"));
    assert_eq!(known["seconds"], json!(time));
    let none = browser.evaluate(&format!(
        "api('/api/preview/what-if?of={of}&tolerance=0', 'json')"
    ));
    assert!(none.is_null(), "{none}");
    assert_eq!(
        services.wait_for(MachineState::Idle).epoch,
        0,
        "nothing ran"
    );
    drop((live, service));
    drop(services.end());
}
