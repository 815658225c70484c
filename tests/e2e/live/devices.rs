//! Tests of paired devices: they are paired by a code, look and hold over TLS, and do nothing else, until they are
//! revoked.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::os::unix::fs::PermissionsExt as _;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Process, Services, Watchdog, encrypted};
use serde_json::{Value, json};

use super::hands::Page;
use super::{Live, PATIENCE, given_now};
use crate::programs::long_program;

/// The configuration of a machine that keeps what it is told.
fn keeping(instance: &Instance) -> String {
    let printed = Process::start(instance, &["config", "--default"]).wait();
    let text = printed.expect(0).stdout;
    let state = instance.path("state");
    let kept = text.replace(
        "# directory = \"state\"",
        &format!("directory = \"{state}\""),
    );
    assert_ne!(kept, text);
    instance.file("keeping.toml", &kept)
}

fn serve(instance: &Instance, config: &str) -> Live {
    let devices = ["--devices", "127.0.0.1:0", "--config", config];
    Live::start(instance, &[&["--may", "operate"], &devices[..]].concat())
}

/// A tablet or a phone: what it knows of the machine, and its token.
struct Device {
    port: u16,
    fingerprint: String,
    token: String,
}

impl Device {
    fn new(live: &Live) -> Self {
        let url = live.devices["url"].as_str().unwrap();
        let port = url.trim_end_matches('/').rsplit(':').next().unwrap();
        Self {
            port: port.parse().unwrap(),
            fingerprint: live.devices["fingerprint"].as_str().unwrap().to_owned(),
            token: String::new(),
        }
    }

    /// Sends a request; the status and the body of the answer.
    fn ask(&self, line: &str, kind: &str, body: &[u8]) -> (u16, String) {
        let (port, token, length) = (self.port, &self.token, body.len());
        let head = format!(
            "{line} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nOrigin: https://127.0.0.1:{port}\r\n\
             X-Glidepath-Token: {token}\r\nX-Glidepath-Page: 00000000000000dd\r\n\
             Content-Type: {kind}\r\nContent-Length: {length}\r\n\r\n"
        );
        let mut stream = encrypted(port, &self.fingerprint);
        stream.write_all(head.as_bytes()).unwrap();
        stream.write_all(body).unwrap();
        let mut answer = Vec::new();
        let _length = stream.read_to_end(&mut answer).unwrap();
        let answer = String::from_utf8_lossy(&answer).into_owned();
        let (head, body) = answer.split_once("\r\n\r\n").unwrap();
        let status = head.split(' ').nth(1).unwrap().parse().unwrap();
        (status, body.to_owned())
    }

    fn get(&self, path: &str) -> (u16, String) {
        self.ask(&format!("GET {path}"), "application/json", b"")
    }

    fn order(&self, order: &Value) -> (u16, String) {
        let body = given_now(order);
        self.ask("POST /api/command", "application/json", body.as_bytes())
    }

    /// Sends a code.
    fn send(&self, code: &str, name: &str) -> (u16, Value) {
        let body = json!({ "code": code, "name": name }).to_string();
        let (status, said) = self.ask("POST /api/pair", "application/json", body.as_bytes());
        (status, serde_json::from_str(&said).unwrap())
    }

    /// Has a code shown at the panel, and is paired by it.
    fn paired(live: &Live, may: &str, name: &str) -> Self {
        let offer = Page(live, 1).accepted(&json!({ "kind": "pair-device", "may": may }));
        let mut device = Self::new(live);
        let code = offer["offer"]["code"].as_str().unwrap();
        let (status, said) = device.send(code, name);
        assert_eq!((status, &said["may"]), (200, &may.into()), "{said}");
        device.token = said["token"].as_str().unwrap().to_owned();
        device
    }

