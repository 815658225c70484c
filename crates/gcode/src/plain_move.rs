//! Straight moves of plain lines, which nearly all lines of a long program are.
//!
//! What [`Interpreter::execute`] does with any block is done here for those alone: without the codes such
//! a line cannot have, and without a copy of the state to go back to, since everything that may be refused
//! is looked at before anything is changed. Where there is a doubt, that is left to `execute`, and with it
//! every finding.

use glidepath_geometry::{AXES, AxisVector, Line, Segment};
use glidepath_motion::{Item, ItemKind, Rate};

use crate::axis_words::axis_value;
use crate::block::{AXIS_WORDS, Block, Letters};
use crate::cycle::Cycles;
use crate::dialect::Dialect;
use crate::interpreter::Interpreter;
use crate::modal::Feed;
use crate::modes::{Distance, FeedMode, Motion};
use crate::moves::{MIN_MOVE, Pace};

/// The words of a straight move.
const WORDS: Letters = AXIS_WORDS.and(Letters::of(b"F"));

/// What a plain block comes to.
struct Straight {
    motion: Motion,
    feed: Option<Feed>,
    rate: Rate,
    /// Where the program goes, and where the segment ends: where an axis only rounds, it stays.
    target: AxisVector,
    end: AxisVector,
    /// No axis moves.
    is_zero: bool,
}

impl Interpreter {
    /// Executes a plain block that is a straight move; false if it is none, or may have to be refused:
    /// then nothing has changed.
    pub(crate) fn go(&mut self, block: &Block, out: &mut Vec<Item>) -> bool {
        let Some(straight) = self.foresee(block) else {
            return false;
        };
        let state = &mut self.state;
        state.modal.feed = straight.feed;
        if block.codes.motion.is_some() {
            state.modal.motion = Some(straight.motion);
            state.cycles = Cycles::default();
        }
        state.cubic_tail = None;
        state.leaving_contour = false;
        state.position = straight.target;
        if straight.is_zero {
            self.count_zero_length(match straight.motion {
                Motion::Rapid => Pace::Rapid,
                _ => Pace::Feed,
            });
            return true;
        }
        let (start, end) = (state.path_end, straight.end);
        state.path_end = end;
        if self.only_judges {
            self.has_judged = true;
            return true;
        }
        let item = Item {
            line: self.line,
            kind: ItemKind::Move {
                segment: Segment::Line(Line { start, end }),
                rate: straight.rate,
                mode: state.modal.path_mode,
            },
        };
        // Not `push`, which copies twice.
        out.extend_from_slice(core::slice::from_ref(&item));
        true
    }

    /// What a plain block comes to if it is a straight move that nothing is wrong with.
    #[inline]
    fn foresee(&self, block: &Block) -> Option<Straight> {
        let modal = &self.state.modal;
        let code = block.codes.motion.and_then(|motion| motion.code);
        let motion = code.or(modal.motion)?;
        let is_straight = matches!(motion, Motion::Rapid | Motion::Linear)
            && block.has_any(AXIS_WORDS)
            && block.unused(WORDS).is_none()
            && !block.has_any(self.lacking);
        if !is_straight || !self.is_plain(block.dialect) {
            return None;
        }
        let scale = modal.units.mm();
        let feed = match block.get(b'F') {
            None => modal.feed,
            Some(feed) if feed > 0.0 => Some(Feed {
                linear_v: feed * scale / 60.0,
                rotary_v: feed / 60.0,
            }),
            Some(_) => return None,
        };
        let start = &self.state.path_end;
        let mut target = self.state.position;
        for (axis, word) in block.axes() {
            let i = axis.index();
            target[i] = axis_value(axis, word, scale) + self.offsets.origin(i);
        }
        // As `settled` and `check_limits` have it, in one go.
        let (mut end, mut is_zero, mut is_outside) = (target, true, false);
        for i in 0..AXES {
            let moves = (target[i] - start[i]).abs() > MIN_MOVE;
            end[i] = if moves { target[i] } else { start[i] };
            is_zero &= !moves;
            is_outside |= self.reach.is_left_at(i, end[i]);
        }
        if is_outside && !is_zero {
            return None;
        }
        let rate = match motion {
            Motion::Rapid => Rate::Rapid,
            _ => Rate::Feed(feed?.of_line(start, &end)),
        };
        Some(Straight {
            motion,
            feed,
            rate,
            target,
            end,
            is_zero,
        })
    }

    /// True if nothing is in force that makes more of a straight move than its words say.
    fn is_plain(&self, dialect: Dialect) -> bool {
        let modal = &self.state.modal;
        modal.distance == Distance::Absolute
            && modal.feed_mode == FeedMode::PerMinute
            && !modal.diameter
            && dialect != Dialect::Marlin
            && !self.offsets.is_rotated()
            && self.compensation.is_none()
            && !self.state.on_contour
            && self.open_spline.is_none()
            && !self.state.spindle.follows_tool()
    }
}
