//! `glidepath setup`: asks for a machine, and writes its configuration.

mod answers;
mod kind;
mod questions;
mod text;

use crate::cli::SetupArgs;
use crate::command::failure::Failure;
use crate::config;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::output;
use answers::{Answers, Home, Motors};
use questions::Questions;
use std::fs::File;
use std::io::{ErrorKind, Write as _};
use std::path::Path;

/// Asks, writes the configuration, and tells what comes next.
///
/// # Errors
/// The file is there, or cannot be written; the answers end before the questions, or make no machine.
pub(super) fn setup(args: &SetupArgs) -> Result<Exit, Failure> {
    let path = args.file.as_path();
    if path.exists() {
        return Err(is_there(path).into());
    }
    let questions = Questions::new(args.suggested);
    questions.say(
        "Enter takes the answer in brackets. Everything can be changed in the file afterwards.",
    );
    let answers = Answers::ask(&questions)?;
    let text = text::configuration(&answers);
    // What cannot be a machine is told before anything is written.
    config::parse(&path.display().to_string(), &text)?;
    let mut file = File::create_new(path).map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => is_there(path),
        _ => FileError::file("write", path)(error),
    })?;
    file.write_all(text.as_bytes())
        .map_err(FileError::file("write", path))?;
    output::result(&next(path, &answers));
    Ok(Exit::Done)
}

fn is_there(path: &Path) -> FileError {
    FileError::guarded(
        path,
        "it is there already; name another file, or move that one away".to_owned(),
    )
}

/// What comes next, up to the first jog.
fn next(path: &Path, answers: &Answers) -> String {
    let file = path.display();
    let mut steps = vec![
        format!("export GLIDEPATH_CONFIG={file}"),
        "glidepath interpolator --best-effort &        # the real-time side; without the option on a real machine".to_owned(),
    ];
    match answers.motors {
        Motors::Simulated => {}
        Motors::Ethercat => {
            steps.push("glidepath ethercat scan enp3s0 > drives.toml   # your interface; look through the file".to_owned());
            steps.push("glidepath ethercat --drives drives.toml &".to_owned());
        }
        Motors::Hal => steps.push("glidepath servo --hal &".to_owned()),
    }
    if answers.motors != Motors::Simulated {
        steps.push("glidepath enable".to_owned());
    }
    if answers.home != Home::Nothing {
        steps.push("glidepath home".to_owned());
    }
    steps.push(format!(
        "glidepath jog {}      # the first motion",
        first_jog(answers)
    ));
    steps.push("glidepath planner --listen &                   # takes programs".to_owned());
    steps.push(
        "glidepath live                                 # the page to run it with".to_owned(),
    );
    let list: String = steps.iter().map(|step| format!("  {step}\n")).collect();
    format!(
        "\nWritten: {file}. Look through it; its keys are explained by `glidepath config --explain`.\n\
         Next, one line after the other:\n\n{list}"
    )
}

/// A millimetre into the travel of the first axis, from where it stands.
fn first_jog(answers: &Answers) -> String {
    let first = answers.axes.first();
    let (letter, is_up) = first.map_or(('X', true), |axis| (axis.letter, axis.max > 0.0));
    format!("{letter}{}", if is_up { "1" } else { "-1" })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Cli;
    use clap::Parser as _;

    #[test]
    fn the_commands_that_come_next_are_commands() {
        for (motors, home) in [
            (Motors::Simulated, Home::Nothing),
            (Motors::Ethercat, Home::Switches),
            (Motors::Hal, Home::Drives),
        ] {
            let suggested = Answers::ask(&Questions::new(true)).unwrap();
            let answers = Answers {
                motors,
                home,
                ..suggested
            };
            let told = next(Path::new("machine.toml"), &answers);
            let commands = told.lines().filter(|line| line.starts_with("  glidepath "));
            for line in commands {
                let command = line.split(['#', '&', '>']).next().unwrap_or_default();
                let words = command.split_whitespace();
                assert!(Cli::try_parse_from(words).is_ok(), "{command}");
            }
        }
    }
}
