//! The reader of programs: RS274/NGC text to canonical machining moves, with diagnostics.
//!
//! This crate is the first stage of the pipeline: it turns the text of a program into
//! [`Item`](glidepath_program::Item)s, which the motion planner then joins and times.
//!
//! ```text
//! bytes ─► syntax ─► blocks ─► execute ─► items ─► (planner, motion, interpolator)
//!            ▲                    │  modal state, offsets, tools,
//!            └── parameters ◄─────┘  cycles, compensation, flow
//! ```
//!
//! * `syntax` reads the text of a line into the words of a block. It knows no machine, no modal
//!   state and no offset.
//! * `execute` gives blocks their meaning: modes, offsets, tools, canned and lathe cycles, cutter
//!   radius compensation, subroutines and loops, in each of the dialects.
//! * `setup` is what a program is read for: the machine, its tools, the folder of its subroutines.
//! * `diagnostic` tells what is wrong with a program; `summary` counts what it comes to.
//!
//! # Entry points
//!
//! | to | use |
//! |---|---|
//! | execute a program | [`Program`]: an iterator of items, which ends at the first diagnostic |
//! | judge a program | [`check`]: reads on behind diagnostics, and gives a [`Report`] with counts and sums |
//! | accept or refuse a program, fast | [`diagnostics`]: as [`check`], without the counts and sums |
//! | say for which machine, and how | [`Options`] with [`Machine`], [`ToolTable`], [`Subroutines`], [`Dialect`] |
//! | know which words there are | the module [`language`] |
//!
//! # What always holds
//!
//! * Items are in machine coordinates, in mm, degrees and mm/s, whatever the program's units and
//!   offsets. Each move starts exactly where the one before it ended.
//! * A line that is not understood is never skipped: it is a [`Diagnostic`] with line, column,
//!   reason and remedy. A block that is refused has no effect at all.
//! * Memory is bounded, whatever the program: lines are read as a stream, and what is kept for
//!   subroutines, loops and open curves has a limit each.
//! * No program makes this crate panic, and no program goes on for ever without a move
//!   ([`LoopLimits`]).
//! * The same text and the same options give the same items, bit for bit.
//!
//! # Example
//!
//! ```
//! use glidepath_gcode::{Options, Program, check};
//!
//! let text = "G21 G90\nG0 X10\nG1 Y5 F600\nM2\n";
//! let items: Result<Vec<_>, _> = Program::new(text.as_bytes(), Options::default()).collect();
//! assert_eq!(items?.len(), 2);
//!
//! let report = check("G1 X1.2.3 F100\n".as_bytes(), Options::default());
//! let first = &report.diagnostics[0];
//! assert_eq!((first.line, first.column), (1, 5));
//! assert_eq!(first.code.as_str(), "malformed-number");
//! # Ok::<(), glidepath_gcode::Diagnostic>(())
//! ```

mod check;
mod diagnostic;
mod execute;
mod lacking;
pub mod language;
mod setup;
mod summary;
mod syntax;

pub use check::{Diagnostics, Report, check, diagnostics};
pub use diagnostic::code::DiagnosticCode;
pub use diagnostic::excerpt::Excerpt;
pub use diagnostic::{Diagnostic, MAX_DIAGNOSTICS};
pub use execute::auxiliary::input_wait::{Input, InputWait, WaitFor};
pub use execute::motion::position_offsets::PositionOffsets;
pub use execute::program::Program;
pub use execute::state::in_force::InForce;
pub use execute::state::modal::{Feed, Modal};
pub use execute::state::probe_result::Probed;
pub use execute::state::tip::Tip;
pub use lacking::Lacking;
pub use setup::fanuc::{
    Arctangent, BoreShift, FanucControl, FanucParameters, FeedAtStart, OffsetMemory, OuterCorners,
    PointInput, RotationStart,
};
pub use setup::firmware::Firmware;
pub use setup::gears::{GearSpeeds, Gears};
pub use setup::kept_variables::{KEPT_VARIABLES, KeptVariables};
pub use setup::m_codes::{MCodes, WaitsAt};
pub use setup::machine::{AxisTravel, Machine};
pub use setup::options::{AdaptiveFeed, Connections, LoopLimits, Options};
pub use setup::reading_watch::ReadingWatch;
pub use setup::siemens::{LatheX, SiemensParameters, ToolChangeBy};
pub use setup::spindle_axis::SpindleAxis;
pub use setup::subroutine_file::{
    MAX_SUBROUTINE_BYTES, NoSubroutineFile, SubroutineFile, Subroutines,
};
pub use setup::threading::Threading;
pub use setup::tool_table::{MAX_TOOLS, Tool, ToolTable};
pub use setup::work_offsets::{CoordinateSystem, SYSTEMS, WorkOffsets};
pub use summary::part_box::PartBox;
pub use summary::pole_turns::PoleTurns;
pub use summary::remark::{Remark, RemarkKind};
pub use summary::survey::{Corner, Survey};
pub use summary::totals::Totals;
pub use syntax::cursor::MAX_NUMBER;
pub use syntax::dialect::Dialect;
pub use syntax::dialect::detect::Detection;
pub use syntax::dialect::question::DialectQuestion;
pub use syntax::line_source::MAX_LINE_BYTES;
pub use syntax::modes::{
    CannedCycle, Distance, FeedMode, LatheCycle, Motion, Pockets, Probe, Retract, Spline, Turning,
    Units,
};
