//! `glidepath servo`: a servo stack. It takes setpoints, plays them on a simulated machine, or on
//! LinuxCNC's HAL, and sends its feedback.

mod desk;
mod hal;
mod notices;
mod part;
mod settings;
mod silence;

pub(super) use desk::begins;
pub(super) use settings::{best_effort_patience_ns, settings};

use super::run::Farewell;
use super::session;
use crate::cli::ServoArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::interrupt::{Interrupt, end_with};
use crate::output;
use crate::recording::Recording;
use crate::report::{counted, grouped};
use crate::sample::TickSample;
use desk::Told;
use glidepath_hal::HalCounts;
use glidepath_link::Setpoint;
use glidepath_link::servo::ServoCounts;
use serde_json::json;
use std::io::{BufWriter, Write};

/// Receives until asked to end.
///
/// # Errors
/// The link or HAL cannot be used, or a file cannot be written.
pub(super) fn servo(args: &ServoArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    end_with(args.end_with).map_err(Failure::Signals)?;
    // Drives that are kept from their setpoints for three periods stop. Where it is not allowed, they are as patient as
    // an ordinary process can be.
    let _may_not = glidepath_realtime::take_precedence();
    if args.relay {
        return relay(args, config, &interrupt);
    }
    let guard = session::guard(None, &args.basic, config, args.overwrite);
    let mut recording = Recording::create(config, args.setpoints.as_deref(), None, &guard)?;
    let period_t = config.period_t();
    let mut take = |setpoint: &Setpoint| {
        recording.push(&TickSample::received(setpoint, period_t))?;
        Ok(true)
    };
    let (counts, hal) = if args.hal.hal {
        let (counts, hal) = hal::play(args, config, &interrupt, take)?;
        (counts, Some(hal))
    } else {
        let counts = desk::play(args, config, &interrupt, |told| match told {
            Told::Setpoint(setpoint) => take(setpoint),
            Told::Stopped(_) => Ok(true),
        })?;
        (counts, None)
    };
    recording.finish("", "")?;
    report(args, &counts, hal.as_ref());
    Ok(interrupt.exit())
}

fn report(args: &ServoArgs, counts: &ServoCounts, hal: Option<&HalCounts>) {
    if args.basic.json {
        let mut object = json!({
            "received": counts.received,
            "lost_setpoints": counts.lost,
            "late_setpoints": counts.late,
            "duplicates": counts.duplicates,
            "refused": counts.refused,
            "restarts": counts.restarts,
            "own_stops": counts.stops,
            "setpoints": args.setpoints,
        });
        if let Some(hal) = hal {
            object["hal"] = json!({
                "lines": hal.lines,
                "rows": hal.rows,
                "lost_rows": hal.lost_rows,
                "underruns": hal.underruns,
                "recentred": hal.recentred,
            });
        }
        output::object(&object);
        return;
    }
    output::result(&format!(
        "servo: {}, {} lost, {} late, {} of the interpolator, {}\n",
        counted(counts.received, "setpoint"),
        grouped(counts.lost),
        grouped(counts.late),
        counted(counts.restarts, "restart"),
        counted(counts.stops, "own stop")
    ));
    if let Some(hal) = hal {
        output::result(&format!(
            "HAL: {} lines, {} rows, {} lost, {} periods without a line\n",
            grouped(hal.lines),
            grouped(hal.rows),
            grouped(hal.lost_rows),
            grouped(hal.underruns)
        ));
    }
}

/// Passes every setpoint on, as it is in memory, until the reader goes away or the servo stops by itself:
/// nothing is played behind that. Whoever reads is told so at once, by the end of the pipe; the drives
/// answer until the process is asked to end.
fn relay(args: &ServoArgs, config: &MachineConfig, interrupt: &Interrupt) -> Result<Exit, Failure> {
    let mut out = Some(BufWriter::new(std::io::stdout().lock()));
    let mut farewell = Farewell::default();
    desk::play(args, config, interrupt, |told| {
        let Some(pipe) = &mut out else {
            return Ok(true);
        };
        match told {
            Told::Setpoint(setpoint) => {
                let written = pipe.write_all(bytemuck::bytes_of(setpoint));
                Ok(written.and_then(|()| pipe.flush()).is_ok())
            }
            Told::Stopped(why) => {
                (farewell.own_stops, farewell.first_stop) = (1, Some(why.to_owned()));
                say(&farewell, pipe);
                out = None;
                end_output().map_err(Failure::Process)?;
                Ok(true)
            }
        }
    })?;
    if let Some(mut pipe) = out {
        say(&farewell, &mut pipe);
    }
    Ok(interrupt.exit())
}

fn say(farewell: &Farewell, pipe: &mut impl Write) {
    // Nobody is left to tell where the reader went away.
    let _ = pipe.write_all(&farewell.to_bytes());
    let _ = pipe.flush();
}

/// Ends standard output: who reads it is at its end.
fn end_output() -> std::io::Result<()> {
    let nowhere = std::fs::OpenOptions::new().write(true).open("/dev/null")?;
    Ok(rustix::stdio::dup2_stdout(nowhere)?)
}
