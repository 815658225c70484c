//! The helpers of every crate's tests: how a test says what it left out, and why, and [`Pulse`] and
//! [`is_crowded`], by which it finds out whether the host let anything run in time.
//!
//! Cargo swallows what a test says that passes. So [`skip`] and [`leave_out`] write past it, and into the file
//! that [`SKIPPED`] names, where `cargo test-all` reads it and tells it at the end.

mod crowd;
mod pulse;

pub use crowd::is_crowded;
pub use pulse::Pulse;

use std::ffi::OsString;
use std::fmt::Write as _;
use std::fs::File;
use std::io::Write as _;
use std::path::PathBuf;

/// The variable of the environment that names the file in which skips are collected.
pub const SKIPPED: &str = "GLIDEPATH_SKIPPED";
/// What a line begins with that tells of a skip. What was skipped follows, a colon, and why.
pub const MARK: &str = "SKIPPED: ";

/// How much of a test was left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// All of it.
    Whole,
    /// A part.
    Part,
}

impl Extent {
    /// The word for it in the file.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Whole => "whole",
            Self::Part => "part",
        }
    }
}

/// Says that the test that calls this tests nothing here: `what` it would have tested, without a colon, and
/// why it does not.
pub fn skip(what: &str, why: &str) {
    say(Extent::Whole, what, why);
}

/// Says that the test that calls this leaves out a part: `what`, without a colon, and why.
pub fn leave_out(what: &str, why: &str) {
    say(Extent::Part, what, why);
}

fn say(extent: Extent, what: &str, why: &str) {
    let why = why.split_whitespace().collect::<Vec<_>>().join(" ");
    let line = format!("{MARK}{what}: {why}\n");
    // Not by `eprint!`, which the harness of tests keeps for itself. Nobody has to hear it.
    let _told = std::io::stderr().write_all(line.as_bytes());
    if let Some(file) = std::env::var_os(SKIPPED) {
        note(&file, extent, &line);
    }
}

/// One write for the line: other tests write to the file, too.
#[expect(
    clippy::panic,
    reason = "a skip that nobody is told of is worse than a failure"
)]
fn note(file: &OsString, extent: Extent, line: &str) {
    let mut noted = String::new();
    let (word, process) = (extent.word(), std::process::id());
    let thread = std::thread::current().id();
    // Into a string nothing fails.
    let _noted = write!(noted, "{word}\t{process} {thread:?}\t{line}");
    let written = File::options()
        .create(true)
        .append(true)
        .open(file)
        .and_then(|mut file| file.write_all(noted.as_bytes()));
    if let Err(error) = written {
        panic!("{}: {error}", file.display());
    }
}

/// The folder of programs of other origin that `GLIDEPATH_CORPUS` names; without one, the test that asks is
/// skipped.
#[must_use]
pub fn corpus() -> Option<PathBuf> {
    corpus_for(Extent::Whole)
}

/// The same for a test that has other programs, too.
#[must_use]
pub fn corpus_beside_others() -> Option<PathBuf> {
    corpus_for(Extent::Part)
}

fn corpus_for(extent: Extent) -> Option<PathBuf> {
    let folder = std::env::var_os("GLIDEPATH_CORPUS").map(PathBuf::from);
    if folder.is_none() {
        let why = "GLIDEPATH_CORPUS names no folder";
        say(extent, "programs of other origin", why);
    }
    folder
}

/// The folder of captures and EEPROMs of real devices that `GLIDEPATH_CAPTURES` names; without one, the test
/// that asks is skipped.
#[must_use]
pub fn captures() -> Option<PathBuf> {
    let folder = std::env::var_os("GLIDEPATH_CAPTURES").map(PathBuf::from);
    if folder.is_none() {
        skip(
            "captures of real devices",
            "GLIDEPATH_CAPTURES names no folder",
        );
    }
    folder
}

/// Whether tests run as root, and may be another user; otherwise, the test that asks is skipped.
#[must_use]
pub fn can_be_another_user() -> bool {
    let is_root = is_root();
    if !is_root {
        skip("another user of the host", "only root can be one");
    }
    is_root
}

/// Whether this process belongs to root.
#[must_use]
pub fn is_root() -> bool {
    use std::os::unix::fs::MetadataExt as _;
    std::fs::metadata("/proc/self").is_ok_and(|own| own.uid() == 0)
}
