//! The operator's end of the panel: see [`super::panel`].

use super::config::LinkConfig;
use super::directory;
use super::interpolator_lock::InterpolatorProcess;
use super::panel::{PLACES, REPLY, REQUEST, STATUS, place_path, status_path};
use crate::service::{COMMANDS, STATUS as STATUS_SERVICE};
use crate::{CommandReply, CommandRequest, LinkError, Record as _, Status};
use core::time::Duration;
use std::fs::{File, TryLockError};
use std::io;
use std::path::Path;
use std::time::Instant;

/// Between two looks for an answer.
const POLL: Duration = Duration::from_millis(1);
/// Between two looks whether the interpolator still lives.
const LOOK: Duration = Duration::from_millis(50);

/// The way of an operator to an interpolator: it commands and reads the status, and needs neither
/// shared memory nor room in a file system, nor anything that the interpolator has not held since
/// it started. It works for as long as the interpolator lives.
///
/// It is for commands that are given one at a time. Programs that follow the status, or command
/// often, join the instance: [`crate::Transport`]. Not for the process of the interpolator itself.
#[derive(Debug)]
pub struct Operator {
    config: LinkConfig,
    interpolator: InterpolatorProcess,
}

impl Operator {
    /// Finds the interpolator of an instance.
    ///
    /// # Errors
    ///
    /// [`LinkError::NoServer`] if none lives, or what [`InterpolatorProcess::find`] fails with.
    pub fn find(config: &LinkConfig) -> Result<Self, LinkError> {
        let service = COMMANDS;
        let interpolator = InterpolatorProcess::find(config)?;
        Ok(Self {
            config: config.clone(),
            interpolator: interpolator.ok_or(LinkError::NoServer { service })?,
        })
    }

    /// The interpolator's process.
    #[must_use]
    pub const fn interpolator(&self) -> &InterpolatorProcess {
        &self.interpolator
    }

    /// Gives a command, and waits at most `patience` for the answer, which is checked; `None` if
    /// there was none.
    ///
    /// # Errors
    ///
    /// [`LinkError::NoServer`] if the interpolator ended, [`LinkError::TooManyRequests`] if all
    /// places were taken for as long, [`LinkError::File`] if a file cannot be used.
    pub fn call(
        &self,
        request: &CommandRequest,
        patience: Duration,
    ) -> Result<Option<CommandReply>, LinkError> {
        let started = Instant::now();
        let place = loop {
            if let Some(place) = self.free_place()? {
                break place;
            }
            if !self.wait(started, patience, COMMANDS)? {
                return Err(LinkError::TooManyRequests { service: COMMANDS });
            }
        };
        let (file, path) = place;
        let failed = |error| LinkError::no_file(&path, 0, error);
        let number = number_after(REQUEST.number(&file).map_err(failed)?);
        REQUEST.write(&file, number, request).map_err(failed)?;
        loop {
            let reply = REPLY.read(&file).map_err(failed)?;
            if let Some((_, reply)) = reply.filter(|(of, _)| *of == number) {
                reply.check()?;
                return Ok(Some(reply));
            }
            if !self.wait(started, patience, COMMANDS)? {
                return Ok(None);
            }
        }
    }

    /// The first status that was shown after the call, checked; `None` if there was none within
    /// `patience`.
    ///
    /// # Errors
    ///
    /// [`LinkError::NoServer`] if the interpolator ended, [`LinkError::File`] if the file cannot be
    /// used.
    pub fn status(&self, patience: Duration) -> Result<Option<Status>, LinkError> {
        let path = status_path(&self.config);
        let failed = |error| LinkError::no_file(&path, 0, error);
        let file = directory::options().open(&path).map_err(failed)?;
        let (started, mut first) = (Instant::now(), None);
        loop {
            if let Some((_, status)) = STATUS.read(&file).map_err(failed)?
                && *first.get_or_insert(status.updated_ns) != status.updated_ns
            {
                status.check()?;
                return Ok(Some(status));
            }
            if !self.wait(started, patience, STATUS_SERVICE)? {
                return Ok(None);
            }
        }
    }

    /// A place that nobody else has.
    fn free_place(&self) -> Result<Option<(File, std::path::PathBuf)>, LinkError> {
        for place in 0..PLACES {
            let path = place_path(&self.config, place);
            match lock(&path) {
                Ok(Some(file)) => return Ok(Some((file, path))),
                Ok(None) => {}
                Err(error) => return Err(LinkError::no_file(&path, 0, error)),
            }
        }
        Ok(None)
    }

    /// Waits a little. Returns whether there is patience left.
    fn wait(
        &self,
        started: Instant,
        patience: Duration,
        service: &'static str,
    ) -> Result<bool, LinkError> {
        let waited = started.elapsed();
        std::thread::sleep(POLL);
        let looks = |at: Duration| at.as_millis() / LOOK.as_millis();
        if looks(started.elapsed()) > looks(waited) && !self.interpolator.lives()? {
            return Err(LinkError::NoServer { service });
        }
        Ok(waited < patience)
    }
}

fn lock(path: &Path) -> io::Result<Option<File>> {
    let file = directory::options().open(path)?;
    match file.try_lock() {
        Ok(()) => Ok(Some(file)),
        Err(TryLockError::WouldBlock) => Ok(None),
        Err(TryLockError::Error(error)) => Err(error),
    }
}

/// A number that is not the one there, whatever part of it was written.
fn number_after(number: u64) -> u64 {
    number.wrapping_add(1).max(1)
}