    /// Opens the stream of what happens, behind its head.
    fn stream(&self) -> impl std::io::Read + use<> {
        let (port, token) = (self.port, &self.token);
        let head = format!(
            "GET /api/stream HTTP/1.1\r\nHost: localhost:{port}\r\nX-Glidepath-Token: {token}\r\n\r\n"
        );
        let mut stream = encrypted(port, &self.fingerprint);
        stream.write_all(head.as_bytes()).unwrap();
        let mut stream = BufReader::new(stream);
        let mut line = String::new();
        stream.read_line(&mut line).unwrap();
        assert!(line.contains(" 200 "), "{line}");
        stream
    }
}

/// Every order of the page that a device may not give, with all that it says.
fn orders_of_operators() -> Vec<Value> {
    let plain = [
        "resume",
        "step",
        "return",
        "reset",
        "reverse",
        "forward",
        "enable",
        "disable",
        "home",
        "here",
        "ask-seat",
        "leave-seat",
        "end-pairing",
    ];
    let mut orders: Vec<Value> = plain.iter().map(|kind| json!({ "kind": kind })).collect();
    orders.extend([
        json!({ "kind": "single-block", "on": true }),
        json!({ "kind": "feed-override", "value": 0.5 }),
        json!({ "kind": "rapid-override", "value": 0.5 }),
        json!({ "kind": "jog-override", "value": 0.5 }),
        json!({ "kind": "acknowledge", "boot": "1", "epoch": 1, "sequence": 1 }),
        json!({ "kind": "jog", "gesture": 1, "number": 1, "at_ms": 1.0, "axes": { "X": 1.0 } }),
        json!({ "kind": "jog-end", "gesture": 1 }),
        json!({ "kind": "jog-step", "axes": { "X": 1.0 }, "feed": 100.0 }),
        json!({ "kind": "mdi", "line": "G0 X1" }),
        json!({ "kind": "sequence", "name": "x", "lines": ["G0 X1"] }),
        json!({ "kind": "run", "name": "a.ngc", "program": "0000000000000001" }),
        json!({ "kind": "queue-add", "name": "a.ngc" }),
        json!({ "kind": "queue-move", "entry": 1, "to": 0 }),
        json!({ "kind": "queue-remove", "entry": 1 }),
        json!({ "kind": "shuttle", "gesture": 1, "number": 1, "at_ms": 1.0, "speed": 0.1 }),
        json!({ "kind": "shuttle-end", "gesture": 1 }),
        json!({ "kind": "answer-seat", "give": true }),
        json!({ "kind": "pair-device", "may": "hold" }),
        json!({ "kind": "revoke-device", "name": "Tablet" }),
    ]);
    orders
}

#[test]
fn a_paired_device_looks_and_holds_and_does_nothing_else() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait_for(MachineState::Running);
    let live = serve(&instance, &keeping(&instance));
    let tablet = Device::paired(&live, "hold", "Tablet");
    let display = Device::paired(&live, "look", "Display");
    for (device, role) in [(&tablet, "hold"), (&display, "look")] {
        assert_eq!(device.get("/api/may"), (200, role.to_owned()));
        assert_eq!(device.get("/api/plan").0, 200);
        for order in orders_of_operators() {
            let (status, said) = device.order(&order);
            assert_eq!(status, 403, "{role}: {order}: {said}");
        }
        let bytes = "application/octet-stream";
        let upload = "POST /api/upload?name=a.ngc&at=0&size=1";
        assert_eq!(device.ask(upload, bytes, b"x").0, 403);
        // Neither the list of devices nor a code that is shown.
        assert_eq!(device.get("/api/devices").0, 404);
        let mut stream = device.stream();
        let mut some = [0; 4096];
        stream.read_exact(&mut some).unwrap();
    }
    assert_eq!(display.order(&json!({ "kind": "hold" })).0, 403);
    assert_eq!(display.order(&json!({ "kind": "abort" })).0, 403);
    // All of that left the machine alone.
    std::thread::sleep(Duration::from_millis(300));
    let _still_moving = services.wait_for(MachineState::Running);
    assert_eq!(tablet.order(&json!({ "kind": "hold" })).0, 200);
    let _held = services.wait_for(MachineState::Held);
    assert_eq!(tablet.order(&json!({ "kind": "abort" })).0, 200);
    let _idle = services.wait_for(MachineState::Idle);
    // Tokens of the one side are nothing on the other.
    let field = format!("X-Glidepath-Token: {}\r\n", tablet.token);
    assert_eq!(live.command(&field, "{\"kind\":\"hold\"}").0, 403);
    let stolen = Device {
        token: live.url.split_once("#token=").unwrap().1.to_owned(),
        ..Device::new(&live)
    };
    assert_eq!(stolen.get("/api/may").0, 403);
    assert_eq!(stolen.order(&json!({ "kind": "hold" })).0, 403);
    drop((live, planner.wait()));
    drop(services.end());
}

