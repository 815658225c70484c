//! The note of the state in force that the planner's service leaves between jobs, for whoever reads a program beside
//! it: modes, offsets and tool are those that the program would begin with there.
//!
//! The service holds a lock beside the note for as long as it lives. Where nobody holds it the note is of a service
//! that was killed, and counts no more: the next one begins without.

use crate::config::MachineConfig;
use crate::persistence::machine::fingerprint;
use crate::text_file;
use glidepath_gcode::InForce;
use glidepath_link::LinkConfig;
use serde::{Deserialize, Serialize};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::os::unix::fs::OpenOptionsExt as _;
use std::path::{Path, PathBuf};

/// The files in the instance's directory.
const FILE: &str = "in-force.toml";
const LOCK: &str = "in-force.lock";
/// The most of the note that is read, bytes: it has a tool table in it.
const MOST_BYTES: u64 = 16 << 20;

/// Where a service notes what is in force, until dropped.
#[derive(Debug)]
pub(crate) struct InForceNote {
    directory: PathBuf,
    /// The machine that the service drives.
    machine: u64,
    _lock: Option<File>,
}

#[derive(Serialize)]
struct Left<'a> {
    machine: u64,
    in_force: &'a InForce,
}

#[derive(Deserialize)]
struct Found {
    machine: u64,
    in_force: InForce,
}

/// What a service has in force.
#[derive(Debug)]
pub(crate) enum Served {
    /// No service is there, or it has executed nothing.
    Nothing,
    /// It drives a machine of another configuration.
    OtherMachine,
    State(Box<InForce>),
}

impl InForceNote {
    /// That of the service that begins now: nothing is in force.
    pub(crate) fn begin(link: &LinkConfig, config: &MachineConfig) -> Self {
        let directory = link.directory();
        // Without the lock the note is taken for that of a killed service: others read as a first program then.
        let lock = OpenOptions::new()
            .create(true)
            .truncate(false)
            .write(true)
            .mode(0o600)
            .open(directory.join(LOCK));
        let lock = lock.ok().filter(|lock| lock.try_lock().is_ok());
        let note = Self {
            directory,
            machine: fingerprint(config),
            _lock: lock,
        };
        note.clear();
        note
    }

    /// Leaves it in the place of the one before.
    ///
    /// # Errors
    /// It cannot be written.
    pub(crate) fn leave(&self, in_force: &InForce) -> io::Result<()> {
        let left = Left {
            machine: self.machine,
            in_force,
        };
        let text = toml::to_string(&left).map_err(io::Error::other)?;
        text_file::replace(&self.directory, FILE, &text)
    }

    fn clear(&self) {
        // Where there is none, none is in force.
        fs::remove_file(self.directory.join(FILE)).ok();
    }
}

impl Drop for InForceNote {
    fn drop(&mut self) {
        self.clear();
    }
}

/// What the service of an instance has in force, for the reader of a program for this machine.
pub(crate) fn served(link: &LinkConfig, config: &MachineConfig) -> Served {
    let directory = link.directory();
    if !is_held(&directory.join(LOCK)) {
        return Served::Nothing;
    }
    let text = text_file::read(&directory.join(FILE), MOST_BYTES).unwrap_or_default();
    match toml::from_str::<Found>(&text) {
        Ok(found) if found.machine == fingerprint(config) => {
            Served::State(Box::new(found.in_force))
        }
        Ok(_) => Served::OtherMachine,
        // None is left yet, or it is of another version.
        Err(_) => Served::Nothing,
    }
}

/// Whether a service holds its lock.
fn is_held(path: &Path) -> bool {
    let Ok(file) = File::open(path) else {
        return false;
    };
    matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config;
    use glidepath_gcode::{Options, Program};

    #[test]
    fn a_note_counts_for_its_machine_and_for_as_long_as_its_service_lives() {
        let folder = tempfile::tempdir().unwrap();
        let link = LinkConfig {
            root: folder.path().to_owned(),
            ..LinkConfig::new("note")
        };
        fs::create_dir_all(link.directory()).unwrap();
        let config = config::load(None).unwrap();
        let nothing = |served| matches!(served, Served::Nothing);
        assert!(nothing(served(&link, &config)));
        let note = InForceNote::begin(&link, &config);
        assert!(nothing(served(&link, &config)));
        let mut program = Program::new(&b"G20 G91 F7\n"[..], Options::default());
        assert!(program.by_ref().all(|item| item.is_ok()));
        note.leave(&program.in_force()).unwrap();
        let Served::State(state) = served(&link, &config) else {
            panic!("it is left");
        };
        assert_eq!(state.words(), program.in_force().words());
        let mut other = config.clone();
        other.path.tolerance_mm *= 2.0;
        assert!(matches!(served(&link, &other), Served::State(_)));
        let _one_axis_less = other.axes.pop();
        assert!(matches!(served(&link, &other), Served::OtherMachine));
        // As a killed service leaves it.
        let text = fs::read(link.directory().join(FILE)).unwrap();
        drop(note);
        fs::write(link.directory().join(FILE), text).unwrap();
        assert!(nothing(served(&link, &config)));
    }
}
