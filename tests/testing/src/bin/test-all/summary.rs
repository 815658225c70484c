//! The summary of what cargo and the tests said.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use glidepath_testing::{Extent, MARK};

/// What a program failed by that said nothing at its end.
const DIED: &str = "it died";

/// What was said so far.
#[derive(Debug, Default)]
pub(crate) struct Summary {
    passed: u64,
    failed: u64,
    /// Programs and tests that failed, in order.
    failures: Vec<String>,
    /// Tests that failed beside others, and passed when they were run once more by themselves.
    passed_alone: Vec<String>,
    /// What was skipped and why, with how often.
    skips: BTreeMap<String, u64>,
    /// Tests that were skipped as a whole. The harness counts them as passed.
    whole: BTreeSet<String>,
    skipped: u64,
    reading: Reading,
}

/// Where in cargo's output the reading is.
#[derive(Debug, Default)]
struct Reading {
    program: String,
    /// A program has said how many tests it runs, and not yet how that went.
    is_running: bool,
    /// The lines that follow name tests that failed.
    names: bool,
}

impl Summary {
    /// Takes a line of cargo, or of a test program.
    pub(crate) fn take(&mut self, line: &str) {
        let line = line.trim_end();
        if let Some(program) = begun(line) {
            self.end_program();
            self.reading.program = program.to_owned();
        } else if is_count(line) {
            self.reading.is_running = true;
        } else if let Some(result) = line.strip_prefix("test result: ") {
            self.reading.is_running = false;
            self.reading.names = false;
            self.passed += number_before(result, " passed");
            self.failed += number_before(result, " failed");
        } else if line == "failures:" {
            self.reading.names = true;
        } else if self.reading.names && !line.is_empty() {
            match line.strip_prefix("    ") {
                Some(name) => self.failures.push(self.named(name)),
                None => self.reading.names = false,
            }
        } else if let Some(why) = ignored(line) {
            self.skipped += 1;
            *self.skips.entry(why).or_default() += 1;
        }
    }

    fn named(&self, test: &str) -> String {
        format!("{}: {test}", self.reading.program)
    }

    /// A program that began and said nothing at its end has died.
    fn end_program(&mut self) {
        if std::mem::take(&mut self.reading.is_running) {
            self.failed += 1;
            self.failures.push(self.named(DIED));
        }
    }

    /// Takes the file of skips.
    pub(crate) fn take_skips(&mut self, text: &str) {
        for line in text.lines() {
            let mut cells = line.splitn(3, '\t');
            let (extent, whose) = (cells.next(), cells.next());
            let Some(said) = cells.next().and_then(|said| said.strip_prefix(MARK)) else {
                continue;
            };
            if extent == Some(Extent::Whole.word()) {
                self.whole.extend(whose.map(str::to_owned));
            }
            self.skipped += 1;
            *self.skips.entry(said.to_owned()).or_default() += 1;
        }
    }

    /// Nothing more comes, and this is how cargo ended.
    pub(crate) fn end(&mut self, is_success: bool) {
        self.end_program();
        if !is_success && self.failed == 0 {
            self.failed = 1;
            self.failures.push("cargo: see above".to_owned());
        }
    }

    /// A failure that is none of a test.
    pub(crate) fn fail(&mut self, what: String) {
        self.failed += 1;
        self.failures.push(what);
    }

    /// The tests that failed of a test target, whose program is `e2e-0123` where the target is `e2e`. None if it died.
    pub(crate) fn failed_tests(&self, target: &str) -> Vec<String> {
        let failures = self.failures.iter();
        let tests: Vec<_> = failures.filter_map(|said| test_of(target, said)).collect();
        let died = tests.contains(&DIED);
        let tests = tests.into_iter().filter(|_| !died);
        tests.map(str::to_owned).collect()
    }

    /// Counts failed tests of a test target as passed, and tells them apart: those that did not fail again in `again`,
    /// which ran them by themselves.
    pub(crate) fn take_again(&mut self, target: &str, again: &Self) {
        if again.passed + again.failed != self.failed_tests(target).len() as u64 {
            return;
        }
        let fails_again = |failure: &String| {
            test_of(target, failure).is_none() || again.failures.contains(failure)
        };
        let (failures, passed) = std::mem::take(&mut self.failures)
            .into_iter()
            .partition::<Vec<_>, _>(fails_again);
        self.failures = failures;
        self.failed -= passed.len() as u64;
        self.passed += passed.len() as u64;
        self.passed_alone = passed;
    }

    /// Whether nothing failed.
    pub(crate) const fn is_good(&self) -> bool {
        self.failed == 0
    }

    /// What was skipped, and why.
    pub(crate) fn skips(&self) -> impl Iterator<Item = &str> {
        self.skips.keys().map(String::as_str)
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.skips.is_empty() {
            writeln!(f, "skipped:")?;
        }
        for (skip, count) in &self.skips {
            match count {
                1 => writeln!(f, "    {skip}")?,
                count => writeln!(f, "    {skip} ({count} times)")?,
            }
        }
        if !self.passed_alone.is_empty() {
            writeln!(f, "failed beside others, passed alone:")?;
        }
        for test in &self.passed_alone {
            writeln!(f, "    {test}")?;
        }
        if !self.failures.is_empty() {
            writeln!(f, "failed:")?;
        }
        for failure in &self.failures {
            writeln!(f, "    {failure}")?;
        }
        let passed = self.passed.saturating_sub(self.whole.len() as u64);
        let (failed, skipped) = (self.failed, self.skipped);
        writeln!(f, "{passed} passed, {failed} failed, {skipped} skipped")
    }
}

