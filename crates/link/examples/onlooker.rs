//! The smallest reader of the mirror: a program of iceoryx2 alone, which knows nothing of Glidepath
//! but the layout of a record. It copies into a program of another project as it is.
//!
//! Start an interpolator (`glidepath interpolator --best-effort`) and its mirror (`glidepath mirror`),
//! then `cargo run -p glidepath-link --example onlooker -- default`, where the word is the name of the
//! instance. A second word names the root of iceoryx2's domain, if the mirror was given one. Ends
//! five seconds after the last setpoint.
//!
//! It is for looking on: any program of the same user can publish there in the mirror's place.

#![allow(clippy::print_stdout, reason = "that is what it is for")]
#![allow(
    unsafe_code,
    reason = "the derive expands to an unsafe impl, and checks the fields"
)]

use iceoryx2::prelude::*;
use std::time::{Duration, Instant};

/// An event in the period of a setpoint: `gp_event` of the manual's page of the ABI.
#[repr(C)]
#[derive(Debug, Clone, Copy, ZeroCopySend)]
struct Event {
    value: f64,
    offset_ns: u32,
    kind: u32,
    number: u32,
    axis: u32,
    depth_um: u32,
    phase: u32,
}

/// A setpoint: `gp_setpoint` of the manual's page of the ABI. iceoryx2 compares the name of the type,
/// its size and its alignment.
#[repr(C)]
#[derive(Debug, Clone, Copy, ZeroCopySend)]
#[type_name("glidepath.SetpointMirror.v6")]
struct Setpoint {
    boot_id: u64,
    reference: u64,
    number: u64,
    tick: u64,
    scheduled_ns: u64,
    apply_ns: u64,
    lateness_ns: u64,
    missed_ticks: u64,
    epoch: u64,
    sequence: u64,
    fraction: f64,
    line: u32,
    flags: u32,
    marks: u32,
    state: u32,
    event_count: u32,
    block: u32,
    enable: u32,
    home: u32,
    path_s: f64,
    feed_v: f64,
    effective_override: f64,
    position: [f64; 9],
    velocity: [f64; 9],
    acceleration: [f64; 9],
    joint_position: [f64; 9],
    joint_velocity: [f64; 9],
    joint_acceleration: [f64; 9],
    away: [f64; 9],
    events: [Event; 16],
    superposed: [f64; 9],
    index: u32,
    reserved: u32,
}

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let instance = arguments.next().unwrap_or_else(|| "default".to_owned());
    let mut config = Config::global_config().clone();
    if let Some(root) = arguments.next() {
        config.global.set_root_path(&Path::new(root.as_bytes())?);
    }
    let node = NodeBuilder::new()
        .config(&config)
        .create::<ipc::Service>()?;
    let service = node
        .service_builder(
            &format!("glidepath/{instance}/setpoints")
                .as_str()
                .try_into()?,
        )
        .publish_subscribe::<Setpoint>()
        // Not open_or_create: what a reader makes has less room than the mirror needs.
        .open()?;
    let setpoints = service.subscriber_builder().create()?;
    println!("ready");
    let (mut expected, mut last_seen) = (None, Instant::now());
    while last_seen.elapsed() < Duration::from_secs(5) {
        let Some(setpoint) = setpoints.receive()? else {
            std::thread::sleep(Duration::from_millis(1));
            continue;
        };
        last_seen = Instant::now();
        if let Some((boot_id, number)) = expected
            && boot_id == setpoint.boot_id
            && number < setpoint.number
        {
            println!("gap {number} to {}", setpoint.number - 1);
        }
        expected = Some((setpoint.boot_id, setpoint.number + 1));
        let [x, y, z, ..] = setpoint.position;
        println!("{} {} {x} {y} {z}", setpoint.number, setpoint.line);
    }
    Ok(())
}
