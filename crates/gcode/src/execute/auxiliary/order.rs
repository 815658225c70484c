//! The order of a block's effects beside its motion: speed, tool, M codes, dwell.

use glidepath_program::{Event, Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::coolant::Coolant;
use crate::execute::state::spindle::SpindleDirection;
use crate::setup::firmware::Firmware;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::dialect::Dialect;
use crate::syntax::letters::Letters;
use crate::syntax::modes::NonModal;
use crate::syntax::word_check::{missing, negative};

impl Interpreter {
    /// S, T, tool change, spindle, coolant, overrides, inputs and outputs, dwell.
    pub(crate) fn auxiliary(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let before = self.state.spindle;
        self.change_gear(block, out)?;
        self.spindle_speed(block, out)?;
        self.select_tool(block, out)?;
        let codes = &block.codes;
        self.tell_speed_at_rest(block, &before, out);
        if let Some(Coded { code, .. }) = codes.spindle {
            self.turn_spindle(match code {
                3 => Some(SpindleDirection::Clockwise),
                4 => Some(SpindleDirection::Counterclockwise),
                _ => None,
            });
        }
        self.check_gear_speed(block)?;
        // A code of the machine's builder may start it; a gear does not.
        self.state.spindle.is_stopped = match (codes.spindle, codes.user) {
            (Some(Coded { code, .. }), _) => code == 5,
            (None, user) => {
                let is_still = user.is_none_or(|user| self.is_gear_word(user.code));
                self.state.spindle.is_stopped && is_still
            }
        };
        if let Some(Coded { code, .. }) = codes.coolant {
            let coolant = &mut self.state.coolant;
            match code {
                7 => coolant.mist = true,
                8 => coolant.flood = true,
                _ => *coolant = Coolant::default(),
            }
            if codes.both_coolants {
                (coolant.mist, coolant.flood) = (true, true);
            }
        }
        if let Some(Coded { code, .. }) = codes.spindle {
            self.push(out, ItemKind::Event(Event::MCode(code)));
        }
        if let Some(Coded { code, .. }) = codes.coolant {
            self.push_passing_code(code, out);
            if codes.both_coolants {
                self.push_passing_code(if code == 7 { 8 } else { 7 }, out);
            }
        }
        self.arm_rigid_tapping(block, out)?;
        self.overrides(block, out)?;
        self.saved_state(block, out)?;
        self.input_output(block, out)?;
        if let Some(Coded {
            code: NonModal::Dwell,
            span,
        }) = codes.non_modal
        {
            if block.dialect == Dialect::Fanuc {
                check_one_time(block, span)?;
            }
            let seconds = self.dwell_seconds(block).ok_or_else(|| {
                let word = match block.dialect {
                    Dialect::Siemens => "F, or S of a spindle that turns",
                    _ => "P",
                };
                missing(span, "G4", word, "how long")
            })?;
            let is_written = block.dialect == Dialect::Marlin && block.get(b'S').is_some();
            self.doubts.did_not_wait |= is_written && self.is_klipper();
            if seconds < 0.0 {
                return Err(negative(block, b'P', "the dwell"));
            }
            self.push(out, ItemKind::Dwell(seconds));
        }
        Ok(())
    }

    /// Seconds of a G4: milliseconds in the P word of printers and FANUC, seconds in their S, X and
    /// U, and in a P with a decimal point, which is Haas'; turns of the spindle in SINUMERIK's S.
    fn dwell_seconds(&self, block: &Block) -> Option<f64> {
        let milliseconds = || block.get(b'P').map(|p| 1e-3 * p);
        match block.dialect {
            Dialect::LinuxCnc => block.get(b'P'),
            Dialect::Siemens => block.get(b'P').or_else(|| self.seconds_of_turns(block)),
            // Klipper's has P alone: without it there is no wait.
            Dialect::Marlin if self.is_klipper() => milliseconds().or(Some(0.0)),
            Dialect::Marlin => block.get(b'S').or_else(milliseconds),
            Dialect::Fanuc => {
                let seconds = block.get(b'X').or_else(|| block.get(b'U'));
                // Alone it is a stop at the end of the block before; F and S are the time of others.
                let is_alone = !block.has_any(Letters::of(b"FS"));
                let written = seconds.or_else(|| fanuc_dwell(block));
                written.or(is_alone.then_some(0.0))
            }
        }
    }

    fn is_klipper(&self) -> bool {
        self.state.firmware == Some(Firmware::Klipper)
    }

    /// How long the spindle takes for the turns of S; `None` where it stands.
    fn seconds_of_turns(&self, block: &Block) -> Option<f64> {
        let spindle = &self.state.spindle;
        let turns = spindle.turning.is_some() && spindle.speed > 0.0;
        let turns = block.get(b'S').filter(|_| turns)?;
        Some(turns * 60.0 / spindle.speed)
    }

    /// An M code that needs no rest, unless the machine says where it is waited for.
    pub(crate) fn push_passing_code(&mut self, code: u32, out: &mut Vec<Item>) {
        let event = if self.options.m_codes.contains(code) {
            Event::MCode(code)
        } else {
            Event::PassingCode(code)
        };
        self.push(out, ItemKind::Event(event));
    }
}

/// Refuses two times of FANUC's dwell: X and U of its block are seconds, and no places.
fn check_one_time(block: &Block, span: SourceSpan) -> Outcome<()> {
    let times = [b'X', b'U', b'P'].map(|letter| block.get(letter));
    if times.iter().flatten().count() < 2 {
        return Ok(());
    }
    let message = "two times of one dwell";
    Err(
        BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, span, message)
            .because("X, U and P of a block with G4 are all how long it is, and no place")
            .help("write one of them; a place belongs into a block of its own"),
    )
}

/// Seconds of a P word of FANUC and Haas.
pub(crate) fn fanuc_dwell(block: &Block) -> Option<f64> {
    let unit = if block.has_no_point(b'P') { 1e-3 } else { 1.0 };
    block.get(b'P').map(|p| unit * p)
}
