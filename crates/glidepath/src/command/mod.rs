//! The subcommands, one file each.

use crate::cli::{Cli, Command};
use crate::exit::Exit;

/// Does what the command line asks for, and prints its result.
#[must_use]
pub fn run(cli: Cli) -> Exit {
    match cli.command {
        _ => Exit::Done,
    }
}
