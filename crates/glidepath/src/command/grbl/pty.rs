//! A pseudo-terminal that senders open as a serial port, by a link to it.

use rustix::event::{PollFd, PollFlags, poll};
use rustix::fs::{Mode, OFlags, chmod, fcntl_getfl, fcntl_setfl, open};
use rustix::io::{Errno, read, write};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, QueueSelector, tcflush, tcgetattr, tcsetattr};
use rustix::time::Timespec;
use std::ffi::CString;
use std::io;
use std::os::fd::{AsFd, BorrowedFd, OwnedFd};
use std::path::{Path, PathBuf};

/// Where the system has pseudo-terminals.
const TERMINALS: &str = "/dev/pts/";

/// A pseudo-terminal, and the link to it. The link goes with it.
#[derive(Debug)]
pub(super) struct Pty {
    master: OwnedFd,
    name: CString,
    link: PathBuf,
}

impl Pty {
    /// Makes a pseudo-terminal that its user alone may open, and a link to it. A link that another one has left is
    /// replaced; anything else that is there stays.
    ///
    /// # Errors
    /// It cannot be made.
    pub(super) fn open(link: &Path) -> io::Result<Self> {
        let flags = OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC;
        let master = openpt(flags)?;
        grantpt(&master)?;
        unlockpt(&master)?;
        let name = ptsname(&master, Vec::new())?;
        // The group of terminals may write to others' terminals: what comes here moves a machine.
        chmod(name.as_c_str(), Mode::RUSR | Mode::WUSR)?;
        fcntl_setfl(&master, fcntl_getfl(&master)? | OFlags::NONBLOCK)?;
        let target = PathBuf::from(name.to_string_lossy().into_owned());
        if std::fs::read_link(link).is_ok_and(|old| old.starts_with(TERMINALS)) {
            std::fs::remove_file(link)?;
        }
        std::os::unix::fs::symlink(&target, link)?;
        let pty = Self {
            master,
            name,
            link: link.to_owned(),
        };
        // Opened and closed once: from now on it is known whether anybody has it open.
        let opened = open(
            pty.name.as_c_str(),
            OFlags::RDWR | OFlags::NOCTTY,
            Mode::empty(),
        )?;
        make_raw(&opened)?;
        Ok(pty)
    }

    pub(super) fn fd(&self) -> BorrowedFd<'_> {
        self.master.as_fd()
    }

    /// Whether a sender has it open.
    pub(super) fn is_open(&self) -> bool {
        let mut looked = [PollFd::new(&self.master, PollFlags::IN)];
        let at_once = Timespec {
            tv_sec: 0,
            tv_nsec: 0,
        };
        let polled = poll(&mut looked, Some(&at_once));
        polled.is_ok()
            && looked
                .iter()
                .all(|it| !it.revents().contains(PollFlags::HUP))
    }

    /// A sender has opened it. One before may have left it with an echo, whose bytes would come back as lines.
    pub(super) fn begin(&self) -> io::Result<()> {
        make_raw(&self.master)
    }

    /// The sender has closed it: nobody is to read what it was told, or to execute what it has sent.
    pub(super) fn end(&self) {
        // What cannot be dropped is dropped by whoever opens it.
        let _flushed = tcflush(&self.master, QueueSelector::IOFlush);
    }

    /// Takes bytes that have come. Returns whether the sender is there.
    pub(super) fn read(&self, into: &mut Vec<u8>) -> bool {
        let mut bytes = [0; 1024];
        match read(&self.master, &mut bytes) {
            Ok(length) => {
                into.extend_from_slice(bytes.get(..length).unwrap_or_default());
                true
            }
            Err(Errno::AGAIN | Errno::INTR) => true,
            Err(_) => false,
        }
    }

    /// Sends as much of the bytes as there is room for.
    pub(super) fn write(&self, bytes: &mut Vec<u8>) {
        while !bytes.is_empty() {
            match write(&self.master, bytes) {
                Ok(length @ 1..) => {
                    bytes.drain(..length);
                }
                Err(Errno::INTR) => {}
                Ok(_) | Err(_) => return,
            }
        }
    }
}

impl Drop for Pty {
    fn drop(&mut self) {
        let is_ours = std::fs::read_link(&self.link)
            .is_ok_and(|target| target.to_string_lossy() == self.name.to_string_lossy());
        if is_ours {
            // One that stays leads nowhere, and is replaced by the next.
            let _removed = std::fs::remove_file(&self.link);
        }
    }
}

fn make_raw(terminal: impl AsFd) -> io::Result<()> {
    let mut modes = tcgetattr(&terminal)?;
    modes.make_raw();
    tcsetattr(&terminal, OptionalActions::Now, &modes)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Read as _, Write as _};

    #[test]
    fn a_sender_opens_and_closes_it_again_and_again() {
        let folder = tempfile::tempdir().unwrap();
        let link = folder.path().join("mill");
        let pty = Pty::open(&link).unwrap();
        for _ in 0..3 {
            assert!(!pty.is_open());
            let mut sender = std::fs::OpenOptions::new()
                .read(true)
                .write(true)
                .open(&link)
                .unwrap();
            assert!(pty.is_open());
            pty.begin().unwrap();
            sender.write_all(b"G0 X1\r\n").unwrap();
            let mut come = Vec::new();
            while come.len() < 7 {
                assert!(pty.read(&mut come));
            }
            assert_eq!(come, b"G0 X1\r\n");
            let mut bytes = b"ok\r\n".to_vec();
            pty.write(&mut bytes);
            let mut answer = [0; 4];
            sender.read_exact(&mut answer).unwrap();
            assert_eq!(&answer, b"ok\r\n");
            drop(sender);
            pty.end();
        }
        drop(pty);
        assert!(link.read_link().is_err());
    }

    #[test]
    fn nothing_but_a_link_to_a_terminal_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        std::fs::write(&file, "mine").unwrap();
        assert!(Pty::open(&file).is_err());
        assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine");
        let left = folder.path().join("left");
        std::os::unix::fs::symlink("/dev/pts/999999", &left).unwrap();
        assert!(Pty::open(&left).is_ok());
    }
}
