//! The end of a program: what its blocks have left open, the offsets that end with it, and the spindle and the
//! coolant that stop at it.

use glidepath_geometry::AxisVector;
use glidepath_program::{Event, Item, ItemKind};

use crate::diagnostic::block_diagnostic::Outcome;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::coolant::Coolant;
use crate::execute::state::fanuc_offsets::FanucFrames;
use crate::execute::state::frame::Frame;
use crate::syntax::block::Block;

impl Interpreter {
    /// Makes what was held back for a next block, and refuses what needs one.
    pub(crate) fn end_open(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        self.mapped_items = out.len();
        self.check_spline_complete()?;
        self.check_line_complete()?;
        self.check_tap_complete()?;
        self.check_plane_complete(SourceSpan::default())?;
        self.make_thread(block, SourceSpan::default(), out)?;
        self.end_corner(block, out)?;
        self.end_compensation(out)?;
        self.map_moves(block, out)
    }

    /// The end of a program: as LinuxCNC does, the next one begins in G54.
    pub(crate) fn end_offsets(&mut self) {
        for (index, system) in core::mem::take(&mut self.state.offsets.fanuc.pending) {
            self.state.offsets.keep_system(index, system);
        }
        self.state.offsets.active = 0;
        self.state.offsets.frame = Frame::default();
        self.state.offsets.tilted = Frame::default();
        self.state.offsets.fanuc.dynamic = None;
        self.state.offsets.fanuc.local = AxisVector::zeros();
        self.state.offsets.fanuc.active = None;
        self.state.offsets.fanuc.frames = FanucFrames::default();
    }

    /// M2 and M30 stop the spindle and the coolant, in every language that has them (LinuxCNC, "M2, M30"; grbl, which
    /// does it in `gc_execute_line`; Haas, "M30"; SINUMERIK, MD 35040). What is off is not told again.
    pub(crate) fn end_auxiliary(&mut self, out: &mut Vec<Item>) {
        if self.state.spindle.turning.is_some() {
            self.turn_spindle(None);
            self.push(out, ItemKind::Event(Event::MCode(5)));
        }
        // A word counts until the end where S chooses the gear; elsewhere it stays like the gear itself.
        self.state.spindle.chooses_gear |= self.options.gears.are_by_speed();
        if self.state.coolant != Coolant::default() {
            self.state.coolant = Coolant::default();
            self.push_passing_code(9, out);
        }
    }
}
