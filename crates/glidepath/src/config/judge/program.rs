//! `[program]`: how programs are read.

use super::values::{Judge, Range};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::program::ProgramConfig;
use crate::config::raw::{Optional, RawProgram};
use glidepath_gcode::{
    Arctangent, BoreShift, Connections, Dialect, FanucControl, FanucParameters, FeedAtStart,
    Firmware, LatheX, OffsetMemory, OuterCorners, PointInput, RotationStart, SiemensParameters,
    ToolChangeBy, Units, WorkOffsets,
};
use glidepath_geometry::Axis;
use glidepath_kinematics::Mechanism;
use std::path::PathBuf;
use std::sync::Arc;
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

/// Where an axis goes before the rotary axes turn.
const SWIVEL: Range = Range {
    min: -1e6,
    max: 1e6,
    unit: "mm",
    help: "a place of that axis of the machine where the rotary axes may turn",
};

impl Judge {
    pub(super) fn program(
        &mut self,
        mut raw: RawProgram,
        mechanism: &Mechanism,
        expects_feedback: bool,
    ) -> ProgramConfig {
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
        let connections = self.choice(
            "program.inputs_outputs",
            raw.inputs_outputs.take(),
            &connections,
        );
        if connections == Connections::Real && !expects_feedback {
            self.diagnostics.push(ConfigDiagnostic {
                key: "program.inputs_outputs".to_owned(),
                message: "program.inputs_outputs = \"feedback\", and nobody sends any".to_owned(),
                help: Some("set feedback.source = \"drives\"".to_owned()),
                span,
            });
        }
        let fanuc = self.fanuc(&mut raw);
        let siemens = self.siemens(&mut raw);
        ProgramConfig {
            fanuc,
            siemens,
            dialect: self.choice("program.dialect", raw.dialect, &dialects),
            question: None,
            tool_table: raw.tool_table.map(|path| path.into_inner().into()),
            tools: None,
            offsets: WorkOffsets::default(),
            variables: Arc::default(),
            subroutine_path: raw.subroutine_path.into_iter().map(PathBuf::from).collect(),
            subroutines: None,
            connections,
            extruder: self.choice("program.extruder", raw.extruder, &EXTRUDERS),
            unwinds_at_rapid: self.unwinds_at_rapid(raw.unwind, mechanism),
            firmware: self.choice("program.firmware", raw.firmware, &FIRMWARES),
            in_force: None,
            stands: None,
            tolerance_ratio: 1.0,
            watch: None,
            may_run_unchecked: false,
        }
    }

    fn unwinds_at_rapid(&mut self, value: Optional<String>, mechanism: &Mechanism) -> bool {
        const KEY: &str = "program.unwind";
        let span = value.as_ref().map(Spanned::span);
        let unwinds = self.choice(KEY, value, &[("never", false), ("rapids", true)]);
        if unwinds && !matches!(mechanism, Mechanism::FiveAxis(_)) {
            self.diagnostics.push(ConfigDiagnostic {
                key: KEY.to_owned(),
                message: format!("{KEY} = \"rapids\" on a machine without five axes"),
                help: Some(
                    "leave it out: there is no direction of a tool that C winds up for".to_owned(),
                ),
                span,
            });
        }
        unwinds
    }

