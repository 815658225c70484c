//! The options of reading a program.

use std::sync::Arc;

use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::FiveAxis;
use glidepath_program::DirectionTolerance;

use crate::execute::state::in_force::InForce;
use crate::execute::state::tip::Tip;
use crate::setup::fanuc::{FanucControl, FanucParameters};
use crate::setup::firmware::Firmware;
use crate::setup::gears::Gears;
use crate::setup::kept_variables::KeptVariables;
use crate::setup::m_codes::MCodes;
use crate::setup::machine::Machine;
use crate::setup::reading_watch::ReadingWatch;
use crate::setup::siemens::SiemensParameters;
use crate::setup::spindle_axis::SpindleAxis;
use crate::setup::subroutine_file::Subroutines;
use crate::setup::threading::Threading;
use crate::setup::tool_table::ToolTable;
use crate::setup::work_offsets::WorkOffsets;
use crate::syntax::dialect::Dialect;
use crate::syntax::dialect::question::DialectQuestion;

/// The options of reading a program: dialect, machine, tools, what is connected, bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// The machine it is for.
    pub machine: Machine,
    /// Feedrate in mm/min (°/min for a move of rotary axes alone), > 0, for feed moves before the
    /// first F word. `None`: such moves are errors.
    pub default_feed_mm_min: Option<f64>,
    /// Skips lines that start with a slash.
    pub block_delete: bool,
    /// M1 stops. Senders of grbl are not stopped by it: they have no switch for it, and grbl reads over it.
    pub stops_at_m1: bool,
    /// Where the machine stands, in machine coordinates.
    pub start: AxisVector,
    /// Coordinate systems, reference positions and the offset of G92 to begin with.
    pub offsets: WorkOffsets,
    /// Lengths and diameters of the tools. `None`: blocks that need them are errors.
    pub tools: Option<Arc<ToolTable>>,
    /// What is in the parameters that outlast a restart. Where `in_force` has parameters, those count.
    pub variables: Arc<KeptVariables>,
    /// Where subroutines come from that the program does not define. `None`: they are errors.
    pub subroutines: Option<Subroutines>,
    /// The language of the program.
    pub dialect: Dialect,
    /// What has to be asked about the language first; `None`: it is known. A program with a question is
    /// refused with it.
    pub question: Option<DialectQuestion>,
    /// What the parameters of a FANUC control say, for [`Dialect::Fanuc`].
    pub fanuc: FanucParameters,
    /// What the machine data of a SINUMERIK say, for [`Dialect::Siemens`].
    pub siemens: SiemensParameters,
    /// A machine with five axes, whose kinematics keep the tip of the tool where the program says while
    /// rotary axes turn. Other controls than LinuxCNC do so between G43.4 and G49, in a tilted plane, or
    /// behind TRAORI; elsewhere their programs move the machine's own axes. `None`: another machine.
    pub five_axis: Option<FiveAxis>,
    /// The axis that E words of [`Dialect::Marlin`] move. `None`: they are errors.
    pub extruder: Option<Axis>,
    /// The firmware of the printer that programs in [`Dialect::Marlin`] are for. `None`: not known, and
    /// where it matters they are refused.
    pub firmware: Option<Firmware>,
    /// What inputs, outputs and the probe are.
    pub connections: Connections,
    /// The highest feed at which a probe may be used, mm/s or °/s: above it the machine could not
    /// stop in time. `None`: there is no probe, unless it is simulated.
    pub probing_v: Option<f64>,
    /// What threads need (G33); `None`: nobody knows the angle of the spindle, and they are errors.
    pub threading: Option<Threading>,
    /// The spindle turns to the angle that a program gives it (M19 R), and stands there. Without it M19 is a
    /// place that the spindle knows by itself, or nothing but a stop.
    pub orients: bool,
    /// The gears of the spindle, whose words `m_codes` has, too ([`Gears::declare`]); without them M41 to M45 are what
    /// the language or `m_codes` has them be.
    pub gears: Arc<Gears>,
    /// The axis that the spindle is where it does not turn; `None`: it is none.
    pub spindle_axis: Option<SpindleAxis>,
    /// Whether the feed follows an input of the machine (M52).
    pub adaptive_feed: AdaptiveFeed,
    /// The tolerance of the path where no G64 P gives one, mm; 0: directions of the tool are taken to the letter.
    pub tolerance_mm: f64,
    /// That of the direction of the tool.
    pub direction: DirectionTolerance,
    /// Whether a rapid move to a direction of the tool may turn C back from the end of its travel.
    pub unwinds_at_rapid: bool,
    /// How far the pieces a spline is made of may be away from it, mm, > 0. G64 P overrides it with
    /// a thousandth of P.
    pub spline_tolerance_mm: f64,
    /// How many times the tolerance of G64 P moves may use, > 0: a run may be made with more or less than its
    /// program says. What is in force stays what the program says, and so does what a cycle asks for itself.
    pub tolerance_ratio: f64,
    /// M codes that the machine has beside those of every program.
    pub m_codes: Arc<MCodes>,
    /// A change of the spindle's speed is told once more at rest, by the code of its direction, so
    /// that it can be waited for.
    pub waits_for_speed: bool,
    /// What is in force when the program begins; `None`: what is so at the start-up of a control.
    pub in_force: Option<InForce>,
    /// How long loops may go on.
    pub loops: LoopLimits,
    /// Who watches the reading, and may end it; `None`: nobody.
    pub watch: Option<ReadingWatch>,
}

