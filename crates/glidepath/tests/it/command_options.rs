//! Tests that options that several commands share have an effect with each command that takes them: where a
//! command gives them to nobody, they would be taken and forgotten.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use clap::{Arg, Command, CommandFactory as _, Parser as _};
use glidepath::cli::Cli;

/// A command line of a command with all that it wants.
fn least(command: &Command) -> Vec<String> {
    let value = |arg: &Arg| {
        let known = arg.get_possible_values();
        let first = known.first().map(|value| value.get_name().to_owned());
        first.unwrap_or_else(|| "0".to_owned())
    };
    let mut words = vec!["glidepath".to_owned(), command.get_name().to_owned()];
    for arg in command.get_arguments().filter(|arg| arg.is_required_set()) {
        words.extend(arg.get_long().map(|name| format!("--{name}")));
        words.push(value(arg));
    }
    words
}

#[test]
fn shared_options_are_not_forgotten() {
    let mut cli = Cli::command();
    cli.build();
    let mut seen = [0; 2];
    for command in cli.get_subcommands() {
        let takes = |name: &str| command.get_arguments().any(|arg| arg.get_id() == name);
        if !takes("effort") && !takes("dialect") {
            continue;
        }
        let words = least(command);
        // A file that is wanted unless something else is said.
        let with_file = words.iter().cloned().chain(["0".to_owned()]);
        let parsed = Cli::try_parse_from(&words).or_else(|_| Cli::try_parse_from(with_file));
        let parsed = parsed.expect("all that it wants").command;
        let name = command.get_name();
        assert_eq!(parsed.path().is_some(), takes("effort"), "{name}: `path`");
        assert_eq!(
            parsed.program().is_some(),
            takes("dialect"),
            "{name}: `program`"
        );
        seen[0] += usize::from(takes("effort"));
        seen[1] += usize::from(takes("dialect"));
    }
    assert!(seen.iter().all(|count| *count > 5), "{seen:?}");
}
