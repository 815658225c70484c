//! `glidepath feed`: a client of a listening planner.

use super::attention::Waiting;
use super::{jobs, session};
use crate::cli::FeedArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::interrupt::Interrupt;
use crate::output;
use crate::report::counted;
use glidepath_planner::{Control, FeedError, Feeding, FileSource, Notice, feed as stream};
use serde_json::json;

/// Streams a program that was asked for at `asked_ns`, ns of the host's steady clock, and waits until it is executed. An
/// interrupt ends the motion.
///
/// # Errors
/// The program is rejected, nobody listens, or the motion ended before the program did.
pub(super) fn feed(
    args: &FeedArgs,
    config: &MachineConfig,
    asked_ns: u64,
) -> Result<Exit, Failure> {
    std::fs::File::open(args.file.path()).map_err(FileError::open(args.file.name()))?;
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let transport = session::join(&args.instance, config)?;
    let mut waiting = Waiting::new(Some((&transport, config)));
    let mut pause = |time| waiting.pause_for_interpolator(time);
    let mut notify = |_: &Notice<'_>| {};
    let mut control = Control {
        stop: interrupt.flag(),
        pause: &mut pause,
        notify: &mut notify,
    };
    let name = args.file.name().display().to_string();
    let open = |start, watch| {
        let mut config = config.clone();
        config.program.watch = Some(watch);
        let options = config.program_options(start);
        FileSource::open(args.file.path(), options, &config.settings())
    };
    let link = session::link(&session::instance(&args.instance, config), config);
    let mut feeding = Feeding {
        asked_ns,
        abort: &mut || jobs::abort(&link),
    };
    let fed =
        stream(&transport, &mut feeding, open, &mut control).map_err(|error| match error {
            FeedError::Refused(refusal) => Failure::refused(&name, refusal, false),
            error => error.into(),
        })?;
    if args.basic.json {
        output::object(&json!({ "program": name, "lines": fed.lines, "items": fed.items }));
    } else {
        output::result(&format!(
            "{name}: executed; {}, {}\n",
            counted(fed.lines, "line"),
            counted(fed.items, "item")
        ));
    }
    Ok(Exit::Done)
}
