//! The spindle as the program commands it: direction, speed, and what S means.
//!
//! With G96 the S word is a cutting speed (m/min, or ft/min in inches) and the revolutions follow
//! from the distance of the tool from the X axis' zero: n = 1000 S / (2 π |x|), at most D. The
//! event with the speed is given out with the S word, on the way of straight moves at feed, and
//! after every move that changes it by more than 1 %. LIMS of SINUMERIK limits the revolutions of G97, too.

use core::f64::consts::TAU;

use glidepath_geometry::AxisVector;
use glidepath_program::{Event, Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::spindle::{Spindle, Surface};
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::cursor::MAX_NUMBER;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{NonModal, SpindleMode, Units};
use crate::syntax::named_word::Named;
use crate::syntax::word_check::{missing, negative};

/// Relative change of the speed of G96 that is worth an event.
const WORTH_TELLING: f64 = 0.01;
/// Millimetres of a foot.
const FOOT_MM: f64 = 304.8;

/// True where S is the highest speed: G50 S of FANUC's lathes.
fn is_limit(block: &Block) -> bool {
    block
        .codes
        .non_modal
        .is_some_and(|non_modal| non_modal.code == NonModal::LatheSetting)
}

impl Interpreter {
    /// G96, G97 and S.
    pub(crate) fn spindle_speed(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        self.speed_limit(block)?;
        self.end_by_feed_mode(block);
        if let Some(Coded { code, span }) = block.codes.spindle_mode {
            // D of SINUMERIK is the edge of a tool.
            let word = block
                .get(b'D')
                .filter(|_| block.dialect == Dialect::LinuxCnc);
            let most = word.unwrap_or(f64::INFINITY);
            if most <= 0.0 {
                let message = "the largest spindle speed is not above zero";
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::InvalidValue,
                    block.span(b'D'),
                    message,
                )
                .help("write a D above zero, or leave it out"));
            }
            let spindle = &mut self.state.spindle;
            if spindle.surface.is_some() {
                // Without S G97 keeps the speed that there is.
                spindle.asked = spindle.speed;
            }
            let is_siemens = block.dialect == Dialect::Siemens;
            spindle.is_limited = is_siemens && code == SpindleMode::Revolutions;
            spindle.surface = match code {
                SpindleMode::Revolutions | SpindleMode::UnlimitedRevolutions => None,
                SpindleMode::SurfaceSpeed if block.get(b'S').is_none() => {
                    return Err(missing(span, "G96", "S", "the cutting speed"));
                }
                SpindleMode::SurfaceSpeed => Some(Surface { speed: 0.0, most }),
            };
        }
        let Some(speed) = block.get(b'S') else {
            self.keep_to_limit(block, out);
            return Ok(());
        };
        if speed > 0.0 && is_limit(block) {
            self.state.spindle.most = Some(speed);
            return Ok(());
        }
        let dwell = block
            .codes
            .non_modal
            .is_some_and(|non_modal| non_modal.code == NonModal::Dwell);
        if block.codes.kept_place.is_some()
            || dwell && matches!(block.dialect, Dialect::Marlin | Dialect::Siemens)
        {
            // The seconds of the dwell, or its turns.
            return Ok(());
        }
        if speed < 0.0 {
            return Err(negative(block, b'S', "the spindle speed"));
        }
        let unit = match self.state.modal.units {
            Units::Inch => FOOT_MM,
            Units::Millimetre => 1000.0,
        };
        if let Some(surface) = &mut self.state.spindle.surface {
            surface.speed = speed * unit;
            let speed = self.surface_revolutions().unwrap_or_default();
            self.tell_speed(speed, out);
        } else {
            self.state.spindle.asked = speed;
            self.tell_speed(self.state.spindle.allowed(), out);
        }
        Ok(())
    }

    /// On a SINUMERIK G93 to G97 are one group: a feed mode alone ends G96 and G97, at the speed that there is.
    fn end_by_feed_mode(&mut self, block: &Block) {
        let codes = &block.codes;
        let ends = codes.feed_mode.is_some() && codes.spindle_mode.is_none();
        if block.dialect == Dialect::Siemens && ends {
            let spindle = &mut self.state.spindle;
            spindle.asked = spindle.speed;
            spindle.is_limited = false;
            spindle.surface = None;
        }
    }

    /// LIMS, and S of G25 and G26.
    fn speed_limit(&mut self, block: &Block) -> Outcome<()> {
        for word in [Named::UpperSpeed, Named::LowerSpeed] {
            let Some(limit) = block.named.find(word) else {
                continue;
            };
            if limit.value < 0.0 || limit.value <= 0.0 && word == Named::UpperSpeed {
                let message = format!("{} is {}", word.name(), limit.value);
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::InvalidValue,
                    limit.span,
                    message,
                )
                .because("it is a limit of the spindle's speed")
                .help("write revolutions a minute"));
            }
            let spindle = &mut self.state.spindle;
            match word {
                Named::UpperSpeed => spindle.upper = Some(limit.value),
                _ => spindle.lower = Some(limit.value),
            }
        }
        let Some(limit) = block.named.find(Named::SpeedLimit) else {
            return Ok(());
        };
        if limit.value > 0.0 {
            self.state.spindle.most = Some(limit.value);
            return Ok(());
        }
        let message = format!("LIMS={} is not above zero", limit.value);
        Err(
            BlockDiagnostic::new(DiagnosticCode::InvalidValue, limit.span, message)
                .because("it is the highest speed of the spindle under G96 and G97")
                .help("write revolutions a minute"),
        )
    }

    /// A limit of G97 that is new, or not in force any more.
    fn keep_to_limit(&mut self, block: &Block, out: &mut Vec<Item>) {
        let spindle = &self.state.spindle;
        let allowed = spindle.allowed();
        let is_new = spindle.asked > 0.0 && (allowed - spindle.speed).abs() > 0.0;
        let limits = [spindle.most, spindle.upper, spindle.lower];
        let has_limit = block.dialect == Dialect::Siemens && limits.iter().any(Option::is_some);
        if has_limit && spindle.surface.is_none() && is_new {
            self.tell_speed(allowed, out);
        }
    }

    /// A new speed of a spindle that turns, or the same in another gear, is told at rest, if it is to be waited
    /// for. With G96 the
    /// speed follows the tool, and is not waited for.
    pub(crate) fn tell_speed_at_rest(
        &mut self,
        block: &Block,
        before: &Spindle,
        out: &mut Vec<Item>,
    ) {
        let Some(direction) = self.state.spindle.turning else {
            return;
        };
        let spindle = &self.state.spindle;
        let is_other = (spindle.speed - before.speed).abs() > 0.0;
        let is_new = is_other && spindle.surface.is_none() || spindle.gear != before.gear;
        let turns = !spindle.is_axis;
        if self.options.waits_for_speed && is_new && turns && block.codes.spindle.is_none() {
            self.push(out, ItemKind::Event(Event::MCode(direction.code())));
        }
    }

    fn tell_speed(&mut self, speed: f64, out: &mut Vec<Item>) {
        self.choose_gear(speed, out);
        self.state.spindle.speed = speed;
        self.push(out, ItemKind::Event(Event::SpindleSpeed(speed)));
    }

    /// Brings back what S means, and the speed.
    pub(crate) fn restore_speed(&mut self, saved: Spindle, out: &mut Vec<Item>) {
        let present = self.state.spindle;
        self.state.spindle.surface = saved.surface;
        let speed = match self.surface_revolutions() {
            // The speed follows the tool.
            Some(_) if present.surface == saved.surface => return,
            Some(speed) => speed,
            None => saved.speed,
        };
        if (speed - present.speed).abs() > 0.0 {
            self.tell_speed(speed, out);
        }
    }

    /// Revolutions a minute for the cutting speed of G96 where the tool is; `None` in G97.
    fn surface_revolutions(&self) -> Option<f64> {
        self.surface_revolutions_at(self.state.position)
    }

    fn surface_revolutions_at(&self, machine: AxisVector) -> Option<f64> {
        let surface = self.state.spindle.surface?;
        let program = self.state.offsets.to_program(machine);
        let round_mm = TAU * program[0].abs();
        let speed = surface.speed / round_mm.max(1e-6);
        let spindle = &self.state.spindle;
        let most = spindle.most.unwrap_or(MAX_NUMBER);
        let speed = spindle.in_range(speed.min(surface.most).min(most).min(MAX_NUMBER));
        Some(self.in_gear(speed))
    }

    /// After a move in G96: tells the spindle's speed if it has changed.
    pub(crate) fn follow_surface(&mut self, out: &mut Vec<Item>) {
        self.follow_surface_at(self.state.position, out);
    }

    /// Whether the speed of G96 at a place, machine coordinates, is worth telling.
    pub(crate) fn is_surface_speed_new(&self, machine: AxisVector) -> bool {
        let told = self.state.spindle.speed;
        let speed = self.surface_revolutions_at(machine);
        speed.is_some_and(|speed| (speed - told).abs() > WORTH_TELLING * told)
    }

    /// Tells the speed of G96 at a place, machine coordinates, if it has changed.
    pub(crate) fn follow_surface_at(&mut self, machine: AxisVector, out: &mut Vec<Item>) {
        if self.is_surface_speed_new(machine)
            && let Some(speed) = self.surface_revolutions_at(machine)
        {
            self.tell_speed(speed, out);
        }
    }
}
