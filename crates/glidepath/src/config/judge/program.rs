//! `[program]`: how programs are read.

use super::values::Judge;
use crate::config::program::ProgramConfig;
use crate::config::raw::RawProgram;
use glidepath_gcode::{Connections, Dialect, WorkOffsets};
use glidepath_geometry::Axis;
use std::path::PathBuf;

impl Judge {
    pub(super) fn program(&mut self, raw: RawProgram) -> ProgramConfig {
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
        ProgramConfig {
            dialect: self.choice("program.dialect", raw.dialect, &dialects),
            tool_table: raw.tool_table.map(|path| path.into_inner().into()),
            tools: None,
            offsets: WorkOffsets::default(),
            subroutine_path: raw.subroutine_path.into_iter().map(PathBuf::from).collect(),
            subroutines: None,
            connections: self.choice("program.inputs_outputs", raw.inputs_outputs, &connections),
            extruder: self.choice("program.extruder", raw.extruder, &extruders),
            may_run_unchecked: false,
        }
    }
}
