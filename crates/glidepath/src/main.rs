//! The `glidepath` command.

use clap::FromArgMatches as _;
use glidepath::cli::{self, Cli};
use glidepath::{command, interrupt};
use std::process::ExitCode;
use std::thread;

/// Stack of the thread that does the work. That of the first thread is what the host leaves it
/// (`ulimit -s`), which can be too little for a machine that is to move.
const STACK_BYTES: usize = 4 << 20;

fn main() -> ExitCode {
    let worker = thread::Builder::new()
        .name("glidepath".into())
        .stack_size(STACK_BYTES)
        .spawn(work);
    match worker {
        // A panic has been told of already.
        Ok(worker) => worker
            .join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
        Err(_) => work(),
    }
}

fn work() -> ExitCode {
    // One that cannot be handled ends this process as ever.
    let _ = interrupt::survive_limits_of_files();
    let mut line = cli::grouped();
    let told = line.try_get_matches_from_mut(std::env::args_os());
    match told.and_then(|told| Cli::from_arg_matches(&told).map_err(|e| e.format(&mut line))) {
        Ok(cli) => command::main(&cli),
        Err(error) => command::usage(&error),
    }
    .into()
}
