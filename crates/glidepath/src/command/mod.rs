//! The subcommands, one file each.

pub mod check;
pub mod plan;

use crate::cli::{Cli, Command};
use crate::config;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::output;

/// Does what the command line asks for, and prints its result.
#[must_use]
pub fn run(cli: &Cli) -> Exit {
    let basic = cli.command.basic();
    dispatch(&cli.command).unwrap_or_else(|failure| output::failure(&failure, basic.json))
}

fn dispatch(command: &Command) -> Result<Exit, Failure> {
    let config = config::load(command.basic().config.as_deref())?;
    match command {
        Command::Check(args) => check::check(args, &config),
        Command::Plan(args) => plan::plan(args, &config),
        _ => Err(Failure::NotBuilt),
    }
}
