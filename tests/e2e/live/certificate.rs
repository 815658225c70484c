//! The test of the certificate of a job: its figures are those of what was executed, and the page that is kept has them with
//! their hash.

use glidepath_tests::{Browser, Instance, Process, Watchdog};
use serde_json::{Value, json};

use super::PATIENCE;
use super::life::{HALF, press};
use super::operated_page::operated_page;

/// The page to keep has the figures, and their hash.
fn is_kept_with_its_hash(browser: &mut Browser, told: &Value) {
    browser.evaluate("setView('programs')");
    browser.wait("document.querySelector('#day [data-do=certificate]')");
    let page = browser.evaluate(
        "(async () => { window.kept = []; URL.createObjectURL = blob => { window.kept.push(blob); return '#'; }; \
         document.querySelector('#day [data-do=certificate]').dispatchEvent(new PointerEvent('pointerdown', { bubbles: true })); \
         while (!window.kept.length) await new Promise(done => setTimeout(done, 20)); return window.kept[0].text(); })()",
    );
    let page = page.as_str().unwrap();
    let figures = page.split("<pre id=\"figures\">").nth(1).unwrap();
    let figures = figures
        .split("</pre>")
        .next()
        .unwrap()
        .replace("&quot;", "\"");
    let figures: Value = serde_json::from_str(&figures).unwrap();
    assert_eq!(figures["seen"], told["seen"]);
    assert!(page.contains(told["program"].as_str().unwrap()) && page.contains("50 to 100 %"));
    let hashed = browser.evaluate(
        "(async () => { const page = new DOMParser().parseFromString(await window.kept[0].text(), 'text/html'); \
         const figures = new TextEncoder().encode(page.querySelector('#figures').textContent); \
         return hexadecimal(await crypto.subtle.digest('SHA-256', figures)) === page.querySelector('code').textContent; })()",
    );
    assert_eq!(hashed, true);
}

#[test]
fn a_job_that_is_over_has_a_certificate() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let moves = "X20 Y7\nX0 Y0\n".repeat(20);
    let program = format!("G21 G90 G64 P0.02 F3000\nG1 X0\n{moves}M2\n");
    let page = operated_page(&instance, (1440, 900), &[("part.ngc", &program)], &[]);
    let Some((mut browser, live, service, services)) = page else {
        return;
    };
    browser.evaluate("setView('programs')");
    browser.wait("document.querySelector('[data-name=\"part.ngc\"]')");
    browser.press("[data-name=\"part.ngc\"]");
    browser.wait("LOOK.info && LOOK.info.report");
    press(&mut browser, "#chosen [data-do=run]", HALF);
    browser.wait("S.state === 'running' && S.status.program_is_shown && INFO.report");
    let _slower = Process::join(&instance, &["override", "50"])
        .wait()
        .expect(0);
    browser.wait("S.state === 'idle' && S.status.day[0].end === 'done'");

    let job = live.told(|status| status["day"][0]["end"] == "done")["day"][0].clone();
    let number = job["number"].as_str().unwrap();
    let told = live.get(&format!("/api/certificate?job={number}"));
    assert_eq!(told["name"], "part.ngc", "{told}");
    let looked_at = live.get("/api/preview?name=part.ngc")["fingerprint"].clone();
    assert_eq!(told["program"], looked_at, "{told}");
    let figure = |at: &str| told.pointer(at).and_then(Value::as_f64).unwrap();
    // It came near to what binds it, and beyond nothing.
    for kind in ["velocity", "acceleration", "jerk"] {
        let part = figure(&format!("/seen/limits/{kind}/part"));
        assert!((0.05..=1.0 + 1e-6).contains(&part), "{kind}: {told}");
    }
    assert!(figure("/seen/limits/jerk/part") > 0.9, "{told}");
    let (deviation, tolerance) = (
        figure("/plan/max_deviation_mm"),
        figure("/plan/tolerance_mm"),
    );
    assert!(deviation > 1e-3 && deviation <= tolerance && (tolerance - 0.02).abs() < 1e-9);
    // The setpoints were as long as the job was, and what the plan says is less: half of it was slower.
    let took_t = (figure("/ended_ms") - figure("/begun_ms")) / 1e3;
    let told_t = figure("/seen/told_s");
    assert!((took_t - told_t).abs() < 2.0, "{took_t} {told_t}");
    assert!(told_t > 1.2 * figure("/plan/planned_s"), "{told}");
    assert_eq!(told["feed_override"], json!([0.5, 1.0]));
    assert_eq!(
        (&told["seen"]["lost"], &told["seen"]["is_whole"]),
        (&0.into(), &true.into())
    );
    assert!(
        told["following_mm"].is_null(),
        "nobody says where drives are"
    );

    is_kept_with_its_hash(&mut browser, &told);
    drop((live, service));
    drop(services.end());
}
