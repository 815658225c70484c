//! Lines per second on one core: plain G1 lines, expressions, and a program of 1 GB that is written
//! while it is read, with the memory that took.
//!
//! ```text
//! cargo run --release -p glidepath-gcode --example throughput
//! cargo run --release -p glidepath-gcode --example throughput -- stream
//! ```

#![expect(
    clippy::print_stdout,
    reason = "the figures are what this program is for"
)]

use std::fmt::Write;
use std::io::{BufRead, BufReader, Read};
use std::time::Instant;

use glidepath_gcode::{Options, Program};

/// Lines of the programs in memory.
const LINES: u32 = 2_000_000;
/// Bytes of a line of the program that is streamed.
const LINE: u64 = 26;
/// Bytes of that program: 1 GiB, in whole lines.
const STREAM: u64 = (1 << 30) / LINE * LINE;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    if std::env::args().nth(1).as_deref() == Some("stream") {
        let (moves, seconds) = read(BufReader::new(Endless::default().take(STREAM)))?;
        println!(
            "1 GB: {moves} moves, {seconds:.1} s, {} at most in memory",
            peak().unwrap_or_default()
        );
        return Ok(());
    }
    let mut plain = String::from("G21 G90 F1000\n");
    let mut computed = String::from("G21 G90 F1000 #1=3 #<r>=50\n");
    for i in 0..LINES {
        let t = f64::from(i) * 1e-3;
        let (x, y, z) = (50.0 * t.cos(), 50.0 * t.sin(), 0.01 * t);
        writeln!(plain, "G1 X{x:.4} Y{y:.4} Z{z:.4}")?;
        writeln!(
            computed,
            "G1 X[#1+{x:.3}*2] Y[SIN[{t:.3}]*#<r>] Z[{z:.3}/#1]"
        )?;
    }
    for (name, text, expressions) in [("plain", plain, 0), ("computed", computed, 3)] {
        let (moves, seconds) = read(text.as_bytes())?;
        let lines = f64::from(LINES) / seconds / 1e6;
        println!(
            "{name}: {moves} moves, {seconds:.3} s, {lines:.2} million lines/s, {:.2} million \
             expressions/s",
            lines * f64::from(expressions)
        );
    }
    Ok(())
}

/// Moves of a program, and the seconds it took to read.
fn read(reader: impl BufRead) -> Result<(u64, f64), Box<dyn std::error::Error>> {
    let begin = Instant::now();
    let mut moves = 0;
    for item in Program::new(reader, Options::default()) {
        item?;
        moves += 1;
    }
    Ok((moves, begin.elapsed().as_secs_f64()))
}

/// The most memory this process had, as Linux says it.
fn peak() -> Option<String> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    Some(line.trim_start_matches("VmHWM:").trim().to_owned())
}

/// A program without end.
#[derive(Debug, Default)]
struct Endless {
    text: String,
    given: usize,
    line: u32,
}

impl Read for Endless {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        if self.given == self.text.len() {
            self.text.clear();
            self.given = 0;
            for _ in 0..100 {
                // Each line is of the same length: LINE.
                let at = self.line % 1000;
                self.text
                    .push_str(&format!("G1X{at:06}.5Y{:06}.25F900\n", 999 - at));
                self.line = self.line.wrapping_add(1);
            }
        }
        let rest = self.text.as_bytes().get(self.given..).unwrap_or_default();
        let length = rest.len().min(buffer.len());
        if let (Some(to), Some(from)) = (buffer.get_mut(..length), rest.get(..length)) {
            to.copy_from_slice(from);
        }
        self.given += length;
        Ok(length)
    }
}
