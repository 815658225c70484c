//! The history of a plan, to plan again from an earlier frame: copies of the planning now and then,
//! and the items taken since the oldest of them.
//!
//! ```text
//!   checkpoints   ●───────────────●───────────────●─────────
//!   frames     ───┼──────┬────────┼───────────────┼──────▶ planned
//!                        │ given out last: planning goes back to the checkpoint before it, makes
//!                        ▼ the frames up to here once more, and goes on with another override
//! ```
//!
//! A plan depends on the items and on the frames at which overrides changed, and on nothing else.
//! So where the copies are taken does not show in it.

use std::collections::VecDeque;

use glidepath_motion::MOST_MOVES_AT_ONCE;
use glidepath_program::Override;

use crate::plan::planning::{Planning, TakenItem};

/// Motion between two checkpoints, s: what is planned once more, at most, when an override
/// changes. Planning it takes less time than the horizon even on a host that is busy otherwise; more
/// copies would take more memory.
const CHECKPOINT_T: f64 = 0.5;

/// Items between two checkpoints.
const CHECKPOINT_ITEMS: u64 = 4096;

/// Items kept, beyond which planning ahead waits for the motion: more than a stretch that is planned
/// as a whole has, so that it is planned while what comes before it is driven. Where so many and more
/// make no frame, an override takes effect at a multiple of them, as the others are forgotten.
const MOST_ITEMS: u64 = 12 * CHECKPOINT_ITEMS;
const _: () = assert!(MOST_ITEMS > MOST_MOVES_AT_ONCE as u64 + CHECKPOINT_ITEMS);

/// A copy of the planning as it was.
#[derive(Debug)]
struct Checkpoint {
    /// Right after a frame.
    planning: Planning,
    /// The override that was given next.
    then: Option<Override>,
}

/// Checkpoints and items of a plan under way.
#[derive(Debug)]
pub(crate) struct History {
    first: Checkpoint,
    /// In the order of their frames.
    later: VecDeque<Checkpoint>,
    /// Taken since the first checkpoint.
    items: VecDeque<TakenItem>,
    checkpoint_frames: u64,
}

