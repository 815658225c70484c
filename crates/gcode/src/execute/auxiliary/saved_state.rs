//! Saved modal state: M70, M71, M72, M73.
//!
//! | code | what it does |
//! |---|---|
//! | M70 | saves the modal state |
//! | M71 | forgets what was saved |
//! | M72 | restores what was saved |
//! | M73 | saves, and restores when the subroutine returns |
//!
//! Each subroutine in progress has a place of its own for it, which goes when it returns, and so
//! does the program. What is saved is all that modal codes set, with F, S and what spindle, coolant
//! and overrides were told; the motion mode stays as it is, and so do values of G10, G52 and G92.
//!
//! Restoring gives out the events of what changes beside the motion: speed, M3 to M5, M7 to M9, M48
//! or M49. It may end cutter radius compensation, and never begins it: where the tool would be then
//! depends on a move that nobody wrote.

use glidepath_program::{Event, Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::coolant::Coolant;
use crate::execute::state::modal::Modal;
use crate::execute::state::open_spline::interrupted;
use crate::execute::state::saved_states::{Saved, SavedLevel};
use crate::execute::state::spindle::SpindleDirection;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::dialect::Dialect;
use crate::syntax::refused::refused_m;

impl Interpreter {
    /// M70 to M73.
    pub(crate) fn saved_state(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let Some(Coded { code, span }) = block.codes.saved_state else {
            return Ok(());
        };
        if block.dialect != Dialect::LinuxCnc {
            return Err(refused_m(code, f64::from(code), span));
        }
        match code {
            71 => self.state.saved_states.present().saved = None,
            72 => {
                let Some(saved) = self.state.saved_states.present().saved else {
                    let message = "there is no saved state to restore";
                    return Err(BlockDiagnostic::new(DiagnosticCode::SavedState, span, message)
                        .because(
                            "a subroutine restores what it saved itself, the program what it saved \
                             outside of subroutines",
                        )
                        .help("save it by M70 before"));
                };
                self.restore(&saved, span, out)?;
            }
            _ => {
                let saved = self.present_state();
                let level = self.state.saved_states.present();
                level.saved = Some(saved);
                level.on_return |= code == 73;
            }
        }
        Ok(())
    }

    /// A subroutine returns, by the O word at `span`: restores what it saved by M73.
    pub(crate) fn restore_on_return(
        &mut self,
        span: SourceSpan,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        match self.state.saved_states.calls.pop() {
            Some(SavedLevel {
                saved: Some(saved),
                on_return: true,
            }) => self.restore(&saved, span, out),
            _ => Ok(()),
        }
    }

    fn present_state(&self) -> Saved {
        Saved {
            modal: self.state.modal,
            compensated: self.compensated(),
            system: self.state.offsets.active,
            tool_offset: self.state.offsets.tool,
            spindle: self.state.spindle,
            coolant: self.state.coolant,
            overrides_off: self.state.overrides_off,
        }
    }

    fn restore(&mut self, saved: &Saved, span: SourceSpan, out: &mut Vec<Item>) -> Outcome<()> {
        if let Some(open) = &self.state.open.spline {
            return Err(interrupted(open, span));
        }
        self.restore_compensation(saved, span, out)?;
        self.state.modal = Modal {
            motion: self.state.modal.motion,
            ..saved.modal
        };
        // How a G5 goes on depends on the plane.
        self.state.cubic_tail = None;
        self.state.offsets.active = saved.system;
        self.state.offsets.tool = saved.tool_offset;
        self.restore_speed(saved.spindle, out);
        let turning = saved.spindle.turning;
        if turning != self.state.spindle.turning {
            self.turn_spindle(turning);
            self.event(turning.map_or(5, SpindleDirection::code), out);
        }
        self.restore_coolant(saved.coolant, out);
        if saved.overrides_off != self.state.overrides_off {
            self.state.overrides_off = saved.overrides_off;
            self.push_passing_code(if saved.overrides_off { 49 } else { 48 }, out);
        }
        Ok(())
    }

    fn event(&mut self, code: u32, out: &mut Vec<Item>) {
        self.push(out, ItemKind::Event(Event::MCode(code)));
    }

    fn restore_coolant(&mut self, saved: Coolant, out: &mut Vec<Item>) {
        let present = self.state.coolant;
        // One of them goes off by M9 alone, which takes the other with it.
        let off = (present.mist && !saved.mist) || (present.flood && !saved.flood);
        if off {
            self.push_passing_code(9, out);
        }
        if saved.mist && (off || !present.mist) {
            self.push_passing_code(7, out);
        }
        if saved.flood && (off || !present.flood) {
            self.push_passing_code(8, out);
        }
        self.state.coolant = saved;
    }

    /// Ends cutter radius compensation that was off, and refuses to begin or change it.
    fn restore_compensation(
        &mut self,
        saved: &Saved,
        span: SourceSpan,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let present = self.compensated();
        if saved.compensated.is_none() {
            if present.is_some() {
                self.end_compensation(out)?;
                self.state.on_contour = false;
            }
            return Ok(());
        }
        let modal = &self.state.modal;
        let same = saved.compensated == present
            && saved.modal.plane == modal.plane
            && saved.modal.diameter == modal.diameter
            && saved.system == self.state.offsets.active
            && saved.tool_offset == self.state.offsets.tool;
        if same {
            return Ok(());
        }
        let message = "the saved state has another cutter radius compensation than there is now";
        Err(BlockDiagnostic::new(DiagnosticCode::CutterRadius, span, message)
            .because("where the tool is when it begins or changes depends on a move of its own")
            .help(
                "write G40 before the state is saved, or the same G41 or G42 before it is restored",
            ))
    }
}
