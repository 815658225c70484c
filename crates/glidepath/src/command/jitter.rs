//! `glidepath jitter`: the measurement of how late the real-time loop wakes on this host.

use super::{interpolator, session};
use crate::cli::JitterArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use crate::jitter::{JitterReport, LoadMotion, Setup, measure};
use crate::output;
use crate::output_file::{self, OutputKind};
use crate::progress::ProgressDisplay;
use glidepath_realtime::{Item, Mode};

/// Measures, reports and draws. An interrupted measurement is reported as far as it went.
///
/// # Errors
/// The host refuses real time, cyclictest does not run, a thread cannot be started, or the plot cannot be written.
pub(super) fn jitter(args: &JitterArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let setup = setup(args, config)?;
    let progress = ProgressDisplay::seconds(setup.seconds.into());
    progress.doing("measuring");
    let measured = measure(&setup, &progress, interrupt.flag())?;
    progress.finish();
    for refusal in measured.grants.refusals() {
        output::note(&format!("not granted: {refusal}"));
    }
    if args.against_cyclictest && !measured.grants.is_granted(Item::Scheduling) {
        output::note("cyclictest was left out: it does not run without SCHED_FIFO");
    }
    let report = JitterReport::new(&setup, &measured);
    if let Some(path) = &args.plot {
        let guard = session::guard(None, &args.basic, config, args.overwrite);
        output_file::write(path, OutputKind::Plot, &guard, &report.plot())?;
    }
    if args.basic.json {
        output::object(&report.object());
    } else {
        output::result(&report.text());
    }
    if interrupt.is_set() {
        return Ok(Exit::Interrupted);
    }
    Ok(Exit::Done)
}

fn setup(args: &JitterArgs, config: &MachineConfig) -> Result<Setup, Failure> {
    let mut config = config.clone();
    let interpolator = &mut config.interpolator;
    interpolator.period_us = args.period_us.unwrap_or(interpolator.period_us);
    interpolator.priority = args.priority.unwrap_or(interpolator.priority);
    interpolator.cpu = args.cpu.or(interpolator.cpu);
    // What the thread does in a period does not depend on what it is granted.
    let settings = interpolator::settings(&config, true);
    let motion = args
        .full_tick
        .then(|| LoadMotion::plan(&config, settings))
        .transpose()?;
    let mode = if args.best_effort {
        Mode::BestEffort
    } else {
        Mode::Strict
    };
    Ok(Setup {
        period_ns: config.period_ns(),
        seconds: args.seconds,
        request: settings.real_time.request,
        mode,
        motion,
        against_cyclictest: args.against_cyclictest,
    })
}
