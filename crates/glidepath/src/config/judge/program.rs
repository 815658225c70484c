//! `[program]`: how programs are read.

use super::values::Judge;
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::program::ProgramConfig;
use crate::config::raw::RawProgram;
use glidepath_gcode::{
    Arctangent, Connections, Dialect, FanucControl, FanucParameters, Firmware, OffsetMemory,
    PointInput, WorkOffsets,
};
use glidepath_geometry::Axis;
use std::path::PathBuf;
use toml::Spanned;

/// The axes that E words may move.
const EXTRUDERS: [(&str, Option<Axis>); 4] = [
    ("none", None),
    ("U", Some(Axis::U)),
    ("V", Some(Axis::V)),
    ("W", Some(Axis::W)),
];

/// The firmwares of printers.
const FIRMWARES: [(&str, Option<Firmware>); 3] = [
    ("auto", None),
    ("marlin", Some(Firmware::Marlin)),
    ("klipper", Some(Firmware::Klipper)),
];

impl Judge {
    pub(super) fn program(&mut self, raw: RawProgram, expects_feedback: bool) -> ProgramConfig {
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
            ("feedback", Connections::Real),
        ];
        let span = raw.inputs_outputs.as_ref().map(Spanned::span);
        let connections = self.choice("program.inputs_outputs", raw.inputs_outputs, &connections);
        if connections == Connections::Real && !expects_feedback {
            self.diagnostics.push(ConfigDiagnostic {
                key: "program.inputs_outputs".to_owned(),
                message: "program.inputs_outputs = \"feedback\", and nobody sends any".to_owned(),
                help: Some("set feedback.source = \"drives\"".to_owned()),
                span,
            });
        }
        let fanuc = FanucParameters {
            control: self.choice(
                "program.fanuc",
                raw.fanuc,
                &[
                    ("auto", None),
                    ("mill", Some(FanucControl::Mill)),
                    ("lathe-a", Some(FanucControl::LatheA)),
                ],
            ),
            point: self.choice(
                "program.point",
                raw.point,
                &[
                    ("unsaid", PointInput::Unsaid),
                    ("calculator", PointInput::Calculator),
                    ("increment", PointInput::Increment),
                ],
            ),
            offset_memory: self.choice(
                "program.offset_memory",
                raw.offset_memory,
                &[
                    ("unsaid", OffsetMemory::Unsaid),
                    ("A", OffsetMemory::A),
                    ("C", OffsetMemory::C),
                    ("haas", OffsetMemory::Haas),
                ],
            ),
            arctangent: self.choice(
                "program.arctangent",
                raw.arctangent,
                &[("0-360", Arctangent::Full), ("signed", Arctangent::Signed)],
            ),
        };
        ProgramConfig {
            fanuc,
            dialect: self.choice("program.dialect", raw.dialect, &dialects),
            tool_table: raw.tool_table.map(|path| path.into_inner().into()),
            tools: None,
            offsets: WorkOffsets::default(),
            subroutine_path: raw.subroutine_path.into_iter().map(PathBuf::from).collect(),
            subroutines: None,
            connections,
            extruder: self.choice("program.extruder", raw.extruder, &EXTRUDERS),
            firmware: self.choice("program.firmware", raw.firmware, &FIRMWARES),
            in_force: None,
            watch: None,
            may_run_unchecked: false,
        }
    }
}
