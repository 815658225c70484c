//! Commands that people are told to type: all that stand in texts of the code, and the examples of the
//! command line's own help. Each has to be one that the command line takes as it stands.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use clap::CommandFactory as _;
use glidepath::cli::Cli;
use glidepath::machine_options::MachineOptions;
use std::path::{Path, PathBuf};

/// Texts of no machine: those of tests.
fn is_of_tests(path: &Path) -> bool {
    path.components()
        .any(|part| part.as_os_str() == "tests" || part.as_os_str() == "tests.rs")
}

/// The sources of all crates, without tests.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") && !is_of_tests(&path) {
            found.push(path);
        }
    }
}

/// The code of a file as it is printed: without comments and tests, strings of several lines in one.
fn printed(text: &str) -> String {
    let code = text.split("#[cfg(test)]\nmod tests {").next();
    let lines = code.unwrap_or_default().lines();
    let code = lines.filter(|line| !line.trim_start().starts_with("//"));
    let code = code.fold(String::new(), |code, line| match line.strip_suffix('\\') {
        Some(part) => code + part.trim_start(),
        None => code + line.trim_start() + "\n",
    });
    code.replace("\\\"", "\"")
}

/// Words as a shell takes them, with quotes around those that have a space.
fn words(command: &str) -> Vec<String> {
    let command = command.replace('"', "'");
    let mut parts = command.split('\'');
    let mut words: Vec<String> = Vec::new();
    while let Some(plain) = parts.next() {
        words.extend(plain.split_whitespace().map(str::to_owned));
        words.extend(parts.next().map(str::to_owned));
    }
    words
}

/// Why the command line does not take a command, if it does not.
fn refused(command: &str) -> Option<String> {
    let parsed = Cli::command().try_get_matches_from(words(command));
    let error = parsed.err()?;
    // Help is taken, and tells as an error.
    (error.exit_code() != 0).then(|| format!("{command}: {error}"))
}

#[test]
fn commands_that_are_told_are_commands() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files = Vec::new();
    for krate in std::fs::read_dir(crates).expect("the crates") {
        let folder = krate.expect("a crate").path().join("src");
        if folder.is_dir() {
            sources(&folder, &mut files);
        }
    }
    let options = MachineOptions::new(Some(Path::new("a b.toml")), Some("mill"));
    let (mut count, mut wrong) = (0, Vec::new());
    for file in files {
        let text = printed(&std::fs::read_to_string(&file).expect("UTF-8"));
        let told = text.split('`').filter(|part| {
            // What is put together has its own test.
            part.starts_with("glidepath ") && !part.contains('{') && !part.contains('\n')
        });
        for command in told {
            count += 1;
            let whole = options.put_into(&format!("`{command}`"));
            for command in [command, whole.trim_matches('`')] {
                wrong.extend(refused(command).map(|why| format!("{}: {why}", file.display())));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 80, "{count}");
}

#[test]
fn commands_that_are_put_together_are_commands() {
    for (file, typed) in [
        ("part.ngc", "part.ngc"),
        ("/a b/part.ngc", "'/a b/part.ngc'"),
        ("a`b.ngc", "FILE"),
    ] {
        for command in ["run-file", "planner"] {
            let told = glidepath::machine_options::resume(command, file);
            assert_eq!(told, format!("`glidepath {command} {typed} --resume`"));
            assert_eq!(refused(told.trim_matches('`')), None);
        }
    }
}

#[test]
fn examples_of_the_help_are_commands() {
    let mut cli = Cli::command();
    cli.build();
    let mut wrong = Vec::new();
    let mut count = 0;
    let mut all = vec![&cli];
    while let Some(command) = all.pop() {
        all.extend(command.get_subcommands());
        let help = command.get_after_help().map(ToString::to_string);
        for example in help.unwrap_or_default().split(" · ") {
            // What goes before, and what a shell makes of the rest, is not ours.
            let Some(at) = example.find("glidepath ") else {
                continue;
            };
            let example = example[at..].split(['|', '>', '<', '&']).next();
            count += 1;
            wrong.extend(refused(example.unwrap_or_default().trim()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 60, "{count}");
}
