//! `glidepath run`: plans a program and plays it, with all the processes that takes, on one desk.
//!
//! ```text
//!   run ── starts ──► interpolator ── setpoints ──► servo --relay ─┐ records
//!    │                     ▲ frames    └► ethercat, with --drives   ▼
//!    └──── starts ──► planner FILE                    this process: audit, CSV, plot
//! ```
//!
//! All of them are this program again. However `run` ends, the motion first comes to rest, then the
//! processes end, then the instance's shared memory is removed.

mod child;
mod instance;
mod left;
mod monitor;
mod pipe;
mod setpoint_receiver;

use super::{check, plan::title, session};
use crate::cli::{RunArgs, RunDrives};
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use crate::joints;
use crate::output;
use crate::output_file::{OutputFile, OutputKind, OverwriteGuard};
use crate::progress::ProgressDisplay;
use crate::recording::Recording;
use crate::report::{DiagnosisReport, Planning, RunReport};
use child::Process;
use glidepath_link::{Ipc, Status};
use left::Left;
use monitor::Monitor;
pub(in crate::command) use pipe::Farewell;
use serde_json::Value;
use setpoint_receiver::{Received, SetpointReceiver};
use std::ffi::OsString;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Between two looks at the processes.
const POLL: Duration = Duration::from_millis(10);
/// How long a process may take to start working, and the machine to come to rest.
const PATIENCE: Duration = Duration::from_secs(20);

/// Plans and plays a program, and reports.
///
/// # Errors
/// The program is rejected, real time is not granted, a process failed, or the user interrupted.
pub(super) fn run(args: &RunArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let lines = check::accepted(&args.file, config, args.basic.json)?.lines;
    let program = args.file.name().display().to_string();
    let progress = ProgressDisplay::lines(lines.into(), args.basic.json);
    progress.doing("judging");
    let watch = &mut |lines| progress.at(lines);
    joints::check_plan(args.file.path(), config, config.home(), watch)
        .map_err(|refusal| Failure::refused(&program, refusal, false))?;
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let guard = session::guard(Some(&args.file), &args.basic, config, args.overwrite);
    let plot = plot_path(args, &guard);
    if config.state_directory.is_some() {
        output::note("run: what is kept is read, and nothing is kept: this machine is imitated");
    }
    let csv = args.setpoints.as_deref();
    let recording = Recording::create(config, csv, plot.as_deref(), &guard)?;
    // From here on a line counts when it is executed.
    progress.start_again();
    let mut left = None;
    let played = Supervisor {
        args,
        config,
        interrupt: &interrupt,
        progress: &progress,
    }
    .play(recording, &mut left);
    progress.finish();
    if let Some(left) = left {
        let files = (args.setpoints.clone(), plot);
        return Err(match played {
            Err(failure) => left.keep(&args.file, config, files, failure),
            Ok(_) => Failure::Thread("the thread that receives setpoints"),
        });
    }
    let Played {
        planning,
        status,
        received,
        drives,
    } = played?;

    let mut report = RunReport::new(
        &planning,
        (&received.audit, received.played),
        &received.counts,
        &status,
        config,
    );
    report.drives = drives;
    report.servo_own_stops = received.farewell.own_stops;
    report.servo_stopped = received.farewell.first_stop;
    report.motion.program = args.file.name().display().to_string();
    report.motion.setpoints.clone_from(&args.setpoints);
    report.motion.plot = plot;
    let mut recording = received.recording;
    report.motion.diagnosis = Some(DiagnosisReport::new(&received.summary, config));
    recording.told(&report.motion, args.file.path());
    recording.finish(&title(args.file.name()), &report.motion.caption())?;
    if args.basic.json {
        output::object(&report);
    } else {
        output::result(&report.text());
    }
    Ok(report.exit())
}

/// Where the plot goes: for people always somewhere, beside nobody's file.
fn plot_path(args: &RunArgs, guard: &OverwriteGuard) -> Option<PathBuf> {
    if args.plot.is_some() || args.basic.json {
        return args.plot.clone();
    }
    let name = args.file.name();
    let stem = if args.file.is_standard_input() {
        "stdin".into()
    } else {
        name.file_stem().unwrap_or_default().to_string_lossy()
    };
    let path = PathBuf::from(format!("{stem}.svg"));
    // What nobody asked for overwrites nothing, and fails without harm.
    let guard = OverwriteGuard {
        force: false,
        ..guard.clone()
    };
    match OutputFile::create(&path, OutputKind::Plot, &guard) {
        Ok(_) => Some(path),
        Err(error) => {
            output::note(&format!("no plot: {error}"));
            None
        }
    }
}

