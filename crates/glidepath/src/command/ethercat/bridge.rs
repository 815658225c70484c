//! The bridge from setpoints to drives, and back.

use crate::cli::EthercatArgs;
use crate::command::failure::Failure;
use crate::command::{servo, session};
use crate::config::MachineConfig;
use crate::drives::{self, DrivesSource};
use crate::exit::Exit;
use crate::interrupt::{Interrupt, end_with};
use crate::output;
use crate::report::grouped;
use glidepath_ethercat::{
    Counts, Demand, Listeners, PacketWire, RunError, RunSettings, Settings, Wire, run,
};
use glidepath_link::{Ipc, Transport};
use glidepath_realtime::{Histogram, Mode, Request};
use serde_json::{Value, json};

/// Drives what `drives.toml` says.
///
/// # Errors
/// The interface, the bus or shared memory cannot be used.
pub(super) fn drive(args: &EthercatArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    if !config.feedback.is_expected {
        return Err(Failure::NoFeedback);
    }
    let file = args
        .drives
        .as_deref()
        .unwrap_or_else(|| "drives.toml".as_ref());
    let drives = drives::load(file, config)?;
    let needed_ns = 2 * config.period_ns()
        + drives.bus.delay_ns
        + u64::from(drives.bus.lost_frames + 1) * drives.bus.period_ns;
    // To the tenth of a millisecond above, as a person writes it.
    let needed_ns = needed_ns.next_multiple_of(100_000);
    let needed_t = core::time::Duration::from_nanos(needed_ns).as_secs_f64();
    let stale_t = config.feedback.stale_t.unwrap_or(3.0 * config.period_t());
    if stale_t < needed_t {
        return Err(Failure::Stale { stale_t, needed_t });
    }
    let settings = Settings {
        bus: drives.bus,
        drives: drives.drives,
        drive_inputs: drives.drive_inputs,
        terminals: drives.terminals,
        servo: servo::settings(config),
    };
    let mut wire = PacketWire::open_alone(&drives.interface)?;
    let interrupt = interrupt(args)?;
    let counts = bridge(args, config, &mut wire, &settings, &interrupt, None)
        .map_err(|failure| in_file(failure, &drives.source))?;
    report(args, &counts);
    Ok(interrupt.exit())
}

/// What the bus refuses of a file is something to mend there.
pub(super) fn in_file(failure: Failure, source: &DrivesSource) -> Failure {
    let refusal = match &failure {
        Failure::Bus(RunError::Bus(error)) => source.refusal(error),
        _ => None,
    };
    refusal.map_or(failure, Failure::Configuration)
}

/// Ends with Ctrl-C, or with the process that started this one.
pub(super) fn interrupt(args: &EthercatArgs) -> Result<Interrupt, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    end_with(args.end_with).map_err(Failure::Signals)?;
    Ok(interrupt)
}

/// Runs until interrupted.
pub(super) fn bridge<W: Wire + Send>(
    args: &EthercatArgs,
    config: &MachineConfig,
    wire: &mut W,
    settings: &Settings,
    interrupt: &Interrupt,
    demands: Option<&mut dyn FnMut(Demand)>,
) -> Result<Counts, Failure> {
    let link = session::link(&session::instance(&args.instance, config), config);
    let transport = move || Ok(Box::new(Ipc::connect(&link)?) as Box<dyn Transport>);
    let request = Request {
        priority: Some(i32::from(args.priority)),
        cpu: args.cpu,
        lock_memory: true,
        prefault_stack: true,
        hold_cpu_awake: true,
    };
    let mode = if args.best_effort {
        Mode::BestEffort
    } else {
        Mode::Strict
    };
    let quiet = args.end_with.is_some();
    let mut log = |line: &str| {
        if !quiet {
            output::note(&format!("ethercat: {line}"));
        }
    };
    let listeners = Listeners {
        log: &mut log,
        demands,
    };
    let how = RunSettings { request, mode };
    Ok(run(
        wire,
        settings,
        how,
        transport,
        interrupt.flag(),
        listeners,
    )?)
}

fn quantiles(histogram: &Histogram) -> Value {
    let found = histogram.quantiles();
    #[allow(clippy::cast_precision_loss, reason = "a report")]
    let us = |ns: u64| ns as f64 / 1e3;
    json!({
        "p50": us(found.p50_ns),
        "p99": us(found.p99_ns),
        "max": us(found.max_ns),
    })
}

/// What the cycles came to.
pub(super) fn report(args: &EthercatArgs, counts: &Counts) {
    if args.basic.json {
        output::object(&json!({
            "cycles": counts.cycles,
            "lost_frames": counts.lost,
            "bad_working_counters": counts.short,
            "late_frames": counts.stale,
            "missed_cycles": counts.missed,
            "coasted_cycles": counts.coasts,
            "bus_restarts": counts.restarts,
            "quartz_ppm": counts.quartz * 1e6,
            "lateness_us": quantiles(&counts.lateness),
            "round_trip_us": quantiles(&counts.round_trip),
        }));
        return;
    }
    #[allow(clippy::cast_precision_loss, reason = "a report")]
    let us = |ns: u64| ns as f64 / 1e3;
    let (late, trip) = (counts.lateness.quantiles(), counts.round_trip.quantiles());
    output::result(&format!(
        "ethercat: {} cycles, {} frames lost, {} bad working counters, {} cycles missed, {} restarts \
         of the bus\n  sent late     p50 {:.0} µs, p99 {:.0} µs, max {:.0} µs\n  round trip    p50 \
         {:.0} µs, p99 {:.0} µs, max {:.0} µs\n",
        grouped(counts.cycles),
        counts.lost,
        counts.short,
        counts.missed,
        counts.restarts,
        us(late.p50_ns),
        us(late.p99_ns),
        us(late.max_ns),
        us(trip.p50_ns),
        us(trip.p99_ns),
        us(trip.max_ns),
    ));
}
