//! The gears of the spindle: M41 to M45, M40 of SINUMERIK, and the gear for an S.
//!
//! A gear is an event in front of the speed and the direction of its block, at rest. An S that the gear in
//! force does not reach is refused: controls limit it, and the part is cut at another speed than the
//! program says. The cutting speed of G96 is limited, as its revolutions follow the tool.

use glidepath_program::{Event, Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::setup::gears::{BY_SPEED, Gears};
use crate::syntax::block::Block;

impl Interpreter {
    /// Whether a code of the machine is a gear of its spindle.
    pub(super) fn is_gear_word(&self, code: u32) -> bool {
        self.options.gears.has_word(code, self.options.dialect)
    }

    /// The word for the gear of a block.
    fn gear_word(&self, block: &Block) -> Outcome<Option<(u32, SourceSpan)>> {
        let Some(user) = block.codes.user else {
            return Ok(None);
        };
        let more = block.codes.more_of_user.map(u32::from);
        let mut words = [user.code]
            .into_iter()
            .chain(more)
            .filter(|code| self.is_gear_word(*code));
        let Some(code) = words.next() else {
            return Ok(None);
        };
        if let Some(other) = words.next() {
            let message = format!("M{code} and M{other} in a block");
            return Err(BlockDiagnostic::new(
                DiagnosticCode::ModalGroupConflict,
                user.span,
                message,
            )
            .because("the spindle has one gear at a time")
            .help("write one of them"));
        }
        Ok(Some((code, user.span)))
    }

    /// M40 to M45.
    pub(super) fn change_gear(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        if self.options.gears.count() == 0 {
            return Ok(());
        }
        let Some((code, span)) = self.gear_word(block)? else {
            return Ok(());
        };
        if code == BY_SPEED {
            self.state.spindle.chooses_gear = true;
            let speed = self.state.spindle.speed;
            if block.get(b'S').is_none() {
                self.choose_gear(speed, out);
            }
            return Ok(());
        }
        let Some(gear) = self.options.gears.of_word(code) else {
            let message = format!("M{code} is a gear that the spindle does not have");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                    .because(format!("it has {}", self.options.gears.listed()))
                    .help("write the word of one of these, or add it to `gears` in [spindle]"),
            );
        };
        self.state.spindle.chooses_gear = false;
        self.tell_gear(gear, out);
        Ok(())
    }

    fn tell_gear(&mut self, gear: u32, out: &mut Vec<Item>) {
        self.state.spindle.gear = gear;
        self.push(out, ItemKind::Event(Event::SpindleGear(gear)));
        self.push(out, ItemKind::Event(Event::MCode(Gears::word(gear))));
    }

    /// The gear for a speed that is told, where S chooses it. Under G96 the gear stays.
    pub(super) fn choose_gear(&mut self, speed: f64, out: &mut Vec<Item>) {
        let spindle = &self.state.spindle;
        if !spindle.chooses_gear || spindle.surface.is_some() || speed <= 0.0 {
            return;
        }
        let present = spindle.gear;
        let chosen = self.options.gears.for_speed(speed, present);
        if let Some(gear) = chosen.filter(|gear| *gear != present) {
            self.tell_gear(gear, out);
        }
    }

    /// Revolutions of G96 that the gear in force has.
    pub(super) fn in_gear(&self, speed: f64) -> f64 {
        let speeds = self.options.gears.speeds_of(self.state.spindle.gear);
        match speeds {
            Some(speeds) if speed > 0.0 => speed.clamp(speeds.least, speeds.most),
            _ => speed,
        }
    }

    /// Refuses a speed that the gear does not have, where a block says one of them, or turns the spindle.
    pub(super) fn check_gear_speed(&self, block: &Block) -> Outcome<()> {
        let gears = &self.options.gears;
        let spindle = &self.state.spindle;
        let (speed, gear) = (spindle.speed, spindle.gear);
        let is_still = spindle.turning.is_none() || speed <= 0.0;
        if gears.count() == 0 || is_still || spindle.surface.is_some() {
            return Ok(());
        }
        let word = self.gear_word(block)?;
        let direction = block.codes.spindle.map(|coded| coded.span);
        let said = block.get(b'S').map(|_| block.span(b'S'));
        let Some(span) = said.or(word.map(|(_, span)| span)).or(direction) else {
            return Ok(());
        };
        let message = match gears.speeds_of(gear) {
            Some(speeds) if (speeds.least..=speeds.most).contains(&speed) => return Ok(()),
            Some(speeds) if !spindle.chooses_gear => format!(
                "S{speed} is not from {} to {} rev/min, as gear {gear} (M{}) turns",
                speeds.least,
                speeds.most,
                Gears::word(gear)
            ),
            None if !spindle.chooses_gear => return Ok(()),
            _ => format!("S{speed} is a speed of no gear"),
        };
        Err(
            BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                .because(format!("the spindle has {}", gears.listed()))
                .help(
                    "write an S that the gear has, in the block of its word or in front of it, or the word of \
                     another gear",
                ),
        )
    }
}
