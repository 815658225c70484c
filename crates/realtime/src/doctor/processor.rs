//! The checks of the processor that the real-time thread is pinned to.

use super::check::Check;
use crate::Host;
use crate::host::{CpuList, field};
use std::fs;

const CPUS: &str = "sys/devices/system/cpu";

fn list(host: &Host, path: &str) -> Option<CpuList> {
    host.line(path).map(|text| CpuList::parse(&text))
}

/// No processor was chosen, so that nothing can be said of it.
pub(super) fn not_chosen() -> Check {
    Check::warning(
        "processor",
        "none is configured: the thread may move from one to another",
        "set interpolator.cpu to an isolated processor",
    )
}

/// Does the processor exist, and may this process use it?
pub(super) fn available(host: &Host, cpu: usize) -> Check {
    let name = "processor";
    if list(host, &format!("{CPUS}/online")).is_some_and(|online| !online.contains(cpu)) {
        return Check::missing(
            name,
            format!("CPU {cpu} does not exist or is off line"),
            "set interpolator.cpu to one of those that `nproc --all` counts from 0",
        );
    }
    let status = host.text("proc/self/status").unwrap_or_default();
    let is_allowed = field(&status, "Cpus_allowed_list:")
        .is_none_or(|allowed| CpuList::parse(allowed).contains(cpu));
    if is_allowed {
        Check::ok(name, format!("CPU {cpu}"))
    } else {
        // Affinity is no obstacle, a set of processors is: this cannot be told apart from here.
        Check::warning(
            name,
            format!("CPU {cpu} is not among those this process was started on"),
            "if the start is refused: add it to CPUAffinity=, to AllowedCPUs= and to the control \
             group's cpuset.cpus",
        )
    }
}

/// Does the kernel keep other threads off?
pub(super) fn isolation(host: &Host, cpu: usize) -> Check {
    let name = "isolation";
    if list(host, &format!("{CPUS}/isolated")).is_some_and(|isolated| isolated.contains(cpu)) {
        Check::ok(name, format!("CPU {cpu} is isolated"))
    } else {
        Check::warning(
            name,
            format!("CPU {cpu} is shared with every other thread"),
            format!("add isolcpus=managed_irq,domain,{cpu} to the kernel's command line"),
        )
    }
}

/// Does the kernel leave out its own tick while one thread runs?
pub(super) fn tickless(host: &Host, cpu: usize) -> Check {
    let name = "kernel tick";
    if list(host, &format!("{CPUS}/nohz_full")).is_some_and(|nohz| nohz.contains(cpu)) {
        Check::ok(name, format!("CPU {cpu} is in nohz_full"))
    } else {
        Check::warning(
            name,
            format!("CPU {cpu} has the kernel's tick and its deferred work"),
            format!("add nohz_full={cpu} rcu_nocbs={cpu} to the kernel's command line"),
        )
    }
}

/// Interrupts shown by number; the others are only counted.
const SHOWN: usize = 8;

/// Do devices interrupt the processor?
pub(super) fn interrupts(host: &Host, cpu: usize) -> Check {
    let name = "interrupts";
    let Ok(folder) = fs::read_dir(host.path("proc/irq")) else {
        return Check::ok(name, "the host does not tell");
    };
    let mut numbers: Vec<u32> = folder
        .filter_map(|entry| entry.ok()?.file_name().to_str()?.parse().ok())
        .filter(|number| serves(host, *number, cpu))
        .collect();
    if numbers.is_empty() {
        return Check::ok(name, format!("no device interrupts CPU {cpu}"));
    }
    numbers.sort_unstable();
    let more = numbers.len().saturating_sub(SHOWN);
    let mut words: Vec<String> = numbers.iter().take(SHOWN).map(u32::to_string).collect();
    if more > 0 {
        words.push(format!("{more} more"));
    }
    Check::warning(
        name,
        format!("IRQ {} may come on CPU {cpu}", words.join(", ")),
        "add irqaffinity= with the other processors to the kernel's command line, ban the processor \
         in irqbalance, or write the others to /proc/irq/N/smp_affinity_list",
    )
}

/// Whether an interrupt is delivered to the processor: where it goes, else where it may go.
fn serves(host: &Host, irq: u32, cpu: usize) -> bool {
    ["effective_affinity_list", "smp_affinity_list"]
        .into_iter()
        .find_map(|file| list(host, &format!("proc/irq/{irq}/{file}")))
        .is_some_and(|cpus| cpus.contains(cpu))
}

/// Is the core shared with a second hardware thread?
pub(super) fn siblings(host: &Host, cpu: usize) -> Check {
    let name = "hardware threads";
    let path = format!("{CPUS}/cpu{cpu}/topology/thread_siblings_list");
    let Some(siblings) = host.line(&path) else {
        return Check::ok(name, "the host does not tell");
    };
    if siblings == cpu.to_string() {
        Check::ok(name, format!("CPU {cpu} has its core to itself"))
    } else {
        Check::warning(
            name,
            format!("CPUs {siblings} share one core"),
            "add nosmt to the kernel's command line, or isolate the sibling too and leave it idle",
        )
    }
}

/// Does the frequency follow the load?
pub(super) fn governor(host: &Host, cpu: usize) -> Check {
    let name = "frequency";
    let path = format!("{CPUS}/cpu{cpu}/cpufreq/scaling_governor");
    match host.line(&path).as_deref() {
        None => Check::ok(name, "the kernel does not scale it"),
        Some("performance") => Check::ok(name, "governor performance"),
        Some(other) => Check::warning(
            name,
            format!("governor {other}: the processor is slow when the tick comes"),
            format!("cpupower -c {cpu} frequency-set -g performance (at every start)"),
        ),
    }
}

/// Was the processor slowed down because it was hot?
pub(super) fn overheating(host: &Host, cpu: usize) -> Check {
    let name = "temperature";
    let folder = format!("{CPUS}/cpu{cpu}/thermal_throttle");
    let times: Vec<i64> = ["core_throttle_count", "package_throttle_count"]
        .into_iter()
        .filter_map(|file| host.number(&format!("{folder}/{file}")))
        .collect();
    match times.iter().max() {
        None => Check::ok(name, "the host does not tell"),
        Some(0) => Check::ok(name, "never throttled"),
        Some(times) => Check::warning(
            name,
            format!("throttled {times} times since the start of the host"),
            "improve the cooling, or lower the highest frequency",
        ),
    }
}
