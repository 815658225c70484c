//! What the numbers of FANUC's words count that have no decimal point, where they count least increments.
//!
//! A length counts in the units that are in force when its block acts: G20 and G21 of the block itself are
//! among them, wherever they stand in it. An angle counts 0.001 degrees and a dwell 0.001 seconds, in inches too.

use crate::setup::fanuc::PointInput;
use crate::syntax::block::Block;
use crate::syntax::expression::scope::Scope;
use crate::syntax::frame_codes::FrameCode;
use crate::syntax::letters::{AXIS_WORDS, Letters, Slot};
use crate::syntax::modes::{NonModal, Units};
use crate::syntax::plain_line::WordSink;

/// What an angle counts, degrees, and a dwell, seconds.
pub(crate) const OF_ANGLES: f64 = 0.001;

impl Block {
    /// Counts the words that have no point; the block has all its codes.
    pub(super) fn count_increments(&mut self, scope: &dyn Scope) {
        if self.point != PointInput::Increment {
            return;
        }
        self.increment = match self.codes.units.map(|units| units.code) {
            Some(Units::Millimetre) => 0.001,
            Some(Units::Inch) => 0.0001,
            None => scope.least_increment(),
        };
        for letter in b'A'..=b'Z' {
            let of_one = self.increment_of(letter);
            if let Some((count, span)) = of_one.and_then(|_| self.take(letter)) {
                let value = count * of_one.unwrap_or(1.0);
                // The place was emptied just now.
                let _added = self.add_value(Slot::of(letter), value, span);
            }
        }
        let of_corner = self.increment;
        if let Some(corner) = self.corner.as_mut().filter(|corner| corner.has_no_point) {
            corner.value *= of_corner;
        }
    }

    /// What the number of a word counts one by one; `None`: it is the value.
    pub(super) fn increment_of(&self, letter: u8) -> Option<f64> {
        let is_counted = AXIS_WORDS.and(Letters::of(b"IJKR")).has(letter)
            || letter == b'H' && self.has_increments();
        if !is_counted || !self.has_no_point(letter) || self.point != PointInput::Increment {
            return None;
        }
        let codes = &self.codes;
        let frame = codes.frame.map(|frame| frame.code);
        let is_dwell = codes
            .non_modal
            .is_some_and(|code| code.code == NonModal::Dwell);
        let is_tilt = codes.tilt.is_some();
        match letter {
            // The factors of G51 count in their own way.
            b'I'..=b'K' if frame == Some(FrameCode::Scale(true)) => None,
            b'A'..=b'C' | b'H' => Some(OF_ANGLES),
            b'R' if frame == Some(FrameCode::Turn(true)) || is_tilt => Some(OF_ANGLES),
            b'I'..=b'K' if is_tilt => Some(OF_ANGLES),
            b'X' | b'U' if is_dwell => Some(OF_ANGLES),
            _ => Some(self.increment),
        }
    }

    /// The value of a word that is an angle where it was counted as a length, degrees.
    pub(crate) fn degrees(&self, letter: u8) -> Option<f64> {
        let share = self
            .increment_of(letter)
            .map_or(1.0, |of_one| OF_ANGLES / of_one);
        self.get(letter).map(|value| value * share)
    }

    /// How many times its value is the length of a word that may have been counted as an angle: C of a chamfer.
    pub(super) fn length_in_count(&self, letter: u8) -> f64 {
        let of_one = self.increment_of(letter);
        of_one.map_or(1.0, |of_one| self.increment / of_one)
    }

    /// The number of a word as it was written: without a decimal point it may have been counted.
    pub(crate) fn written(&self, letter: u8) -> Option<f64> {
        let of_one = self.increment_of(letter).unwrap_or(1.0);
        self.get(letter).map(|value| value / of_one)
    }
}
