//! G60 and G61 of Marlin: places that are kept, and gone back to.
//!
//! `G60 S` keeps the place where the tool is. `G61 S F` goes straight back to it in X, Y and Z, and
//! gives the extruder the coordinate that it had. `G61 S X Y Z` moves the axes that it names, each by
//! its number beside the place; E names no move, but the coordinate. F is that of the move alone.

use glidepath_geometry::{Axis, AxisVector};
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::Pace;
use crate::execute::state::modal::Feed;
use crate::execute::state::printer::KeptPlace;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::letters::AXIS_WORDS;
use crate::syntax::word_check::whole;

/// Most places.
const MAX_PLACES: u32 = 255;

impl Interpreter {
    /// G60, or G61 where the code is false.
    pub(crate) fn kept_place(
        &mut self,
        block: &Block,
        coded: Coded<bool>,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let slot = whole(block, b'S', MAX_PLACES)?.unwrap_or(0);
        let extruder = self.options.extruder;
        let program = self.state.offsets.to_program(self.state.position);
        let extruder_mm = extruder.map_or(0.0, |axis| program[axis.index()]);
        if coded.code {
            let place = self.state.position;
            let kept = KeptPlace { place, extruder_mm };
            self.state.kept_by_printer.places.insert(slot, kept);
            return Ok(());
        }
        let Some(kept) = self.state.kept_by_printer.places.get(&slot).copied() else {
            let message = format!("G61 S{slot} without a place that was kept");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::Parameter, coded.span, message)
                    .because("it goes back to where G60 of the same number was")
                    .help("write G60 before it, or the place itself"),
            );
        };
        let all = !block.has_any(AXIS_WORDS) && block.get(b'E').is_none();
        let scale = self.state.modal.units.mm();
        let mut target: AxisVector = self.state.position;
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            let i = axis.index();
            let beside = block.axes().find(|(named, _)| *named == axis);
            if let Some((_, by)) = beside {
                target[i] = kept.place[i] + by * scale;
            } else if all {
                target[i] = kept.place[i];
            }
        }
        let before = self.state.modal.feed;
        if let Some(feed) = block.get(b'F').filter(|feed| *feed > 0.0) {
            self.state.modal.feed = Some(Feed {
                linear_v: feed * scale / 60.0,
                rotary_v: feed / 60.0,
            });
        }
        let pace = match self.state.modal.feed {
            Some(_) => Pace::Feed,
            None => Pace::Rapid,
        };
        self.straight(block, target, pace, out)?;
        self.state.modal.feed = before;
        if let Some(axis) = extruder.filter(|_| all || block.get(b'E').is_some()) {
            let mut values = [None; glidepath_geometry::AXES];
            values[axis.index()] = Some(kept.extruder_mm);
            self.state.offsets.set_shift(self.state.position, &values);
        }
        Ok(())
    }
}
