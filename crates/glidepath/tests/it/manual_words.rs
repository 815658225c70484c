//! Tests of commands that the manual names within its text, and those of `--help`: the command line
//! knows them. Blocks of commands are run by `tests/e2e/manual`.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use clap::Parser as _;
use glidepath::cli::{Cli, CliCommand};
use std::path::{Path, PathBuf};

fn pages() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let docs = std::fs::read_dir(root.join("crates/glidepath/docs")).expect("the manual");
    let mut pages: Vec<PathBuf> = docs
        .map(|entry| entry.expect("a page").path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "md"))
        .collect();
    pages.push(root.join("README.md"));
    pages.sort();
    pages
}

/// What is between backticks outside of blocks. A line may end inside.
fn inline_code(page: &str) -> Vec<String> {
    let mut is_block = false;
    let mut text = String::new();
    for line in page.lines() {
        if line.starts_with("```") {
            is_block = !is_block;
        } else if !is_block {
            text.push_str(line.trim());
            // Backticks do not pair over the end of a paragraph or of a row of a table.
            text.push(if line.is_empty() || line.starts_with('|') {
                '\n'
            } else {
                ' '
            });
        }
    }
    let paragraphs = text.split('\n');
    let codes = paragraphs.flat_map(|paragraph| paragraph.split('`').skip(1).step_by(2));
    codes.map(str::to_owned).collect()
}

/// Words as a shell takes them, up to what is not the command's own any more.
fn words(command: &str) -> Vec<String> {
    let mut words = Vec::new();
    let (mut word, mut quote, mut is_open) = (String::new(), None, false);
    for letter in command.chars() {
        match (quote, letter) {
            (Some(mark), _) if mark == letter => quote = None,
            (None, '"' | '\'') => (quote, is_open) = (Some(letter), true),
            (None, ' ') => {
                if is_open {
                    words.push(std::mem::take(&mut word));
                }
                is_open = false;
            }
            _ => {
                word.push(letter);
                is_open = true;
            }
        }
    }
    if is_open {
        words.push(word);
    }
    let ends = |word: &String| matches!(word.as_str(), "|" | "||" | "&" | "&&" | ">" | "<" | "#");
    let end = words.iter().position(ends).unwrap_or(words.len());
    words.truncate(end);
    words
}

/// A name alone, as `glidepath live`, tells which command is meant, without what that takes.
fn is_known(command: &str) -> Result<(), clap::Error> {
    match Cli::try_parse_from(words(command)) {
        Ok(_) => Ok(()),
        Err(error) => match error.kind() {
            clap::error::ErrorKind::DisplayHelp | clap::error::ErrorKind::DisplayVersion => Ok(()),
            clap::error::ErrorKind::MissingRequiredArgument
            | clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => Ok(()),
            _ => Err(error),
        },
    }
}

#[test]
fn commands_within_the_text_are_understood() {
    let mut count = 0;
    let mut wrong = Vec::new();
    for page in pages() {
        let text = std::fs::read_to_string(&page).expect("a page");
        for code in inline_code(&text) {
            if !code.starts_with("glidepath ") || code.contains("COMMAND") || code.contains('…') {
                continue;
            }
            count += 1;
            if let Err(error) = is_known(&code) {
                wrong.push(format!("{}: `{code}`\n{error}", page.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 60, "the manual has lost its commands: {count}");
}

#[test]
fn words_are_those_of_a_shell() {
    let words = words("glidepath mdi 'G0 X1' --config a\"b c\" && glidepath home");
    assert_eq!(words, ["glidepath", "mdi", "G0 X1", "--config", "ab c"]);
    let codes = inline_code("a `b` c `d\ne`\n```\nf `g`\n```\n| `h |\n`i`\n");
    assert_eq!(codes, ["b", "d e", "h |", "i"].map(str::to_owned));
    assert!(matches!(
        Cli::try_parse_from(["glidepath", "hold"]).map(|cli| cli.command),
        Ok(CliCommand::Hold(_))
    ));
    assert!(is_known("glidepath hold --softly").is_err());
}
