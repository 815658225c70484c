//! A network namespace with a pair of virtual interfaces.
//!
//! Root makes one without more; others by way of a user namespace, in which they are themselves, but
//! have the rights over that network. `unshare` (util-linux) and `ip` (iproute2) do it: this program
//! starts itself again in there, as the same process.

use crate::command::failure::Failure;
use std::os::unix::process::CommandExt as _;
use std::process::{Command, Stdio};

/// The end of the master, and that of the drives.
pub(super) const MASTER: &str = "gp-master";
pub(super) const DRIVES: &str = "gp-drives";

/// Ways to a namespace: the first that works is taken.
const WAYS: [&[&str]; 2] = [&["--net"], &["--net", "--map-current-user", "--keep-caps"]];

fn works(way: &[&str]) -> bool {
    let status = Command::new("unshare")
        .args(way)
        .args(["--", "true"])
        .stdin(Stdio::null())
        .stderr(Stdio::null())
        .status();
    status.is_ok_and(|status| status.success())
}

/// Starts this program again in a namespace. Returns only if that is not possible.
pub(super) fn enter() -> Failure {
    let Some(way) = WAYS.into_iter().find(|way| works(way)) else {
        return Failure::NotEmulated(
            "neither root's nor a user's network namespaces are to be had. It takes `unshare` of \
             util-linux, and kernel.unprivileged_userns_clone=1 or root; containers often forbid it"
                .to_owned(),
        );
    };
    let program = match std::env::current_exe() {
        Ok(program) => program,
        Err(error) => return Failure::Process(error),
    };
    let error = Command::new("unshare")
        .args(way)
        .arg("--")
        .arg(program)
        .args(std::env::args_os().skip(1))
        .arg("--in-namespace")
        .exec();
    Failure::Process(error)
}

/// Makes the pair of interfaces.
///
/// # Errors
/// There is no `ip`, or the kernel has no such interfaces.
pub(super) fn make_interfaces() -> Result<(), Failure> {
    ip(&[
        "link", "add", "name", MASTER, "type", "veth", "peer", "name", DRIVES,
    ])?;
    for name in [MASTER, DRIVES] {
        // Nothing else is to be heard there. Kernels without IPv6 have no such switch.
        let switch = format!("/proc/sys/net/ipv6/conf/{name}/disable_ipv6");
        let _ = std::fs::write(switch, "1");
        ip(&["link", "set", name, "up"])?;
    }
    Ok(())
}

fn ip(arguments: &[&str]) -> Result<(), Failure> {
    let output = Command::new("ip")
        .args(arguments)
        .stdin(Stdio::null())
        .output();
    let said = match output {
        Ok(output) if output.status.success() => return Ok(()),
        Ok(output) => String::from_utf8_lossy(&output.stderr).trim().to_owned(),
        Err(error) => format!("{error}; it is in the package iproute2"),
    };
    Err(Failure::NotEmulated(format!(
        "`ip {}`: {said}",
        arguments.join(" ")
    )))
}
