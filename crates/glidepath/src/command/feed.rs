//! `glidepath feed`: a client of a listening planner.

use super::session;
use crate::cli::FeedArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::interrupt::Interrupt;
use crate::output;
use crate::report::counted;
use glidepath_planner::{Control, FeedError, FileSource, Notice, feed as stream};
use glidepath_realtime::{Clock as _, Monotonic};
use serde_json::json;

/// Streams a program, and waits until it is executed.
///
/// # Errors
/// The program is rejected, nobody listens, or the motion ended before the program did.
pub(super) fn feed(args: &FeedArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let asked_ns = Monotonic.now_ns();
    std::fs::File::open(args.file.path()).map_err(FileError::open(args.file.name()))?;
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let transport = session::join(&args.instance, config)?;
    let mut notify = |_: &Notice<'_>| {};
    let mut control = Control {
        stop: interrupt.flag(),
        pause: &mut std::thread::sleep,
        notify: &mut notify,
    };
    let name = args.file.name().display().to_string();
    let open = |start| {
        FileSource::open(
            args.file.path(),
            config.program_options(start),
            &config.settings(),
        )
    };
    let fed = stream(&transport, asked_ns, open, &mut control).map_err(|error| match error {
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
