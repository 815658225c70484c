//! The recovery behind a refused block, where a program is judged: its modes count, so that a
//! diagnostic does not breed others.
//!
//! A move beyond the travel leaves `G1` in force, and the machine is taken to be where the move was
//! to end: the next blocks are judged by themselves. What runs a program stops at its first
//! diagnostic, and a line that was typed has no effect at all.

use std::io::BufRead;
use std::mem;

use crate::diagnostic::Diagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::nurbs::has_point;
use crate::execute::program::Program;
use crate::execute::scope::ProgramScope;
use crate::execute::state::modal::Feed;
use crate::execute::state::open_spline::goes_on;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::dialect::marlin::named_command;
use crate::syntax::modes::{FeedMode, Motion, Spline};

impl Interpreter {
    /// Takes over the modes of a block that was refused.
    pub(crate) fn adopt_modes(&mut self, block: &Block) {
        let (modal, codes) = (&mut self.state.modal, &block.codes);
        if let Some(coded) = codes.motion.filter(|_| !codes.is_once) {
            modal.motion = coded.code;
        }
        if let Some(coded) = codes.plane {
            modal.plane = coded.code;
        }
        if let Some(coded) = codes.units {
            modal.units = coded.code;
        }
        if let Some(coded) = codes.diameter {
            modal.diameter = coded.code;
        }
        if let Some(coded) = codes.distance {
            modal.distance = coded.code;
        }
        if let Some(coded) = codes.arc_distance {
            modal.arc_distance = coded.code;
        }
        if let Some(coded) = codes.retract {
            modal.retract = coded.code;
        }
        if let Some(coded) = codes.feed_mode {
            if modal.feed_mode != coded.code {
                modal.feed = None;
            }
            modal.feed_mode = coded.code;
        }
        let per_second = match modal.feed_mode {
            FeedMode::PerMinute => 60.0,
            FeedMode::PerRevolution => 1.0,
            FeedMode::InverseTime => return,
        };
        if let Some(feed) = block.get(b'F').filter(|feed| *feed > 0.0) {
            modal.feed = Some(Feed {
                linear_v: feed * modal.units.mm() / per_second,
                rotary_v: feed / per_second,
            });
        }
    }

    /// Whether a block that was refused is the end of the NURBS in front of it: it completes it, or is none of
    /// its blocks.
    fn ends_curve(&self, block: &Block) -> bool {
        let Some(open) = &self.state.open.spline else {
            return false;
        };
        let motion = self.motion_of(block).unwrap_or_default();
        match motion {
            Some(Motion::Spline(Spline::EndWeighted)) => true,
            Some(Motion::Spline(Spline::Knotted)) if open.knotted => {
                !has_point(block) && open.knots + 1 >= open.knots_needed()
            }
            motion => !goes_on(block, open, motion),
        }
    }

    /// Takes the machine to be where a move beyond its travel, or into a corner that the tool does not fit into, would
    /// have ended. Of a contour whose path is not known any more no more is told.
    pub(crate) fn adopt_place(&mut self, block: &Block, code: DiagnosticCode) {
        let is_move = self
            .state
            .modal
            .motion
            .is_some_and(|motion| !motion.may_lack_axes() || motion.is_arc());
        let is_plain = block.codes.non_modal.is_none();
        let leads_somewhere = matches!(code, DiagnosticCode::SoftLimit | DiagnosticCode::Gouge);
        if leads_somewhere && is_move && is_plain && block.has_axes() {
            if self.state.open.compensation.take().is_some() {
                (self.state.on_contour, self.state.leaving_contour) = (false, false);
            }
            self.take_polar_words(block);
            if let Ok(target) = self.target(block) {
                self.state.position = target;
                self.state.path_end = target;
                self.axes_follow_place();
            }
        }
    }
}

impl<R: BufRead> Program<R> {
    /// Reads on behind a diagnostic.
    pub(crate) fn read_on(&mut self, diagnostic: &Diagnostic) {
        if diagnostic.code.is_of_reading() {
            // What stands in front of the word that could not be read.
            let before = diagnostic.column.saturating_sub(1);
            let text = self.here().text;
            let length = usize::try_from(before).unwrap_or_default().min(text.len());
            self.read_words(text.get(..length).unwrap_or_default());
        }
        let is_printer = self.block.dialect == Dialect::Marlin;
        if is_printer && named_command(self.source.text()).is_some() {
            self.take_for_klipper();
        }
        let ends_curve =
            !diagnostic.code.is_of_reading() && self.interpreter.ends_curve(&self.block);
        let state = &mut self.interpreter.state;
        // What is open in front of it is no finding of its own.
        let open = mem::take(&mut state.open);
        if open.corner.is_some() || open.thread.is_some() {
            state.path_end = state.position;
        }
        state.open.compensation = open.compensation;
        state.open.spline = open.spline.filter(|_| !ends_curve);
        state.fanuc.open_plane = None;
        self.interpreter.adopt_modes(&self.block);
        self.interpreter.adopt_place(&self.block, diagnostic.code);
    }

    fn read_words(&mut self, text: &[u8]) {
        let scope = ProgramScope {
            parameters: &self.parameters,
            interpreter: &self.interpreter,
        };
        // What cannot be read either leaves the words in front of it.
        self.block.parse_any(text, &scope).ok();
    }
}
