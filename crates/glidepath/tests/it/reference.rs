//! Tests of man pages, completions, and the manual's pages of commands and keys: made from the
//! code, and held against the files. `GLIDEPATH_BLESS=1 cargo test -p glidepath --test it
//! reference` writes them.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use clap::{Arg, Command, CommandFactory as _};
use clap_complete::Shell;
use glidepath::cli::Cli;
use glidepath::config::{self, keys};
use glidepath_link::{AtRest, CommandRefusal, FaultCause, MachineState, UnmetPrecondition};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Files by their place in the repository.
type Files = BTreeMap<PathBuf, String>;

fn cli() -> Command {
    let mut command = Cli::command();
    command.build();
    command
}

fn completions() -> Files {
    let shells = [
        (Shell::Bash, "glidepath.bash"),
        (Shell::Zsh, "_glidepath"),
        (Shell::Fish, "glidepath.fish"),
    ];
    let made = shells.map(|(shell, name)| {
        let mut text = Vec::new();
        clap_complete::generate(shell, &mut Cli::command(), "glidepath", &mut text);
        let text = String::from_utf8(text).expect("UTF-8");
        (Path::new("deploy/completions").join(name), text)
    });
    made.into_iter().collect()
}

fn man_pages() -> Files {
    let folder = tempfile::tempdir().expect("a folder");
    clap_mangen::generate_to(Cli::command(), folder.path()).expect("pages");
    let pages = std::fs::read_dir(folder.path()).expect("a folder");
    let pages = pages.map(|page| {
        let page = page.expect("a page");
        let text = std::fs::read_to_string(page.path()).expect("UTF-8");
        (Path::new("deploy/man").join(page.file_name()), text)
    });
    pages.collect()
}

/// Options of a table are on one line, and a bar would end a column.
fn cell(text: &str) -> String {
    text.replace('\n', " ").replace('|', "\\|")
}

fn signature(argument: &Arg) -> String {
    let values: Vec<String> = argument
        .get_value_names()
        .unwrap_or_default()
        .iter()
        .map(ToString::to_string)
        .collect();
    let takes = argument.get_action().takes_values();
    match (argument.get_long(), argument.get_short()) {
        (Some(long), _) if takes => format!("`--{long} {}`", values.join(" ")),
        (Some(long), Some(short)) => format!("`--{long}`, `-{short}`"),
        (Some(long), None) => format!("`--{long}`"),
        (None, _) => format!("`{}`", values.join(" ")),
    }
}

fn row(argument: &Arg) -> String {
    let mut says = argument
        .get_help()
        .map(ToString::to_string)
        .unwrap_or_default();
    let names = argument.get_possible_values();
    if !names.is_empty() && argument.get_action().takes_values() {
        let names: Vec<String> = names
            .iter()
            .map(|v| format!("`{}`", v.get_name()))
            .collect();
        let _ = write!(says, " ({})", names.join(", "));
    }
    let default: Vec<_> = argument.get_default_values().iter().collect();
    if let [default] = default.as_slice()
        && argument.get_action().takes_values()
    {
        let _ = write!(says, "; default {}", default.to_string_lossy());
    }
    format!("| {} | {} |\n", cell(&signature(argument)), cell(&says))
}

fn put_command(name: &str, command: &Command, text: &mut String) {
    let about = command
        .get_about()
        .map(ToString::to_string)
        .unwrap_or_default();
    let _ = write!(text, "\n## {name}\n\n{about}.\n");
    let examples = command
        .get_after_help()
        .map(ToString::to_string)
        .unwrap_or_default();
    if let Some((_, examples)) = examples.split_once(": ") {
        let examples: Vec<String> = examples
            .split(" · ")
            .map(|e| format!("`{}`", e.trim()))
            .collect();
        let _ = write!(text, "\n{}\n", examples.join(" · "));
    }
    let arguments: Vec<&Arg> = command
        .get_arguments()
        .filter(|argument| !argument.is_hide_set() && argument.get_id() != "help")
        .collect();
    if !arguments.is_empty() {
        text.push_str("\n| | |\n|---|---|\n");
        arguments
            .iter()
            .for_each(|argument| text.push_str(&row(argument)));
    }
    for sub in command
        .get_subcommands()
        .filter(|sub| sub.get_name() != "help")
    {
        put_command(&format!("{name} {}", sub.get_name()), sub, text);
    }
}

