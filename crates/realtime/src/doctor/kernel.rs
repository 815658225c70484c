//! The checks of the kernel as a whole.

use super::check::Check;
use crate::{Host, ProcessorTime};

/// Fully preemptible or not: only then has latency a bound.
pub(super) fn preemption(host: &Host) -> Check {
    let name = "kernel";
    let release = host
        .line("proc/sys/kernel/osrelease")
        .unwrap_or_else(|| "unknown".to_owned());
    let version = host.line("proc/sys/kernel/version").unwrap_or_default();
    let is_real_time =
        version.contains("PREEMPT_RT") || host.number("sys/kernel/realtime") == Some(1);
    if is_real_time {
        Check::ok(name, format!("{release}, PREEMPT_RT"))
    } else {
        let kind = ["PREEMPT_DYNAMIC", "PREEMPT"]
            .into_iter()
            .find(|kind| version.contains(kind))
            .unwrap_or("not preemptible");
        Check::warning(
            name,
            format!("{release}, {kind}: no upper bound of latency"),
            "install a PREEMPT_RT kernel (Debian: apt install linux-image-rt-amd64; Ubuntu: pro enable \
             realtime-kernel)",
        )
    }
}

/// How much of each second all real-time threads together may run.
pub(super) fn throttling(host: &Host) -> Check {
    let name = "throttling";
    let period = host
        .number("proc/sys/kernel/sched_rt_period_us")
        .filter(|us| *us > 0)
        .unwrap_or(1_000_000);
    let remedy = "sysctl -w kernel.sched_rt_runtime_us=950000 (in /etc/sysctl.d to keep it)";
    match host.number("proc/sys/kernel/sched_rt_runtime_us") {
        None => Check::ok(name, "this kernel has none"),
        Some(-1) => Check::warning(
            name,
            "off: a real-time thread that runs wild takes its processor for good",
            remedy,
        ),
        Some(0) => Check::missing(name, "real-time threads may not run at all", remedy),
        Some(us) => {
            let percent = us.saturating_mul(100) / period;
            let found = format!("real-time threads may run {percent} % of the time");
            if percent < 50 {
                Check::warning(name, found, remedy)
            } else {
                Check::ok(name, found)
            }
        }
    }
}

/// Clocks that are read without a system call and without a bus.
const QUICK_CLOCKS: [&str; 5] = [
    "tsc",
    "kvm-clock",
    "hyperv_clocksource_tsc_page",
    "arch_sys_counter",
    "riscv_clocksource",
];

/// What the time is read from.
pub(super) fn clock_source(host: &Host) -> Check {
    let name = "clock source";
    let folder = "sys/devices/system/clocksource/clocksource0";
    let Some(current) = host.line(&format!("{folder}/current_clocksource")) else {
        return Check::ok(name, "the host does not tell");
    };
    if QUICK_CLOCKS.contains(&current.as_str()) {
        return Check::ok(name, current);
    }
    let available = host
        .line(&format!("{folder}/available_clocksource"))
        .unwrap_or_default();
    let quick = available
        .split_whitespace()
        .find(|clock| QUICK_CLOCKS.contains(clock));
    let remedy = quick.map_or_else(
        || {
            "add tsc=reliable to the kernel's command line if the hardware's TSC is invariant"
                .into()
        },
        |clock| format!("add clocksource={clock} to the kernel's command line"),
    );
    Check::warning(name, format!("{current}: slow to read"), remedy)
}

/// Time the hypervisor took away since the start of the host.
pub(super) fn steal(host: &Host) -> Check {
    let name = "steal time";
    let Some(time) = ProcessorTime::read(host, None) else {
        return Check::ok(name, "the host does not tell");
    };
    if time.steal == 0 {
        return Check::ok(name, "none since the start of the host");
    }
    #[allow(clippy::cast_precision_loss, reason = "for display")]
    let percent = 100.0 * time.steal as f64 / time.total.max(1) as f64;
    Check::warning(
        name,
        format!(
            "{percent:.2} % since the start of the host ({:.1} s): this is a guest that has to wait \
             for its processor",
            time.steal_s()
        ),
        "run the interpolator on hardware of its own, or give the guest dedicated processors",
    )
}
