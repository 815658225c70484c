//! The bounds of a plan on several threads: they keep its memory bounded and its workers busy.

use super::allowance::Allowance;

/// Items that wait for workers, about 2.5 MB. The reader must be far ahead: a part is known to end
/// only where the next one begins, so no second worker has anything to do before all of the first
/// part was read.
const MOST_ITEMS: usize = 8 * 1024;

/// Plans that wait for the caller, bytes: at 4 ms about 5 minutes of motion.
const MOST_PLANNED: usize = 40 << 20;
/// What the part that is being taken may add to that.
const MOST_PLANNED_OF_FIRST: usize = 1 << 20;

/// Both ends of the workers.
#[derive(Debug)]
pub(super) struct Bounds {
    /// Between the reader and the workers. Of which part they are does not count.
    items: Allowance,
    /// Between the workers and the caller.
    pub(super) plans: Allowance,
}

impl Bounds {
    pub(super) fn new() -> Self {
        Self {
            items: Allowance::new(MOST_ITEMS, 0),
            plans: Allowance::new(MOST_PLANNED, MOST_PLANNED_OF_FIRST),
        }
    }

    /// Adds items, once there is room; false if nobody takes them any more.
    pub(super) fn add_items(&self, items: usize) -> bool {
        self.items.add(0, items)
    }

    /// Items were taken up by a worker.
    pub(super) fn take_items(&self, items: usize) {
        self.items.take(items);
    }

    /// Nothing more is taken.
    pub(super) fn close(&self) {
        self.items.close();
        self.plans.close();
    }
}
