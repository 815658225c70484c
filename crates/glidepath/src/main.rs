//! The `glidepath` command.

use clap::Parser as _;
use glidepath::{cli::Cli, command};
use std::process::ExitCode;

fn main() -> ExitCode {
    match Cli::try_parse() {
        Ok(cli) => command::main(&cli),
        Err(error) => command::usage(&error),
    }
    .into()
}
