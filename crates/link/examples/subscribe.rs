//! The smallest consumer of setpoints: prints what an interpolator publishes.
//!
//! Start an interpolator (`glidepath interpolator --best-effort`), then
//! `cargo run -p glidepath-link --example subscribe -- default`, where the last word is the name of
//! the instance. Ends after five seconds without a setpoint.

#![allow(clippy::print_stdout, reason = "that is what it is for")]

use glidepath_link::{Ipc, LinkConfig, Record, Transport};
use std::time::{Duration, Instant};

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let instance = std::env::args()
        .nth(1)
        .unwrap_or_else(|| "default".to_owned());
    let link = Ipc::connect(&LinkConfig::new(&instance))?;
    let mut setpoints = link.setpoint_source()?;
    let (mut expected, mut lost) = (None, 0);
    let mut last_seen = Instant::now();
    while last_seen.elapsed() < Duration::from_secs(5) {
        let Some(setpoint) = setpoints.take()? else {
            // Setpoints come one period before they are to be applied: there is time to sleep.
            std::thread::sleep(Duration::from_millis(1));
            continue;
        };
        last_seen = Instant::now();
        setpoint.check()?; // It comes from another process.
        if let Some((boot_id, number)) = expected
            && boot_id == setpoint.boot_id
        {
            lost += setpoint.number.saturating_sub(number); // A gap is loss.
        }
        expected = Some((setpoint.boot_id, setpoint.number + 1));
        let [x, y, z, ..] = setpoint.joint_position;
        println!(
            "tick {:8} {:?} line {:6} at {} ns: {x:10.4} {y:10.4} {z:10.4}  lost {lost}",
            setpoint.tick,
            setpoint.state()?,
            setpoint.line,
            setpoint.apply_ns,
        );
    }
    Ok(())
}
