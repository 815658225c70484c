//! Tests of the page of a machine, in a browser: it loads, it moves, and it holds the machine if it
//! may.

mod certificate;
mod colours;
mod course;
mod cut_off;
mod devices;
mod following;
mod gamepad;
mod hands;
mod judged;
mod last;
mod life;
mod looked_at;
mod machines;
mod operated_page;
mod other_client;
mod overrides;
mod pictures;
mod proxy;
mod queue;
mod says;
mod screens;
mod scripts;
mod shortcut;
mod shuttle;
mod spindle;
mod steps;
mod touch;
mod units;
mod way;
mod why;

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::TcpStream;
use std::process::Child;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use glidepath_link::MachineState;
use glidepath_realtime::{Clock as _, Monotonic};
use glidepath_tests::{Browser, Instance, Process, Services, Watchdog, served};
use rustix::process::{Pid, Signal, kill_process};
use serde_json::Value;

use crate::programs::long_program;

const PATIENCE: Duration = Duration::from_secs(420);

/// `glidepath live` at work.
pub(crate) struct Live {
    child: Child,
    url: String,
    /// The addresses of all roles.
    urls: Value,
    pub(crate) port: u16,
    /// Where devices are served, and the fingerprint of the certificate.
    devices: Value,
}

/// An order of a page that hears what the server says at once.
fn given_now(order: &Value) -> String {
    let mut order = order.clone();
    let heard_ms = Monotonic.now_ns() / 1_000_000;
    order["heard_ms"] = heard_ms.into();
    order.to_string()
}

impl Live {
    pub(crate) fn start(instance: &Instance, arguments: &[&str]) -> Self {
        let (child, told) = served(instance, "live", arguments);
        Self {
            child,
            url: told["url"].as_str().unwrap().to_owned(),
            urls: told["urls"].clone(),
            devices: told["devices"].clone(),
            port: told["port"].as_u64().unwrap().try_into().unwrap(),
        }
    }

    /// Commands as a page does; gives the status and the body of the answer.
    fn command(&self, token: &str, body: &str) -> (u16, String) {
        let json = "application/json";
        // What is no order is sent as it is.
        let order = serde_json::from_str::<Value>(body).ok();
        let order = order.filter(Value::is_object);
        let body = order.map_or_else(|| body.to_owned(), |order| given_now(&order));
        self.post(
            "/api/command",
            json,
            &format!("{token}{}", of_page(1)),
            body.as_bytes(),
        )
    }

    fn post(&self, path: &str, kind: &str, fields: &str, body: &[u8]) -> (u16, String) {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        let (port, length) = (self.port, body.len());
        let head = format!(
            "POST {path} HTTP/1.1\r\nHost: localhost:{port}\r\nContent-Type: {kind}\r\n\
             {fields}Content-Length: {length}\r\n\r\n"
        );
        stream.write_all(head.as_bytes()).unwrap();
        stream.write_all(body).unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        let (head, body) = answer.split_once("\r\n\r\n").unwrap();
        let status = head.split(' ').nth(1).unwrap().parse().unwrap();
        (status, body.to_owned())
    }

    /// What is at a path, as a page asks for it.
    fn get(&self, path: &str) -> Value {
        self.get_with(&self.token(), path)
    }

    /// The same with header fields of whoever asks.
    fn get_with(&self, fields: &str, path: &str) -> Value {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        let port = self.port;
        let head = format!("GET {path} HTTP/1.1\r\nHost: localhost:{port}\r\n{fields}\r\n");
        stream.write_all(head.as_bytes()).unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        let (head, body) = answer.split_once("\r\n\r\n").unwrap();
        assert!(head.starts_with("HTTP/1.1 200"), "{path}: {answer}");
        serde_json::from_str(body).unwrap()
    }

    /// Listens as a page does, from what is remembered on, until a status pleases.
    fn told(&self, wanted: impl Fn(&Value) -> bool) -> Value {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        let (port, token) = (self.port, self.token());
        let head = format!("GET /api/stream HTTP/1.1\r\nHost: localhost:{port}\r\n{token}\r\n");
        stream.write_all(head.as_bytes()).unwrap();
        let mut stream = BufReader::new(stream);
        let mut line = String::new();
        while line != "\r\n" {
            line.clear();
            stream.read_line(&mut line).unwrap();
        }
        loop {
            let mut length = [0; 4];
            stream.read_exact(&mut length).unwrap();
            let mut message = vec![0; u32::from_le_bytes(length) as usize];
            stream.read_exact(&mut message).unwrap();
            if message[0] != 1 {
                continue;
            }
            let status = serde_json::from_slice(&message[1..]).unwrap();
            if wanted(&status) {
                return status;
            }
        }
    }

