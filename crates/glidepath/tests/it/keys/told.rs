//! Tests that people are told of every key: in the built-in machine, and in the manual.

use super::last;
use glidepath::config;
use glidepath::config::keys::{self, Key};

#[test]
fn every_key_that_the_built_in_machine_may_have_is_named_and_explained_in_it() {
    let text = config::EMBEDDED;
    for key in keys::all().filter(|key| key.name.split('.').count() == 2) {
        let name = last(key.name);
        let (table, _) = key.name.split_once('.').expect("a table");
        let is_head = |line: &&str| line.starts_with(&format!("[{table}]"));
        let of_table = text.lines().skip_while(|line| !is_head(line)).skip(1);
        let mut of_table = of_table.take_while(|line| !line.starts_with('['));
        let is_there = of_table.any(|line| {
            let line = line.trim_start_matches("# ");
            line.strip_prefix(name)
                .is_some_and(|rest| rest.trim_start().starts_with('='))
        });
        assert!(is_there, "{} is not in the default", key.name);
    }
}

/// The heading of the manual that a key is below.
fn heading(key: &Key) -> String {
    let parts: Vec<&str> = key.name.split('.').collect();
    match *parts.as_slice() {
        ["machine", mechanism, _] => format!("### {mechanism}"),
        ["machine", _] => "## Mechanisms".to_owned(),
        ["axis", ..] => "## Axes".to_owned(),
        ["joint", ..] => "## Joints".to_owned(),
        ["m_codes", ..] => "## M codes".to_owned(),
        [table, ..] => {
            let words = table.replace('_', " ");
            format!("## {}{}", words[..1].to_uppercase(), &words[1..])
        }
        [] => panic!("a key without a name"),
    }
}

#[test]
fn the_manual_names_every_key() {
    let manual = include_str!("../../../docs/configuration.md");
    for key in keys::all() {
        let heading = heading(key);
        let section = manual.lines().skip_while(|line| *line != heading).skip(1);
        let mut section =
            section.take_while(|line| !line.starts_with("## ") && !line.starts_with("### "));
        let name = format!("`{}`", last(key.name));
        let row = |line: &str| {
            line.starts_with("| ")
                && line
                    .split('|')
                    .nth(1)
                    .is_some_and(|names| names.contains(&name))
        };
        assert!(
            section.any(row),
            "{} is not in the manual, below {heading}",
            key.name
        );
    }
}
