//! What the end of a program, a reset and a sender that goes leave on, stored and in motion.

use std::time::{Duration, Instant};

use glidepath_tests::{Instance, Watchdog};

use super::sender::Sender;
use super::{Bench, PATIENCE};

/// A full report that says what is on: `|A:S` for a spindle.
fn waits_for_accessories(sender: &mut Sender, wanted: &str) {
    let begun = Instant::now();
    loop {
        sender.send(b"\x87");
        let _state = sender.state();
        let report = sender.report().to_owned();
        let told = report.split("|A:").nth(1);
        let told = told.map(|told| told.trim_end_matches('>'));
        if report.contains("|Ov:") && told.unwrap_or_default() == wanted {
            return;
        }
        assert!(begun.elapsed() < Duration::from_secs(20), "{report}");
    }
}

#[test]
fn programs_resets_and_senders_leave_nothing_on_and_lose_nothing_that_was_answered() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    let mut sender = bench.sender();
    // The end of a program.
    let part = ["M3 S1000 M8", "G1 X1 F3000", "M30"];
    assert_eq!(sender.answers(&part), ["ok"; 3]);
    waits_for_accessories(&mut sender, "");
    // A reset at rest, and what it puts in force.
    let on = ["M3 S500 M7", "G91 G55", "G92 X7"];
    assert_eq!(sender.answers(&on), ["ok"; 3]);
    waits_for_accessories(&mut sender, "SM");
    sender.send(b"\x18$G\n");
    sender.wait_for("Grbl 1.1");
    sender.wait_for("[GC:G0 G54 G17 G21 G90 G94 M5 M9");
    sender.send(b"$#\n");
    sender.wait_for("[G92:0.000,0.000,0.000]");
    waits_for_accessories(&mut sender, "");
    // A reset at rest locks nothing.
    sender.wait_for_state("Idle");
    // What was answered is stored.
    assert_eq!(sender.answers(&["G10 L20 P1 X5"]), ["ok"]);
    sender.send(b"\x18$#\n");
    sender.wait_for("[G54:-4.000,0.000,0.000]");
    sender.wait_for_state("Idle");
    // M1 is read over, and M0 waits while questions are answered.
    assert_eq!(sender.answers(&["M1", "G4 P0.01"]), ["ok"; 2]);
    sender.send(b"M0\n");
    sender.wait_for_state("Hold:0");
    sender.send(b"$$\n");
    sender.wait_for("$110=");
    sender.send(b"~");
    sender.wait_for("ok");
    sender.wait_for("ok");
    sender.wait_for_state("Idle");
    // A sender that leaves behind its last answer has done its work.
    let away = ["G1 X30 F3000", "G1 X10"];
    assert_eq!(sender.answers(&away), ["ok"; 2]);
    drop(sender);
    // The motion takes 0.8 s and more: the machine is in its middle.
    std::thread::sleep(Duration::from_millis(200));
    let mut next = bench.sender();
    next.wait_for_state("Idle");
    bench.rests_at([6.0, 0.0]);
    assert!(!next.said("was lost"), "{:?}", next.log);
    bench.end();
}
