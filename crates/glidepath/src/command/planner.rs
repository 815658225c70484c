//! `glidepath planner`: programs, or segments of other processes, to frames.

use super::session;
use crate::cli::PlannerArgs;
use crate::clock;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::interrupt::{Interrupt, end_with};
use crate::joints;
use crate::output;
use crate::report::{grouped, peak_rss_bytes, seconds, state_name};
use glidepath_geometry::AxisVector;
use glidepath_link::{Ipc, Transport};
use glidepath_planner::{
    Control, FileSource, ItemSource, Listening, Notice, PipeSource, Pipeline, Publisher, Refusal,
    Remainder, RunError, SoftLimits, Statistics, listen,
};
use serde_json::{Value, json};

/// Plans and publishes until the motion is executed, or, with `--listen`, until asked to end.
///
/// # Errors
/// The program is rejected, the motion was aborted or stopped by a fault, or the link failed.
pub(super) fn planner(args: &PlannerArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    end_with(args.end_with).map_err(Failure::Signals)?;
    let transport = session::join(&args.instance, config)?;
    let quiet = args.end_with.is_some();
    let mut notify = |notice: &Notice<'_>| tell(notice, quiet);
    let mut control = Control {
        stop: interrupt.flag(),
        pause: &mut std::thread::sleep,
        notify: &mut notify,
    };
    let Some(file) = &args.file else {
        let exit = serve(&transport, config, &mut control, &interrupt)?;
        if args.basic.json {
            output::object(&json!({ "listened": true, "exit_code": exit as u8 }));
        }
        return Ok(exit);
    };
    let name = file.name().display().to_string();
    let statistics = if file.is_standard_input() {
        if args.resume {
            return Err(Failure::ResumePipe);
        }
        if !quiet {
            output::note(
                "planner: reading standard input; the machine waits on the path where no more has come",
            );
        }
        run(&transport, config, &mut control, &name, true, |start| {
            PipeSource::spawn(std::io::stdin(), config.program_options(start))
        })
    } else {
        // A file that does not exist is told at once, not when the machine is ready.
        let file = file.path();
        std::fs::File::open(file).map_err(FileError::open(file))?;
        let open = |start| {
            joints::check_plan(file, config, start, &mut |_| {})?;
            FileSource::open(file, config.program_options(start), &config.settings())
        };
        if args.resume {
            resume(&transport, config, &mut control, &name, open)
        } else {
            run(&transport, config, &mut control, &name, false, open)
        }
    }?;
    if args.basic.json {
        output::object(&object(&name, &statistics));
    } else {
        output::result(&text(&name, &statistics));
    }
    Ok(Exit::Done)
}

/// One program, from where the machine stands.
fn run<S: ItemSource + Send>(
    transport: &Ipc,
    config: &MachineConfig,
    control: &mut Control<'_>,
    name: &str,
    is_pipe: bool,
    open: impl FnOnce(AxisVector) -> Result<S, Refusal>,
) -> Result<Statistics, Failure> {
    let mut publisher = Publisher::connect(transport, session::pace(config))?;
    let start = publisher.wait_until_ready(control)?;
    let source = open(start).map_err(|refusal| Failure::refused(name, refusal, false))?;
    let mut pipeline = Pipeline::new(source, config.settings(), start)
        .with_joints(config.path_caps())
        .with_clock(clock::elapsed);
    publisher
        .publish(&mut pipeline, control)
        .map_err(|error| match error {
            RunError::Refused(refusal) => Failure::refused(name, refusal, is_pipe),
            error => error.into(),
        })
}

/// The rest of a program, from where the machine stands on its path.
fn resume<S: ItemSource + Send>(
    transport: &Ipc,
    config: &MachineConfig,
    control: &mut Control<'_>,
    name: &str,
    open: impl FnOnce(AxisVector) -> Result<S, Refusal>,
) -> Result<Statistics, Failure> {
    let mut publisher = Publisher::connect(transport, session::pace(config))?;
    let point = publisher.wait_until_left(control)?;
    let source =
        open(point.program_start).map_err(|refusal| Failure::refused(name, refusal, false))?;
    let settings = config.settings();
    let remainder = Remainder::find(source, point, settings.tolerance_mm)?;
    // Only now is a fault reset: one that resumes nothing leaves it to whoever looks at it.
    publisher.wait_until_ready(control)?;
    let mut pipeline = Pipeline::resuming(remainder, settings)
        .with_joints(config.path_caps())
        .with_clock(clock::elapsed);
    Ok(publisher.publish(&mut pipeline, control)?)
}

/// Streams, until asked to end.
fn serve(
    transport: &dyn Transport,
    config: &MachineConfig,
    control: &mut Control<'_>,
    interrupt: &Interrupt,
) -> Result<Exit, Failure> {
    let (low, high) = config.travel();
    let listening = Listening {
        settings: config.settings(),
        joints: config.path_caps(),
        pace: session::pace(config),
        limits: Some(SoftLimits { low, high }),
    };
    match listen(transport, &listening, control) {
        Ok(()) | Err(RunError::Interrupted) => Ok(interrupt.exit()),
        Err(error) => Err(error.into()),
    }
}

fn tell(notice: &Notice<'_>, quiet: bool) {
    let words = match notice {
        Notice::NoInterpolator => "waiting for an interpolator".to_owned(),
        Notice::NotReady(state) => {
            format!("waiting: the machine is {}", state_name(*state))
        }
        Notice::FaultReset => "reset the fault of a planner that died".to_owned(),
        Notice::Listening => "waiting for a client".to_owned(),
        Notice::StreamOpened { session } => format!("stream {session} opened"),
        Notice::StreamExecuted(statistics) => {
            format!("executed: {} segments", grouped(statistics.segments))
        }
        Notice::StreamBroken(error) => format!("the stream broke off: {error}"),
        Notice::Started { epoch } => format!("epoch {epoch} starts"),
        Notice::Progress(_) => return,
    };
    if !quiet {
        output::note(&format!("planner: {words}"));
    }
}

fn object(program: &str, statistics: &Statistics) -> Value {
    let plan_wall_s = statistics.planning.as_secs_f64();
    json!({
        "program": program,
        "lines": statistics.lines,
        "segments": statistics.segments,
        "samples": statistics.frames,
        "plan_wall_s": plan_wall_s,
        "peak_rss_bytes": peak_rss_bytes(),
    })
}

fn text(program: &str, statistics: &Statistics) -> String {
    format!(
        "{program}: executed; {} lines, {} segments, {} frames, planned in {}\n",
        grouped(statistics.lines),
        grouped(statistics.segments),
        grouped(statistics.frames),
        seconds(statistics.planning.as_secs_f64())
    )
}