/// The kind of inputs, outputs (M62 to M68), spindle orientation (M19) and the probe (G38).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Connections {
    /// Nothing: blocks that need them are errors.
    #[default]
    None,
    /// Simulated: outputs are events, inputs read zero and never keep waiting, and the probe makes
    /// contact at the end of its move.
    Simulated,
    /// The machine's: outputs are events, M66 waits until [`crate::Program::answer_input`] says what
    /// an input is, and a probing move ends where [`crate::Program::answer_probe`] says.
    Real,
}

/// Whether the feed follows an input of the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AdaptiveFeed {
    /// It does not: M52 P1 is refused.
    #[default]
    None,
    /// From M52 P1 to M52 P0.
    Switched,
    /// At all times: M52 P0 is refused.
    Always,
}

/// The limits on subroutines and loops.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LoopLimits {
    /// Most of their lines executed in a row without anything coming of them; more is an error.
    pub idle_lines: u32,
    /// Most of their lines executed by [`crate::check`], each as often as it is.
    pub checked_lines: u64,
    /// Whether a program whose loops go on for longer than that may be run: what it does then is
    /// judged only when it comes to it.
    pub may_run_unchecked: bool,
}

impl Default for LoopLimits {
    /// A million idle lines, twenty million checked ones, and no more than those may run.
    fn default() -> Self {
        Self {
            idle_lines: 1_000_000,
            checked_lines: 20_000_000,
            may_run_unchecked: false,
        }
    }
}

impl Options {
    /// What the coordinates of a program are of at its beginning.
    pub(crate) const fn first_tip(&self) -> Tip {
        match self.dialect {
            Dialect::Fanuc | Dialect::Siemens if self.five_axis.is_some() => Tip::Stands,
            _ => Tip::PLAIN,
        }
    }

    /// True for a machine with X and Z, and without Y.
    pub(crate) const fn is_lathe(&self) -> bool {
        self.machine.is_lathe()
    }

    /// What a FANUC program's control is made for.
    pub(crate) fn fanuc_control(&self) -> FanucControl {
        self.fanuc.control.unwrap_or(if self.is_lathe() {
            FanucControl::LatheA
        } else {
            FanucControl::Mill
        })
    }

    /// True for a program of a SINUMERIK's lathe.
    pub(crate) fn is_siemens_lathe(&self) -> bool {
        self.dialect == Dialect::Siemens && self.is_lathe()
    }

    /// True for a program of a FANUC lathe.
    pub(crate) fn is_fanuc_lathe(&self) -> bool {
        self.dialect == Dialect::Fanuc && self.fanuc_control() != FanucControl::Mill
    }
}

impl Default for Options {
    /// All nine axes without soft limits, no default feedrate, block delete off, M1 stops, at machine zero,
    /// no offsets, no tool table, no subroutines in other files, LinuxCNC's language, nothing connected,
    /// splines to a micrometre.
    fn default() -> Self {
        Self {
            machine: Machine::unlimited(),
            default_feed_mm_min: None,
            block_delete: false,
            stops_at_m1: true,
            start: AxisVector::zeros(),
            offsets: WorkOffsets::default(),
            tools: None,
            variables: Arc::default(),
            subroutines: None,
            dialect: Dialect::LinuxCnc,
            question: None,
            fanuc: FanucParameters::default(),
            siemens: SiemensParameters::default(),
            five_axis: None,
            extruder: None,
            firmware: None,
            connections: Connections::None,
            probing_v: None,
            threading: None,
            orients: false,
            gears: Arc::default(),
            spindle_axis: None,
            adaptive_feed: AdaptiveFeed::None,
            tolerance_mm: 0.0,
            direction: DirectionTolerance::default(),
            unwinds_at_rapid: false,
            spline_tolerance_mm: 1e-5,
            tolerance_ratio: 1.0,
            m_codes: Arc::default(),
            waits_for_speed: false,
            in_force: None,
            loops: LoopLimits::default(),
            watch: None,
        }
    }
}
