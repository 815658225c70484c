//! Tests of the machines of a host on one page: each is listed with what it does, and its page is a press away.

use glidepath_tests::{Browser, Instance, Process, Services, Watchdog};
use serde_json::{Value, json};

use super::screens::{CUT, HOLD_IS_IN_ITS_CORNER, resize};
use super::{Live, PATIENCE};

/// A page of another instance, with the addresses that it tells.
fn page_of_second(instance: &Instance, arguments: &[&str]) -> (Process, Value) {
    let page = ["live", "--json", "--port", "0", "--instance", "second"];
    let page = Process::start(instance, &[&page[..], arguments].concat());
    let told = page.wait_for_object();
    (page, told)
}

#[test]
fn the_machines_of_a_host_are_on_one_page_and_their_pages_a_press_away() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    let live = Live::start(&instance, &["--may", "operate"]);
    let of_second = ["--instance", "second"];
    let interpolator = [&["interpolator", "--best-effort"], &of_second[..]].concat();
    let interpolator = Process::start(&instance, &interpolator);
    interpolator.wait_until_it_is_ready();

    // One that is not listed is nowhere.
    let (page, _told) = page_of_second(&instance, &["--may", "hold"]);
    let none = live.get("/api/machines");
    assert_eq!(none["machines"], Value::Array(Vec::new()));
    let _ended = page.end().expect(0);

    let (page, told) = page_of_second(&instance, &["--may", "hold", "--listed"]);
    let second = |role: &str| {
        loop {
            let known = live.get_with(&live.token_for(role), "/api/machines");
            if let Some(second) = known["machines"].get(0) {
                return second.clone();
            }
            std::thread::sleep(std::time::Duration::from_millis(50));
        }
    };
    assert_eq!(second("operate")["instance"], "second");
    assert_eq!(second("operate")["state"], "idle");
    // Nobody is led to more than they may, and nobody to more than there is.
    assert_eq!(second("look")["url"], told["urls"]["look"]);
    assert_eq!(second("hold")["url"], told["urls"]["hold"]);
    assert_eq!(second("operate")["url"], told["urls"]["hold"]);

    if let Some(mut browser) = Browser::start(800, 480) {
        browser.open(&live.url);
        browser.wait("typeof S !== 'undefined' && S.operates && S.state === 'idle'");
        browser.wait("document.querySelector('#machines a').textContent === 'secondIdle'");
        for screen in [(1440, 900), (1024, 768), (768, 1024), (800, 480)] {
            resize(&mut browser, screen);
            for view in ["operate", "setup", "programs", "tune", "health"] {
                browser.evaluate(&format!("setView('{view}')"));
                let shown = browser.evaluate(&format!("[{HOLD_IS_IN_ITS_CORNER}, {CUT}]"));
                assert_eq!(shown, json!([true, ""]), "{screen:?} {view}");
            }
        }
        browser.press("#machines a");
        browser.wait(&format!("location.port === '{}'", told["port"]));
        browser.wait(
            "typeof S !== 'undefined' && S.state === 'idle' && INFO.machine.instance === 'second' && S.may === 'hold'",
        );
        // The first one is not listed.
        browser.wait("!document.querySelector('#machines a')");
    }
    let _ended = page.end().expect(0);
    let gone = || live.get("/api/machines")["machines"] == Value::Array(Vec::new());
    assert!(gone());
    let _ended = interpolator.end().expect(0);
    drop(live);
    drop(services.end());
}
