//! The output of the process: results to standard output, diagnostics and progress to standard
//! error, so that a result can be piped.
//!
//! Text of others (programs, names of files, keys, other processes) is in nearly everything. So all of
//! it is made safe here, on its way out: no terminal and no log obeys it. What is written as it is are
//! the colours of diagnostics, around text that was made safe before, and what [`control`] gets.

use crate::machine_options::complete;
use crate::shown_diagnostic::ShownDiagnostic;
use core::fmt::Write as _;
use glidepath_link::{is_printable, printable};
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};
use serde::Serialize;
use std::io::{ErrorKind, IsTerminal as _, Write};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// Why a result was not written.
static UNWRITTEN: OnceLock<String> = OnceLock::new();
/// Whether the reader of standard output went away.
static HAS_NO_READER: AtomicBool = AtomicBool::new(false);
/// Whether a file is written to standard output.
static IS_GIVEN_AWAY: AtomicBool = AtomicBool::new(false);

/// Leaves standard output to a file: results go to standard error from now on. False if another file
/// has it.
pub fn give_away() -> bool {
    !IS_GIVEN_AWAY.swap(true, Ordering::Relaxed)
}

/// Writes text to standard output, with commands as they have to be typed, or to standard error where a
/// file has that. A reader that went
/// away (`| head`) is no fault of ours; any other failure is kept for the end of the command
/// ([`unwritten`]).
pub fn result(text: &str) {
    control(&shown(text));
}

/// Writes to standard output what the terminal is to obey; nothing of others.
pub fn control(text: &str) {
    let mut out: Box<dyn Write> = if IS_GIVEN_AWAY.load(Ordering::Relaxed) {
        Box::new(std::io::stderr().lock())
    } else {
        Box::new(std::io::stdout().lock())
    };
    let written = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    match written {
        Ok(()) => {}
        Err(error) if error.kind() == ErrorKind::BrokenPipe => {
            HAS_NO_READER.store(true, Ordering::Relaxed);
        }
        Err(error) => {
            UNWRITTEN.get_or_init(|| error.to_string());
        }
    }
}

/// True once the reader of standard output went away: a command that only shows, again and again, is done then.
pub fn has_no_reader() -> bool {
    HAS_NO_READER.load(Ordering::Relaxed)
}

/// Why a result of this process was not written to standard output, if one was not.
pub fn unwritten() -> Option<&'static str> {
    UNWRITTEN.get().map(String::as_str)
}

/// Writes the one JSON object of a `--json` command.
pub fn object<T: Serialize>(object: &T) {
    written(serde_json::to_string_pretty(object));
}

/// Writes an object in one line, of a `--json` command that goes on.
pub fn object_line<T: Serialize>(object: &T) {
    written(serde_json::to_string(object));
}

fn written(json: serde_json::Result<String>) {
    match json {
        Ok(text) => control(&(escaped(&text) + "\n")),
        // Only a map with keys that are no strings cannot be written; ours have none.
        Err(error) => note(&format!("error: cannot write the report: {error}")),
    }
}

/// JSON whose strings hold nothing that a terminal obeys; what they mean stays.
fn escaped(json: &str) -> String {
    json.chars().fold(String::new(), |mut text, character| {
        if is_printable(character) {
            text.push(character);
        } else {
            // None of them is beyond four digits. Writing to a String does not fail.
            let _ = write!(text, "\\u{:04x}", u32::from(character));
        }
        text
    })
}

/// Writes a line to standard error.
pub fn note(text: &str) {
    note_rendered(&shown(text));
}

/// A line as it is shown: with commands as they have to be typed, and nothing that a terminal obeys.
#[must_use]
pub fn shown(text: &str) -> String {
    printable(&complete(text)).into_owned()
}

fn note_rendered(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// Tells what is wrong with a command line, or what was asked about it.
pub fn usage(error: &clap::Error) {
    let text = error.render();
    let in_colour = if error.use_stderr() {
        stderr_in_colour()
    } else {
        std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none()
    };
    let text = if in_colour {
        styled(&text.ansi().to_string())
    } else {
        printable(&text.to_string()).into_owned()
    };
    if error.use_stderr() {
        // Nobody is left to tell.
        let _ = write!(std::io::stderr().lock(), "{text}");
    } else {
        control(&text);
    }
}

/// A text in which clap has put words in colour: of what a terminal obeys nothing else is left.
fn styled(text: &str) -> String {
    let mut parts = text.split("\x1b[");
    let first = parts.next().unwrap_or_default();
    parts.fold(printable(first).into_owned(), |mut shown, part| {
        let end = part.find(|c: char| !(c.is_ascii_digit() || c == ';'));
        let (style, rest) = part.split_at(end.unwrap_or(part.len()));
        match rest.strip_prefix('m') {
            Some(rest) => {
                let _ = write!(shown, "\x1b[{style}m{}", printable(rest));
            }
            None => {
                let _ = write!(shown, "?[{style}{}", printable(rest));
            }
        }
        shown
    })
}

/// A diagnostic as text with the source line and a caret: in colour if `colour`.
#[must_use]
pub fn render(diagnostic: &dyn Diagnostic, colour: bool) -> String {
    let theme = if colour {
        GraphicalTheme::unicode()
    } else {
        GraphicalTheme::unicode_nocolor()
    };
    let mut text = String::new();
    let handler = GraphicalReportHandler::new_themed(theme)
        .with_width(100)
        .with_links(false);
    // Writing to a String does not fail.
    let _ = handler.render_report(&mut text, &ShownDiagnostic::new(diagnostic));
    text
}

/// True if standard error is a terminal and the user did not ask for plain text (`NO_COLOR`).
#[must_use]
pub fn stderr_in_colour() -> bool {
    std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none()
}

/// Prints diagnostics to standard error.
pub fn diagnostics<'a>(diagnostics: impl IntoIterator<Item = &'a dyn Diagnostic>) {
    let colour = stderr_in_colour();
    for diagnostic in diagnostics {
        note_rendered(&complete(render(diagnostic, colour).trim_end()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_means_the_same_and_holds_nothing_that_a_terminal_obeys() {
        let hostile = "a\x1b[2J\u{9b}31m\u{202e}b\u{7f}\"\\ü";
        let json = serde_json::to_string(&[hostile]).expect("a text");
        let told = escaped(&json);
        assert!(told.chars().all(is_printable), "{told}");
        let read: Vec<String> = serde_json::from_str(&told).expect("JSON");
        assert_eq!(read, [hostile]);
    }

    #[test]
    fn of_a_usage_only_its_colours_are_obeyed() {
        let told = styled("\x1b[1merror:\x1b[0m no \x1b[2J\x1b]0;title\x07 here\r\u{9b}2J");
        assert_eq!(told, "\x1b[1merror:\x1b[0m no ?[2J?]0;title? here?¿2J");
    }
}
