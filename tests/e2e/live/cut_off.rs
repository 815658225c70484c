//! Tests of a finger whose page cannot be heard any more: no network, a network that carries nothing and keeps its
//! connections, a browser that stands still, a browser that is killed.

use std::time::{Duration, Instant};

use glidepath_link::{MachineState, Status};
use glidepath_testing::{Pulse, is_crowded, leave_out};
use glidepath_tests::{Browser, Instance, Process, Services, Watchdog};
use rustix::process::Signal;
use serde_json::json;

use super::hands::{rests, x};
use super::life::HALF;
use super::operated_page::operated_page;
use super::proxy::Proxy;
use super::{Live, PATIENCE};

const KEY: &str = ".jog[aria-label=\"move X+\"]";
/// The way behind which the finger is taken to move the axis, mm.
const MOVES: f64 = 1.0;

/// How long an axis moves on at most where its page is not heard: the 150 ms that a finger may be silent, a jerk-limited way
/// to rest from 50 mm/s (2 √(v / j) = 71 ms), and a little for whoever looks.
const IN_TIME: Duration = Duration::from_millis(150 + 71 + 80);
/// By how much a thread is late at most where the host is in time.
const LATE: Duration = Duration::from_millis(20);

/// Waits until the axes rest, which a host in time lets them do within the time-out, and looks whether they stay.
fn rests_in_time(services: &Services<'_>) -> Status {
    let (begun, pulse) = (Instant::now(), Pulse::start());
    let _rest = services.wait_for(MachineState::Idle);
    let took = begun.elapsed();
    if pulse.worst() < LATE && !is_crowded() {
        assert!(took < IN_TIME, "{took:?}");
    } else {
        leave_out(
            "an axis at rest within the time-out",
            "the host had other things to do",
        );
    }
    rests(services)
}

/// Puts a finger on X+ until the axis moves. A page on a busy host may lose it: then it comes down anew.
fn moving(browser: &mut Browser, services: &Services<'_>) -> serde_json::Value {
    loop {
        let before = x(&rests(services));
        let place = browser.finger_down(KEY);
        let begun = Instant::now();
        while begun.elapsed() < 4 * HALF {
            let status = services.wait(|_| true);
            if status.state == MachineState::Jogging.code() && x(&status) > before + MOVES {
                return place;
            }
        }
        browser.finger_up(&place);
    }
}

#[test]
fn an_axis_rests_when_its_page_cannot_be_heard() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some((mut browser, live, service, services)) =
        operated_page(&instance, (1024, 768), &[], &[])
    else {
        return;
    };
    browser.evaluate("setView('setup')");
    browser.wait("document.querySelector('.jog:not([aria-disabled])')");

    // No network: the finger is down all the time, and is still when the network is back.
    let network = |browser: &mut Browser, is_gone: bool| {
        let conditions = json!({
            "offline": is_gone, "latency": 0, "downloadThroughput": -1, "uploadThroughput": -1,
        });
        let _done = browser.call("Network.emulateNetworkConditions", &conditions);
    };
    let _enabled = browser.call("Network.enable", &json!({}));
    let place = moving(&mut browser, &services);
    network(&mut browser, true);
    let there = x(&rests_in_time(&services));
    network(&mut browser, false);
    std::thread::sleep(Duration::from_millis(800));
    assert_eq!(x(&rests(&services)).to_bits(), there.to_bits());
    browser.finger_up(&place);
    browser.wait("S.state === 'idle' && document.querySelector('.jog:not([aria-disabled])')");

    // The browser stands still, and goes on later.
    let place = moving(&mut browser, &services);
    browser.signal(Signal::STOP);
    let there = x(&rests_in_time(&services));
    browser.signal(Signal::CONT);
    std::thread::sleep(Duration::from_millis(800));
    assert_eq!(x(&rests(&services)).to_bits(), there.to_bits());
    browser.finger_up(&place);
    browser.wait("S.state === 'idle' && document.querySelector('.jog:not([aria-disabled])')");

    // The browser is killed.
    let _place = moving(&mut browser, &services);
    browser.signal(Signal::KILL);
    let _rest = rests_in_time(&services);
    drop((live, service));
    drop(services.end());
}

#[test]
fn an_axis_rests_when_the_network_carries_nothing_and_what_it_kept_moves_nothing() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    let service = Process::service(&instance);
    let live = Live::start(&instance, &["--may", "operate"]);
    let network = Proxy::to(live.port);
    let way = format!(
        "--host-resolver-rules=MAP localhost:{} 127.0.0.1:{}",
        live.port, network.port
    );
    let Some(mut browser) = Browser::start_with((1024, 768), &[&way]) else {
        return;
    };
    browser.open(&live.url.replace("127.0.0.1", "localhost"));
    browser.wait("typeof S !== 'undefined' && S.operates && S.state === 'idle' && SETUP.jog");
    browser.evaluate("setView('setup')");
    browser.wait("document.querySelector('.jog:not([aria-disabled])')");
    let place = moving(&mut browser, &services);
    network.stop();
    let there = x(&rests_in_time(&services));
    // The finger is still down, and the page goes on to say so, to nobody.
    browser.wait("S.state === 'stale'");
    network.go_on();
    std::thread::sleep(Duration::from_millis(800));
    assert_eq!(x(&rests(&services)).to_bits(), there.to_bits());
    browser.finger_up(&place);
    browser.wait("S.state === 'idle' && document.querySelector('.jog:not([aria-disabled])')");
    drop((live, service));
    drop(services.end());
}