    /// The header that lets a request in.
    pub(crate) fn token(&self) -> String {
        token_of(&self.url)
    }

    /// That of a page that may no more than this.
    fn token_for(&self, role: &str) -> String {
        token_of(self.urls[role].as_str().unwrap())
    }

    /// Its process number.
    pub(crate) fn id(&self) -> u32 {
        self.child.id()
    }
}

fn token_of(url: &str) -> String {
    let (_, token) = url.split_once("#token=").unwrap();
    format!("X-Glidepath-Token: {token}\r\n")
}

/// The header by which a page says which one it is.
fn of_page(number: u64) -> String {
    format!("X-Glidepath-Page: {number:016x}\r\n")
}

impl Drop for Live {
    fn drop(&mut self) {
        // Not waited for yet, so the number is still its own.
        let pid = Pid::from_raw(self.child.id().try_into().unwrap()).unwrap();
        let _asked = kill_process(pid, Signal::TERM);
        let _ended = self.child.wait();
    }
}

#[test]
fn commands_take_the_token_and_leave() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait_for(MachineState::Running);
    let hold = "{\"kind\":\"hold\"}";

    let showing = Live::start(&instance, &[]);
    let (status, said) = showing.command(&showing.token(), hold);
    assert_eq!(status, 403, "{said}");
    assert!(said.contains("this page may look"), "{said}");

    let live = Live::start(&instance, &["--may", "operate"]);
    assert_eq!(live.command("", hold).0, 403);
    assert_eq!(live.command(&showing.token(), hold).0, 403);
    // What is no command.
    for body in [
        "{\"kind\":\"jog\",\"value\":1}",
        "{\"kind\":\"set-position\",\"joint\":0,\"position\":0}",
        "{\"kind\":\"unhome\"}",
        "{\"kind\":\"feed-override\",\"value\":3}",
        "{\"kind\":\"feed-override\",\"value\":-3}",
        "{\"kind\":\"feed-override\"}",
        "{\"kind\":\"hold\",\"joint\":1}",
        "hold",
    ] {
        assert_eq!(live.command(&live.token(), body).0, 400, "{body}");
    }
    // All that was refused left the machine alone.
    std::thread::sleep(Duration::from_millis(300));
    let _still_moving = services.wait_for(MachineState::Running);

    let (status, said) = live.command(&live.token(), hold);
    assert_eq!((status, said.contains("true")), (200, true), "{said}");
    let _held = services.wait_for(MachineState::Held);
    let slower = "{\"kind\":\"feed-override\",\"value\":0.5}";
    assert_eq!(live.command(&live.token(), slower).0, 200);
    let _slower = services.wait(|status| (status.feed_override - 0.5).abs() < 1e-9);
    assert_eq!(live.command(&live.token(), "{\"kind\":\"resume\"}").0, 200);
    let _moving = services.wait_for(MachineState::Running);
    assert_eq!(live.command(&live.token(), "{\"kind\":\"abort\"}").0, 200);
    let _idle = services.wait_for(MachineState::Idle);
    // Refused by the machine: with its reason.
    let (status, said) = live.command(&live.token(), "{\"kind\":\"step\"}");
    assert_eq!(status, 409, "{said}");
    assert!(said.contains("nothing is held"), "{said}");
    drop((showing, live, planner.wait()));
    drop(services.end());
}

