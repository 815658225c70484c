//! Threads of several blocks: G32 behind G32 (FANUC), G33 behind G33 (FANUC, SINUMERIK).
//!
//! Only the first block waits for the angle of the spindle: the others go on at the speed that it gives.
//! So all of them are one pass, which is made when its last block is known. Between two blocks that lead
//! to different sides the motion does not rest: the corner is rounded by as much as the axes need to
//! keep up with the spindle.

use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::open_thread::Groove;
use crate::execute::state::open_thread::OpenThread;
use crate::setup::threading::{SPEED_RESERVE, Threading};
use crate::syntax::block::Block;
use crate::syntax::modes::Motion;

/// Most blocks of one thread.
const MOST_BLOCKS: usize = 100;
/// Rounding of corners that are none, mm.
const LEAST_CORNER_MM: f64 = 1e-3;
/// The part of a block that the rounding of a corner may take.
const CORNER_PART: f64 = 0.25;

impl Interpreter {
    /// Where the next thread begins.
    pub(super) fn thread_from(&self) -> AxisVector {
        let open = self.state.open.thread.as_ref();
        let last = open.and_then(|open| open.grooves.last());
        last.map_or(self.state.path_end, |groove| groove.end)
    }

    /// Takes up a block of a thread, and makes the pass if it is the last one.
    pub(super) fn chain_thread(
        &mut self,
        block: &Block,
        (groove, target): (Groove, AxisVector),
        phase: u32,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let open = self.state.open.thread.get_or_insert_default();
        if open.grooves.is_empty() {
            open.phase = phase;
        } else if block.get(b'Q').is_some() || open.grooves.len() >= MOST_BLOCKS {
            let span = block.motion_span();
            let message = "a thread that does not go on as it began";
            return Err(BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                .because(format!(
                    "its first block gives the angle (Q) at which it begins, and it has {MOST_BLOCKS} blocks at most"
                ))
                .help("write Q into the first block, or retract in between"));
        }
        open.grooves.push(groove);
        self.state.position = target;
        if self.thread_goes_on {
            return Ok(());
        }
        self.make_thread(block, block.motion_span(), out)?;
        self.state.position = target;
        Ok(())
    }

    /// Before a block: makes a thread that it does not go on with.
    pub(crate) fn settle_thread(
        &mut self,
        block: &Block,
        motion: Option<Motion>,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        if self.state.open.thread.is_none() || motion == Some(Motion::Thread) {
            return Ok(());
        }
        self.make_thread(block, block.first_span(), out)
    }

    /// Makes the pass of all blocks.
    pub(crate) fn make_thread(
        &mut self,
        block: &Block,
        span: SourceSpan,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let Some(mut open) = self.state.open.thread.take() else {
            return Ok(());
        };
        let threading = self.check_spindle(span)?;
        let corner_mm = self.corner_of_thread(&threading, &open, span)?;
        for groove in &mut open.grooves {
            groove.corner_mm = corner_mm;
        }
        self.pass(block, &open.grooves, open.phase, out)
    }

    /// By how much corners are rounded so that the axes keep up with the spindle, mm.
    fn corner_of_thread(
        &self,
        threading: &Threading,
        open: &OpenThread,
        span: SourceSpan,
    ) -> Outcome<f64> {
        let turns = SPEED_RESERVE * self.state.spindle.speed / 60.0;
        let mut from = self.state.path_end;
        let mut before: Option<(AxisVector, f64)> = None;
        let mut corner_mm = LEAST_CORNER_MM;
        for groove in &open.grooves {
            let segment = Segment::line(from, groove.end);
            let speed = segment.jet(0.0).d1 * (groove.pitch_mm * turns);
            if let Some((speed_before, length)) = before {
                let own_mm = threading.corner_mm(&(speed - speed_before));
                if own_mm > CORNER_PART * length.min(segment.length()) {
                    return Err(too_sharp(groove, own_mm, span));
                }
                corner_mm = corner_mm.max(own_mm);
            }
            before = Some((speed, segment.length()));
            from = groove.end;
        }
        Ok(corner_mm)
    }
}

#[cold]
fn too_sharp(groove: &Groove, corner_mm: f64, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!(
        "the thread of line {} turns too sharply for this speed of the spindle",
        groove.line
    );
    BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
        .because(format!(
            "the axes need a corner that is rounded by {corner_mm:.3} mm to keep up with it, which is more than a quarter of a block"
        ))
        .help("turn more slowly, or write longer blocks")
}
