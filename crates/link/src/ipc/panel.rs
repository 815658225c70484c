//! The operator's panel: commands and status by a way that needs nothing but what the interpolator
//! took when it started.
//!
//! Commands over iceoryx2 need memory and descriptors for every client that joins. A machine must
//! be held when there are none left. The panel is a few small files in the instance's directory
//! that the interpolator makes, with all of their room, before anything moves, and keeps open: a
//! few places for a command and its answer each, and one for the status. They are read and written,
//! not mapped, so that nobody can die of them. Whoever has a command takes a place by a lock, which
//! the kernel releases however its process ends; see [`super::operator`]. A command whose place nobody
//! has any more was given up, and nothing moves by it, however late an interpolator that hung sees it.

use super::config::LinkConfig;
use super::directory;
use super::stamped::{RecordPlace, reserve};
use crate::{Command, CommandReply, CommandRequest, LinkError, Status};
use std::fs::{File, TryLockError};
use std::io;
use std::path::PathBuf;

/// How many may have a command under way at a time.
pub(super) const PLACES: usize = 8;

/// Of the command in its file.
pub(super) const REQUEST: RecordPlace<CommandRequest> = RecordPlace::at(0);
/// Of the answer, behind it.
pub(super) const REPLY: RecordPlace<CommandReply> = RecordPlace::at(512);
const _ROOM_FOR_REQUEST: () = assert!(RecordPlace::<CommandRequest>::SIZE <= 512);
/// Of the status in a file of its own.
pub(super) const STATUS: RecordPlace<Status> = RecordPlace::at(0);

/// The path of a place for commands.
pub(super) fn place_path(config: &LinkConfig, place: usize) -> PathBuf {
    config.directory().join(format!("panel.{place}"))
}

/// The path of the status.
pub(super) fn status_path(config: &LinkConfig) -> PathBuf {
    config.directory().join("panel.status")
}

/// The interpolator's end of the commands.
#[derive(Debug)]
pub(super) struct Panel {
    places: Vec<Slot>,
    /// Where to look first: nobody is served twice before all others were.
    next: usize,
}

#[derive(Debug)]
struct Slot {
    file: File,
    path: PathBuf,
    /// Number of the request that was seen last.
    seen: u64,
}

impl Panel {
    /// Makes the files, or takes over those of one that was killed.
    ///
    /// # Errors
    ///
    /// A file cannot be made, or has no room.
    pub(super) fn make(config: &LinkConfig) -> Result<Self, LinkError> {
        let make = |place| {
            let path = place_path(config, place);
            let file = make_file(&path, 512 + RecordPlace::<CommandReply>::SIZE)?;
            // What was asked of one that is dead is not done by the next.
            let seen = REQUEST
                .number(&file)
                .map_err(|e| LinkError::no_file(&path, 0, e))?;
            Ok(Slot { file, path, seen })
        };
        let places = (0..PLACES).map(make).collect::<Result<_, LinkError>>()?;
        Ok(Self { places, next: 0 })
    }

    /// Answers the next request, if there is one. Returns whether there was one.
    pub(super) fn serve(
        &mut self,
        answer: &mut dyn FnMut(&CommandRequest) -> CommandReply,
    ) -> Result<bool, LinkError> {
        let (last, first) = self.places.split_at_mut(self.next);
        for (slot, turn) in first.iter_mut().chain(last).zip(1..) {
            let failed = |error| LinkError::no_file(&slot.path, 0, error);
            // One short read is what a place costs that nobody has written to.
            if REQUEST.number(&slot.file).map_err(failed)? == slot.seen {
                continue;
            }
            let Some((number, request)) = REQUEST.read(&slot.file).map_err(failed)? else {
                continue; // Not written to its end yet.
            };
            slot.seen = number;
            if !request.command().is_ok_and(Command::stops)
                && !is_held(&slot.file).map_err(failed)?
            {
                continue; // Given up: a stop counts all the same.
            }
            let reply = answer(&request);
            REPLY.write(&slot.file, number, &reply).map_err(failed)?;
            self.next = (self.next + turn) % PLACES;
            return Ok(true);
        }
        Ok(false)
    }
}

/// Whether somebody has the place: the lock ends with whoever asked, however that comes.
fn is_held(file: &File) -> io::Result<bool> {
    match file.try_lock() {
        Ok(()) => file.unlock().map(|()| false),
        Err(TryLockError::WouldBlock) => Ok(true),
        Err(TryLockError::Error(error)) => Err(error),
    }
}

/// The interpolator's end of the status.
#[derive(Debug)]
pub(super) struct StatusBoard {
    file: File,
    path: PathBuf,
}

impl StatusBoard {
    /// Makes the file.
    ///
    /// # Errors
    ///
    /// It cannot be made, or has no room.
    pub(super) fn make(config: &LinkConfig) -> Result<Self, LinkError> {
        let path = status_path(config);
        let file = make_file(&path, RecordPlace::<Status>::SIZE)?;
        Ok(Self { file, path })
    }

    /// Shows a status.
    pub(super) fn show(&self, status: &Status) -> Result<(), LinkError> {
        STATUS
            .write(&self.file, status.updated_ns, status)
            .map_err(|error| LinkError::no_file(&self.path, 0, error))
    }
}

fn make_file(path: &std::path::Path, length: usize) -> Result<File, LinkError> {
    let file = directory::open(path).map_err(|error| LinkError::no_file(path, 0, error))?;
    reserve(&file, path, length)?;
    Ok(file)
}
