//! The checks of a network interface that drives hang on.

use super::check::Check;
use crate::Host;
use crate::host::field;

/// Bit of a capability in the masks of `/proc/self/status`.
const NET_RAW: u32 = 13;
const UP: i64 = 1;
const LOOPBACK: i64 = 1 << 3;

fn file(name: &str, what: &str) -> String {
    format!("sys/class/net/{name}/{what}")
}

/// Is there such an interface, and is it one of Ethernet?
pub(super) fn exists(host: &Host, name: &str) -> Check {
    let what = "interface";
    if name.contains('/') || !host.path(&file(name, "")).is_dir() {
        return Check::missing(
            what,
            format!("there is no `{name}`"),
            "`ip -br link` lists those there are",
        );
    }
    let flags = flags(host, name);
    if flags & LOOPBACK != 0 {
        return Check::missing(
            what,
            format!("{name} is the loopback"),
            "choose a port of a card",
        );
    }
    if host.path(&file(name, "wireless")).exists() {
        return Check::missing(
            what,
            format!("{name} is wireless"),
            "drives need a port of their own, without a switch",
        );
    }
    if host.path(&file(name, "device")).exists() {
        Check::ok(what, name)
    } else {
        Check::warning(
            what,
            format!("{name} is virtual"),
            "drives that are there hang on a port of a card",
        )
    }
}

fn flags(host: &Host, name: &str) -> i64 {
    let flags = host.line(&file(name, "flags")).unwrap_or_default();
    let hex = flags.trim_start_matches("0x");
    i64::from_str_radix(hex, 16).unwrap_or(0)
}

/// Is it up, and is there a cable?
pub(super) fn link(host: &Host, name: &str) -> Check {
    let what = "link";
    if flags(host, name) & UP == 0 {
        return Check::missing(what, "it is down", format!("`ip link set {name} up`"));
    }
    if host.number(&file(name, "carrier")) == Some(1) {
        let speed = host.number(&file(name, "speed"));
        let speed = speed.filter(|speed| *speed > 0);
        return Check::ok(
            what,
            speed.map_or_else(|| "up".to_owned(), |speed| format!("up, {speed} Mbit/s")),
        );
    }
    Check::missing(
        what,
        "no carrier",
        "plug the cable into the IN port of the first drive, and switch its logic supply on",
    )
}

/// Does anything else send there?
pub(super) fn sole_use(host: &Host, name: &str) -> Check {
    let what = "sole use";
    if host.path(&file(name, "master")).exists() {
        return Check::warning(
            what,
            format!("{name} belongs to a bridge or a bond"),
            format!("`ip link set {name} nomaster`"),
        );
    }
    let switch = format!("proc/sys/net/ipv6/conf/{name}/disable_ipv6");
    if host.number(&switch) == Some(0) {
        return Check::warning(
            what,
            "IPv6 is on: the host sends frames of its own to the drives",
            format!(
                "`sysctl net.ipv6.conf.{name}.disable_ipv6=1`, and have no network manager see to it"
            ),
        );
    }
    Check::ok(what, "IPv6 is off")
}

/// May this process send raw frames?
pub(super) fn raw_frames(host: &Host) -> Check {
    let what = "raw frames";
    let status = host.text("proc/self/status").unwrap_or_default();
    let mask = field(&status, "CapEff:").and_then(|mask| u64::from_str_radix(mask, 16).ok());
    if mask.is_some_and(|mask| mask >> NET_RAW & 1 == 1) {
        Check::ok(what, "CAP_NET_RAW")
    } else {
        Check::missing(
            what,
            "no CAP_NET_RAW",
            "AmbientCapabilities=CAP_NET_RAW for a service, or `setcap cap_net_raw+ep` for the binary",
        )
    }
}

/// How long the card keeps frames back to save interrupts is known to `ethtool` alone.
pub(super) fn coalescing(name: &str) -> Check {
    Check::warning(
        "coalescing",
        "not known: the card may keep frames back for some 50 µs",
        format!("`ethtool -C {name} rx-usecs 0 tx-usecs 0`, and look with `ethtool -c {name}`"),
    )
}
