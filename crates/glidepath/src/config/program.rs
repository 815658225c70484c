//! The table `[program]`: how programs are read.

use glidepath_gcode::{
    Connections, Dialect, DialectQuestion, FanucParameters, Firmware, InForce, KeptVariables,
    ReadingWatch, SiemensParameters, Subroutines, ToolTable, WorkOffsets,
};
use glidepath_geometry::{Axis, AxisVector};
use std::path::PathBuf;
use std::sync::Arc;

/// The table `[program]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ProgramConfig {
    /// The language of programs; `None`: told by their beginning.
    pub dialect: Option<Dialect>,
    /// What has to be asked about the language of the program to be read.
    pub question: Option<DialectQuestion>,
    /// What the parameters of a FANUC control say.
    pub fanuc: FanucParameters,
    /// What the machine data of a SINUMERIK say.
    pub siemens: SiemensParameters,
    /// The tool table's file.
    pub tool_table: Option<PathBuf>,
    /// What the machine is set up with, once it has been read.
    pub offsets: WorkOffsets,
    /// The tool table, once it has been read.
    pub tools: Option<Arc<ToolTable>>,
    /// What is kept of the parameters of programs, once it has been read.
    pub variables: Arc<KeptVariables>,
    /// Folders of subroutines in files of their own, in the order they are looked in, behind the
    /// folder of the program.
    pub subroutine_path: Vec<PathBuf>,
    /// The subroutines of the program to be read, once that is known.
    pub subroutines: Option<Subroutines>,
    /// What inputs, outputs and the probe are.
    pub connections: Connections,
    /// The axis E words move.
    pub extruder: Option<Axis>,
    /// Whether a rapid move to a direction of the tool may turn C back from the end of its travel.
    pub unwinds_at_rapid: bool,
    /// The firmware of the printer.
    pub firmware: Option<Firmware>,
    /// What is in force when the program begins, behind others of the same service.
    pub in_force: Option<InForce>,
    /// Where the machine stands on which it would begin now, in machine coordinates; `None`: at home.
    pub stands: Option<AxisVector>,
    /// How many times its tolerance this run may use. The tolerance of the path has it already.
    pub tolerance_ratio: f64,
    /// Who watches the reading, and may end it.
    pub watch: Option<ReadingWatch>,
    /// Whether a program may run that could not be checked to its end.
    pub may_run_unchecked: bool,
}