impl History {
    /// The history of a plan from here on.
    pub(crate) fn new(planning: &Planning, period_t: f64) -> Self {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the cast saturates, and periods are positive"
        )]
        let checkpoint_frames = ((CHECKPOINT_T / period_t) as u64).max(1);
        Self {
            first: Checkpoint {
                planning: planning.clone(),
                then: None,
            },
            later: VecDeque::new(),
            items: VecDeque::new(),
            checkpoint_frames,
        }
    }

    /// The item that comes after so many, if it was taken before.
    pub(crate) fn item_after(&self, items: u64) -> Option<TakenItem> {
        let index = items.checked_sub(self.first.planning.items())?;
        self.items.get(usize::try_from(index).ok()?).copied()
    }

    /// Keeps the next item, as it is given to the planning.
    pub(crate) fn keep(&mut self, kept: TakenItem) {
        self.items.push_back(kept);
    }

    /// Takes a checkpoint if it is time to.
    pub(crate) fn follow(&mut self, planning: &Planning) {
        let last = &self.later.back().unwrap_or(&self.first).planning;
        let frames = planning.frames().saturating_sub(last.frames());
        let items = planning.items().saturating_sub(last.items());
        let is_due = if planning.items_since_frame() == 0 {
            frames >= self.checkpoint_frames || (frames > 0 && items >= CHECKPOINT_ITEMS)
        } else {
            // Items that make no frame must not be kept for ever.
            planning.items_since_frame().is_multiple_of(MOST_ITEMS)
        };
        if is_due {
            self.mark(planning, None);
        }
    }

    /// Forgets what is not needed to go back to where so many frames were made, or to later ones.
    pub(crate) fn forget_before(&mut self, frames: u64) {
        let is_past = |next: &Checkpoint| next.planning.frames() <= frames;
        while self.later.front().is_some_and(is_past)
            && let Some(next) = self.later.pop_front()
        {
            let gone = next.planning.items() - self.first.planning.items();
            let gone = usize::try_from(gone).unwrap_or(usize::MAX);
            self.items.drain(..gone.min(self.items.len()));
            self.first = next;
        }
    }

    /// True if no more items are to be taken without need.
    pub(crate) fn is_full(&self) -> bool {
        self.items.len() as u64 >= MOST_ITEMS
    }

    /// The planning as it was when so many frames were made, or before; forgets what came after.
    pub(crate) fn back_to(&mut self, frames: u64) -> Planning {
        let is_later = |last: &Checkpoint| last.planning.frames() > frames;
        while self.later.back().is_some_and(is_later) {
            self.later.pop_back();
        }
        let last = self.later.back_mut().unwrap_or(&mut self.first);
        if last.planning.frames() >= frames {
            // What was wanted here has had no effect yet.
            last.then = None;
        }
        let mut planning = last.planning.clone();
        if let Some(wanted) = last.then {
            planning.follow_override(wanted);
        }
        planning
    }

    /// An override is given to the planning as it is now.
    pub(crate) fn mark_override(&mut self, planning: &Planning, wanted: Override) {
        let last = self.later.back_mut().unwrap_or(&mut self.first);
        if last.planning.frames() >= planning.frames() {
            last.then = Some(wanted);
        } else {
            self.mark(planning, Some(wanted));
        }
    }

    fn mark(&mut self, planning: &Planning, then: Option<Override>) {
        self.later.push_back(Checkpoint {
            planning: planning.clone(),
            then,
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::blocks::Blocks;
    use glidepath_geometry::{AxisVector, Segment};
    use glidepath_program::{Effort, Item, ItemKind, Limits, PathMode, Rate, Settings, Smoothing};

    /// Moves far below the resolution of programs: none of them makes a frame.
    fn nothing(number: u64) -> Item {
        #[allow(clippy::cast_precision_loss, reason = "exact for any test")]
        let at = |number: u64| {
            let mut at = AxisVector::zeros();
            at[0] = 1e-12 * number as f64;
            at
        };
        Item {
            block: 0,
            line: 1,
            kind: ItemKind::Move {
                segment: Segment::line(at(number), at(number + 1)),
                rate: Rate::Feed(50.0),
                mode: PathMode::Continuous { tolerance_mm: None },
            },
        }
    }

    #[test]
    fn items_that_make_no_frame_are_not_kept_for_ever() {
        let settings = Settings {
            limits: Limits::uniform(200.0, 2000.0, 40_000.0),
            tolerance_mm: 0.02,
            direction: glidepath_program::DirectionTolerance::default(),
            smoothing: Smoothing::Auto,
            corners: glidepath_program::Corners::default(),
            period_t: 0.004,
            effort: Effort::Fast,
        };
        let mut planning = Planning::new(settings, AxisVector::zeros(), Blocks::whole(), 0.0);
        let mut history = History::new(&planning, settings.period_t);
        assert_eq!(planning.make_frame(), Ok(true));
        history.follow(&planning);
        for number in 0..3 * MOST_ITEMS + 7 {
            assert_eq!(planning.make_frame(), Ok(false));
            planning.take(nothing(number)).unwrap();
            history.keep(TakenItem {
                item: nothing(number),
                is_aside: false,
            });
            history.follow(&planning);
            history.forget_before(planning.frames());
            assert!(history.items.len() as u64 <= MOST_ITEMS);
        }
        let back = history.back_to(1);
        assert_eq!((back.frames(), back.items()), (1, 3 * MOST_ITEMS));
        let next = history.item_after(3 * MOST_ITEMS).map(|kept| kept.item);
        assert_eq!(next, Some(nothing(3 * MOST_ITEMS)));
        assert_eq!(history.item_after(3 * MOST_ITEMS + 7), None);
    }
}
