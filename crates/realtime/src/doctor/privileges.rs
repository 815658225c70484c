//! The checks of what this process may do.

use super::check::Check;
use crate::host::{field, field_kib};
use crate::{Host, PLANNING_NICE};
use rustix::fs::{Access, access};

/// Bits of the capabilities in `/proc/self/status`, of capability.h.
const CAP_IPC_LOCK: u32 = 14;
const CAP_SYS_NICE: u32 = 23;

fn is_capable(status: &str, capability: u32) -> bool {
    field(status, "CapEff:")
        .and_then(|mask| u64::from_str_radix(mask, 16).ok())
        .is_some_and(|mask| mask >> capability & 1 == 1)
}

/// A soft limit of `/proc/self/limits`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SoftLimit {
    Unlimited,
    At(u64),
}

fn soft_limit(host: &Host, name: &str) -> Option<SoftLimit> {
    let limits = host.text("proc/self/limits")?;
    match field(&limits, name)?.split_whitespace().next()? {
        "unlimited" => Some(SoftLimit::Unlimited),
        number => number.parse().ok().map(SoftLimit::At),
    }
}

/// May a thread be put into `SCHED_FIFO`?
pub(super) fn scheduling(host: &Host, priority: i32) -> Check {
    let name = "scheduling";
    let status = host.text("proc/self/status").unwrap_or_default();
    if is_capable(&status, CAP_SYS_NICE) {
        return Check::ok(name, "CAP_SYS_NICE: any SCHED_FIFO priority");
    }
    let highest = match soft_limit(host, "Max realtime priority") {
        Some(SoftLimit::Unlimited) => u64::MAX,
        Some(SoftLimit::At(highest)) => highest,
        None => 0,
    };
    if highest >= u64::try_from(priority).unwrap_or(0).max(1) {
        return Check::ok(
            name,
            format!("SCHED_FIFO up to priority {highest} (rtprio)"),
        );
    }
    Check::missing(
        name,
        format!("no CAP_SYS_NICE, and rtprio is {highest} where priority {priority} is configured"),
        "systemd: AmbientCapabilities=CAP_SYS_NICE; at the shell: sudo setcap \
         cap_sys_nice,cap_ipc_lock+ep $(command -v glidepath), or `@realtime - rtprio 99` in \
         /etc/security/limits.d and a new login",
    )
}

/// May a thread that plans take precedence over ordinary ones?
pub(super) fn precedence(host: &Host) -> Check {
    let name = "planning";
    let status = host.text("proc/self/status").unwrap_or_default();
    if is_capable(&status, CAP_SYS_NICE) {
        return Check::ok(name, "CAP_SYS_NICE: precedence over ordinary processes");
    }
    // The limit counts from the other end: 20 less the nice value.
    let highest = match soft_limit(host, "Max nice priority") {
        Some(SoftLimit::Unlimited) => u64::MAX,
        Some(SoftLimit::At(highest)) => highest,
        None => 0,
    };
    let needed = 20_u64.saturating_add_signed(-i64::from(PLANNING_NICE));
    if highest >= needed {
        return Check::ok(name, "precedence over ordinary processes (nice)");
    }
    Check::warning(
        name,
        format!(
            "no CAP_SYS_NICE, and no limit that allows nice {PLANNING_NICE}: beside a busy host plans may come late"
        ),
        format!(
            "systemd: Nice={PLANNING_NICE}; at the shell: `@realtime - nice {PLANNING_NICE}` in \
             /etc/security/limits.d and a new login"
        ),
    )
}

/// May the process lock its memory?
pub(super) fn memory_lock(host: &Host) -> Check {
    let name = "memory lock";
    let status = host.text("proc/self/status").unwrap_or_default();
    if is_capable(&status, CAP_IPC_LOCK) {
        return Check::ok(name, "CAP_IPC_LOCK: any amount");
    }
    let remedy = "systemd: AmbientCapabilities=CAP_IPC_LOCK or LimitMEMLOCK=infinity; at the shell: \
                  `@realtime - memlock unlimited` in /etc/security/limits.d and a new login";
    match soft_limit(host, "Max locked memory") {
        Some(SoftLimit::Unlimited) => Check::ok(name, "any amount (memlock)"),
        Some(SoftLimit::At(bytes)) => {
            // Every mapping counts. This process maps less than an interpolator with its ports.
            let least = field_kib(&status, "VmSize:").unwrap_or(0) * 1024;
            let found = format!("no CAP_IPC_LOCK, and memlock is {} KiB", bytes / 1024);
            if bytes < least {
                Check::missing(name, found, remedy)
            } else {
                Check::warning(name, found + ": may be too little", remedy)
            }
        }
        None => Check::missing(name, "no CAP_IPC_LOCK", remedy),
    }
}

/// Has the control group time for real-time threads?
///
/// Kernels with `RT_GROUP_SCHED` and version 1 of the control groups give each group a budget,
/// which is zero for a new one: `SCHED_FIFO` then fails even for root.
pub(super) fn group_budget(host: &Host) -> Check {
    let name = "RT budget";
    let Some(group) = cpu_group(host) else {
        return Check::ok(name, "the control group has none of its own");
    };
    let file = format!("{group}/cpu.rt_runtime_us");
    match host.number(&file) {
        None => Check::ok(name, "this kernel needs none"),
        Some(us) if us > 0 => Check::ok(name, format!("{us} µs of each period for the group")),
        Some(-1) => Check::ok(name, "not limited"),
        Some(_) => Check::missing(
            name,
            "the cpu control group has no time for real-time threads",
            format!("echo 100000 > /{file}, or start the process in the root group"),
        ),
    }
}

/// Folder of the `cpu` control group (version 1) this process is in, without the leading slash.
fn cpu_group(host: &Host) -> Option<String> {
    let has_cpu = |names: &str| names.split(',').any(|name| name == "cpu");
    let groups = host.text("proc/self/cgroup")?;
    // 1:cpu,cpuacct:/path
    let group = groups.lines().find_map(|line| {
        let (controllers, path) = line.split_once(':')?.1.split_once(':')?;
        has_cpu(controllers).then_some(path)
    })?;
    let mounts = host.text("proc/self/mounts")?;
    // cgroup /sys/fs/cgroup/cpu cgroup rw,relatime,cpu 0 0
    let mount = mounts.lines().find_map(|line| {
        let mut words = line.split_whitespace().skip(1);
        let (folder, kind, options) = (words.next()?, words.next()?, words.next()?);
        (kind == "cgroup" && has_cpu(options)).then_some(folder)
    })?;
    let folder = format!("{mount}{group}");
    Some(folder.trim_matches('/').to_owned())
}

/// May the process keep the processors out of deep idle states?
pub(super) fn idle_latency(host: &Host) -> Check {
    let name = "idle states";
    let device = host.path("dev/cpu_dma_latency");
    if !device.exists() {
        return Check::missing(
            name,
            "no /dev/cpu_dma_latency",
            "use a kernel with CONFIG_CPU_IDLE and PM QoS; processor.max_cstate=1 on its command line \
             has the same effect, but a strict start asks for the device",
        );
    }
    if access(&device, Access::WRITE_OK).is_ok() {
        Check::ok(name, "/dev/cpu_dma_latency can be held")
    } else {
        Check::missing(
            name,
            "/dev/cpu_dma_latency cannot be written",
            "install deploy/udev/60-glidepath.rules and join its group: usermod -aG realtime USER",
        )
    }
}