    /// What the parameters of a FANUC control say.
    fn fanuc(&mut self, raw: &mut RawProgram) -> FanucParameters {
        FanucParameters {
            control: self.choice(
                "program.fanuc",
                raw.fanuc.take(),
                &[
                    ("auto", None),
                    ("mill", Some(FanucControl::Mill)),
                    ("lathe-a", Some(FanucControl::LatheA)),
                    ("lathe-b", Some(FanucControl::LatheB)),
                    ("lathe-c", Some(FanucControl::LatheC)),
                ],
            ),
            point: self.choice(
                "program.point",
                raw.point.take(),
                &[
                    ("unsaid", PointInput::Unsaid),
                    ("calculator", PointInput::Calculator),
                    ("increment", PointInput::Increment),
                ],
            ),
            offset_memory: self.choice(
                "program.offset_memory",
                raw.offset_memory.take(),
                &[
                    ("unsaid", OffsetMemory::Unsaid),
                    ("A", OffsetMemory::A),
                    ("C", OffsetMemory::C),
                    ("haas", OffsetMemory::Haas),
                ],
            ),
            arctangent: self.choice(
                "program.arctangent",
                raw.arctangent.take(),
                &[("0-360", Arctangent::Full), ("signed", Arctangent::Signed)],
            ),
            bore_shift: self.choice(
                "program.bore_shift",
                raw.bore_shift.take(),
                &[
                    ("unsaid", BoreShift::Unsaid),
                    ("+X", BoreShift::PlusX),
                    ("-X", BoreShift::MinusX),
                    ("+Y", BoreShift::PlusY),
                    ("-Y", BoreShift::MinusY),
                ],
            ),
            rolls_over: self.choice(
                "program.roll_over",
                raw.roll_over.take(),
                &[("off", false), ("shorter-way", true)],
            ),
            rotations_are_absolute: self.choice(
                "program.rotation",
                raw.rotation.take(),
                &[("by-distance-mode", false), ("absolute", true)],
            ),
            rotation_start: self.rotation_start(raw),
            outer_corners: self.choice(
                "program.outer_corners",
                raw.outer_corners.take(),
                &[
                    ("unsaid", OuterCorners::Unsaid),
                    ("lines", OuterCorners::Lines),
                    ("arcs", OuterCorners::Arcs),
                ],
            ),
            units_at_start: self.choice(
                "program.units",
                raw.units.take(),
                &[
                    ("unsaid", None),
                    ("mm", Some(Units::Millimetre)),
                    ("inch", Some(Units::Inch)),
                ],
            ),
            feed_at_start: self.feed_at_start(raw),
        }
    }

    /// Where a coordinate is that the first move behind a FANUC's G68 does not name.
    fn rotation_start(&mut self, raw: &mut RawProgram) -> RotationStart {
        self.choice(
            "program.rotation_start",
            raw.rotation_start.take(),
            &[
                ("unsaid", RotationStart::Unsaid),
                ("as-before", RotationStart::AsBefore),
                ("as-rotated", RotationStart::AsRotated),
            ],
        )
    }

    /// What F of a FANUC's lathe counts before a program says it.
    fn feed_at_start(&mut self, raw: &mut RawProgram) -> FeedAtStart {
        self.choice(
            "program.lathe_feed",
            raw.lathe_feed.take(),
            &[
                ("unsaid", FeedAtStart::Unsaid),
                ("minute", FeedAtStart::PerMinute),
                ("revolution", FeedAtStart::PerRevolution),
            ],
        )
    }

    /// What the machine data of a SINUMERIK say.
    fn siemens(&mut self, raw: &mut RawProgram) -> SiemensParameters {
        SiemensParameters {
            tool_change: self.choice(
                "program.tool_change",
                raw.tool_change.take(),
                &[
                    ("auto", None),
                    ("T", Some(ToolChangeBy::T)),
                    ("M6", Some(ToolChangeBy::M6)),
                ],
            ),
            edge_after_change: self.choice(
                "program.edge_after_change",
                raw.edge_after_change.take(),
                &[("D1", true), ("none", false)],
            ),
            flat_d_numbers: self.choice(
                "program.d_numbers",
                raw.d_numbers.take(),
                &[("edges", false), ("flat", true)],
            ),
            lathe_x: self.choice(
                "program.lathe_x",
                raw.lathe_x.take(),
                &[
                    ("unsaid", LatheX::Unsaid),
                    ("diameter", LatheX::Diameter),
                    ("radius", LatheX::Radius),
                    ("diameter-in-G90", LatheX::DiameterInG90),
                ],
            ),
            frame_goes_with_increments: self.choice(
                "program.increment_after_frame",
                raw.increment_after_frame.take(),
                &[("shifted", true), ("alone", false)],
            ),
            length_goes_with_increments: self.choice(
                "program.increment_after_length",
                raw.increment_after_length.take(),
                &[("shifted", true), ("alone", false)],
            ),
            reads_over_h: self.choice(
                "program.h_words",
                raw.h_words.take(),
                &[("refused", false), ("read-over", true)],
            ),
            swivel_z_mm: raw
                .swivel_z
                .take()
                .map(|value| self.number("program.swivel_z", &value, &SWIVEL)),
            swivel_xy_mm: [
                ("program.swivel_x", raw.swivel_x.take()),
                ("program.swivel_y", raw.swivel_y.take()),
            ]
            .map(|(key, value)| value.map(|value| self.number(key, &value, &SWIVEL))),
        }
    }
}