/// What a run came to.
struct Played {
    planning: Planning,
    status: Status,
    received: Received,
    /// What the bridge to emulated drives reports; `None` without.
    drives: Option<Value>,
}

struct Supervisor<'a> {
    args: &'a RunArgs,
    config: &'a MachineConfig,
    interrupt: &'a Interrupt,
    progress: &'a ProgressDisplay,
}

impl Supervisor<'_> {
    /// Starts the processes, waits for the end of the motion, and ends them. Locals go in the order
    /// opposite to that in which they came: processes, ports, shared memory. Of a motion that ended
    /// before its end, what was played is `left`.
    fn play(&self, recording: Recording, left: &mut Option<Left>) -> Result<Played, Failure> {
        let named = self
            .args
            .instance
            .instance
            .clone()
            .or_else(|| self.config.instance.clone());
        let instance = named.unwrap_or_else(instance::own);
        instance::remove_killed_runs(&session::link(&instance, self.config));
        let leftovers = instance::Leftovers(session::link(&instance, self.config));
        let transport = Ipc::connect(&leftovers.0)?;
        let mut monitor = Monitor::new(&transport, &leftovers.0)?;

        self.progress.doing("starting");
        let mut interpolator = self.start("interpolator", &instance)?;
        self.wait_for(&mut interpolator, || {
            monitor.observe()?;
            Ok(monitor.status().is_some())
        })?;
        let mut servo = self.start("servo", &instance)?;
        let output = servo
            .take_output()
            .ok_or(Failure::Thread("the servo's output"))?;
        let receiver =
            SetpointReceiver::start(output, self.args.file.path(), self.config, recording);
        self.wait_for(&mut servo, || Ok(receiver.seen.received() > 0))?;
        let is_emulated = self.args.drives == RunDrives::Emulated;
        let mut bridge = is_emulated
            .then(|| self.start("ethercat", &instance))
            .transpose()?;

        let drives = bridge.as_mut().unwrap_or(&mut servo);
        self.wait_for(drives, || {
            monitor.observe()?;
            monitor.switch_on()
        })?;

        self.progress.doing("running");
        let mut planner = self.start("planner", &instance)?;
        let others = [&mut interpolator, &mut servo].into_iter();
        let others = &mut others.chain(&mut bridge).collect::<Vec<_>>();
        let played = self.watch(&mut planner, others, &mut monitor, &receiver);
        if let Err(failure) = played {
            rest(&mut monitor);
            let status = monitor.status().copied();
            let (was_over, has_given_all) = (receiver.is_over(), receiver.given_all.is_so());
            // What it has received is whole when it has ended.
            servo.end().map_err(Failure::Process)?;
            return Err(match receiver.finish() {
                // A file that cannot be written, most often.
                Err(cause) if was_over => cause,
                Err(_) => failure,
                // Whoever interrupts a run has no use for half of it.
                Ok(_) if self.interrupt.is_set() => failure,
                Ok(received) => {
                    let stopped = received.farewell.first_stop.as_deref();
                    let stopped = stopped.map(|why| servo.stopped(why));
                    *left = Some(Left { received, status });
                    let of_servo = || servo.must_live().err().filter(|_| has_given_all);
                    stopped.or_else(of_servo).unwrap_or(failure)
                }
            });
        }
        let planning = planner.planning()?;
        let status = last_status(&mut monitor)?;
        let drives = bridge.map(|bridge| bridge.finish()).transpose()?;
        servo.end().map_err(Failure::Process)?;
        let received = receiver.finish()?;
        interpolator.end().map_err(Failure::Process)?;
        Ok(Played {
            planning,
            status,
            received,
            drives,
        })
    }

    fn start(&self, name: &'static str, instance: &str) -> Result<Process, Failure> {
        let mut args: Vec<OsString> = vec!["--instance".into(), instance.into()];
        let is_emulated = self.args.drives == RunDrives::Emulated;
        match name {
            "planner" => {
                args.extend([self.args.file.path().into(), "--json".into()]);
                args.extend(self.program_args());
                args.extend(self.path_args());
            }
            "servo" => {
                args.push("--relay".into());
                args.extend(self.args.best_effort.then(|| "--best-effort".into()));
                args.extend(is_emulated.then(|| "--listens".into()));
            }
            name => {
                args.push("--json".into());
                args.extend(self.args.best_effort.then(|| "--best-effort".into()));
                if name == "ethercat" {
                    args.extend(self.bus_args());
                } else {
                    args.extend(is_emulated.then(|| "--expect-drives".into()));
                }
            }
        }
        if let Some(config) = &self.args.basic.config {
            args.extend(["--config".into(), config.path().into()]);
        }
        Process::start(name, args).map_err(Failure::Process)
    }

    /// How the bridge is to emulate its drives.
    fn bus_args(&self) -> Vec<OsString> {
        let period_us = self.args.bus_period_us.to_string();
        let mut args: Vec<OsString> = vec![
            "--emulated".into(),
            "--emulated-period-us".into(),
            period_us.into(),
        ];
        if let Some(record) = &self.args.drives_record {
            args.extend(["--emulated-record".into(), record.into()]);
        }
        args
    }

    /// How the planner is to follow the path: as it was told here.
    fn path_args(&self) -> Vec<OsString> {
        let path = &self.args.path;
        let mut args = Vec::new();
        if let Some(effort) = path.effort {
            args.extend(["--effort".into(), effort.name().into()]);
        }
        if let Some(tolerance_mm) = path.tolerance {
            args.extend(["--tolerance".into(), tolerance_mm.to_string().into()]);
        }
        args
    }

    /// How the planner is to read the program: as it was checked.
    fn program_args(&self) -> Vec<OsString> {
        let program = &self.config.program;
        let mut args = Vec::new();
        if let Some(dialect) = program.dialect {
            args.extend(["--dialect".into(), dialect.name().into()]);
        }
        if let Some(table) = &program.tool_table {
            args.extend(["--tool-table".into(), table.into()]);
        }
        for folder in &program.subroutine_path {
            args.extend(["--subroutine-path".into(), folder.into()]);
        }
        args.extend(
            program
                .may_run_unchecked
                .then(|| "--allow-unchecked".into()),
        );
        args
    }

    /// Waits until a process that was just started works.
    fn wait_for(
        &self,
        process: &mut Process,
        mut works: impl FnMut() -> Result<bool, Failure>,
    ) -> Result<(), Failure> {
        let started = Instant::now();
        while !works()? {
            if self.interrupt.is_set() {
                return Err(Failure::Interrupted);
            }
            process.must_live()?;
            if started.elapsed() > PATIENCE {
                return Err(process.silent());
            }
            std::thread::sleep(POLL);
        }
        Ok(())
    }

    /// Waits until the planner says that the motion is executed.
    fn watch(
        &self,
        planner: &mut Process,
        others: &mut [&mut Process],
        monitor: &mut Monitor<'_>,
        receiver: &SetpointReceiver,
    ) -> Result<(), Failure> {
        loop {
            if self.interrupt.is_set() {
                return Err(Failure::Interrupted);
            }
            // Before the servo, which ends when nobody takes what it gives.
            if receiver.is_over() || receiver.given_all.is_so() {
                return Err(Failure::Thread("the thread that receives setpoints"));
            }
            for other in others.iter_mut() {
                other.must_live()?;
            }
            if planner.is_done()? {
                return Ok(());
            }
            monitor.observe()?;
            if let Some(line) = monitor.resume_program_stop()? {
                self.progress
                    .note(&format!("line {line}: program stop; going on by itself"));
            }
            // Where somebody is named who answers, that one is waited for.
            if self.config.asks_for_tools()
                && let Some(line) = monitor.pass_tool_change()?
            {
                self.progress
                    .note(&format!("line {line}: tool change; going on by itself"));
            }
            self.progress.at(receiver.seen.line());
            std::thread::sleep(POLL);
        }
    }
}

/// Brings the machine to rest on the path, if there still is somebody who can.
fn rest(monitor: &mut Monitor<'_>) {
    let started = Instant::now();
    if monitor.observe().is_err() || monitor.rests() || monitor.abort().is_err() {
        return;
    }
    while started.elapsed() < PATIENCE && monitor.observe().is_ok() && !monitor.rests() {
        std::thread::sleep(POLL);
    }
}

/// The status after the end of the motion.
fn last_status(monitor: &mut Monitor<'_>) -> Result<Status, Failure> {
    let started = Instant::now();
    let after = monitor.status().map(|status| status.updated_ns);
    loop {
        monitor.observe()?;
        let newer = monitor
            .status()
            .filter(|status| Some(status.updated_ns) != after);
        if let Some(status) = newer {
            return Ok(*status);
        }
        if started.elapsed() > PATIENCE {
            return Err(Failure::Thread("the interpolator's status"));
        }
        std::thread::sleep(POLL);
    }
}
