//! Tests of telemetry by a real broker: what it publishes is what the machine did, the broker tells
//! of its death, and a broker that comes again is told everything again.

use std::io::{BufRead as _, BufReader};
use std::net::TcpListener;
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use glidepath_link::MachineState;
use glidepath_testing::skip;
use glidepath_tests::{Instance, Process, Services, Watchdog, of_this_test};
use rustix::process::Signal;
use serde_json::Value;

const PATIENCE: Duration = Duration::from_secs(120);
const PROGRAM: &str = "G21 G90 G1 X40 Y5 F1200\nM3 S1000\nX0 Y0\nM2\n";
/// Why there is no telemetry.
pub(crate) const NO_BROKER: &str = "mosquitto and mosquitto_sub are not installed";

/// A process of the broker's, ended with its value.
pub(crate) struct Ended(Child);

impl Drop for Ended {
    fn drop(&mut self) {
        // One that has ended already cannot be killed, and need not be.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A port that is free now.
pub(crate) fn free_port() -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    listener.local_addr().unwrap().port()
}

/// A broker at a port of this host, once it listens.
pub(crate) fn broker(instance: &Instance, port: u16) -> Ended {
    let text = format!("listener {port} 127.0.0.1\nallow_anonymous true\npersistence false\n");
    let config = instance.file("mosquitto.conf", &text);
    let child = of_this_test(&mut Command::new("mosquitto"))
        .args(["-c", &config])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let started = Instant::now();
    while std::net::TcpStream::connect(("127.0.0.1", port)).is_err() {
        assert!(
            started.elapsed() < PATIENCE / 4,
            "the broker does not listen"
        );
        std::thread::sleep(Duration::from_millis(20));
    }
    Ended(child)
}

/// What a subscriber heard: topics and messages, in order.
type Heard = Arc<Mutex<Vec<(String, Value)>>>;

struct Witness {
    heard: Heard,
    _process: Ended,
}

impl Witness {
    fn start(port: u16) -> Self {
        let mut child = of_this_test(&mut Command::new("mosquitto_sub"))
            .args([
                "-h",
                "127.0.0.1",
                "-p",
                &port.to_string(),
                "-v",
                "-t",
                "glidepath/#",
            ])
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let output = child.stdout.take().unwrap();
        let heard = Heard::default();
        let into = Arc::clone(&heard);
        std::thread::spawn(move || {
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                let (topic, text) = line.split_once(' ').unwrap();
                let name = topic.rsplit('/').next().unwrap().to_owned();
                let value = serde_json::from_str(text).unwrap();
                into.lock().unwrap().push((name, value));
            }
        });
        Self {
            heard,
            _process: Ended(child),
        }
    }

    /// Waits for a message; the test ends with what was heard if none comes.
    fn wait(&self, name: &str, wanted: impl Fn(&Value) -> bool) -> Value {
        let started = Instant::now();
        loop {
            let heard = self.heard.lock().unwrap();
            let found = heard
                .iter()
                .find(|(topic, value)| topic == name && wanted(value));
            if let Some((_, value)) = found {
                return value.clone();
            }
            assert!(started.elapsed() < PATIENCE / 4, "no {name}: {heard:#?}");
            drop(heard);
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    fn all(&self, name: &str) -> Vec<Value> {
        let heard = self.heard.lock().unwrap();
        let of = heard.iter().filter(|(topic, _)| topic == name);
        of.map(|(_, value)| value.clone()).collect()
    }
}

pub(crate) fn is_there() -> bool {
    ["mosquitto", "mosquitto_sub"]
        .iter()
        .all(|name| Command::new(name).arg("--help").output().is_ok())
}

#[test]
fn a_broker_hears_what_the_machine_does_and_of_the_end_of_who_tells_it() {
    if !is_there() {
        skip("telemetry to a broker", NO_BROKER);
        return;
    }
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let port = free_port();
    let mosquitto = broker(&instance, port);
    let witness = Witness::start(port);
    let services = Services::start(&instance);
    let address = format!("127.0.0.1:{port}");
    let arguments = ["telemetry", "--broker", &address, "--json"];
    let telemetry = Process::join(&instance, &arguments);
    witness.wait("online", |value| value["online"] == true);
    let info = witness.wait("info", |_| true);
    assert_eq!(info["axes"], serde_json::json!(["X", "Y", "Z"]));
    witness.wait("status", |value| value["state"] == "idle");

    let program = instance.file("program.ngc", PROGRAM);
    let _planned = Process::join(&instance, &["planner", &program])
        .wait()
        .expect(0);
    let _idle = services.wait_for(MachineState::Idle);
    witness.wait("event", |value| {
        value["from"] == "running" && value["to"] == "idle"
    });
    witness.wait("event", |value| value["event"] == "M3");
    // Four seconds of motion, ten times a second, at the feed that was programmed.
    let moving = |status: &&Value| status["feed_mm_s"].as_f64().is_some_and(|feed| feed > 19.9);
    let told = witness.all("status");
    let moving: Vec<&Value> = told.iter().filter(moving).collect();
    assert!(moving.len() >= 8, "{told:#?}");
    let places = moving
        .iter()
        .map(|status| status["position"]["X"].as_f64().unwrap());
    assert!(
        places.clone().all(|x| (-1e-9..=40.0).contains(&x)),
        "{told:#?}"
    );
    assert!(places.fold(0.0, f64::max) > 10.0, "{told:#?}");

    // The broker goes and comes again: nothing old comes late, and who is there is told anew.
    drop((witness, mosquitto));
    let gone = Instant::now();
    std::thread::sleep(Duration::from_millis(500));
    let _mosquitto = broker(&instance, port);
    let witness = Witness::start(port);
    witness.wait("online", |value| value["online"] == true);
    let first = witness.wait("status", |_| true);
    let age = gone.elapsed();
    assert_eq!(first["state"], "idle");
    assert!(age < PATIENCE / 8, "{age:?}");

    // Who dies is told of by the broker; who ends says so.
    telemetry.signal(Signal::KILL);
    let _killed = telemetry.wait();
    witness.wait("online", |value| value["online"] == false);
    let telemetry = Process::join(&instance, &arguments);
    let online = |witness: &Witness| witness.all("online").into_iter().next_back();
    while online(&witness).is_none_or(|value| value["online"] == false) {
        std::thread::sleep(Duration::from_millis(5));
    }
    let report = telemetry.end().expect(0).json();
    assert_eq!(report["connections"], 1, "{report}");
    while online(&witness).is_none_or(|value| value["online"] == true) {
        std::thread::sleep(Duration::from_millis(5));
    }
    // What is retained is the last word.
    let late = Witness::start(port);
    assert_eq!(late.wait("online", |_| true)["online"], false);
    let _recorded = services.end();
}
