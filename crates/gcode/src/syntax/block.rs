//! A block: one line of text, read into words.
//!
//! Nothing here depends on the modal state but the parameters a line reads. A block is filled again
//! for every line, so that none is allocated.

use std::sync::Arc;

use glidepath_geometry::Axis;

use crate::diagnostic::span::SourceSpan;
use crate::setup::fanuc::{FanucControl, PointInput};
use crate::setup::m_codes::MCodes;
use crate::syntax::codes::{Coded, Codes};
use crate::syntax::dialect::Dialect;
use crate::syntax::dialect::words::fanuc_systems::OtherSystem;
use crate::syntax::expression::scope::Parameter;
use crate::syntax::letters::{AXIS_LETTERS, AXIS_WORDS, Letters, Slot, WordValues};
use crate::syntax::modes::{Motion, NonModal};
use crate::syntax::named_word::NamedWords;
use crate::syntax::plain_line::{WordSink, read_plain};

/// The kinds of lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum LineKind {
    /// Words, perhaps none.
    #[default]
    Block,
    /// A percent sign by itself: start or end of the tape.
    Percent,
}

/// The words of a line.
#[derive(Debug, Clone, Default)]
pub(crate) struct Block {
    pub(crate) dialect: Dialect,
    pub(crate) kind: LineKind,
    pub(crate) codes: Codes,
    pub(crate) words: WordValues,
    /// Where the words stand, by slot.
    spans: [SourceSpan; 26],
    /// Nothing but what [`Block::parse_plain`] reads was put into it since it was cleared: its
    /// codes have a motion at most.
    pub(super) is_plain: bool,
    /// Letters of FANUC's words whose numbers have no decimal point.
    pub(crate) pointless: Letters,
    /// What its lengths without a decimal point count, where that is a least increment.
    pub(super) increment: f64,
    /// Words with longer names than a letter.
    pub(crate) named: NamedWords,
    /// `,C` and `,R` of FANUC.
    pub(crate) corner: Option<CornerWord>,
    /// It has another code than G0 to G3, or LIMS.
    pub(crate) says_modes: bool,
    /// `@` and `^`.
    pub(crate) polar: [Option<PolarWord>; 2],
    /// Parameters to assign after the block, in order.
    pub(crate) assignments: Vec<Assignment>,
    /// True if the line has any word or code.
    pub(crate) any: bool,
    /// What the last comment in parentheses says.
    pub(crate) comment: Vec<u8>,
    /// M codes that the machine's builder declared.
    pub(super) declared: Arc<MCodes>,
    /// What coordinates without a point are in a FANUC program.
    pub(crate) point: PointInput,
    /// The lines are of a FANUC lathe.
    pub(crate) is_lathe: bool,
    /// The codes of it are those of system B or C.
    pub(super) system: Option<OtherSystem>,
}

/// How the corner between two moves is broken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CornerKind {
    /// By a straight line whose ends are as far from the corner.
    Chamfer,
    /// By a straight line of that length (SINUMERIK's CHF).
    ChamferLength,
    /// By an arc that touches both moves.
    Round,
    /// The same at every corner from here on (SINUMERIK's RNDM).
    RoundAll,
}

/// A word that breaks the corner behind a move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CornerWord {
    pub(crate) kind: CornerKind,
    pub(crate) value: f64,
    /// A FANUC's, whose number has no decimal point.
    pub(crate) has_no_point: bool,
    pub(crate) span: SourceSpan,
}

/// A polar word: distance or angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PolarWord {
    pub(crate) value: f64,
    pub(crate) span: SourceSpan,
}

/// `#1=2`: takes effect after everything else of its block.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Assignment {
    pub(crate) parameter: Parameter,
    pub(crate) value: f64,
    pub(crate) span: SourceSpan,
}

impl Block {
    /// A block to be filled with lines of a dialect, for a machine with these M codes of its own.
    pub(crate) fn of(dialect: Dialect, declared: &Arc<MCodes>) -> Self {
        Self {
            dialect,
            declared: Arc::clone(declared),
            ..Self::default()
        }
    }

    /// Value of a word.
    pub(crate) const fn get(&self, letter: u8) -> Option<f64> {
        self.words.get(letter)
    }

    /// Where a word stands; an empty span if the block does not have it.
    pub(crate) const fn span(&self, letter: u8) -> SourceSpan {
        if self.words.get(letter).is_none() {
            SourceSpan {
                start: 0,
                length: 0,
            }
        } else {
            self.spans[Slot::of(letter).index()]
        }
    }

    /// Takes a word out of the block, with the place where it stands.
    pub(super) fn take(&mut self, letter: u8) -> Option<(f64, SourceSpan)> {
        let span = self.span(letter);
        let value = self.words.take(letter)?;
        self.is_plain = false;
        Some((value, span))
    }

    /// True if the word of a FANUC program was written without a decimal point.
    pub(crate) const fn has_no_point(&self, letter: u8) -> bool {
        self.pointless.has(letter)
    }

