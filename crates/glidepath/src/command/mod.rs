//! The subcommands, one file each.

use crate::cli::Cli;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::output;

/// Does what the command line asks for, and prints its result.
#[must_use]
pub fn run(cli: &Cli) -> Exit {
    let basic = cli.command.basic();
    match crate::config::load(basic.config.as_deref()) {
        Ok(_) => output::failure(&Failure::NotBuilt, basic.json),
        Err(error) => output::failure(&error.into(), basic.json),
    }
}
