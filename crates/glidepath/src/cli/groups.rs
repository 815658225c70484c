//! The list of commands that `--help` shows, in groups: what belongs to one task stands together.

use super::Cli;
use clap::{Command, CommandFactory as _};
use std::fmt::Write as _;

/// Headings, and the commands below each. Every command is in one group.
const GROUPS: [(&str, &[&str]); 6] = [
    (
        "Programs, without a machine",
        &["check", "plan", "run", "audit", "fit", "preview"],
    ),
    (
        "Work on a machine",
        &[
            "run-file",
            "mdi",
            "status",
            "hold",
            "resume",
            "abort",
            "override",
            "acknowledge",
            "step",
            "single-block",
            "stop-at-block-end",
            "reverse",
            "forward",
            "return",
            "live",
            "grbl",
        ],
    ),
    (
        "Set a machine up",
        &[
            "enable",
            "disable",
            "reset",
            "home",
            "unhome",
            "set-position",
            "jog",
            "offsets",
        ],
    ),
    (
        "Processes of a machine",
        &["interpolator", "planner", "servo", "ethercat", "feed"],
    ),
    (
        "Recordings and reports",
        &["record", "replay", "telemetry", "mirror"],
    ),
    (
        "Configuration and host",
        &["setup", "config", "calibrate", "doctor", "jitter", "bench"],
    ),
];

const WIDTH: usize = 18;

/// The command line with its commands in groups.
#[must_use]
pub fn grouped() -> Command {
    let command = Cli::command();
    let list = list(&command);
    command.help_template(format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{list}Options:\n{{options}}{{after-help}}"
    ))
}

fn list(command: &Command) -> String {
    let mut text = String::new();
    for (heading, names) in GROUPS {
        let _ = writeln!(text, "{heading}:");
        for name in names {
            let found = command.find_subcommand(name);
            let about = found.and_then(Command::get_about);
            let about = about.map(ToString::to_string).unwrap_or_default();
            let _ = writeln!(text, "  {name:WIDTH$} {about}");
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_command_is_in_one_group() {
        let grouped: Vec<&str> = GROUPS
            .iter()
            .flat_map(|(_, names)| *names)
            .copied()
            .collect();
        let once: BTreeSet<&str> = grouped.iter().copied().collect();
        assert_eq!(once.len(), grouped.len(), "a command is in two groups");
        let cli = Cli::command();
        let all: BTreeSet<&str> = cli.get_subcommands().map(Command::get_name).collect();
        assert_eq!(once, all);
    }

    #[test]
    fn help_shows_the_groups() {
        let help = grouped().render_help().to_string();
        let (before, after) = help.split_once("Set a machine up:").unwrap();
        assert!(before.contains("run-file") && after.contains("  home"));
        assert!(help.contains("\nUsage: glidepath <COMMAND>\n"), "{help}");
        assert!(help.contains("\n  -h, --help") && help.contains("\nExit codes: "));
    }
}
