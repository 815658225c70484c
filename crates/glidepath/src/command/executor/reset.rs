//! The reset that a sender asks for: modes and offsets in force are those that a machine begins with.

use std::io;

use glidepath_gcode::Program;
use glidepath_geometry::AxisVector;

use super::state::{JobExecutor, of_sender};
use crate::output;
use crate::persistence::state_store::StateStore;
use crate::position_offsets_note::PositionOffsetsNote;

impl JobExecutor<'_> {
    /// Puts in force what a machine begins with that was switched on. What is kept stays, but for the coordinate system
    /// that is chosen. Spindle and coolant are off, unless the configuration has an abort leave them as they are.
    pub(super) fn begin_anew(&mut self) {
        let mut config = self.config.clone();
        let kept = StateStore::open(&mut config).and_then(|opened| match opened {
            Some((store, _)) => store.in_first_system().map(|()| true),
            None => Ok(false),
        });
        match (&kept, &self.in_force) {
            (Ok(true), _) | (_, None) => {}
            (_, Some(in_force)) => config.program.offsets = in_force.work_offsets(),
        }
        if let Err(error) = kept {
            output::note(&format!(
                "planner: programs begin in the system of before: {error}"
            ));
        }
        (config.program.offsets.active, config.program.offsets.shift) = (0, AxisVector::zeros());
        let home = config.home();
        let options = of_sender(config).program_options(home);
        let begin = Program::new(io::empty(), options).typed().in_force();
        let before = self.in_force.as_ref().unwrap_or(&begin);
        let mut in_force = before.reset_to(&begin);
        if !self.config.stops.abort {
            in_force = in_force.turning_as(before);
        }
        let offsets = PositionOffsetsNote::new(self.link.directory());
        let noted = self.note.leave(&in_force);
        let noted = noted.and_then(|()| offsets.leave(&in_force.position_offsets()));
        if let Err(error) = noted {
            output::note(&format!(
                "planner: whoever reads a program beside it does not know what is in force: {error}"
            ));
        }
        self.in_force = Some(in_force);
    }
}
