//! cyclictest of the rt-tests, the usual measure of a host's latency, run beside the loop.
//!
//! Both threads have the same priority on the same processor and the same period, and run in the
//! same time, but never wake together: see `section`.

use super::section::Section;
use super::setup::Setup;
use glidepath_realtime::{Grants, Item};
use std::collections::BTreeMap;
use std::io;
use std::process::{Child, Command, Stdio};

/// Longest latency cyclictest resolves, µs. Longer ones are only counted.
const LONGEST_US: u64 = 100_000;

/// The reason why there are no figures of cyclictest.
#[derive(Debug, thiserror::Error)]
pub enum CyclictestError {
    /// It is not installed.
    #[error(
        "cyclictest is not installed; install it (Debian, Ubuntu: apt install rt-tests; Fedora: dnf \
         install realtime-tests), or leave out --against-cyclictest"
    )]
    Absent,
    /// It could not be started or waited for.
    #[error("cannot run cyclictest: {0}")]
    Run(io::Error),
    /// It ended with an error.
    #[error("cyclictest failed ({status}): {message}")]
    Failed {
        /// How it ended.
        status: std::process::ExitStatus,
        /// What it said.
        message: String,
    },
    /// Its histogram cannot be understood.
    #[error("cyclictest printed something else than a histogram: no {0}")]
    Output(&'static str),
}

/// A running cyclictest; ended when dropped.
#[derive(Debug)]
pub(super) struct Cyclictest(Option<Child>);

impl Cyclictest {
    /// Starts it with what the loop was granted. It begins at the next whole second, unless that is
    /// less than 0.1 s away.
    pub(super) fn start(
        setup: &Setup,
        section: &Section,
        grants: &Grants,
    ) -> Result<Self, CyclictestError> {
        Command::new("cyclictest")
            .args(arguments(setup, section, grants))
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map(|child| Self(Some(child)))
            .map_err(|error| match error.kind() {
                io::ErrorKind::NotFound => CyclictestError::Absent,
                _ => CyclictestError::Run(error),
            })
    }

    /// Waits for its end, and reads its histogram.
    pub(super) fn finish(mut self) -> Result<Latencies, CyclictestError> {
        let child = self.0.take().ok_or(CyclictestError::Output("process"))?;
        let output = child.wait_with_output().map_err(CyclictestError::Run)?;
        if !output.status.success() {
            let message = String::from_utf8_lossy(&output.stderr).trim().to_owned();
            return Err(CyclictestError::Failed {
                status: output.status,
                message,
            });
        }
        Latencies::parse(&String::from_utf8_lossy(&output.stdout))
    }
}

