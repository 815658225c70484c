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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config;
    use core::time::Duration;
    use glidepath_grbl::{Act, Doing, MachineSettings, MachineView, Session};

    /// What a sender is told for each of these lines, the first one at once in `$C`.
    fn answers(lines: &[&str]) -> Vec<String> {
        let config = config::parse("mill.toml", config::EMBEDDED).unwrap();
        let mut checking = Checking::new(&config);
        let mut session = Session::new(MachineSettings::default());
        let machine = MachineView {
            doing: Doing::Idle,
            ..MachineView::default()
        };
        session.see(&machine, Duration::ZERO);
        session.connected(Duration::ZERO);
        session.hear(b"$C\n", Duration::ZERO);
        session.take_output();
        let answer = |line: &&str| {
            session.hear(format!("{line}\n").as_bytes(), Duration::ZERO);
            for act in session.take_acts() {
                if let Act::Judge(line) = act {
                    session.judged(checking.judge(&line, AxisVector::zeros()).as_ref());
                }
            }
            let said = String::from_utf8(session.take_output()).unwrap();
            said.lines().last().unwrap_or_default().to_owned()
        };
        lines.iter().map(answer).collect()
    }

    /// The numbers are those of grbl 1.1h (`report.h`), for what `gc_execute_line` finds in these lines.
    #[test]
    fn lines_are_refused_by_the_numbers_of_grbl() {
        let expected = [
            ("G92", "error:26"),
            ("G10 L2 P1", "error:26"),
            ("G10 L20 P1", "error:26"),
            ("G10 L2 P1 R5", "error:20"),
            ("G2 X1 F100", "error:35"),
            ("G3 F100 X1 Y1", "error:35"),
            ("G2 X10 Y0 I1 J0 F100", "error:33"),
            ("G2 X100 R1 F100", "error:34"),
            ("G43.1", "error:37"),
            ("G1 X1 X2 F100", "error:25"),
            ("G1 X1 F1 F2", "error:25"),
            ("G4 P-1", "error:4"),
            ("S-1", "error:4"),
            ("M3 S-1", "error:4"),
            ("F-1", "error:4"),
            ("G1 X1 F-1", "error:4"),
            ("T-1", "error:4"),
            ("G4", "error:28"),
            ("G1 X1", "error:22"),
            ("G1 X1 F0", "error:22"),
            ("F0", "ok"),
            ("G53", "ok"),
            ("G53 G2 X1 I1 F100", "error:30"),
            ("G10 L2 P99 X1", "error:29"),
            ("G10 X1", "error:28"),
            ("G38.2 F100", "error:26"),
            ("G0 G53", "ok"),
            ("M1", "ok"),
            ("G17 G18", "error:21"),
            ("G999", "error:20"),
        ];
        for (line, number) in expected {
            assert_eq!(answers(&["G0 X0 Y0", line])[1], number, "{line}");
        }
        assert_eq!(answers(&["F100", "F0", "G1 X1"])[2], "error:22");
    }
}
