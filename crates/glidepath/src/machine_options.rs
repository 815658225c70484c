//! The options that name the machine, put into the commands that people are told.
//!
//! A text names a command by itself, as `glidepath reset`. Where the machine is not the built-in one
//! or its instance not the default, that command would reach another machine or none. So whoever
//! shows a text puts in what this process was started with.

use std::path::Path;
use std::sync::OnceLock;

/// Commands that work on a configuration alone.
const WITHOUT_INSTANCE: [&str; 7] = [
    "audit",
    "bench",
    "calibrate",
    "doctor",
    "fit",
    "jitter",
    "preview",
];
/// Commands that know no machine.
const WITHOUT_MACHINE: [&str; 3] = ["config", "help", "setup"];

/// The same of one that does something else.
const SCAN: &str = "ethercat scan";

static OWN: OnceLock<MachineOptions> = OnceLock::new();

/// The options that this process was given of its machine.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct MachineOptions {
    config: Option<String>,
    instance: Option<String>,
}

impl MachineOptions {
    /// The options as they were given.
    #[must_use]
    pub fn new(config: Option<&Path>, instance: Option<&str>) -> Self {
        Self {
            config: config.map(|file| file.display().to_string()),
            instance: instance.map(str::to_owned),
        }
    }

    /// A text with its commands as they have to be typed. What a command says already is left.
    #[must_use]
    pub fn put_into(&self, text: &str) -> String {
        const BEGIN: &str = "`glidepath ";
        let (mut told, mut rest) = (String::with_capacity(text.len()), text);
        while let Some(at) = rest.find(BEGIN) {
            let begin = at + BEGIN.len();
            let Some(length) = rest[begin..].find('`') else {
                break;
            };
            let (before, command) = (&rest[..begin], &rest[begin..begin + length]);
            told.push_str(before);
            told.push_str(command);
            told.push_str(&self.missing_in(command));
            rest = &rest[begin + length..];
        }
        told.push_str(rest);
        told
    }

    fn missing_in(&self, command: &str) -> String {
        let name = command.split_whitespace().next().unwrap_or_default();
        let has_machine = !WITHOUT_MACHINE.contains(&name) && !command.starts_with(SCAN);
        let has_instance = has_machine && !WITHOUT_INSTANCE.contains(&name);
        let options = [
            ("--instance", &self.instance, has_instance),
            ("--config", &self.config, has_machine),
        ];
        let missing = options.into_iter().filter(|(name, _, takes)| {
            *takes && !command.split_whitespace().any(|word| word == *name)
        });
        missing
            .filter_map(|(name, value, _)| Some(format!(" {name} {}", typed(value.as_deref()?))))
            .collect()
    }
}

/// The command that goes on with a program, in the marks that commands stand in.
#[must_use]
pub fn resume(command: &str, file: &str) -> String {
    // A mark in the name would end the command.
    let file = if file.contains('`') { "FILE" } else { file };
    format!("`glidepath {command} {} --resume`", typed(file))
}

/// A word as a shell takes it.
fn typed(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./+:,@%=".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// Keeps what this process was told, once.
pub fn keep(options: MachineOptions) {
    OWN.get_or_init(|| options);
}

/// A text with its commands as they have to be typed for the machine of this process.
#[must_use]
pub fn complete(text: &str) -> String {
    OWN.get()
        .map_or_else(|| text.to_owned(), |own| own.put_into(text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Cli;
    use clap::{CommandFactory as _, Parser as _};

    #[test]
    fn commands_that_are_told_name_the_machine() {
        let text = "clear it with `glidepath reset`, look at `glidepath doctor`, \
                    `glidepath config --check m.toml` and `glidepath status --instance b`";
        assert_eq!(MachineOptions::default().put_into(text), text);
        let options = MachineOptions::new(Some(Path::new("my mill.toml")), Some("a"));
        assert_eq!(
            options.put_into(text),
            "clear it with `glidepath reset --instance a --config 'my mill.toml'`, look at \
             `glidepath doctor --config 'my mill.toml'`, `glidepath config --check m.toml` and \
             `glidepath status --instance b --config 'my mill.toml'`"
        );
        let once = options.put_into(text);
        assert_eq!(options.put_into(&once), once, "nothing is put in twice");
        assert_eq!(
            options.put_into("an open `glidepath reset"),
            "an open `glidepath reset"
        );
    }

    #[test]
    fn what_is_kept_is_of_the_machine_that_was_asked() {
        for words in [
            &["show"][..],
            &["adopt"],
            &["recover"],
            &["use", "G55"],
            &["set", "G55", "X1"],
            &["export", "--linear-units", "mm"],
            &["import", "a.var", "--linear-units", "mm"],
        ] {
            let line = [&["glidepath", "offsets"], words, &["--instance", "b"]].concat();
            let cli = Cli::try_parse_from(line);
            let instance = cli.as_ref().map(|cli| cli.command.instance());
            assert!(matches!(instance, Ok(Some("b"))), "{words:?}");
        }
        let options = MachineOptions::new(None, Some("b"));
        assert_eq!(
            options.put_into("`glidepath abort`, `glidepath offsets recover`"),
            "`glidepath abort --instance b`, `glidepath offsets recover --instance b`"
        );
    }

    #[test]
    fn commands_take_the_options_that_are_put_in() {
        let mut cli = Cli::command();
        cli.build();
        for command in cli.get_subcommands() {
            let name = command.get_name();
            let takes = |option: &str| {
                let of = |command: &clap::Command| {
                    command.get_arguments().any(|it| it.get_id() == option)
                };
                of(command) || command.get_subcommands().any(of)
            };
            let has_machine = !WITHOUT_MACHINE.contains(&name);
            assert_eq!(takes("config"), has_machine, "{name}");
            let has_instance = has_machine && !WITHOUT_INSTANCE.contains(&name);
            assert_eq!(takes("instance"), has_instance, "{name}");
        }
    }
}
