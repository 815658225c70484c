//! Increments behind a new frame, work offset or tool length: whether they go its shift, too.
//!
//! ```text
//!   G90 G0 X0
//!   TRANS X10
//!   G91 X5        X15 of the machine: the increment counts from X0 of the new frame (SD 42440, 1)
//!                 X5 of the machine: the increment alone                          (SD 42440, 0)
//! ```
//!
//! SD 42442 says the same of the length of the tool.

use std::io::BufRead;

use glidepath_geometry::{AXES, AxisVector};

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::interpreter::Interpreter;
use crate::execute::program::Program;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::dialect::siemens::coordinate::unclear_increment;

/// The names that places have: the coordinates of the machine's place, and what a way along each of
/// X, Y and Z is to the machine.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlaceNames {
    place: AxisVector,
    ways: [AxisVector; 3],
}

impl Interpreter {
    /// The names in force.
    pub(crate) fn place_names(&self) -> PlaceNames {
        let way = |axis: usize| {
            let mut way = AxisVector::zeros();
            way[axis] = 1.0;
            self.state.offsets.turn(way)
        };
        PlaceNames {
            place: self.state.offsets.to_program(self.state.position),
            ways: [way(0), way(1), way(2)],
        }
    }

    /// A frame or a work offset has given the first `axes` axes other names.
    pub(crate) fn rename_by_frame(&mut self, before: &PlaceNames, axes: usize) {
        if self.options.siemens.frame_goes_with_increments {
            self.rename(before, axes);
        }
    }

    /// A tool length has.
    pub(crate) fn rename_by_length(&mut self, before: &PlaceNames) {
        if self.options.siemens.length_goes_with_increments {
            self.rename(before, AXES);
        }
    }

    fn rename(&mut self, before: &PlaceNames, axes: usize) {
        if self.options.dialect != Dialect::Siemens {
            return;
        }
        let now = self.place_names();
        let is_turned = now.ways != before.ways;
        for axis in 0..axes {
            self.state.untraversed.rename(
                axis,
                before.place[axis],
                now.place[axis],
                is_turned && axis < 3,
            );
        }
    }

    /// Adds the shifts to the increments of a block.
    pub(crate) fn add_untraversed(
        &self,
        block: &Block,
        values: &mut [Option<f64>; AXES],
    ) -> Outcome<()> {
        let untraversed = &self.state.untraversed;
        for (axis, value) in values.iter_mut().enumerate() {
            let Some(value) = value else { continue };
            if untraversed.is_unclear[axis] {
                let named = block.axes().find(|(named, _)| named.index() == axis);
                let span =
                    named.map_or_else(|| block.motion_span(), |(axis, _)| block.axis_span(axis));
                return Err(unclear_increment(span));
            }
            *value += untraversed.way[axis];
        }
        Ok(())
    }

    /// Behind a motion that began at `from`: the axes that moved, or were named, have coordinates of their own.
    pub(crate) fn forget_untraversed(&mut self, block: &Block, from: &AxisVector) {
        if !self.state.untraversed.is_any() {
            return;
        }
        for axis in 0..AXES {
            if (self.state.position[axis] - from[axis]).abs() > 0.0 {
                self.state.untraversed.forget(axis);
            }
        }
        for (axis, _) in block.axes() {
            self.state.untraversed.forget(axis.index());
        }
    }
}

impl<R: BufRead> Program<R> {
    /// Does what gives places other names, and moves nothing.
    pub(super) fn renaming(&mut self, act: impl FnOnce(&mut Self) -> Outcome<()>) -> Outcome<()> {
        let before = self.interpreter.place_names();
        act(self)?;
        self.interpreter.rename_by_frame(&before, AXES);
        Ok(())
    }
}
