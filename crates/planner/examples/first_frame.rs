//! The time that a program takes to begin: dense lines in a file, from opening it to the first
//! frame, published as the planner process does, and to the first motion, pulled from a pipeline.
//! All of the file is read and checked before.
//!
//! ```text
//! cargo run --release -p glidepath-planner --example first_frame
//! ```
#![allow(clippy::print_stdout, reason = "a table")]

#[path = "../tests/it/support/mill.rs"]
mod mill;

use std::cell::RefCell;
use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use glidepath_gcode::{AxisTravel, Machine, Options};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_link::{
    Command, CommandReply, CommandRequest, InProcess, JobStage, MachineState, Status,
    Transport as _,
};
use glidepath_planner::{Control, FramePublisher, Notice, Pace, Pipeline, ProgramSource, RunError};
use glidepath_program::Effort;
use mill::mill;

const PERIOD_NS: u64 = 4_000_000;
/// Times each is measured; the median counts.
const TURNS: usize = 9;

/// A mill with soft limits.
fn options() -> Options {
    let travel = AxisTravel {
        min: -500.0,
        max: 500.0,
    };
    let machine = [Axis::X, Axis::Y, Axis::Z]
        .into_iter()
        .fold(Machine::new(&[]), |machine, axis| {
            machine.with_travel(axis, travel)
        });
    Options {
        machine,
        ..Options::default()
    }
}

/// Lines of a hundredth of a millimetre round a circle that slowly sinks.
fn dense(file: &File, lines: u32) -> std::io::Result<()> {
    let mut file = BufWriter::new(file);
    writeln!(file, "G21 G90 G64 F6000\nG0 X0 Y0 Z0")?;
    for k in 1..=lines {
        let angle = 2e-4 * f64::from(k);
        let (x, y, z) = (50.0 * angle.cos() - 50.0, 50.0 * angle.sin(), -1e-4 * angle);
        writeln!(file, "G1 X{x:.4} Y{y:.4} Z{z:.4}")?;
    }
    writeln!(file, "M2")?;
    file.flush()
}

/// From the start until the file is checked; the same again, until the first frame, at rest, is
/// published; and until the first one is planned that moves.
fn begin(path: &Path, effort: Effort) -> Result<[Duration; 3], Box<dyn Error>> {
    let start = Instant::now();
    let source = ProgramSource::open(path, options())?;
    let checked = start.elapsed();
    let mut pipeline = Pipeline::new(source, mill(effort), AxisVector::zeros());
    let first = pipeline.next_frame()?.ok_or("no frame")?;
    while pipeline.next_frame()?.ok_or("no motion")?.position == first.position {}
    let moved = start.elapsed();
    Ok([checked, publish(path, effort)?, moved])
}

/// From the start until the first frame is in the queue of an interpolator.
fn publish(path: &Path, effort: Effort) -> Result<Duration, Box<dyn Error>> {
    let transport = InProcess::default();
    // The interpolator's end of the queue.
    let _frames = transport.frame_source()?;
    let sink = transport.status_sink()?;
    let (sink, mut status): (_, Status) = (RefCell::new(sink), bytemuck::Zeroable::zeroed());
    (status.period_ns, status.state) = (PERIOD_NS, MachineState::Idle.code());
    status.next_epoch = 1;
    let stop = AtomicBool::new(false);
    let mut commands = transport.command_server()?;
    let mut pause = |time| {
        // Whatever job it is told of has the machine.
        let mut answer = |request: &CommandRequest| {
            if let Ok(Command::Job { number, .. }) = request.command() {
                (status.job_number, status.job_stage) = (number, JobStage::Preparing.code());
            }
            CommandReply::new(0, request.number, Ok(()), MachineState::Idle, "")
        };
        while commands.serve(&mut answer).is_ok_and(|any| any) {}
        status.updated_ns += 1;
        // A queue that is full has enough of them.
        let _ = sink.borrow_mut().publish(&status);
        // Nobody answers what comes after.
        if !stop.load(Ordering::Relaxed) {
            std::thread::sleep(time);
        }
    };
    let mut published = None;
    let mut publisher = FramePublisher::connect(&transport, Pace::new(PERIOD_NS, 0.6))?;
    let mut none = |_: &Notice<'_>| {};
    let position = publisher.wait_until_ready(
        ("part", 0),
        &mut Control {
            stop: &stop,
            pause: &mut pause,
            notify: &mut none,
        },
    )?;
    let start = Instant::now();
    let mut notify = |notice: &Notice<'_>| {
        if matches!(notice, Notice::Started { .. }) {
            published = Some(start.elapsed());
            stop.store(true, Ordering::Relaxed);
        }
    };
    let source = ProgramSource::open(path, options())?;
    let mut pipeline = Pipeline::new(source, mill(effort), position);
    let ended = publisher.publish(
        &mut pipeline,
        &mut Control {
            stop: &stop,
            pause: &mut pause,
            notify: &mut notify,
        },
    );
    match ended {
        Err(RunError::Interrupted) => published.ok_or_else(|| "no frame".into()),
        other => Err(format!("{other:?}").into()),
    }
}

fn median(mut times: Vec<Duration>) -> f64 {
    times.sort_unstable();
    let middle = times.get(times.len() / 2).copied();
    1e3 * middle.unwrap_or_default().as_secs_f64()
}

/// The most memory this process had, as Linux says it.
fn peak() -> Option<String> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    Some(line.trim_start_matches("VmHWM:").trim().to_owned())
}

fn main() -> Result<(), Box<dyn Error>> {
    println!(
        "| lines | effort | checked, ms | first frame published, ms | first motion planned, ms |"
    );
    println!("|---|---|---|---|---|");
    for lines in [10_000, 100_000, 1_000_000] {
        let file = tempfile::NamedTempFile::new()?;
        dense(file.as_file(), lines)?;
        for effort in [Effort::Fast, Effort::Optimal] {
            let mut times = [const { Vec::new() }; 3];
            for _ in 0..TURNS {
                for (times, time) in times.iter_mut().zip(begin(file.path(), effort)?) {
                    times.push(time);
                }
            }
            let [checked, published, moved] = times.map(median);
            println!("| {lines} | {effort:?} | {checked:.1} | {published:.1} | {moved:.1} |");
        }
    }
    println!("\n{} at most in memory", peak().unwrap_or_default());
    Ok(())
}
