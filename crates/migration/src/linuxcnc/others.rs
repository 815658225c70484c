//! The remaining keys: files, and everything that nothing here corresponds to, each with the
//! reason.

use super::Machine;
use crate::draft::quoted;
use crate::inputs::Fate;

/// Why keys of a section have no counterpart.
const SECTIONS: [(&str, &str); 14] = [
    ("EMC", "names and versions of LinuxCNC's own"),
    ("DISPLAY", "the operator's screen is no part of this"),
    ("FILTER", "programs are read as they are"),
    (
        "TASK",
        "processes are services here, see deployment.md of the manual",
    ),
    ("EMCMOT", "threads and modules of LinuxCNC's own"),
    (
        "HAL",
        "inputs, outputs and drives are connected through the servo stack",
    ),
    (
        "HALUI",
        "what an operator does is a command here, such as `glidepath hold`",
    ),
    (
        "EMCIO",
        "tool changers are connected through the servo stack",
    ),
    ("APPLICATIONS", "no programs are started"),
    ("PYTHON", "there are no remaps"),
    ("KINS", "joints follow from the mechanism"),
    (
        "TRAJ",
        "velocities and homes of the path are no part of the machine here",
    ),
    (
        "RS274NGC",
        "there is no such setting of the program's reader",
    ),
    (
        "HOSTMOT2",
        "drives and their interfaces belong to the servo stack",
    ),
];

/// Why keys of an axis or a joint have no counterpart, by how they begin.
const JOINT_KEYS: [(&str, &str); 20] = [
    (
        "HOME",
        "joints that are not axes come home by their drives: feedback.homing = \"drive\"",
    ),
    (
        "VOLATILE_HOME",
        "joints that are not axes come home by their drives: feedback.homing = \"drive\"",
    ),
    ("LOCKING_INDEXER", "there are no locking indexers"),
    (
        "WRAPPED_ROTARY",
        "a rotary axis counts on; it does not wrap",
    ),
    ("FERROR", "see feedback.following_error"),
    ("MIN_FERROR", "see feedback.min_following_error"),
    (
        "BACKLASH",
        "it is converted where joints are axes and each axis has one; else see compensation.J0.backlash",
    ),
    (
        "COMP_FILE",
        "`glidepath config from-screw FILE --joint J0 --values measured` makes its table (`trims`, if COMP_FILE_TYPE is 1; `--unit inch`, if its units are)",
    ),
    ("TYPE", "letters say which axes turn"),
    ("UNITS", "units are those of [TRAJ]"),
    ("P", "the drive's control loop"),
    ("I", "the drive's control loop"),
    ("D", "the drive's control loop"),
    ("FF", "the drive's control loop"),
    ("BIAS", "the drive's control loop"),
    ("DEADBAND", "the drive's control loop"),
    ("SCALE", "the drive's steps"),
    ("STEP", "the drive's steps"),
    ("DIR", "the drive's steps"),
    ("OFFSET_AV_RATIO", "there are no external offsets"),
];

/// Why some keys have no counterpart.
const REASONS: [(&str, &str, &str); 7] = [
    ("RS274NGC", "REMAP", "there are no remaps"),
    (
        "RS274NGC",
        "ON_ABORT_COMMAND",
        "nothing is executed after an abort",
    ),
    ("RS274NGC", "USER_M_PATH", "M100 to M199 are refused"),
    (
        "TRAJ",
        "NO_FORCE_HOMING",
        "nothing asks for homing here: see to it that the drives are homed",
    ),
    (
        "TRAJ",
        "POSITION_FILE",
        "no position is taken from a file: drives say where they are",
    ),
    (
        "TRAJ",
        "MAX_LINEAR_VELOCITY",
        "each axis has its own limit; the path has none",
    ),
    (
        "TRAJ",
        "MAX_LINEAR_ACCELERATION",
        "each axis has its own limit; path.max_tangential_acceleration is another",
    ),
];

impl Machine {
    pub(crate) fn others(&mut self) {
        self.files();
        for at in 0..self.inputs.len() {
            if self.inputs.is_decided(at) {
                continue;
            }
            let Some(input) = self.inputs.get(at) else {
                continue;
            };
            let (section, key) = (
                input.section.to_ascii_uppercase(),
                input.key.to_ascii_uppercase(),
            );
            let is_repeated = self.inputs.find(&section, &key) != Some(at);
            let is_of_joint = section.starts_with("JOINT_") || section.starts_with("AXIS_");
            let reason = if is_repeated && is_of_joint {
                "it stands there before, and the first one counts"
            } else if is_of_joint {
                let known = JOINT_KEYS.iter().find(|(begin, _)| {
                    key.strip_prefix(begin).is_some_and(|rest| {
                        begin.len() > 2
                            || rest.is_empty()
                            || rest.starts_with(|c: char| c.is_ascii_digit())
                    })
                });
                known.map_or(
                    "belongs to the drive, or to an axis or joint the machine does not have",
                    |k| k.1,
                )
            } else {
                let known = SECTIONS.iter().find(|(name, _)| *name == section);
                known.map_or("a section of somebody else's", |k| k.1)
            };
            self.inputs.decide(at, Fate::NoCounterpart, reason);
        }
    }

    fn files(&mut self) {
        let in_inches = self.units.linear_mm != Some(1.0);
        if let Some((at, file)) = self.inputs.text("EMCIO", "TOOL_TABLE") {
            let file = file.to_owned();
            if in_inches {
                let note = "its lengths are in the machine's units there, in mm here: convert the file, \
                            then name it as program.tool_table";
                self.draft.remark(
                    "program",
                    &format!("tool_table = {}; {note}", quoted(&file)),
                );
                self.inputs.decide(at, Fate::Changed, note);
            } else {
                self.draft
                    .known("program", "tool_table", quoted(&file), "[EMCIO]TOOL_TABLE");
                self.inputs
                    .decide(at, Fate::Converted, "program.tool_table");
            }
        }
        if let Some((at, path)) = self.inputs.text("RS274NGC", "SUBROUTINE_PATH") {
            let folders: Vec<String> = path
                .split(':')
                .map(|folder| quoted(folder.trim()))
                .collect();
            let list = format!("[{}]", folders.join(", "));
            self.draft.known(
                "program",
                "subroutine_path",
                list,
                "[RS274NGC]SUBROUTINE_PATH",
            );
            self.inputs
                .decide(at, Fate::Converted, "program.subroutine_path");
        }
        if let Some((at, file)) = self.inputs.text("RS274NGC", "PARAMETER_FILE") {
            let units = if in_inches { "inch" } else { "mm" };
            let note = format!(
                "what it keeps is taken over by `glidepath offsets import {file} --linear-units {units}`, \
                 once state.directory names a folder"
            );
            self.draft
                .remark("state", &format!("directory = \"state\"; {note}"));
            self.inputs.decide(at, Fate::Changed, note);
        }
        self.reasons();
    }

    /// Keys whose reason is not that of their section.
    fn reasons(&mut self) {
        for (section, key, note) in REASONS {
            for at in 0..self.inputs.len() {
                let is = self.inputs.get(at).is_some_and(|input| {
                    input.section.eq_ignore_ascii_case(section)
                        && input.key.eq_ignore_ascii_case(key)
                });
                if is {
                    self.inputs.decide(at, Fate::NoCounterpart, note);
                }
            }
        }
    }
}
