//! How programs are read.

use super::judge::Judge;
use super::raw::RawProgram;
use glidepath_gcode::{Connections, Dialect, Subroutines, ToolTable};
use glidepath_geometry::Axis;
use std::path::PathBuf;
use std::sync::Arc;

/// The table `[program]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ProgramConfig {
    /// The language of programs; `None`: told by their beginning.
    pub dialect: Option<Dialect>,
    /// The tool table's file.
    pub tool_table: Option<PathBuf>,
    /// The tool table, once it has been read.
    pub tools: Option<Arc<ToolTable>>,
    /// Folders of subroutines in files of their own, in the order they are looked in, behind the
    /// folder of the program.
    pub subroutine_path: Vec<PathBuf>,
    /// The subroutines of the program to be read, once that is known.
    pub subroutines: Option<Subroutines>,
    /// What inputs, outputs and the probe are.
    pub connections: Connections,
    /// The axis E words move.
    pub extruder: Option<Axis>,
}

impl ProgramConfig {
    /// Judges the table.
    pub(super) fn judge(judge: &mut Judge, raw: RawProgram) -> Self {
        let dialects = [
            ("auto", None),
            ("linuxcnc", Some(Dialect::LinuxCnc)),
            ("marlin", Some(Dialect::Marlin)),
            ("fanuc", Some(Dialect::Fanuc)),
            ("siemens", Some(Dialect::Siemens)),
        ];
        let connections = [
            ("none", Connections::None),
            ("simulated", Connections::Simulated),
        ];
        let extruders = [
            ("none", None),
            ("U", Some(Axis::U)),
            ("V", Some(Axis::V)),
            ("W", Some(Axis::W)),
        ];
        Self {
            dialect: judge.choice("program.dialect", raw.dialect, &dialects),
            tool_table: raw.tool_table.map(|path| path.into_inner().into()),
            tools: None,
            subroutine_path: raw.subroutine_path.into_iter().map(PathBuf::from).collect(),
            subroutines: None,
            connections: judge.choice("program.inputs_outputs", raw.inputs_outputs, &connections),
            extruder: judge.choice("program.extruder", raw.extruder, &extruders),
        }
    }
}
