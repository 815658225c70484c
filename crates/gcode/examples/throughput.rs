//! Lines per second of a program of plain G1 lines, on one core.
//!
//! ```text
//! cargo run --release -p glidepath-gcode --example throughput
//! ```

#![expect(
    clippy::print_stdout,
    reason = "the figure is what this program is for"
)]

use std::fmt::Write;
use std::time::Instant;

use glidepath_gcode::{Options, Program};

/// Lines of the program.
const LINES: u32 = 2_000_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut text = String::from("G21 G90 F1000\n");
    for i in 0..LINES {
        let t = f64::from(i) * 1e-3;
        let (x, y, z) = (50.0 * t.cos(), 50.0 * t.sin(), 0.01 * t);
        writeln!(text, "G1 X{x:.4} Y{y:.4} Z{z:.4}")?;
    }
    let begin = Instant::now();
    let mut moves = 0_u32;
    for item in Program::new(text.as_bytes(), Options::default()) {
        item?;
        moves += 1;
    }
    let seconds = begin.elapsed().as_secs_f64();
    let rate = f64::from(LINES) / seconds;
    println!(
        "{moves} moves, {seconds:.3} s, {:.2} million lines/s",
        rate / 1e6
    );
    Ok(())
}