#[test]
fn a_code_pairs_once_while_it_is_shown() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    let config = keeping(&instance);
    let live = serve(&instance, &config);
    let (panel, device) = (Page(&live, 1), Device::new(&live));
    let offer =
        || panel.accepted(&json!({ "kind": "pair-device", "may": "hold" }))["offer"].clone();
    let refused = |code: &Value, words: &str| {
        let (status, said) = device.send(code.as_str().unwrap(), "x");
        let reason = said["reason"].as_str().unwrap_or("");
        assert!(
            status == 403 && reason.contains(words),
            "{words}: {status} {said}"
        );
    };
    refused(&"00000000".into(), "no code is shown");
    // Once.
    let first = offer();
    assert_eq!(
        device.send(first["code"].as_str().unwrap(), "Tablet").0,
        200
    );
    refused(&first["code"], "no code is shown");
    // Another one ends it, and so does the page that shows it.
    let (before, after) = (offer(), offer());
    refused(&before["code"], "wrong");
    let _ended = panel.accepted(&json!({ "kind": "end-pairing" }));
    refused(&after["code"], "no code is shown");
    // Not after so many wrong ones.
    let guessed = offer();
    for _ in 0..5 {
        refused(&"00000000".into(), "wrong");
    }
    refused(&guessed["code"], "too often");
    let shown = Value::Null;
    let fields = format!("{}X-Glidepath-Page: 0000000000000001\r\n", live.token());
    let known = live.get_with(&fields, "/api/devices");
    assert_eq!(known["offer"]["code"], shown);
    // Who shows it no more has it no more: nobody has asked for it for longer than that.
    let left = offer();
    std::thread::sleep(Duration::from_secs(6));
    refused(&left["code"], "no code is shown");
    // A page that does not show it is not told.
    let _offer = offer();
    let other = format!("{}X-Glidepath-Page: 0000000000000002\r\n", live.token());
    let known = live.get_with(&other, "/api/devices");
    assert_eq!(known["offer"], Value::Null);
    assert_eq!(known["devices"][0]["name"], "Tablet");
    // It is told in the log.
    let status = live.told(|status| {
        let log = status["log"].as_array();
        log.is_some_and(|log| {
            log.iter()
                .any(|entry| entry["text"] == "device paired: Tablet, which may hold")
        })
    });
    drop(status);
    drop(live);
    drop(services.end());
}

