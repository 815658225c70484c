//! Why a program cannot be taken up again.

use thiserror::Error;

/// Why a program cannot be taken up again. Nothing has moved.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ResumeError {
    /// The interpolator has not executed any program since it was started.
    #[error("no program was under way: run it from its beginning, without --resume")]
    NothingToResume,
    /// What was executed last came to its end.
    #[error("what was executed last came to its end: there is nothing to resume")]
    Completed,
    /// The program that is under way goes back along its path.
    #[error(
        "the program under way goes back along its path: let it go on (`glidepath forward`), or end \
         it (`glidepath abort`)"
    )]
    GoesBack,
    /// The program is not the one that was under way, or was edited since.
    #[error(
        "this is not the program that was under way, or it was edited since; only the same text can \
         be resumed"
    )]
    OtherProgram,
    /// The program was left in a pass of a thread.
    #[error(
        "the program was left in the thread of line {line}: retract the tool, and run it from that \
         line or an earlier one (--from-line)"
    )]
    InThread {
        /// The line.
        line: u32,
    },
    /// The machine does not stand where the program says.
    #[error(
        "the machine does not stand on this program's path at block {block} (line {line}): the \
         nearest point there is {distance_mm:.4} mm away; it was moved, or another configuration was \
         used"
    )]
    OffPath {
        /// The block.
        block: u32,
        /// Its line, 0 if the program ends before.
        line: u32,
        /// Distance to the nearest point that comes into question, mm or degrees; infinite if there
        /// is none.
        distance_mm: f64,
    },
}
