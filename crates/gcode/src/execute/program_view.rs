//! What a program has come to, for those who ask: modes, places, offsets, tools.

use std::io::BufRead;
use std::sync::Arc;

use glidepath_geometry::AxisVector;

use crate::execute::motion::position_offsets::PositionOffsets;
use crate::execute::program::Program;
use crate::execute::state::modal::Modal;
use crate::execute::state::words_in_force::words_in_force;
use crate::setup::kept_variables::KeptVariables;
use crate::setup::tool_table::ToolTable;
use crate::setup::work_offsets::WorkOffsets;

impl<R: BufRead> Program<R> {
    /// True where G41 or G42 is in force.
    #[must_use]
    pub const fn is_on_contour(&self) -> bool {
        self.interpreter.state.on_contour || self.interpreter.state.leaving_contour
    }

    /// Modal state after the last block read.
    #[must_use]
    pub const fn modal(&self) -> &Modal {
        &self.interpreter.state.modal
    }

    /// Machine position after the last block read.
    #[must_use]
    pub const fn position(&self) -> &AxisVector {
        self.interpreter.axes_place()
    }

    /// How many times coordinate systems, reference positions, the offset of G92, tools, or parameters that
    /// outlast a restart were changed so far.
    #[must_use]
    pub const fn changes(&self) -> u64 {
        self.interpreter.state.changes + self.parameters.changes()
    }

    /// What is in the parameters that outlast a restart after the last block read.
    #[must_use]
    pub fn kept_variables(&self) -> KeptVariables {
        self.parameters.kept()
    }

    /// Coordinate systems, reference positions and the offset of G92 after the last block read.
    #[must_use]
    pub fn work_offsets(&self) -> WorkOffsets {
        self.interpreter.state.offsets.set_up()
    }

    /// The tool table after the last block read, with what G10 has made of it.
    #[must_use]
    pub const fn tools(&self) -> Option<&Arc<ToolTable>> {
        self.interpreter.state.tools.as_ref()
    }

    /// The codes and words in force after the last block read, as a line would say them: motion, coordinate
    /// system, plane, units, distance and feed mode, spindle, coolant, tool, feed and speed.
    #[must_use]
    pub fn words_in_force(&self) -> String {
        words_in_force(&self.interpreter.state)
    }

    /// Where the program's zero is in machine coordinates after the last block read, with all offsets, that of
    /// the tool, too.
    #[must_use]
    pub fn zero(&self) -> AxisVector {
        self.interpreter
            .state
            .offsets
            .to_machine(AxisVector::zeros())
    }

    /// The offset of the tool (G43) after the last block read.
    #[must_use]
    pub fn tool_offset(&self) -> &AxisVector {
        &self.interpreter.state.offsets.tool
    }

    /// The offsets in force after the last block read, beside the coordinate system.
    #[must_use]
    pub fn position_offsets(&self) -> PositionOffsets {
        PositionOffsets {
            tool: self.interpreter.state.offsets.tool,
            shift: self.interpreter.state.offsets.shift,
            tip: self.interpreter.state.tip,
        }
    }

    /// Tool in the spindle after the last block read; 0: none.
    #[must_use]
    pub const fn tool(&self) -> u32 {
        self.interpreter.state.tool
    }
}