    /// True if the block has an axis word or a polar one.
    pub(crate) const fn has_axes(&self) -> bool {
        let extruder = matches!(self.dialect, Dialect::Marlin) && self.get(b'E').is_some();
        // The increment of C.
        let turns = self.has_increments() && self.get(b'H').is_some();
        extruder
            || turns
            || self.has_any(AXIS_WORDS)
            || self.polar[0].is_some()
            || self.polar[1].is_some()
            || self.named.are_places()
    }

    /// True if the block has any of these words.
    pub(crate) const fn has_any(&self, letters: Letters) -> bool {
        self.words.has_any(letters)
    }

    /// The axis words, in index order.
    pub(crate) fn axes(&self) -> impl Iterator<Item = (Axis, f64)> + '_ {
        self.words.axes()
    }

    /// Where an axis word stands.
    pub(crate) const fn axis_span(&self, axis: Axis) -> SourceSpan {
        self.span(AXIS_LETTERS[axis.index()])
    }

    /// The first word, from the left, that is not among `used`.
    pub(crate) fn unused(&self, used: Letters) -> Option<(char, SourceSpan)> {
        let left = self.words.beside(used);
        if left.is_empty() {
            return None;
        }
        (b'A'..=b'Z')
            .filter(|&letter| left.has(letter))
            .map(|letter| (char::from(letter), self.span(letter)))
            .min_by_key(|(_, span)| span.start)
    }

    /// Where the first word with a value stands.
    pub(crate) fn first_span(&self) -> SourceSpan {
        let code = self.codes.motion.map(|motion| motion.span);
        let word = self.unused(Letters::of(b"")).map(|(_, span)| span);
        let first = code.into_iter().chain(word).min_by_key(|span| span.start);
        first.unwrap_or_default()
    }

    /// True if its axis words are places of the machine (G53).
    pub(crate) fn has_machine_coordinates(&self) -> bool {
        self.codes
            .non_modal
            .is_some_and(|coded| coded.code == NonModal::MachineCoordinates)
    }

    /// Where a diagnostic about the motion of the block points.
    pub(crate) fn motion_span(&self) -> SourceSpan {
        let code = self.codes.motion.map(|motion| motion.span);
        let axes = self.axes().map(|(axis, _)| self.axis_span(axis));
        let polar = self.polar.into_iter().flatten().map(|word| word.span);
        code.into_iter()
            .chain(axes)
            .chain(polar)
            .min_by_key(|span| span.start)
            .unwrap_or_default()
    }

    /// Makes the block an empty one.
    #[inline]
    pub(crate) fn clear(&mut self) {
        self.words.clear();
        self.any = false;
        self.codes.motion = None;
        if !self.is_plain {
            self.assignments.clear();
            self.comment.clear();
            self.polar = [None, None];
            self.corner = None;
            self.says_modes = false;
            self.named = NamedWords::default();
            self.pointless = Letters::default();
            self.codes = Codes::default();
            self.kind = LineKind::Block;
            self.is_plain = true;
        }
    }

    /// True if the block has words with values, and of codes a motion at most: a comment beside them does nothing
    /// to the motion.
    pub(crate) const fn is_plain(&self) -> bool {
        self.is_plain
            || matches!(self.dialect, Dialect::LinuxCnc)
                && !self.says_modes
                && self.polar[0].is_none()
                && self.polar[1].is_none()
                && self.assignments.is_empty()
    }

    /// A block for lines of a FANUC control that reads coordinates so.
    pub(crate) const fn with_point(mut self, point: PointInput) -> Self {
        self.point = point;
        self
    }

    /// A block for lines of a FANUC lathe, if they are.
    pub(crate) fn of_lathe(mut self, is_lathe: bool, control: FanucControl) -> Self {
        self.is_lathe = is_lathe;
        self.system = OtherSystem::of(control).filter(|_| is_lathe);
        self
    }

    /// True where U, V, W and H are increments: on a lathe of system A.
    pub(crate) const fn has_increments(&self) -> bool {
        self.is_lathe && self.system.is_none()
    }

    /// Fills the block from a plain line, of which `text` has all and may have more: where the line
    /// ends. `None` if the line is not plain: the block is then to be filled by
    /// [`Block::parse_any`].
    #[inline]
    pub(crate) fn parse_plain(&mut self, text: &[u8]) -> Option<usize> {
        self.clear();
        read_plain(text, self)
    }
}

impl WordSink for Block {
    #[inline]
    fn add_motion(&mut self, motion: Motion, span: SourceSpan) -> Option<()> {
        if self.codes.motion.is_some() {
            return None;
        }
        self.any = true;
        self.codes.motion = Some(Coded {
            code: Some(motion),
            span,
        });
        Some(())
    }

    #[inline]
    fn add_value(&mut self, slot: Slot, value: f64, span: SourceSpan) -> Option<()> {
        self.words.add(slot, value)?;
        self.any = true;
        self.spans[slot.index()] = span;
        Some(())
    }
}
