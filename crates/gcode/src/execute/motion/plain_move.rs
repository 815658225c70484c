//! Straight moves of plain lines, which nearly all lines of a long program are.
//!
//! What [`Interpreter::execute`] does with any block is done here for those alone: without the
//! codes such a line cannot have, and without a copy of the state to go back to, since everything
//! that may be refused is looked at before anything is changed. Where there is a doubt, that is
//! left to `execute`, and with it every diagnostic.
//!
//! Only the axes a line names are looked at. That the others are where they may be, and that
//! nothing in force makes more of a move than its words say, is seen once, at the first of such
//! lines in a row:
//!
//! ```text
//!   G91             any line
//!   G90 F1000       any line
//!   G1 X1 Y2        begins a run: units, offsets and modes are looked at
//!   X1.5            goes on with it
//!   G0 Z5
//!   M3              ends it, whatever it does
//! ```

use glidepath_geometry::{AXES, Axis, AxisVector, Line, Segment};
use glidepath_program::{Item, ItemKind, Rate};

use crate::execute::interpreter::Interpreter;
use crate::execute::motion::axis_words::axis_value;
use crate::execute::motion::settled::MIN_MOVE;
use crate::execute::motion::speed::Pace;
use crate::execute::state::modal::Feed;
use crate::execute::state::plain_run::PlainRun;
use crate::execute::state::sticky_words::CycleSeries;
use crate::syntax::dialect::Dialect;
use crate::syntax::letters::{AXIS_WORDS, Letters, WordValues};
use crate::syntax::modes::{Distance, FeedMode, Motion, Units};
use crate::syntax::straight_line::{WORDS, is_straight};

/// Axes beside X, Y and Z.
const OTHER_AXES: Letters = Letters::of(b"ABCUVW");
const ROTARY_AXES: Letters = Letters::of(b"ABC");

impl Interpreter {
    /// Makes the straight move of a plain line; false if it makes none, or one that may have to be
    /// refused: then nothing has changed. `goes_on` if nothing else was executed since the last
    /// one.
    #[inline]
    pub(crate) fn go(
        &mut self,
        code: Option<Motion>,
        words: &WordValues,
        goes_on: bool,
        out: &mut Vec<Item>,
    ) -> bool {
        let Some(motion) = code.or(self.state.modal.motion) else {
            return false;
        };
        let is_move = is_straight(motion)
            && words.has_any(AXIS_WORDS)
            && words.beside(WORDS).is_empty()
            && !words.has_any(self.lacking)
            && !(words.has_any(OTHER_AXES) && self.differs_with_others(motion, words));
        is_move && (goes_on || self.begin_run()) && self.go_straight(code, motion, words, out)
    }

    /// Whether more comes with other axes than X, Y and Z: the feed of a FANUC is shared with them, and rotary axes may
    /// roll over.
    fn differs_with_others(&self, motion: Motion, words: &WordValues) -> bool {
        let options = &self.options;
        let shares_feed = motion == Motion::Linear
            && options.dialect == Dialect::Fanuc
            && !options.fanuc.is_haas();
        shares_feed || words.has_any(ROTARY_AXES) && self.rolls_over(Axis::A)
    }

    #[inline]
    fn go_straight(
        &mut self,
        code: Option<Motion>,
        motion: Motion,
        words: &WordValues,
        out: &mut Vec<Item>,
    ) -> bool {
        let (state, run) = (&mut self.state, &self.plain_run);
        let feed = match words.get(b'F') {
            None => state.modal.feed,
            Some(feed) if feed > 0.0 => Some(Feed {
                linear_v: feed * run.scale / 60.0,
                rotary_v: feed / 60.0,
            }),
            Some(_) => return false,
        };
        if motion != Motion::Rapid && feed.is_none() {
            return false;
        }
        let (mut target, mut end, mut is_zero) = (state.position, state.path_end, true);
        let mut way = 0.0_f64;
        for (axis, word) in words.axes() {
            let i = axis.index();
            target[i] = axis_value(axis, word, run.scale) + run.origin[i];
            // As `settled` has it: where an axis only rounds, it stays. Each axis comes once.
            let distance = (target[i] - end[i]).abs();
            if distance > MIN_MOVE {
                if self.soft_limits.is_beyond(i, target[i]) {
                    return false;
                }
                end[i] = target[i];
                way = way.max(distance);
                is_zero = false;
            }
        }
        state.modal.feed = feed;
        if code.is_some() {
            state.modal.motion = code;
            state.cycles = CycleSeries::default();
        }
        state.cubic_tail = None;
        state.position = target;
        if is_zero {
            self.count_zero_length(match motion {
                Motion::Rapid => Pace::Rapid,
                _ => Pace::Feed,
            });
        } else if self.only_judges {
            self.has_judged = true;
            if let Some(feed) = feed.filter(|_| motion != Motion::Rapid) {
                self.judged_time_s += way / feed.linear_v;
            }
        } else {
            let rate = match feed {
                Some(feed) if motion != Motion::Rapid => {
                    Rate::Feed(feed.of_line(&state.path_end, &end))
                }
                _ => Rate::Rapid,
            };
            self.give_out(&end, rate, out);
        }
        self.state.path_end = end;
        true
    }

    /// Gives out the move from where the last one ended.
    #[inline]
    fn give_out(&self, end: &AxisVector, rate: Rate, out: &mut Vec<Item>) {
        let (start, end) = (self.state.path_end, *end);
        let item = Item {
            block: 0,
            line: self.line,
            kind: ItemKind::Move {
                segment: Segment::Line(Line { start, end }),
                rate,
                mode: self.path_mode(),
            },
        };
        // Not `push`, which copies twice.
        out.extend_from_slice(core::slice::from_ref(&item));
    }

    /// Looks at what plain lines do not change; false if it makes more of a straight move than its
    /// words say, or if an axis is not where it may be.
    fn begin_run(&mut self) -> bool {
        let (state, modal) = (&self.state, &self.state.modal);
        let is_plain = modal.distance == Distance::Absolute
            && modal.feed_mode == FeedMode::PerMinute
            && !modal.diameter
            && !self.state.is_mapped
            && self.turns_on_circles().is_none()
            // F counts in the unit of lengths.
            && !(state.feeds_in_mm && modal.units == Units::Inch)
            && state.tilted.is_none()
            && !state.untraversed.is_any()
            && state.fanuc.polar.is_none()
            && state.fanuc.open_plane.is_none()
            && state.fanuc.length_on_way_mm == 0.0
            && self.options.dialect != Dialect::Marlin
            && !self.state.offsets.is_turned()
            && self.state.open.compensation.is_none()
            && !state.on_contour
            && !state.leaving_contour
            && self.state.open.spline.is_none()
            // Corners that are broken, and what the blocks before have left open.
            && state.rounds_mm <= 0.0
            && self.state.open.corner.is_none()
            && self.state.open.line.is_none()
            && self.state.open.tap.is_none()
            && self.state.open.thread.is_none()
            && self.state.offsets.fanuc.dynamic.is_none()
            && !state.spindle.follows_tool()
            && !state.spindle.stands_for_tap();
        let is_settled = |i: usize| {
            (state.position[i] - state.path_end[i]).abs() <= MIN_MOVE
                && !self.soft_limits.is_beyond(i, state.path_end[i])
        };
        if !is_plain || !(0..AXES).all(is_settled) {
            return false;
        }
        self.plain_run = PlainRun {
            scale: modal.units.mm(),
            origin: AxisVector::from_fn(|i, _| self.state.offsets.origin(i)),
        };
        true
    }
}
