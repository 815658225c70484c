//! Facts about the host that decide how well it keeps time.

use std::fs;

/// What the kernel says of itself. Each fact is `None` where the host does not tell.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct HostFacts {
    /// Kernel release, e.g. `6.12.0-rt`.
    pub kernel: Option<String>,
    /// The kernel is fully preemptible (`PREEMPT_RT`): only then has latency a bound.
    pub preempt_rt: bool,
    /// `kernel.sched_rt_runtime_us`: how much of every second real-time threads may run; −1 is all.
    pub rt_runtime_us: Option<i64>,
    /// Source of the clock; anything but `tsc` (or an architecture's counter) is slow to read.
    pub clock_source: Option<String>,
    /// Processors the kernel keeps other work off (`isolcpus`), as a list such as `2-3`.
    pub isolated_cpus: Option<String>,
    /// The processor says that it is a guest of a hypervisor, whose scheduling adds to latency.
    pub virtual_machine: bool,
}

impl HostFacts {
    /// Reads them. Never fails: what cannot be read is absent.
    #[must_use]
    pub fn read() -> Self {
        let kernel = line("/proc/sys/kernel/osrelease");
        let version = line("/proc/sys/kernel/version").unwrap_or_default();
        Self {
            preempt_rt: version.contains("PREEMPT_RT")
                || line("/sys/kernel/realtime").as_deref() == Some("1"),
            kernel,
            rt_runtime_us: line("/proc/sys/kernel/sched_rt_runtime_us")
                .and_then(|text| text.parse().ok()),
            clock_source: line("/sys/devices/system/clocksource/clocksource0/current_clocksource"),
            isolated_cpus: line("/sys/devices/system/cpu/isolated").filter(|l| !l.is_empty()),
            virtual_machine: fs::read_to_string("/proc/cpuinfo").is_ok_and(|text| {
                text.lines()
                    .any(|l| l.starts_with("flags") && l.contains(" hypervisor"))
            }),
        }
    }
}

fn line(path: &str) -> Option<String> {
    fs::read_to_string(path)
        .ok()
        .map(|text| text.trim().to_owned())
}

/// A value in KiB of a file like `/proc/self/status`.
pub(crate) fn field_kib(status: &str, name: &str) -> Option<u64> {
    let rest = status.lines().find_map(|line| line.strip_prefix(name))?;
    rest.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_of_status_are_found() {
        let status = "VmPeak:\t  9000 kB\nVmLck:\t   120 kB\n";
        assert_eq!(field_kib(status, "VmLck:"), Some(120));
        assert_eq!(field_kib(status, "VmPin:"), None);
    }

    #[test]
    fn every_linux_tells_its_release() {
        let facts = HostFacts::read();
        assert!(facts.kernel.is_some_and(|kernel| kernel.contains('.')));
    }
}
