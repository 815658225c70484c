//! The blocks of commands in the pages of the manual, and how each is run.

use std::path::{Path, PathBuf};

/// What commands of the manual begin with. A block with such a line has to say how it is run.
const COMMANDS: [&str; 10] = [
    "glidepath",
    "cargo",
    "sudo",
    "apt",
    "mosquitto",
    "halrun",
    "pip",
    "cc",
    "ssh",
    "./",
];

/// How a block is run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum How {
    /// As a whole, in a folder with files to work on; it ends with this code.
    Desk(i32),
    /// Line by line, with a machine whose drives answer.
    Machine,
    /// It is not, and why.
    Not(String),
}

/// A block of commands.
#[derive(Debug)]
pub(crate) struct Block {
    /// Where it stands, as `page:line`.
    pub(crate) place: String,
    pub(crate) text: String,
    pub(crate) how: How,
}

/// The top of the repository.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .canonicalize()
        .unwrap()
}

/// Every block of commands of the introduction and of the manual's pages.
pub(crate) fn all() -> Vec<Block> {
    let docs = root().join("crates/glidepath/docs");
    let mut pages: Vec<PathBuf> = std::fs::read_dir(docs)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "md"))
        .collect();
    pages.sort();
    pages.push(root().join("README.md"));
    pages.iter().flat_map(|page| of_page(page)).collect()
}

fn of_page(page: &Path) -> Vec<Block> {
    let text = std::fs::read_to_string(page).unwrap();
    let name = page.strip_prefix(root()).unwrap().display().to_string();
    in_text(&name, &text)
}

pub(crate) fn in_text(name: &str, text: &str) -> Vec<Block> {
    let mut found = Vec::new();
    let mut lines = text.lines().enumerate();
    let mut before = "";
    while let Some((number, line)) = lines.next() {
        if line.starts_with("```") {
            let body = lines.by_ref().map(|(_, line)| line);
            let body: Vec<&str> = body.take_while(|line| !line.starts_with("```")).collect();
            if body.iter().any(|line| is_command(line)) {
                let place = format!("{name}:{}", number + 1);
                let how = how(before);
                assert!(how.is_some(), "{place}: {UNSAID}");
                found.push(Block {
                    how: how.unwrap(),
                    text: body.join("\n"),
                    place,
                });
            }
            before = "";
        } else if !line.trim().is_empty() {
            before = line;
        }
    }
    found
}

const UNSAID: &str = "say in the line above it how the block is run: `<!-- Run by a test: desk. -->`, \
                      `desk, ends with 3`, `machine`, or `<!-- Not run by a test: REASON. -->`";

fn is_command(line: &str) -> bool {
    let first = line.split_whitespace().next().unwrap_or_default();
    COMMANDS.contains(&first) || first.starts_with("./")
}

fn how(comment: &str) -> Option<How> {
    let said = comment.strip_prefix("<!-- ")?.strip_suffix(". -->")?;
    if let Some(reason) = said.strip_prefix("Not run by a test: ") {
        return Some(How::Not(reason.to_owned()));
    }
    match said.strip_prefix("Run by a test: ")? {
        "machine" => Some(How::Machine),
        "desk" => Some(How::Desk(0)),
        other => Some(How::Desk(
            other.strip_prefix("desk, ends with ")?.parse().ok()?,
        )),
    }
}

#[test]
fn blocks_are_found_with_what_is_said_of_them() {
    let text = "Look:\n\n<!-- Run by a test: desk, ends with 3. -->\n```sh\nglidepath a # b\nc\n```\n\
                <!-- Not run by a test: no drive. -->\n\n```\nsudo x\n```\n\n```toml\na = 1\n```\n";
    let found = in_text("page", text);
    let found: Vec<_> = found
        .iter()
        .map(|b| (b.place.as_str(), b.text.as_str(), &b.how))
        .collect();
    let expected = [
        ("page:4", "glidepath a # b\nc", &How::Desk(3)),
        ("page:10", "sudo x", &How::Not("no drive".to_owned())),
    ];
    assert_eq!(found, expected);
    let silent = || in_text("page", "Run this.\n```\nglidepath run\n```\n");
    assert!(std::panic::catch_unwind(silent).is_err());
}
