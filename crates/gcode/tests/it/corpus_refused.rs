//! Tests of every real program that is refused, against the table that says why.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glidepath_gcode::{Connections, Dialect, Machine, Options, Threading, Tool, ToolTable, check};
use glidepath_geometry::Axis;
use glidepath_program::Limits;
use glidepath_testing::corpus;

/// The table: program, line and code of the first finding, reason.
const TABLE: &str = include_str!("../../../planner/examples/corpus.md");

/// The folder of programs that are damaged on purpose.
const DAMAGED: &str = "malformed/";

/// All that a machine may have, in the language that the beginning of the program tells.
fn options(text: &[u8]) -> Options {
    let mut tools = ToolTable::new();
    for number in 1..=99 {
        tools.set(number, Tool::default());
    }
    Options {
        dialect: Dialect::detect(text, &Machine::unlimited()).dialect,
        tools: Some(Arc::new(tools)),
        connections: Connections::Simulated,
        extruder: Some(Axis::U),
        threading: Some(Threading::new(
            Limits::uniform(200.0, 2_000.0, 40_000.0),
            0.004,
        )),
        ..Options::default()
    }
}

/// All programs below a folder, by their names.
fn programs(directory: &Path) -> Vec<(String, PathBuf)> {
    let entries = |folder: &Path| -> Vec<PathBuf> {
        let entries = fs::read_dir(folder).expect("a folder");
        entries
            .map(|entry| entry.expect("an entry").path())
            .collect()
    };
    let folders = entries(directory).into_iter().filter(|path| path.is_dir());
    let mut found: Vec<(String, PathBuf)> = folders
        .flat_map(|folder| entries(&folder))
        .map(|path| {
            let name = path.strip_prefix(directory).expect("below it");
            (name.display().to_string(), path)
        })
        .collect();
    found.sort();
    found
}

/// Rows of the table of refusals: program, line, code.
fn rows() -> Vec<String> {
    let (_, section) = TABLE.split_once("## Refused").expect("the section");
    let rows = section.lines().filter(|line| line.contains("| `"));
    rows.map(|row| {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        assert!(cells[4].len() > 20, "a reason: {row}");
        format!("{} {} {}", cells[1], cells[2], cells[3].trim_matches('`'))
    })
    .collect()
}

#[test]
fn every_program_that_is_refused_is_in_the_table_with_its_reason() {
    let Some(directory) = corpus() else {
        return;
    };
    let (mut accepted, mut damaged, mut refused) = (0, 0, Vec::new());
    for (name, path) in programs(&directory) {
        let text = fs::read(path).expect("a program");
        let report = check(text.as_slice(), options(&text));
        match report.diagnostics.first() {
            None => accepted += 1,
            Some(_) if name.starts_with(DAMAGED) => damaged += 1,
            Some(first) => refused.push(format!("{name} {} {}", first.line, first.code.as_str())),
        }
    }
    let mut listed = rows();
    listed.sort();
    assert_eq!(refused, listed);
    let counts = format!(
        "Of {} programs {accepted} are accepted, {damaged} are damaged on purpose and refused",
        accepted + damaged + refused.len()
    );
    assert!(TABLE.contains(&counts), "{counts}");
}
