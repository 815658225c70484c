//! The load of many machines on one broker: how many messages a second it passes on, and how late.
//!
//! ```text
//! mosquitto -p 1883 &
//! cargo run --release -p glidepath-telemetry --example machines -- localhost 1883 200 10 20
//! ```
//!
//! Two hundred machines that each tell of themselves ten times a second, for twenty seconds, each by
//! a connection of its own; one more listens to all of them.
#![allow(
    clippy::print_stdout,
    clippy::expect_used,
    clippy::panic,
    reason = "a program to be looked at"
)]

use glidepath_telemetry::{Broker, BrokerSettings, Quality};
use rumqttc::{Client, Event, MqttOptions, Packet, QoS};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// As long as what `glidepath telemetry` publishes of three axes.
const PADDING: usize = 260;

fn settings(host: &str, port: u16, machine: usize) -> BrokerSettings {
    BrokerSettings {
        host: host.to_owned(),
        port,
        client_id: format!("example-{}-{machine}", std::process::id()),
        credentials: None,
        topic: format!("example/mill-{machine}"),
        info: "{}".to_owned(),
    }
}

/// Listens, and gives how late messages came, ns.
fn listen(
    host: &str,
    port: u16,
    since: Instant,
    late: Arc<Mutex<Vec<u64>>>,
    over: Arc<AtomicBool>,
) {
    let mut options = MqttOptions::new("example-listener", host, port);
    options.set_max_packet_size(1 << 20, 1 << 20);
    let (client, mut connection) = Client::new(options, 16);
    client
        .subscribe("example/+/status", QoS::AtMostOnce)
        .expect("there is room for one");
    std::thread::spawn(move || {
        for event in connection.iter() {
            if over.load(Ordering::Relaxed) {
                return;
            }
            let Ok(Event::Incoming(Packet::Publish(message))) = event else {
                continue;
            };
            let text = String::from_utf8_lossy(&message.payload);
            let sent_ns: u64 = text
                .split(' ')
                .next()
                .and_then(|t| t.parse().ok())
                .unwrap_or(0);
            let now_ns = u64::try_from(since.elapsed().as_nanos()).unwrap_or(u64::MAX);
            late.lock()
                .expect("nobody panics")
                .push(now_ns.saturating_sub(sent_ns));
        }
    });
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [host, rest @ ..] = arguments.as_slice() else {
        panic!("usage: machines HOST PORT MACHINES HZ SECONDS");
    };
    let numbers: Vec<u64> = rest
        .iter()
        .map(|text| text.parse().expect("a number"))
        .collect();
    let [port, machines, rate, seconds] = numbers[..] else {
        panic!("usage: machines HOST PORT MACHINES HZ SECONDS");
    };
    let port = u16::try_from(port).expect("a port");
    let since = Instant::now();
    let (late, over) = (
        Arc::new(Mutex::new(Vec::new())),
        Arc::new(AtomicBool::new(false)),
    );
    listen(host, port, since, Arc::clone(&late), Arc::clone(&over));
    let brokers: Vec<Broker> = (0..usize::try_from(machines).expect("some"))
        .map(|machine| Broker::connect(&settings(host, port, machine)))
        .collect();
    while !brokers.iter().all(Broker::is_connected) {
        assert!(since.elapsed() < Duration::from_secs(30), "no connection");
        std::thread::sleep(Duration::from_millis(20));
    }
    println!(
        "{machines} machines connected after {:.1} s",
        since.elapsed().as_secs_f64()
    );
    let (period, begun) = (
        Duration::from_secs(1) / u32::try_from(rate).expect("a rate"),
        Instant::now(),
    );
    let sent = AtomicU64::new(0);
    let padding = "x".repeat(PADDING);
    for turn in 0..rate * seconds {
        let due = begun + period * u32::try_from(turn).expect("minutes at most");
        for broker in &brokers {
            let now_ns = since.elapsed().as_nanos();
            if broker.publish("status", Quality::AtMostOnce, format!("{now_ns} {padding}")) {
                sent.fetch_add(1, Ordering::Relaxed);
            }
        }
        std::thread::sleep(due.saturating_duration_since(Instant::now()));
    }
    let took = begun.elapsed().as_secs_f64();
    std::thread::sleep(Duration::from_secs(1));
    over.store(true, Ordering::Relaxed);
    let mut late = late.lock().expect("nobody panics").clone();
    late.sort_unstable();
    let sent = sent.load(Ordering::Relaxed);
    let quantile = |share: usize| late.get(late.len() * share / 1000).copied().unwrap_or(0) / 1000;
    println!(
        "{sent} messages in {took:.1} s, {} arrived, late by {} µs (median), {} µs (99 %)",
        late.len(),
        quantile(500),
        quantile(990)
    );
    for broker in brokers {
        broker.close();
    }
}