impl Drop for Cyclictest {
    fn drop(&mut self) {
        if let Some(mut child) = self.0.take() {
            // Fails only if it has ended by itself.
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

fn arguments(setup: &Setup, section: &Section, grants: &Grants) -> Vec<String> {
    let mut arguments = vec![
        "--quiet".to_owned(),
        format!("--secaligned={}", section.cyclictest_offset_ns / 1_000),
        format!("--interval={}", setup.period_ns / 1_000),
        format!("--duration={}", section.seconds),
        format!("--histogram={LONGEST_US}"),
    ];
    if let Some(priority) = setup
        .request
        .priority
        .filter(|_| grants.is_granted(Item::Scheduling))
    {
        arguments.push(format!("--priority={priority}"));
    }
    if let Some(cpu) = setup
        .request
        .cpu
        .filter(|_| grants.is_granted(Item::Affinity))
    {
        arguments.push(format!("--affinity={cpu}"));
    }
    if grants.is_granted(Item::MemoryLock) {
        arguments.push("--mlockall".to_owned());
    }
    arguments
}

/// The latencies that cyclictest saw.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Latencies {
    /// µs, rounded down, and how many; ascending.
    pub counts: Vec<(u64, u64)>,
    /// Latencies longer than the histogram.
    pub overflows: u64,
    /// The largest, µs, rounded down.
    pub max_us: u64,
}

impl Latencies {
    /// From the output of `cyclictest --quiet --histogram=…` with one thread.
    ///
    /// # Errors
    /// The output has no histogram, or no line for the maximum.
    pub fn parse(text: &str) -> Result<Self, CyclictestError> {
        // 000016 000001
        let count = |line: &str| {
            let (us, count) = line.split_once([' ', '\t'])?;
            Some((us.parse().ok()?, count.trim().parse().ok()?))
        };
        let counts: Vec<(u64, u64)> = text
            .lines()
            .filter_map(count)
            .filter(|(_, count)| *count > 0)
            .collect();
        let summary = |name: &str| {
            let rest = text.lines().find_map(|line| line.strip_prefix(name))?;
            rest.trim().parse().ok()
        };
        let overflows = summary("# Histogram Overflows:").unwrap_or(0);
        if counts.is_empty() && overflows == 0 {
            return Err(CyclictestError::Output("count"));
        }
        Ok(Self {
            counts,
            overflows,
            max_us: summary("# Max Latencies:").ok_or(CyclictestError::Output("maximum"))?,
        })
    }

    /// Counts everything that other latencies hold.
    pub fn merge(&mut self, other: &Self) {
        let mut counts: BTreeMap<u64, u64> = self.counts.iter().copied().collect();
        for (us, count) in &other.counts {
            *counts.entry(*us).or_default() += count;
        }
        self.counts = counts.into_iter().collect();
        self.overflows += other.overflows;
        self.max_us = self.max_us.max(other.max_us);
    }

    /// Number of periods.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.overflows + self.counts.iter().map(|(_, count)| count).sum::<u64>()
    }

    /// The smallest latency that `part` (0 to 1) of all do not exceed, µs, rounded down. Of those
    /// beyond the histogram only the largest is known.
    #[must_use]
    #[allow(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "counts far below 2⁵³"
    )]
    pub fn quantile_us(&self, part: f64) -> u64 {
        let rank = ((part * self.total() as f64).ceil() as u64).max(1);
        let mut sum = 0;
        for (us, count) in &self.counts {
            sum += count;
            if sum >= rank {
                return *us;
            }
        }
        self.max_us
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_realtime::{Mode, Request};

    const OUTPUT: &str = "# /dev/cpu_dma_latency set to 0us\n# Histogram\n000015 000000\n\
        000016 000090\n000017 000008\n000300 000001\n# Total: 000000099\n# Min Latencies: 00016\n\
        # Avg Latencies: 00030\n# Max Latencies: 01729\n# Histogram Overflows: 00001\n\
        # Histogram Overflow at cycle number:\n# Thread 0: 00148\n";

    #[test]
    fn the_histogram_is_read() {
        let latencies = Latencies::parse(OUTPUT).unwrap();
        assert_eq!(latencies.counts, [(16, 90), (17, 8), (300, 1)]);
        assert_eq!((latencies.total(), latencies.max_us), (100, 1729));
        let quantiles = [0.0, 0.5, 0.9, 0.91, 0.98, 0.99, 0.999].map(|q| latencies.quantile_us(q));
        assert_eq!(quantiles, [16, 16, 16, 17, 17, 300, 1729]);
    }

    #[test]
    fn merging_is_counting_both() {
        let mut both = Latencies::parse(OUTPUT).unwrap();
        let other =
            Latencies::parse("000017 000002\n000019 000001\n# Max Latencies: 00019\n").unwrap();
        both.merge(&other);
        assert_eq!(both.counts, [(16, 90), (17, 10), (19, 1), (300, 1)]);
        assert_eq!((both.total(), both.max_us), (103, 1729));
    }

    #[test]
    fn something_else_is_no_histogram() {
        for text in [
            "",
            "usage: cyclictest\n",
            "# Max Latencies: 00009\n",
            "16 1\n",
        ] {
            assert!(Latencies::parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn only_what_was_granted_is_asked_for() {
        let setup = Setup {
            period_ns: 4_000_000,
            seconds: 20,
            request: Request {
                priority: Some(80),
                cpu: Some(1),
                ..Request::default()
            },
            mode: Mode::BestEffort,
            motion: None,
            against_cyclictest: true,
        };
        let section = Section {
            seconds: 10,
            offset_ns: 3_000_000,
            cyclictest_offset_ns: 1_000_000,
        };
        let arguments = arguments(&setup, &section, &Grants::NONE).join(" ");
        assert_eq!(
            arguments,
            "--quiet --secaligned=1000 --interval=4000 --duration=10 --histogram=100000"
        );
    }
}
