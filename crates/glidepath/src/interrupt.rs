//! The flag that Ctrl-C and its relatives set.

use crate::exit::Exit;
use rustix::process::{Signal, getppid, set_parent_process_death_signal};
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Set when the process was asked to end.
#[derive(Debug, Clone)]
pub struct Interrupt {
    any: Arc<AtomicBool>,
    /// By SIGTERM, the way services are ended.
    terminated: Arc<AtomicBool>,
}

impl Interrupt {
    /// Takes over SIGINT, SIGTERM and SIGHUP. However often they come, the process ends in good
    /// order: a machine in motion is to be brought to rest first.
    ///
    /// # Errors
    /// The system refuses the handlers.
    pub fn install() -> io::Result<Self> {
        let any = Arc::new(AtomicBool::new(false));
        let terminated = Arc::new(AtomicBool::new(false));
        signal_hook::flag::register(SIGTERM, Arc::clone(&terminated))?;
        for signal in [SIGINT, SIGTERM, SIGHUP] {
            signal_hook::flag::register(signal, Arc::clone(&any))?;
        }
        Ok(Self { any, terminated })
    }

    /// True once the process was asked to end.
    #[must_use]
    pub fn is_set(&self) -> bool {
        self.any.load(Ordering::Relaxed)
    }

    /// The flag itself, for libraries that end with it.
    #[must_use]
    pub fn flag(&self) -> &AtomicBool {
        &self.any
    }

    /// How a process ends that runs until it is asked to end: SIGTERM is the regular way.
    #[must_use]
    pub fn exit(&self) -> Exit {
        let regular = self.terminated.load(Ordering::Relaxed) || !self.is_set();
        if regular {
            Exit::Done
        } else {
            Exit::Interrupted
        }
    }
}

/// Has a file that grew to the limit of its size (`ulimit -f`) tell an error where it is written. By
/// itself the system kills the process without a word, and a machine in motion with it.
///
/// # Errors
/// The system refuses the handler.
pub fn survive_limits_of_files() -> io::Result<()> {
    signal_hook::flag::register(SIGXFSZ, Arc::default())?;
    Ok(())
}

/// Makes this process end (by SIGTERM) when its parent does.
///
/// # Errors
/// The system refuses, or the parent has ended already.
pub fn end_with(parent: Option<u32>) -> io::Result<()> {
    let Some(parent) = parent else { return Ok(()) };
    set_parent_process_death_signal(Some(Signal::TERM))?;
    let own = getppid().map(|pid| pid.as_raw_nonzero().get());
    if own.and_then(|own| u32::try_from(own).ok()) == Some(parent) {
        Ok(())
    } else {
        Err(io::Error::other(
            "the process that started this one has ended",
        ))
    }
}
