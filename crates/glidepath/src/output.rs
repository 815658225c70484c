//! Everything the process prints: results to standard output, diagnostics and progress to standard
//! error, so that a result can be piped.

use crate::machine_options::complete;
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};
use serde::Serialize;
use std::io::{ErrorKind, IsTerminal as _, Write};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// Why a result was not written.
static UNWRITTEN: OnceLock<String> = OnceLock::new();
/// Whether a file is written to standard output.
static IS_GIVEN_AWAY: AtomicBool = AtomicBool::new(false);

/// Leaves standard output to a file: results go to standard error from now on. False if another file
/// has it.
pub fn give_away() -> bool {
    !IS_GIVEN_AWAY.swap(true, Ordering::Relaxed)
}

/// Writes text to standard output, or to standard error where a file has that. A reader that went
/// away (`| head`) is no fault of ours; any other failure is kept for the end of the command
/// ([`unwritten`]).
pub fn result(text: &str) {
    let mut out: Box<dyn Write> = if IS_GIVEN_AWAY.load(Ordering::Relaxed) {
        Box::new(std::io::stderr().lock())
    } else {
        Box::new(std::io::stdout().lock())
    };
    let written = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    if let Err(error) = written
        && error.kind() != ErrorKind::BrokenPipe
    {
        UNWRITTEN.get_or_init(|| error.to_string());
    }
}

/// Why a result of this process was not written to standard output, if one was not.
pub fn unwritten() -> Option<&'static str> {
    UNWRITTEN.get().map(String::as_str)
}

/// Writes the one JSON object of a `--json` command.
pub fn object<T: Serialize>(object: &T) {
    match serde_json::to_string_pretty(object) {
        Ok(text) => result(&(text + "\n")),
        // Only a map with keys that are no strings cannot be written; ours have none.
        Err(error) => note(&format!("error: cannot write the report: {error}")),
    }
}

/// Writes a line to standard error.
pub fn note(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{}", complete(text));
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
    let _ = handler.render_report(&mut text, diagnostic);
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
        note(render(diagnostic, colour).trim_end());
    }
}
