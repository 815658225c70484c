//! The command `cargo test-all`: all tests, whatever fails, and one summary of them at the end. Its
//! last line is `N passed, N failed, N skipped`.
//!
//! ```text
//! cargo test-all [--allowed-skips FILE] [arguments of cargo test]
//! ```
//!
//! Without a package among the arguments all that tests start, and the library that programs in other languages link to,
//! are built at once before: built by the tests themselves, most of it is compiled a second time.
//!
//! A process that a test leaves behind is ended, and is a failure: it has a hand on what others wait for, and on the
//! outputs of the tests, which would have no end.
//!
//! Tests of the target `e2e` run processes at the speed of the clock, several at a time, and a host that stands still for
//! longer than a machine can wait ends them. A few of them that failed are run once more, one at a time; those that pass
//! then are told by themselves. More than a few are the fault of the change at hand.
//!
//! With a list of allowed skips, one that is not in it is a failure. Skips are collected in the file that
//! `GLIDEPATH_SKIPPED` names, with those that are there already; without it in one that is made for them.
#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a command for developers"
)]

mod allowed;
mod left_behind;
mod summary;

use std::ffi::OsString;
use std::io::{self, BufRead as _, BufReader, Write as _};
use std::path::PathBuf;
use std::process::{Command, ExitCode};

use allowed::Allowed;
use glidepath_testing::{SKIPPED, is_root};
use summary::Summary;

/// The test target of what runs at the speed of the clock.
const BY_CLOCK: &str = "e2e";
/// All that is built at once, and tested.
const TARGETS: [&str; 4] = ["--lib", "--bins", "--examples", "--tests"];
/// How many of its tests may have failed for the host to be held the cause.
const FEW: usize = 4;

fn main() -> ExitCode {
    match run(std::env::args().skip(1).collect()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("cargo test-all: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(mut arguments: Vec<String>) -> Result<bool, String> {
    let allowed = allowed(&mut arguments)?;
    let (skips, is_own) = match std::env::var_os(SKIPPED) {
        Some(path) => (PathBuf::from(path), false),
        None => {
            let name = format!("glidepath-skipped.{}", std::process::id());
            (std::env::temp_dir().join(name), true)
        }
    };
    let mut summary = Summary::default();
    let is_whole = !arguments.iter().any(|word| is_package(word));
    if is_whole && !build(&arguments).map_err(|error| error.to_string())? {
        summary.fail("cargo build".to_owned());
        print!("\n{summary}");
        return Ok(false);
    }
    let is_success = test(&arguments, is_whole, &skips, &mut summary);
    let is_success = is_success.map_err(|error| error.to_string())?;
    summary.end(is_success);
    let failed = summary.failed_tests(BY_CLOCK);
    if is_whole && (1..=FEW).contains(&failed.len()) {
        let mut again = Summary::default();
        let arguments = again_alone(&arguments, &failed);
        let is_success = test(&arguments, is_whole, &skips, &mut again);
        again.end(is_success.map_err(|error| error.to_string())?);
        summary.take_again(BY_CLOCK, &again);
    }
    let told = std::fs::read_to_string(&skips).unwrap_or_default();
    if is_own {
        // There is none where nothing was skipped.
        let _removed = std::fs::remove_file(&skips);
    }
    summary.take_skips(&told);
    if let Some(allowed) = allowed {
        let is_root = is_root();
        let strange = summary.skips().filter(|skip| !allowed.has(skip, is_root));
        let strange: Vec<String> = strange.map(str::to_owned).collect();
        for skip in strange {
            summary.fail(format!("skipped, and not to be skipped here: {skip}"));
        }
    }
    print!("\n{summary}");
    Ok(summary.is_good())
}

/// The list of allowed skips that is asked for.
fn allowed(arguments: &mut Vec<String>) -> Result<Option<Allowed>, String> {
    if arguments.first().map(String::as_str) != Some("--allowed-skips") {
        return Ok(None);
    }
    let path = arguments.get(1).ok_or("--allowed-skips takes a file")?;
    let text = std::fs::read_to_string(path).map_err(|error| format!("{path}: {error}"))?;
    let allowed = Allowed::parse(&text).map_err(|error| format!("{path}: {error}"))?;
    arguments.drain(..2);
    Ok(Some(allowed))
}

fn is_package(word: &str) -> bool {
    word == "-p" || word.starts_with("--package")
}

/// The arguments that run these tests alone, behind those that all were run with.
fn again_alone(arguments: &[String], tests: &[String]) -> Vec<String> {
    let of_cargo = arguments.iter().take_while(|word| *word != "--");
    // The same targets as were built at once: with fewer, crates they need have other features, and are compiled anew.
    let alone = TARGETS.iter().chain(&["--", "--exact", "--test-threads=1"]);
    let words = of_cargo.map(String::as_str).chain(alone.copied());
    let tests = tests.iter().map(String::as_str);
    words.chain(tests).map(str::to_owned).collect()
}

/// Two for each core: the longest tests are those that run at the speed of the clock, and mostly wait.
fn test_threads() -> usize {
    2 * std::thread::available_parallelism().map_or(1, usize::from)
}

fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo")))
}

/// Builds everything, in the profile that is tested.
fn build(arguments: &[String]) -> io::Result<bool> {
    let mut command = cargo();
    command.args(["build", "--workspace"]).args(TARGETS);
    let release = ["--release", "-r"];
    if arguments
        .iter()
        .any(|word| release.contains(&word.as_str()))
    {
        command.arg("--release");
    }
    Ok(command.status()?.success())
}

/// Runs them, and shows what they say. Both outputs of cargo are one: what a program says follows its name.
fn test(
    arguments: &[String],
    is_whole: bool,
    skips: &PathBuf,
    summary: &mut Summary,
) -> io::Result<bool> {
    let (said, says) = io::pipe()?;
    let mut command = cargo();
    command.args(["test", "--no-fail-fast"]);
    if is_whole {
        command.arg("--workspace").env("GLIDEPATH_BUILT", "1");
    }
    if std::env::var_os("RUST_TEST_THREADS").is_none() {
        command.env("RUST_TEST_THREADS", test_threads().to_string());
    }
    command
        .args(arguments)
        .env(SKIPPED, skips)
        // The machine of whoever works here is none of the tests'.
        .env_remove("GLIDEPATH_CONFIG")
        .env_remove("GLIDEPATH_INSTANCE")
        .stdout(says.try_clone()?)
        .stderr(says);
    left_behind::come_to_this_process()?;
    let mut child = command.spawn()?;
    // This process has the writing end no longer: then the reading one has an end.
    drop(command);
    let ended = std::thread::spawn(move || {
        let status = child.wait()?;
        Ok::<_, io::Error>((status, left_behind::end_all()))
    });
    let (mut said, mut line) = (BufReader::new(said), Vec::new());
    let mut out = io::stdout().lock();
    while said.read_until(b'\n', &mut line)? > 0 {
        out.write_all(&line)?;
        summary.take(&String::from_utf8_lossy(&line));
        line.clear();
    }
    let ended = ended
        .join()
        .map_err(|_| io::Error::other("a thread panicked"))?;
    let (status, left) = ended?;
    for process in left {
        summary.fail(format!("left behind by a test: {process}"));
    }
    Ok(status.success())
}
