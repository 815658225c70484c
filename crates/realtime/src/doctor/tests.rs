//! Tests of the checks, on made-up hosts.

use super::*;
use std::fs;
use tempfile::TempDir;

/// A host that consists of the given files.
fn host(files: &[(&str, &str)]) -> (TempDir, Host) {
    let folder = tempfile::tempdir().unwrap();
    for (path, text) in files {
        let path = folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    let host = Host::at(folder.path());
    (folder, host)
}

const GOOD: &[(&str, &str)] = &[
    ("proc/sys/kernel/osrelease", "6.12.0-rt\n"),
    ("proc/sys/kernel/version", "#1 SMP PREEMPT_RT\n"),
    ("proc/sys/kernel/sched_rt_runtime_us", "950000\n"),
    ("proc/sys/kernel/sched_rt_period_us", "1000000\n"),
    (
        "proc/self/status",
        "VmSize:\t  9000 kB\nCapEff:\t0000000000804000\nCpus_allowed_list:\t0-3\n",
    ),
    (
        "proc/self/limits",
        "Max locked memory         8388608  8388608 bytes\n",
    ),
    ("proc/stat", "cpu  30 2 10 200 5 0 3 0 0 0\n"),
    ("proc/irq/9/smp_affinity_list", "0-3\n"),
    ("proc/irq/9/effective_affinity_list", "0\n"),
    ("dev/cpu_dma_latency", ""),
    (
        "sys/devices/system/clocksource/clocksource0/current_clocksource",
        "tsc\n",
    ),
    ("sys/devices/system/cpu/online", "0-3\n"),
    ("sys/devices/system/cpu/isolated", "2-3\n"),
    ("sys/devices/system/cpu/nohz_full", "2-3\n"),
    (
        "sys/devices/system/cpu/cpu3/topology/thread_siblings_list",
        "3\n",
    ),
    (
        "sys/devices/system/cpu/cpu3/cpufreq/scaling_governor",
        "performance\n",
    ),
    (
        "sys/devices/system/cpu/cpu3/thermal_throttle/core_throttle_count",
        "0\n",
    ),
];

const DEMAND: RealTimeDemand = RealTimeDemand {
    cpu: Some(3),
    priority: 80,
};

/// The check of that name on the good host with one file changed.
fn with(name: &str, path: &str, text: &str) -> Check {
    let mut files = GOOD.to_vec();
    files.push((path, text));
    let (_folder, host) = host(&files);
    examine(&host, DEMAND)
        .into_iter()
        .find(|check| check.name == name)
        .unwrap()
}

#[test]
fn a_good_host_has_nothing_to_mend() {
    let (_folder, host) = host(GOOD);
    let checks = examine(&host, DEMAND);
    assert_eq!(checks.len(), 16);
    for check in checks {
        assert_eq!(
            (check.verdict, check.remedy),
            (CheckVerdict::Ok, None),
            "{}",
            check.found
        );
    }
}

/// Check, file, its text, verdict, part of the remedy.
const DEFECTS: &[(&str, &str, &str, CheckVerdict, &str)] = &[
    (
        "kernel",
        "proc/sys/kernel/version",
        "#1 SMP PREEMPT_DYNAMIC",
        CheckVerdict::Warning,
        "PREEMPT_RT",
    ),
    (
        "throttling",
        "proc/sys/kernel/sched_rt_runtime_us",
        "-1",
        CheckVerdict::Warning,
        "950000",
    ),
    (
        "throttling",
        "proc/sys/kernel/sched_rt_runtime_us",
        "0",
        CheckVerdict::Missing,
        "950000",
    ),
    (
        "throttling",
        "proc/sys/kernel/sched_rt_runtime_us",
        "100000",
        CheckVerdict::Warning,
        "950000",
    ),
    (
        "scheduling",
        "proc/self/status",
        "CapEff:\t0000000000000000\n",
        CheckVerdict::Missing,
        "CAP_SYS_NICE",
    ),
    (
        "planning",
        "proc/self/status",
        "CapEff:\t0000000000000000\n",
        CheckVerdict::Warning,
        "Nice=-15",
    ),
    (
        "memory lock",
        "proc/self/status",
        "VmSize:\t8000 kB\n",
        CheckVerdict::Warning,
        "CAP_IPC_LOCK",
    ),
    (
        "memory lock",
        "proc/self/status",
        "VmSize:\t9000 kB\n",
        CheckVerdict::Missing,
        "CAP_IPC_LOCK",
    ),
    (
        "steal time",
        "proc/stat",
        "cpu  30 2 10 200 5 0 3 50 0 0\n",
        CheckVerdict::Warning,
        "dedicated",
    ),
    (
        "processor",
        "sys/devices/system/cpu/online",
        "0-2",
        CheckVerdict::Missing,
        "interpolator.cpu",
    ),
    (
        "processor",
        "proc/self/status",
        "Cpus_allowed_list:\t0-1\n",
        CheckVerdict::Warning,
        "cpuset",
    ),
    (
        "isolation",
        "sys/devices/system/cpu/isolated",
        "",
        CheckVerdict::Warning,
        "isolcpus=managed_irq,domain,3",
    ),
    (
        "kernel tick",
        "sys/devices/system/cpu/nohz_full",
        "(null)",
        CheckVerdict::Warning,
        "nohz_full=3",
    ),
    (
        "interrupts",
        "proc/irq/10/smp_affinity_list",
        "2-3",
        CheckVerdict::Warning,
        "irqaffinity=",
    ),
    (
        "hardware threads",
        "sys/devices/system/cpu/cpu3/topology/thread_siblings_list",
        "1,3",
        CheckVerdict::Warning,
        "nosmt",
    ),
    (
        "frequency",
        "sys/devices/system/cpu/cpu3/cpufreq/scaling_governor",
        "powersave",
        CheckVerdict::Warning,
        "cpupower -c 3",
    ),
    (
        "temperature",
        "sys/devices/system/cpu/cpu3/thermal_throttle/package_throttle_count",
        "7",
        CheckVerdict::Warning,
        "cooling",
    ),
];

#[test]
fn every_defect_is_found_and_has_a_remedy() {
    for (name, path, text, verdict, remedy) in DEFECTS {
        let check = with(name, path, text);
        assert_eq!(check.verdict, *verdict, "{name}: {}", check.found);
        assert!(check.remedy.unwrap().contains(remedy), "{name}");
    }
}

#[test]
fn limits_stand_in_for_capabilities() {
    let limits = "Max locked memory         unlimited   unlimited   bytes\n\
                  Max nice priority         35          35\n\
                  Max realtime priority     95          95\n";
    let with_limit = |limits| {
        host(&[
            ("proc/self/status", "CapEff:\t0000000000000000\n"),
            ("proc/self/limits", limits),
        ])
    };
    let (_folder, host) = with_limit(limits);
    assert_eq!(privileges::scheduling(&host, 80).verdict, CheckVerdict::Ok);
    assert_eq!(
        privileges::scheduling(&host, 96).verdict,
        CheckVerdict::Missing
    );
    assert_eq!(privileges::memory_lock(&host).verdict, CheckVerdict::Ok);
    assert_eq!(privileges::precedence(&host).verdict, CheckVerdict::Ok);
    let (_folder, host) = with_limit("Max nice priority         34          34\n");
    assert_eq!(privileges::precedence(&host).verdict, CheckVerdict::Warning);
}

#[test]
fn a_group_without_real_time_budget_is_named() {
    let groups = "3:cpuset:/a\n1:cpu,cpuacct:/a/b\n0::/c\n";
    let mounts = "cgroup /sys/fs/cgroup/cpuset cgroup rw,cpuset 0 0\n\
                  cgroup /sys/fs/cgroup/cpu,cpuacct cgroup rw,relatime,cpu,cpuacct 0 0\n";
    let budget = |us: Option<&str>| {
        let file = "sys/fs/cgroup/cpu,cpuacct/a/b/cpu.rt_runtime_us";
        let mut files = vec![("proc/self/cgroup", groups), ("proc/self/mounts", mounts)];
        files.extend(us.map(|us| (file, us)));
        let (_folder, host) = host(&files);
        privileges::group_budget(&host)
    };
    let none = budget(Some("0\n"));
    assert_eq!(none.verdict, CheckVerdict::Missing);
    assert!(
        none.remedy
            .unwrap()
            .contains("/sys/fs/cgroup/cpu,cpuacct/a/b/cpu.rt_runtime_us")
    );
    assert_eq!(budget(Some("100000\n")).verdict, CheckVerdict::Ok);
    assert_eq!(budget(None).verdict, CheckVerdict::Ok);
}

#[test]
fn a_slow_clock_names_a_quicker_one() {
    let folder = "sys/devices/system/clocksource/clocksource0";
    let current = (&*format!("{folder}/current_clocksource"), "hpet\n");
    let available = (&*format!("{folder}/available_clocksource"), "hpet tsc\n");
    let (_folder, host) = host(&[current, available]);
    let check = kernel::clock_source(&host);
    assert_eq!(check.verdict, CheckVerdict::Warning);
    assert!(check.remedy.unwrap().contains("clocksource=tsc"));
}

#[test]
fn a_host_that_tells_nothing_is_not_fit() {
    let (_folder, host) = host(&[]);
    let missing: Vec<_> = examine(&host, DEMAND)
        .into_iter()
        .filter(|check| check.verdict == CheckVerdict::Missing)
        .map(|check| check.name)
        .collect();
    assert_eq!(missing, ["scheduling", "memory lock", "idle states"]);
}

#[test]
fn without_a_processor_that_is_the_finding() {
    let (_folder, host) = host(GOOD);
    let demand = RealTimeDemand {
        cpu: None,
        ..DEMAND
    };
    let checks = examine(&host, demand);
    assert!(
        checks
            .iter()
            .any(|c| c.name == "processor" && c.verdict == CheckVerdict::Warning)
    );
}

#[test]
fn an_interface_for_drives_is_one_of_a_card_with_a_cable_and_nobody_else() {
    let mut files = vec![
        ("sys/class/net/enp3s0/flags", "0x1003\n"),
        ("sys/class/net/enp3s0/carrier", "1\n"),
        ("sys/class/net/enp3s0/speed", "100\n"),
        ("sys/class/net/enp3s0/device/vendor", "0x8086\n"),
        ("proc/sys/net/ipv6/conf/enp3s0/disable_ipv6", "1\n"),
        ("proc/self/status", "CapEff:\t0000000000002000\n"),
    ];
    let verdicts = |files: &[(&str, &str)], name: &str| {
        let (_folder, host) = host(files);
        let checks = examine_interface(&host, name);
        checks
            .into_iter()
            .map(|check| (check.name, check.verdict))
            .collect::<Vec<_>>()
    };
    let good = [
        ("interface", CheckVerdict::Ok),
        ("link", CheckVerdict::Ok),
        ("raw frames", CheckVerdict::Ok),
        ("sole use", CheckVerdict::Ok),
        ("coalescing", CheckVerdict::Warning),
    ];
    assert_eq!(verdicts(&files, "enp3s0"), good);
    assert_eq!(
        verdicts(&files, "enp4s0"),
        [("interface", CheckVerdict::Missing)]
    );
    files[1].1 = "0\n";
    files[4].1 = "0\n";
    files[5].1 = "CapEff:\t0000000000000000\n";
    let bad = verdicts(&files, "enp3s0");
    let of = |name: &str| bad.iter().find(|(n, _)| *n == name).unwrap().1;
    assert_eq!(
        (of("link"), of("raw frames")),
        (CheckVerdict::Missing, CheckVerdict::Missing)
    );
    assert_eq!(of("sole use"), CheckVerdict::Warning);
    files[0].1 = "0x9\n";
    assert_eq!(
        verdicts(&files, "enp3s0")[0],
        ("interface", CheckVerdict::Missing)
    );
}
