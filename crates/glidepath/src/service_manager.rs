//! The notices to the service manager that the interpolator works.
//!
//! systemd gives a service the name of a socket (`NOTIFY_SOCKET`) and, with `WatchdogSec=`, a time
//! in which it wants to hear from it (`WATCHDOG_USEC`); see `sd_notify(3)`. A thread of ordinary
//! priority looks at the status that the interpolator publishes, as any other process would, and
//! speaks only while its tick counter moves: silence of the real-time thread, of the ports thread,
//! or of the shared memory between processes is then silence towards the manager too.

use core::sync::atomic::{AtomicBool, Ordering};
use glidepath_link::{Ipc, LinkConfig, LinkError, Transport as _};
use std::ffi::{OsStr, OsString};
use std::io;
use std::os::linux::net::SocketAddrExt as _;
use std::os::unix::ffi::OsStrExt as _;
use std::os::unix::net::{SocketAddr, UnixDatagram};
use std::time::{Duration, Instant};

/// How often the status is looked at.
const POLL: Duration = Duration::from_millis(20);

/// The manager this process was started by.
#[derive(Debug)]
pub struct ServiceManager {
    socket: UnixDatagram,
    /// How long it waits for a word.
    patience: Option<Duration>,
}

impl ServiceManager {
    /// From the environment; `None` if no manager wants to be told.
    ///
    /// # Errors
    /// The manager's socket cannot be reached.
    pub fn from_environment() -> io::Result<Option<Self>> {
        let name = |key| std::env::var_os(key).filter(|value: &OsString| !value.is_empty());
        let Some(path) = name("NOTIFY_SOCKET") else {
            return Ok(None);
        };
        let number = |key| name(key)?.to_str()?.parse::<u64>().ok();
        let is_for_this =
            number("WATCHDOG_PID").is_none_or(|pid| pid == u64::from(std::process::id()));
        let patience = number("WATCHDOG_USEC")
            .filter(|_| is_for_this)
            .map(Duration::from_micros);
        Self::new(&path, patience).map(Some)
    }

    /// A manager with a socket, given as a path or, after `@`, as an abstract name.
    ///
    /// # Errors
    /// The socket cannot be reached.
    pub fn new(socket: &OsStr, patience: Option<Duration>) -> io::Result<Self> {
        let address = match socket.as_bytes() {
            [b'@', name @ ..] => SocketAddr::from_abstract_name(name)?,
            _ => SocketAddr::from_pathname(socket)?,
        };
        let socket = UnixDatagram::unbound()?;
        socket.connect_addr(&address)?;
        Ok(Self { socket, patience })
    }

    fn tell(&self, what: &str) {
        // A manager that does not listen any more is no reason to stop a machine.
        let _ = self.socket.send(what.as_bytes());
    }

    /// Watches the interpolator of an instance until `over` is set: tells when it is ready, then
    /// that it is alive, three times as often as the manager wants to hear, as long as it ticks.
    ///
    /// # Errors
    /// The status cannot be received.
    pub fn watch(&self, link: &LinkConfig, over: &AtomicBool) -> Result<(), LinkError> {
        let mut source = Ipc::connect(link)?.status_source()?;
        let pid = std::process::id();
        let mut pulse = Pulse::new(self.patience.map(|patience| patience / 3));
        while !over.load(Ordering::Relaxed) {
            // One that died before may have left a status.
            if let Some(status) = source.take()?.filter(|status| status.pid == pid)
                && let Some(word) = pulse.beat(status.ticks, Instant::now())
            {
                self.tell(word);
            }
            std::thread::sleep(POLL);
        }
        self.tell("STOPPING=1");
        Ok(())
    }
}

/// What there is to tell.
#[derive(Debug)]
struct Pulse {
    interval: Option<Duration>,
    /// Ticks, and when that was told.
    told: Option<(u64, Instant)>,
}

impl Pulse {
    const fn new(interval: Option<Duration>) -> Self {
        Self {
            interval,
            told: None,
        }
    }

    fn beat(&mut self, ticks: u64, now: Instant) -> Option<&'static str> {
        let word = match (self.told, self.interval) {
            (None, _) => "READY=1",
            (Some((before, at)), Some(interval)) if ticks > before && now >= at + interval => {
                "WATCHDOG=1"
            }
            _ => return None,
        };
        self.told = Some((ticks, now));
        Some(word)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_counter_that_moves_is_alive() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut pulse = Pulse::new(Some(Duration::from_millis(300)));
        assert_eq!(pulse.beat(1, at(0)), Some("READY=1"));
        assert_eq!(pulse.beat(20, at(100)), None);
        assert_eq!(pulse.beat(80, at(300)), Some("WATCHDOG=1"));
        assert_eq!(pulse.beat(80, at(700)), None);
        assert_eq!(pulse.beat(80, at(9_000)), None);
        assert_eq!(pulse.beat(81, at(9_020)), Some("WATCHDOG=1"));
    }

    #[test]
    fn without_a_watchdog_only_readiness_is_told() {
        let mut pulse = Pulse::new(None);
        let now = Instant::now();
        assert_eq!(pulse.beat(1, now), Some("READY=1"));
        assert_eq!(pulse.beat(9, now + Duration::from_secs(9)), None);
    }
}
