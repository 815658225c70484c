//! A raw socket on an interface of this host.

use super::line_lock::{LineLock, NotAlone};
use super::{Wire, sys};
use glidepath_realtime::{Clock as _, Monotonic};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;
use rustix::net::netdevice::{index_to_name, name_to_index};
use rustix::net::{AddressFamily, RecvFlags, SendFlags, SocketType, recv, send, socket};
use std::io;
use std::os::fd::OwnedFd;

/// The protocol number of EtherCAT.
const ETHERCAT: u16 = 0x88a4;

/// An interface cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum WireError {
    /// There is no interface of that name.
    #[error("there is no network interface `{name}`; there are: {}", known.join(", "))]
    NoInterface {
        /// The name.
        name: String,
        /// Those there are.
        known: Vec<String>,
    },
    /// Raw sockets are refused.
    #[error(
        "cannot open a raw socket on {name}: {source}; it takes CAP_NET_RAW: `setcap cap_net_raw+ep` \
         for the binary, or AmbientCapabilities=CAP_NET_RAW for a service"
    )]
    Refused {
        /// The interface.
        name: String,
        /// What the system said.
        source: io::Error,
    },
    /// Another process drives this line.
    #[error(
        "{} drives the line on {name} already, and a line has one master; end that one first",
        Holder(*.process)
    )]
    Taken {
        /// The interface.
        name: String,
        /// Which process it is, if that can be told.
        process: Option<u32>,
    },
    /// The interface does not carry frames.
    #[error("the interface {name} is not up: `ip link set {name} up`, and plug in the cable")]
    Down {
        /// The interface.
        name: String,
    },
}

/// A raw socket on an interface of this host.
#[derive(Debug)]
pub struct PacketWire {
    socket: OwnedFd,
    /// Of a master.
    _alone: Option<LineLock>,
}

/// Who has a line.
struct Holder(Option<u32>);

impl std::fmt::Display for Holder {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Some(process) => write!(f, "process {process}"),
            None => f.write_str("another process"),
        }
    }
}

/// Highest number of an interface that is looked at for its name.
const MOST_INTERFACES: u32 = 256;

/// A socket to ask about interfaces by. Not by way of `/sys`, which shows those of the network
/// namespace in which it was mounted.
fn inquiry() -> io::Result<OwnedFd> {
    Ok(socket(AddressFamily::INET, SocketType::DGRAM, None)?)
}

fn interfaces(inquiry: &OwnedFd) -> Vec<String> {
    let names = (1..MOST_INTERFACES).filter_map(|index| index_to_name(inquiry, index).ok());
    names.filter(|name| name != "lo").collect()
}

impl PacketWire {
    /// Opens an interface by its name.
    ///
    /// # Errors
    ///
    /// There is no such interface, it is not up, or the process may not use it.
    pub fn open(name: &str) -> Result<Self, WireError> {
        let refused = |source| WireError::Refused {
            name: name.to_owned(),
            source,
        };
        let inquiry = inquiry().map_err(refused)?;
        let Ok(index) = name_to_index(&inquiry, name) else {
            return Err(WireError::NoInterface {
                name: name.to_owned(),
                known: interfaces(&inquiry),
            });
        };
        let socket = sys::packet_socket(index, ETHERCAT).map_err(refused)?;
        // A socket that is bound to an interface that is down says so once.
        match recv(&socket, &mut [0; 1][..], RecvFlags::empty()) {
            Err(Errno::NETDOWN) => Err(WireError::Down {
                name: name.to_owned(),
            }),
            _ => Ok(Self {
                socket,
                _alone: None,
            }),
        }
    }

    /// Opens an interface as the only master of its line, for as long as the port lives.
    ///
    /// # Errors
    ///
    /// As [`PacketWire::open`], and [`WireError::Taken`].
    pub fn open_alone(name: &str) -> Result<Self, WireError> {
        let wire = Self::open(name)?;
        let lock = LineLock::take(name).map_err(|why| match why {
            NotAlone::Taken(process) => WireError::Taken {
                name: name.to_owned(),
                process,
            },
            NotAlone::Refused(source) => WireError::Refused {
                name: name.to_owned(),
                source,
            },
        })?;
        Ok(Self {
            _alone: Some(lock),
            ..wire
        })
    }
}

impl Wire for PacketWire {
    fn now_ns(&self) -> u64 {
        Monotonic.now_ns()
    }

    fn sleep_until(&mut self, deadline_ns: u64) {
        Monotonic.sleep_until(deadline_ns);
    }

    fn send(&mut self, frame: &[u8]) -> io::Result<()> {
        send(&self.socket, frame, SendFlags::empty())?;
        Ok(())
    }

    fn receive(&mut self, into: &mut [u8], until_ns: u64) -> io::Result<Option<usize>> {
        loop {
            match recv(&self.socket, &mut *into, RecvFlags::empty()) {
                Ok((_, length)) => return Ok(Some(length)),
                Err(Errno::AGAIN | Errno::INTR) => {}
                Err(error) => return Err(error.into()),
            }
            let left_ns = until_ns.saturating_sub(self.now_ns());
            if left_ns == 0 {
                return Ok(None);
            }
            let patience = Timespec {
                tv_sec: i64::try_from(left_ns / 1_000_000_000).unwrap_or(i64::MAX),
                tv_nsec: i64::try_from(left_ns % 1_000_000_000).unwrap_or(0),
            };
            match poll(
                &mut [PollFd::new(&self.socket, PollFlags::IN)],
                Some(&patience),
            ) {
                Ok(_) | Err(Errno::INTR) => {}
                Err(error) => return Err(error.into()),
            }
        }
    }
}