const MADE: &str = "This page is made from the code, and a test compares the two.\n";

fn commands() -> Files {
    let mut text = format!(
        "# Commands\n\n{MADE}`glidepath COMMAND --help` says the same. \
         The [user guide](user-guide.md) tells what commands are for.\n"
    );
    for command in cli()
        .get_subcommands()
        .filter(|sub| sub.get_name() != "help")
    {
        put_command(command.get_name(), command, &mut text);
    }
    [("crates/glidepath/docs/commands.md".into(), text)].into()
}

fn keys() -> Files {
    let mut text = format!(
        "# Keys\n\n{MADE}`glidepath config --explain KEY` says the same. `axis.X` stands for every \
         axis,\n`joint.J0` and `home.J0` for every joint, `m_codes.M6` for every M code. What \
         they are for is in\n[configuration](configuration.md).\n"
    );
    let mut table = "";
    for key in keys::all() {
        let (of, name) = key.name.rsplit_once('.').expect("a table and a key");
        if of != table {
            table = of;
            let _ = write!(
                text,
                "\n## [{table}]\n\n| key | takes | left out | meaning |\n|---|---|---|---|\n"
            );
        }
        let left_out = key.left_out.words();
        let left_out = left_out.trim_start_matches("left out: ");
        let _ = writeln!(
            text,
            "| `{name}` | {} | {} | {} |",
            cell(&key.takes.words()),
            cell(left_out),
            cell(key.meaning)
        );
    }
    [("crates/glidepath/docs/keys.md".into(), text)].into()
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Compares files with what they are to be, or makes them that.
fn hold(files: &Files) {
    for (name, expected) in files {
        let path = root().join(name);
        if std::env::var_os("GLIDEPATH_BLESS").is_some() {
            std::fs::write(&path, expected).expect("a file that can be written");
        }
        let actual = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(
            actual == *expected,
            "{} is not what the code says: write it with GLIDEPATH_BLESS=1 cargo test -p glidepath \
             --test it reference",
            name.display()
        );
    }
}

#[test]
fn the_manual_has_every_command_and_every_key() {
    hold(&commands());
    hold(&keys());
}

#[test]
fn completions_and_man_pages_are_those_of_the_commands() {
    let pages = man_pages();
    hold(&completions());
    hold(&pages);
    // None is left of a command that is gone.
    let there = std::fs::read_dir(root().join("deploy/man")).expect("the pages");
    for page in there {
        let name = Path::new("deploy/man").join(page.expect("a page").file_name());
        assert!(
            pages.contains_key(&name),
            "{} is of no command",
            name.display()
        );
    }
}

/// The text of all sources, with strings that go over several lines as they are printed.
fn sources() -> String {
    fn put(folder: &Path, text: &mut String) {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                put(&path, text);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                text.push_str(&std::fs::read_to_string(path).expect("UTF-8"));
            }
        }
    }
    let mut text = String::new();
    for krate in std::fs::read_dir(root().join("crates")).expect("the crates") {
        let folder = krate.expect("a crate").path().join("src");
        if folder.is_dir() {
            put(&folder, &mut text);
        }
    }
    let mut joined = String::with_capacity(text.len());
    let mut parts = text.split("\\\n");
    joined.push_str(parts.next().unwrap_or_default());
    parts.for_each(|part| joined.push_str(part.trim_start()));
    joined.replace("\\\"", "\"")
}

#[test]
fn messages_that_the_manual_explains_are_those_of_the_program() {
    let page = std::fs::read_to_string(root().join("crates/glidepath/docs/troubleshooting.md"));
    let page = page.expect("the page");
    let sources = sources();
    let mut count = 0;
    for row in page.lines().filter_map(|line| line.strip_prefix("| `")) {
        let message = row.split('`').next().expect("a message");
        for part in message
            .split('…')
            .map(str::trim)
            .filter(|part| !part.is_empty())
        {
            assert!(sources.contains(part), "nothing says `{part}`");
            count += 1;
        }
    }
    assert!(count > 30, "the page has lost its tables: {count}");
}

