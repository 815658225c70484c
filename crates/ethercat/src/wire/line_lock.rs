//! The right to drive the line of an interface: one process has it at a time.
//!
//! Two masters on one line would each answer for the other's frames. The right is a name among the abstract
//! sockets of the network namespace: interfaces are of a namespace, too, and the kernel gives the name back when the
//! process ends, however it ends.

use rustix::net::sockopt::socket_peercred;
use std::io;
use std::os::linux::net::SocketAddrExt as _;
use std::os::unix::net::{SocketAddr, UnixListener, UnixStream};

/// The right, until it is dropped.
#[derive(Debug)]
pub(super) struct LineLock {
    _listener: UnixListener,
}

/// Why the right is not to be had.
#[derive(Debug)]
pub(super) enum NotAlone {
    /// A process has it: which one, if that can be told.
    Taken(Option<u32>),
    /// The system refuses.
    Refused(io::Error),
}

impl LineLock {
    pub(super) fn take(interface: &str) -> Result<Self, NotAlone> {
        let name = format!("glidepath-ethercat-{interface}");
        let address = SocketAddr::from_abstract_name(name).map_err(NotAlone::Refused)?;
        match UnixListener::bind_addr(&address) {
            Ok(listener) => Ok(Self {
                _listener: listener,
            }),
            Err(error) if error.kind() == io::ErrorKind::AddrInUse => {
                Err(NotAlone::Taken(holder(&address)))
            }
            Err(error) => Err(NotAlone::Refused(error)),
        }
    }
}

/// The process that has the right.
fn holder(address: &SocketAddr) -> Option<u32> {
    let stream = UnixStream::connect_addr(address).ok()?;
    let peer = socket_peercred(&stream).ok()?;
    u32::try_from(peer.pid.as_raw_nonzero().get()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_process_at_a_time_has_the_line_and_is_told_to_others() {
        let name = format!("test-{}", std::process::id());
        let lock = LineLock::take(&name).unwrap();
        let own = std::process::id();
        assert!(matches!(LineLock::take(&name), Err(NotAlone::Taken(Some(pid))) if pid == own));
        assert!(LineLock::take(&format!("{name}b")).is_ok());
        drop(lock);
        assert!(LineLock::take(&name).is_ok());
    }
}
