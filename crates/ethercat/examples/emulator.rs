//! Emulated drives on a network interface, for masters by other people, with a coupler and four kinds of
//! terminals behind them if that is asked for:
//! `cargo run -p glidepath-ethercat --example emulator -- veth1 3 terminals`. They answer until the process ends.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::infinite_loop,
    reason = "an example, which ends with Ctrl-C"
)]

use glidepath_emulator::{ClockKind, DriveSettings, Segment};
use glidepath_ethercat::{MAX_FRAME, PacketWire, Wire};

fn main() {
    let mut args = std::env::args().skip(1);
    let (Some(interface), Some(drives)) = (args.next(), args.next()) else {
        println!("usage: emulator INTERFACE DRIVES [terminals]");
        return;
    };
    let mut line = vec![DriveSettings::default(); drives.parse().unwrap()];
    if args.next().is_some() {
        line.extend([
            DriveSettings::terminal("COUPLER", ClockKind::Bits64),
            DriveSettings::inputs(4),
            DriveSettings::outputs(4),
            DriveSettings::analog_inputs(4),
            DriveSettings::analog_outputs(2),
        ]);
    }
    let mut wire = PacketWire::open(&interface).unwrap();
    let mut segment = Segment::new_at(&line, wire.now_ns());
    let mut frame = [0; MAX_FRAME];
    loop {
        let until_ns = wire.now_ns() + 1_000_000_000;
        if let Some(length) = wire.receive(&mut frame, until_ns).unwrap() {
            let frame = &mut frame[..length];
            segment.pass(frame, wire.now_ns());
            wire.send(frame).unwrap();
        }
    }
}
