//! The check of moves against the travel of every axis.

use glidepath_geometry::{Axis, AxisVector};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::syntax::block::Block;

impl Interpreter {
    /// Refuses a move whose box, from `low` to `high`, leaves the travel of an axis that moves, or
    /// turns a spindle by its axis that turns already.
    pub(crate) fn check_limits(
        &self,
        block: &Block,
        low: &AxisVector,
        high: &AxisVector,
        what: &str,
    ) -> Outcome<()> {
        self.check_spindle_axis(block, low, high)?;
        if self.state.is_mapped {
            // The places of the axes are judged when they are known.
            return Ok(());
        }
        self.check_travel(block, low, high, &self.state.path_end, what)
    }

    /// Refuses a move of the axes whose box leaves the travel of one that moves; `start` is where they
    /// stand.
    pub(crate) fn check_travel(
        &self,
        block: &Block,
        low: &AxisVector,
        high: &AxisVector,
        start: &AxisVector,
        what: &str,
    ) -> Outcome<()> {
        for axis in Axis::ALL {
            let i = axis.index();
            let Some(travel) = self.options.machine.travel(axis) else {
                continue;
            };
            // A machine that stands outside may come back, and may move its other axes.
            let start = start[i];
            if high[i] > self.soft_limits.high[i] && high[i] > start {
                return Err(beyond_limit(block, axis, high[i], travel.max, what));
            }
            if low[i] < self.soft_limits.low[i] && low[i] < start {
                return Err(beyond_limit(block, axis, low[i], travel.min, what));
            }
        }
        Ok(())
    }
}

#[cold]
fn beyond_limit(
    block: &Block,
    axis: Axis,
    reached: f64,
    limit: f64,
    what: &str,
) -> Box<BlockDiagnostic> {
    let span = Some(block.axis_span(axis)).filter(|span| span.length > 0);
    let unit = if axis.is_rotary() { "°" } else { " mm" };
    let side = if reached > limit { "above" } else { "below" };
    let message = format!(
        "{what} of the move is outside the travel of {axis}: {}{unit} is {side} {}{unit}",
        short(reached),
        short(limit)
    );
    BlockDiagnostic::new(
        DiagnosticCode::SoftLimit,
        span.unwrap_or_else(|| block.motion_span()),
        message,
    )
    .because("the soft limits are machine coordinates: work offsets are included")
    .help("check the work offset and the start position, or make the part smaller")
}

/// A coordinate for a message, to the nanometre.
fn short(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}