#[test]
fn a_device_is_paired_over_a_restart_until_it_is_revoked() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    let config = keeping(&instance);
    let first = serve(&instance, &config);
    let before = Device::paired(&first, "hold", "Küche <1>");
    drop(first);
    let command = |arguments: &[&str]| {
        let config = ["--config", &config];
        Process::join(
            &instance,
            &[&["live", "devices"], arguments, &config].concat(),
        )
        .wait()
    };
    let live = serve(&instance, &config);
    let device = Device {
        token: before.token.clone(),
        ..Device::new(&live)
    };
    assert_eq!(
        device.fingerprint, before.fingerprint,
        "the certificate is kept"
    );
    assert_eq!(device.get("/api/may").0, 200);
    let listed = command(&["--json"]).expect(0).json();
    assert_eq!(listed["devices"][0]["name"], "Küche 1");
    assert!(command(&[]).expect(0).stdout.contains("Küche 1"));
    let unknown = command(&["revoke", "Tablet"]).expect(2);
    assert!(
        unknown.stderr.contains("there are: Küche 1"),
        "{}",
        unknown.stderr
    );
    let mut stream = device.stream();
    let _revoked = command(&["revoke", "Küche 1"]).expect(0);
    let revoked = Instant::now();
    let mut rest = Vec::new();
    let _length = stream.read_to_end(&mut rest).unwrap();
    assert!(revoked.elapsed() < Duration::from_secs(5));
    assert_eq!(device.get("/api/may").0, 403);
    assert_eq!(device.order(&json!({ "kind": "hold" })).0, 403);
    drop(live);
    drop(services.end());
}

/// And nothing starts with it.
#[test]
fn what_others_can_read_lets_nobody_in() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    let config = keeping(&instance);
    let live = serve(&instance, &config);
    let again = Device::paired(&live, "hold", "Tablet");
    assert_eq!(again.get("/api/may").0, 200);
    let state = instance.path("state");
    let list = format!("{state}/devices/devices.json");
    for file in [&list, &format!("{state}/devices/certificate.json")] {
        let mode = |mode| {
            std::fs::set_permissions(file, std::fs::Permissions::from_mode(mode)).unwrap();
        };
        assert_eq!(
            std::fs::metadata(file).unwrap().permissions().mode() & 0o777,
            0o600
        );
        mode(0o640);
        if *file == list {
            assert_eq!(again.get("/api/may").0, 403);
            let said = Process::join(&instance, &["live", "devices", "--config", &config])
                .wait()
                .expect(5)
                .stderr;
            assert!(said.contains("other users can open it"), "{said}");
        }
        let arguments = [
            "live",
            "--port",
            "0",
            "--devices",
            "127.0.0.1:0",
            "--config",
            &config,
        ];
        let refused = Process::join(&instance, &arguments).wait();
        assert!(
            refused.stderr.contains("other users can open it"),
            "{}",
            refused.stderr
        );
        mode(0o600);
    }
    assert_eq!(again.get("/api/may").0, 200);
    // Neither tokens nor codes are kept.
    let text = std::fs::read_to_string(&list).unwrap();
    assert!(!text.contains(&again.token) && text.contains("Tablet"));
    drop(live);
    drop(services.end());
}

#[test]
fn the_panel_and_a_device_stop_the_machine_while_strangers_shake_hands() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait_for(MachineState::Running);
    let live = serve(&instance, &keeping(&instance));
    let device = Device::paired(&live, "hold", "Tablet");
    let over = Arc::<AtomicBool>::default();
    let (port, print) = (device.port, device.fingerprint.clone());
    let shake = {
        let over = Arc::clone(&over);
        move || {
            while !over.load(Ordering::Relaxed) {
                // Refused: it has no host. Or shown out before.
                let _gone = encrypted(port, &print).write_all(b"GET /api/may HTTP/1.1\r\n\r\n");
            }
        }
    };
    let half = {
        let over = Arc::clone(&over);
        move || {
            let mut streams = Vec::new();
            while !over.load(Ordering::Relaxed) {
                while streams.len() < 150 {
                    let mut stream = std::net::TcpStream::connect(("127.0.0.1", port)).unwrap();
                    if stream.write_all(b"\x16\x03\x01\x40\x00").is_ok() {
                        streams.push(stream);
                    }
                }
                streams.retain_mut(|stream| stream.write_all(b"x").is_ok());
                std::thread::sleep(Duration::from_millis(20));
            }
        }
    };
    let flood = [std::thread::spawn(shake), std::thread::spawn(half)];
    std::thread::sleep(Duration::from_millis(500));
    let panel = Page(&live, 1);
    for (kind, by_device, state) in [
        ("hold", false, MachineState::Held),
        ("resume", false, MachineState::Running),
        ("hold", true, MachineState::Held),
        ("resume", false, MachineState::Running),
        ("hold", false, MachineState::Held),
        ("abort", true, MachineState::Idle),
    ] {
        let order = json!({ "kind": kind });
        if by_device {
            assert_eq!(device.order(&order).0, 200, "{kind}");
        } else {
            let _said = panel.accepted(&order);
        }
        let _there = services.wait_for(state);
    }
    over.store(true, Ordering::Relaxed);
    for thread in flood {
        thread.join().unwrap();
    }
    drop((live, planner.wait()));
    drop(services.end());
}