/// The cells of a table below a heading, row by row, without the two lines of its head.
fn table(page: &str, heading: &str) -> Vec<Vec<String>> {
    let (_, below) = page.split_once(heading).expect("the heading");
    let rows = below
        .lines()
        .take_while(|line| !line.starts_with("## "))
        .filter(|line| line.starts_with('|'))
        .skip(2);
    let cells = |row: &str| {
        let cells = row.trim_matches('|').split('|');
        cells.map(|cell| cell.trim().to_owned()).collect()
    };
    rows.map(cells).collect()
}

#[test]
fn states_faults_and_refusals_are_told_as_the_manual_has_them() {
    let page = std::fs::read_to_string(root().join("crates/glidepath/docs/troubleshooting.md"));
    let page = page.expect("the page");
    let columns = |heading: &str, which: &[usize]| -> BTreeSet<Vec<String>> {
        let rows = table(&page, heading);
        assert!(!rows.is_empty(), "{heading}");
        let of = |row: &Vec<String>| which.iter().map(|at| row[*at].clone()).collect();
        let set: BTreeSet<Vec<String>> = rows.iter().map(of).collect();
        assert_eq!(set.len(), rows.len(), "{heading}: a row stands twice");
        set
    };
    let row =
        |state: MachineState, text: &str| vec![format!("`{}`", state.name()), text.to_owned()];
    let states = MachineState::ALL
        .iter()
        .map(|state| row(*state, state.text()));
    let at_rest = AtRest::ALL.iter().flat_map(|why| {
        let states = why.states().iter();
        states.map(|state| row(*state, why.text()))
    });
    let states = states.chain(at_rest);
    assert_eq!(columns("\n## States\n", &[0, 1]), states.collect());
    let faults =
        FaultCause::all().map(|cause| vec![cause.text().to_owned(), cause.remedy().to_owned()]);
    assert_eq!(
        columns("\n## The machine stopped\n", &[0, 2]),
        faults.collect()
    );
    let preconditions = UnmetPrecondition::ALL
        .iter()
        .map(|why| vec![why.text().to_owned()]);
    assert_eq!(
        columns("\n## What is refused\n", &[0]),
        preconditions.collect()
    );
    // The one that is no precondition.
    assert!(page.contains(CommandRefusal::Busy.text()));
}

/// What is installed is the machine of the manual, which keeps its state.
#[test]
fn the_installed_configuration_keeps_its_state_and_waits_for_tools() {
    let read = |name: &str| std::fs::read_to_string(root().join(name)).expect("a file");
    let (ours, installed) = (read("config/mill.toml"), read("deploy/machine.toml"));
    let (_, installed_body) = installed.split_once('\n').expect("a first line");
    let keeps = "directory = \"/var/lib/glidepath\"";
    assert_eq!(
        installed_body,
        ours.replace("# directory = \"state\"", keeps)
    );
    assert!(installed.contains(keeps));
    let path = root().join("deploy/machine.toml");
    let machine = config::load(Some(path.as_path())).expect("it is read");
    assert_eq!(
        machine.state_directory.as_deref(),
        Some(Path::new("/var/lib/glidepath"))
    );
    assert!(
        machine.m_code_waits().of(6).is_some(),
        "a person changes the tool"
    );
    let by_itself = config::parse("m", &(ours + "\n[m_codes.M6]\ndone = \"nothing\"\n"));
    assert!(
        by_itself
            .expect("it is read")
            .m_code_waits()
            .of(6)
            .is_none()
    );
    let unit = read("deploy/systemd/glidepath-planner.service");
    assert!(unit.contains("\nStateDirectory=glidepath\n"));
    let package = read("crates/glidepath/Cargo.toml");
    assert!(
        package.contains("\"../../deploy/machine.toml\", \"usr/share/glidepath/machine.toml\"")
    );
}
