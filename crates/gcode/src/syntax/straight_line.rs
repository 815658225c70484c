//! The words of a line that says nothing but a straight move, as nearly all lines of a long program
//! do.

use crate::diagnostic::span::SourceSpan;
use crate::syntax::letters::{AXIS_WORDS, Letters, Slot, WordValues};
use crate::syntax::modes::Motion;
use crate::syntax::plain_line::WordSink;

/// The words of a straight move.
pub(crate) const WORDS: Letters = AXIS_WORDS.and(Letters::of(b"F"));

/// What a line says that is nothing but a straight move.
#[derive(Debug, Clone, Default)]
pub(crate) struct StraightLine {
    /// Its own motion code.
    pub(crate) motion: Option<Motion>,
    pub(crate) words: WordValues,
    /// The line says something else.
    pub(crate) says_more: bool,
}

impl StraightLine {
    #[inline]
    pub(crate) const fn clear(&mut self) {
        self.motion = None;
        self.words.clear();
        self.says_more = false;
    }
}

impl WordSink for StraightLine {
    #[inline]
    fn add_motion(&mut self, motion: Motion, _: SourceSpan) -> Option<()> {
        self.says_more = self.motion.is_some() || !is_straight(motion);
        self.motion = Some(motion);
        (!self.says_more).then_some(())
    }

    #[inline]
    fn add_value(&mut self, slot: Slot, value: f64, _: SourceSpan) -> Option<()> {
        self.says_more = !WORDS.holds(slot) || self.words.add(slot, value).is_none();
        (!self.says_more).then_some(())
    }
}

pub(crate) const fn is_straight(motion: Motion) -> bool {
    matches!(motion, Motion::Rapid | Motion::Linear)
}