/// The test that failed, if it is one of the test target.
fn test_of<'a>(target: &str, failure: &'a str) -> Option<&'a str> {
    let (program, test) = failure.split_once(": ")?;
    (program.rsplit_once('-')?.0 == target).then_some(test)
}

/// The test program that cargo begins: `Running tests/it/main.rs (target/debug/deps/it-0123)`.
fn begun(line: &str) -> Option<&str> {
    let said = line.trim_start();
    if let Some(of) = said.strip_prefix("Doc-tests ") {
        return Some(of);
    }
    let (_, path) = said.strip_prefix("Running ")?.split_once(" (")?;
    path.strip_suffix(')')?.rsplit('/').next()
}

/// `running 12 tests`.
fn is_count(line: &str) -> bool {
    let number = line
        .strip_prefix("running ")
        .and_then(|rest| rest.strip_suffix(" tests").or(rest.strip_suffix(" test")));
    number.is_some_and(|number| number.parse::<u64>().is_ok())
}

/// A test that the harness left out: `test a::b ... ignored, why`.
fn ignored(line: &str) -> Option<String> {
    let (name, why) = line.strip_prefix("test ")?.split_once(" ... ignored")?;
    let why = why.strip_prefix(", ").unwrap_or("it is ignored");
    Some(format!("{name}: {why}"))
}

/// The number before a word, 0 without.
fn number_before(text: &str, word: &str) -> u64 {
    let before = text.split(word).next().unwrap_or_default();
    let digits = before.rsplit(' ').next().unwrap_or_default();
    digits.parse().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAID: &str = "\
     Running unittests src/lib.rs (target/debug/deps/glidepath_link-01ab)

running 2 tests
test a ... ok
test b::c ... ok

test result: ok. 2 passed; 0 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.01s

     Running tests/it/main.rs (target/debug/deps/it-02cd)

running 4 tests
test good ... ok
test left ... ignored, it takes a day
test bad::one ... FAILED
test bad::two ... FAILED

failures:

---- bad::one stdout ----
thread panicked

failures:
    bad::one
    bad::two

test result: FAILED. 1 passed; 2 failed; 1 ignored; 0 measured; 0 filtered out; finished in 9.00s

error: test failed, to rerun pass `-p glidepath-link --test it`
     Running tests/dies.rs (target/debug/deps/dies-03ef)

running 1 test
test dies hangs: no end after 3s
   Doc-tests glidepath_link

running 1 test
test src/lib.rs - (line 3) ... ok

test result: ok. 1 passed; 0 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.00s
";

    fn summary(said: &str) -> Summary {
        let mut summary = Summary::default();
        said.lines().for_each(|line| summary.take(line));
        summary
    }

    #[test]
    fn everything_is_counted_and_named() {
        let mut summary = summary(SAID);
        summary.end(false);
        let expected = "\
skipped:
    left: it takes a day
failed:
    it-02cd: bad::one
    it-02cd: bad::two
    dies-03ef: it died
4 passed, 3 failed, 1 skipped
";
        assert_eq!(summary.to_string(), expected);
        assert!(!summary.is_good());
    }

    #[test]
    fn skips_are_counted_and_no_skipped_test_has_passed() {
        let mut summary = summary(&SAID[..SAID.find("     Running tests/it").unwrap()]);
        summary.take_skips(
            "whole\t7 ThreadId(2)\tSKIPPED: HAL: halrun is not here: install it\n\
             part\t7 ThreadId(3)\tSKIPPED: C++: no compiler\n\
             part\t7 ThreadId(3)\tSKIPPED: C++: no compiler\n",
        );
        summary.end(true);
        let expected = "\
skipped:
    C++: no compiler (2 times)
    HAL: halrun is not here: install it
1 passed, 0 failed, 3 skipped
";
        assert_eq!(summary.to_string(), expected);
        assert!(summary.is_good());
    }

    #[test]
    fn what_failed_and_passes_alone_is_told_as_that() {
        let mut summary = summary(SAID);
        summary.end(false);
        let tests = summary.failed_tests("it");
        assert_eq!(tests, ["bad::one", "bad::two"]);
        let again = "\
     Running tests/it/main.rs (target/debug/deps/it-02cd)

running 2 tests
test bad::one ... ok
test bad::two ... FAILED

failures:
    bad::two

test result: FAILED. 1 passed; 1 failed; 0 ignored; 0 measured; 9 filtered out; finished in 9.00s
";
        summary.take_again("it", &self::summary(again));
        let expected = "\
skipped:
    left: it takes a day
failed beside others, passed alone:
    it-02cd: bad::one
failed:
    it-02cd: bad::two
    dies-03ef: it died
5 passed, 2 failed, 1 skipped
";
        assert_eq!(summary.to_string(), expected);
    }

    #[test]
    fn a_program_that_died_has_no_tests_to_run_again_and_one_that_dies_passes_none() {
        let mut summary = summary(SAID);
        assert!(summary.failed_tests("dies").is_empty());
        let tests = summary.failed_tests("it");
        let again = "\
     Running tests/it/main.rs (target/debug/deps/it-02cd)

running 2 tests
test bad::one ... ok
";
        let mut again = self::summary(again);
        again.end(false);
        summary.take_again("it", &again);
        assert_eq!(summary.failed_tests("it"), tests);
    }

    #[test]
    fn a_cargo_that_fails_without_a_test_that_fails_is_a_failure() {
        let mut summary = summary("error: could not compile `glidepath`\n");
        summary.end(false);
        assert_eq!(
            summary.to_string(),
            "failed:\n    cargo: see above\n0 passed, 1 failed, 0 skipped\n"
        );
    }
}
