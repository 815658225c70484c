//! The beginnings of programs, taken from where the planner tells them when their motion begins.

use crate::begun::{self, Begun as Told};
use crate::output;
use crate::text_file;
use glidepath_link::{MachineState, Setpoint};
use glidepath_recording::Begun;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Longest text that is taken without being asked for, bytes: it is kept in memory, and setpoints wait meanwhile.
const MOST_TEXT_BYTES: u64 = 64 << 20;

/// Looks what each motion began with.
pub(super) struct Beginnings {
    /// That of the instance.
    directory: PathBuf,
    epoch: u64,
}

impl Beginnings {
    pub(super) const fn new(directory: PathBuf) -> Self {
        Self {
            directory,
            epoch: 0,
        }
    }

    /// What the motion began with that a setpoint is the first of.
    pub(super) fn at(&mut self, setpoint: &Setpoint) -> Option<Begun> {
        let epoch = setpoint.epoch;
        // Behind a motion the machine rests in its epoch, whatever is told meanwhile.
        let rests = setpoint.state() == Ok(MachineState::Idle);
        if rests || epoch == 0 || epoch == self.epoch {
            return None;
        }
        self.epoch = epoch;
        let set_up = begun::told(&self.directory);
        let set_up = set_up.unwrap_or_else(|error| {
            left_out("what the program began with", &error.to_string());
            None
        })?;
        let told = match Told::parse(&set_up) {
            Ok(told) => told,
            Err(error) => {
                left_out("what the program began with", error.message());
                return None;
            }
        };
        let subroutines = told.subroutines.iter();
        let subroutines: BTreeMap<_, _> = subroutines
            .filter_map(|(name, path)| Some((name.clone(), text(path)?)))
            .collect();
        Some(Begun {
            epoch,
            program: text(&told.path),
            subroutines,
            set_up,
        })
    }
}

fn text(path: &Path) -> Option<Arc<[u8]>> {
    let read = text_file::bytes(path, MOST_TEXT_BYTES);
    let read = read.map_err(|error| left_out(&path.display().to_string(), &error.to_string()));
    read.ok().map(Into::into)
}

/// Says what is not in the recording: it is worth having without that.
fn left_out(what: &str, why: &str) {
    output::note(&format!(
        "record: {what} is not part of the recording: {why}"
    ));
}
