//! A spindle that is an axis of the machine: when it turns, and when it is one.
//!
//! Its drive turns it from M3 or M4 to M5, and follows the axis at all other times. So a tap has it
//! stand before, and the program has it turn again before the next move that is no tap.

use glidepath_geometry::{Axis, AxisVector};
use glidepath_program::{Event, Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::settled::MIN_MOVE;
use crate::execute::state::spindle::SpindleDirection;
use crate::syntax::block::Block;

impl Interpreter {
    pub(crate) fn spindle_axis(&self) -> Option<Axis> {
        self.options.spindle_axis.map(|spindle| spindle.axis)
    }

    /// Notes which way the spindle is told to turn, or that it is told to stand.
    pub(crate) fn turn_spindle(&mut self, turning: Option<SpindleDirection>) {
        self.state.spindle.turning = turning;
        self.state.spindle.is_axis = turning.is_none();
    }

    /// Makes an axis of the spindle.
    pub(crate) fn spindle_to_axis(&mut self, out: &mut Vec<Item>) {
        if !core::mem::replace(&mut self.state.spindle.is_axis, true) {
            self.push(out, ItemKind::Event(Event::MCode(5)));
        }
    }

    /// Has the spindle turn again if it stands for taps alone.
    pub(crate) fn spindle_from_taps(&mut self, out: &mut Vec<Item>) {
        let spindle = &mut self.state.spindle;
        if spindle.stands_for_tap()
            && let Some(turning) = spindle.turning
        {
            spindle.is_axis = false;
            self.push(out, ItemKind::Event(Event::MCode(turning.code())));
        }
    }

    /// Refuses a move, by its box, of the axis that is the spindle while that turns.
    pub(crate) fn check_spindle_axis(
        &self,
        block: &Block,
        low: &AxisVector,
        high: &AxisVector,
    ) -> Outcome<()> {
        let spindle = &self.state.spindle;
        let Some(axis) = self.spindle_axis() else {
            return Ok(());
        };
        let i = axis.index();
        let start = self.state.path_end[i];
        let moves = high[i] - start > MIN_MOVE || start - low[i] > MIN_MOVE;
        if !moves || spindle.turning.is_none() || spindle.is_axis {
            return Ok(());
        }
        let span = Some(block.axis_span(axis)).filter(|span| span.length > 0);
        let message = format!("a move of {axis}, which is the spindle, while that turns");
        Err(BlockDiagnostic::new(
            DiagnosticCode::Spindle,
            span.unwrap_or_else(|| block.motion_span()),
            message,
        )
        .because("its drive follows the axis when M3 and M4 do not turn it")
        .help("write M5 before"))
    }
}