/// The address in the picture: what a camera would read, read from the page, which is all that the picture is made of.
#[test]
fn a_browser_is_paired_by_the_address_in_the_picture() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let (Some(mut panel), Some(mut phone)) = (Browser::start(1280, 800), Browser::start(390, 844))
    else {
        return;
    };
    let program = instance.file("program.ngc", &long_program());
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait_for(MachineState::Running);
    let live = serve(&instance, &keeping(&instance));
    panel.open(&live.url);
    panel.wait("typeof S !== 'undefined' && S.operates && S.status && DEVICES.known");
    panel.evaluate("setView('setup')");
    panel.press("[data-do=table-devices]");
    panel.wait("document.querySelector('[data-do=pair-device]:not([aria-disabled])')");
    panel.picture("devices-none");
    panel.press("[data-do=pair-device]");
    panel.wait("document.querySelector('.qr path') && DEVICES.known.offer.code");
    for name in ["light", "dark"] {
        panel.evaluate(&format!("theme('{name}')"));
        panel.picture(&format!("devices-code-{name}"));
    }
    // It is shown for longer than a page that is silent has it.
    std::thread::sleep(Duration::from_secs(6));
    let code = panel.evaluate("document.querySelector('.offer .code').textContent");
    let url = panel.evaluate("DEVICES.known.url");
    let (code, url) = (code.as_str().unwrap(), url.as_str().unwrap());

    let trust = json!({ "ignore": true });
    let _trusted = phone.call("Security.setIgnoreCertificateErrors", &trust);
    let size = json!({ "width": 390, "height": 844, "deviceScaleFactor": 1, "mobile": false });
    let _sized = phone.call("Emulation.setDeviceMetricsOverride", &size);
    phone.open(&format!("{url}#code={code}"));
    phone.wait("document.querySelector('#pairing-name')");
    assert_eq!(
        phone.evaluate("location.hash"),
        "",
        "the code has left the address"
    );
    phone.picture("devices-pairing");
    phone.evaluate("document.querySelector('#pairing-name').value = 'Phone'");
    phone.press("#pairing button");
    phone.wait("typeof S !== 'undefined' && S.may === 'hold' && S.state === 'running'");
    assert_eq!(phone.evaluate("S.view"), "glance");
    phone.picture("devices-glance");
    panel.wait("DEVICES.said === 'Phone is paired: it may hold and abort.'");
    panel.wait("DEVICES.known.devices[0].here");
    panel.picture("devices-paired");
    phone.press("[data-c=hold]");
    let _held = services.wait_for(MachineState::Held);
    phone.wait("S.state === 'held'");
    // Loaded again, it is paired.
    phone.open("about:blank");
    phone.open(url);
    phone.wait("typeof S !== 'undefined' && S.may === 'hold' && S.state === 'held'");
    assert_eq!(
        phone.evaluate("!document.querySelector('#pairing form')"),
        true
    );
    // A finger at the panel ends it.
    panel.press_for("[data-do=revoke-device]", Duration::from_millis(1400));
    panel.wait("DEVICES.known.devices.length === 0");
    phone
        .wait("document.querySelector('#pairing-code') && S.state === 'stale' && S.may === 'look'");
    phone.picture("devices-revoked");
    drop(live);
    drop(planner);
    drop(services.end());
}
