//! The check mode `$C`: lines are judged, and nothing moves.

use crate::config::MachineConfig;
use crate::persistence::read::{read, set_up};
use glidepath_gcode::{Dialect, InForce, Program};
use glidepath_geometry::AxisVector;
use glidepath_grbl::Refused;

/// Judges lines, each with what those before it have left in force.
pub(super) struct Checking {
    config: MachineConfig,
    /// What is in force, and where the lines have brought the machine that does not move.
    behind: Option<(InForce, AxisVector)>,
}

impl Checking {
    pub(super) fn new(config: &MachineConfig) -> Self {
        let mut config = config.clone();
        config.program.dialect = Some(Dialect::LinuxCnc);
        Self {
            config,
            behind: None,
        }
    }

    /// Why a line is refused, if it is. The first one begins where the machine stands.
    pub(super) fn judge(&mut self, line: &str, position: AxisVector) -> Option<Refused> {
        let mut config = self.config.clone();
        let start = match self.behind.take() {
            Some((in_force, place)) => {
                config.program.offsets = in_force.work_offsets();
                config.program.in_force = Some(in_force);
                place
            }
            None => {
                if let Ok(Some(kept)) = read(&config) {
                    set_up(&mut config, &kept);
                }
                position
            }
        };
        let text = format!("{line}\n");
        let mut program = Program::new(text.as_bytes(), config.program_options(start));
        let found = program.find_map(Result::err);
        // Without the end of a program, which a line with a finding does not come to.
        self.behind = match &found {
            None => Some((program.in_force(), *program.position())),
            Some(_) => config.program.in_force.take().map(|it| (it, start)),
        };
        found.map(|found| Refused {
            column: found.column,
            name: found.code.as_str().to_owned(),
            text: found.message,
            is_in_motion: false,
        })
    }
}