/// Opens connections, gives a byte of each now and then, and opens anew what is closed, until `over`.
fn flood(port: u16, over: &AtomicBool) {
    let mut streams: Vec<TcpStream> = Vec::new();
    while !over.load(Ordering::Relaxed) {
        let missing = 40 - streams.len();
        streams.extend((0..missing).map(|_| TcpStream::connect(("127.0.0.1", port)).unwrap()));
        streams.retain_mut(|stream| stream.write_all(b"G").is_ok());
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn a_page_holds_and_aborts_while_others_keep_connections_open() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait_for(MachineState::Running);
    let live = Live::start(&instance, &["--may", "operate"]);
    let (port, over) = (live.port, Arc::<AtomicBool>::default());
    let flooding = {
        let over = Arc::clone(&over);
        std::thread::spawn(move || flood(port, &over))
    };
    // All of them are there.
    std::thread::sleep(Duration::from_millis(500));
    for (command, state) in [
        ("hold", MachineState::Held),
        ("resume", MachineState::Running),
        ("hold", MachineState::Held),
        ("abort", MachineState::Idle),
    ] {
        let body = format!("{{\"kind\":\"{command}\"}}");
        let (status, said) = live.command(&live.token(), &body);
        assert_eq!(status, 200, "{command}: {said}");
        let _there = services.wait_for(state);
    }
    over.store(true, Ordering::Relaxed);
    flooding.join().unwrap();
    drop((live, planner.wait()));
    drop(services.end());
}

#[test]
fn a_browser_shows_the_machine_and_holds_it() {
    let (instance, _watchdog) = (Instance::alone(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1440, 900) else {
        return;
    };
    let program = instance.file("program.ngc", &long_program());
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait_for(MachineState::Running);
    let live = Live::start(&instance, &["--may", "operate"]);

    // Without the token the page is there, and shows nothing.
    browser.open(&format!("http://127.0.0.1:{}/", live.port));
    browser.wait("typeof S !== 'undefined' && S.refused");
    assert_eq!(
        browser.evaluate("S.status === null && RINGED === null"),
        true
    );

    browser.open("about:blank");
    browser.open(&live.url);
    browser.wait("typeof S !== 'undefined' && RINGED && RINGED.count > 200 && PLAN");
    // The token is not in the address any more, where a picture of the screen would show it.
    assert_eq!(browser.evaluate("location.hash.includes('token')"), false);
    assert_eq!(browser.evaluate("S.state"), "running");
    // The plot moves: other samples, another picture.
    browser.evaluate("setView('tune')");
    browser.wait("AREA.width > 100");
    let look = "[RINGED.now, S.p, document.querySelector('#strips canvas').toDataURL().length, \
                document.querySelector('#strips canvas').toDataURL()]";
    let before = browser.evaluate(look);
    std::thread::sleep(Duration::from_millis(400));
    let after = browser.evaluate(look);
    assert!(after[0].as_f64() > before[0].as_f64(), "time goes on");
    assert!(
        after[1].as_f64() > before[1].as_f64(),
        "so does the program"
    );
    assert!(before[2].as_u64() > Some(5000), "something is drawn");
    assert!(after[3] != before[3], "and drawn anew");
    // What the page derives is what the limits allow, and no setpoint is missing.
    let most = browser.evaluate(
        "Math.max(...RINGED.axes[0].ranges[1].slice(0, RINGED.count).map(Math.abs)) / AXES()[0].limits[1]",
    );
    let most = most.as_f64().unwrap();
    assert!((0.5..1.0 + 1e-6).contains(&most), "{most}");
    assert_eq!(browser.evaluate("RINGED.lost"), 0);
    // Of a pure tone the frequencies hold its power, whatever the window takes; of the motion there
    // is a picture, and what of it is above the resonances.
    let tone = browser.evaluate(
        "(() => { const p = power(i => Math.sin(100 * Math.PI * i * 0.004), 4096, 0.004); \
         return p.reduce((all, x) => all + x, 0) / 0.008 / (p.length - 1); })()",
    );
    assert!((tone.as_f64().unwrap() - 0.5).abs() < 1e-3, "{tone}");
    browser.press("[data-box=spec]");
    browser.wait(
        "document.querySelector('#specbox canvas').width > 100 && \
         document.querySelector('#specof').textContent.includes('rms above 30 Hz')",
    );
    // A finger on hold, and on resume.
    browser.press("[data-c=hold]");
    let _held = services.wait_for(MachineState::Held);
    browser.wait(
        "S.state === 'held' && document.querySelector('#word').textContent.startsWith('Held')",
    );
    // What begins motion is pressed for half a second.
    browser.press("[data-c=go]");
    std::thread::sleep(Duration::from_millis(700));
    let _still_held = services.wait_for(MachineState::Held);
    // Nothing that a finger is about to begin begins behind a stop of another one.
    let place = browser.finger_down("[data-c=go]");
    browser.evaluate("press(BAR.hold)");
    std::thread::sleep(Duration::from_millis(700));
    browser.finger_up(&place);
    let _still_held = services.wait_for(MachineState::Held);
    browser.press_for("[data-c=go]", Duration::from_millis(700));
    let _moving = services.wait_for(MachineState::Running);
    browser.wait("S.state === 'running'");
    drop((live, planner));
    drop(services.end());
}
