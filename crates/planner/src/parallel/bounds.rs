//! What keeps the memory of a plan bounded.

use super::allowance::Allowance;
use super::room::Room;

/// Both ends of the workers.
#[derive(Debug)]
pub(super) struct Bounds {
    /// For items, between the reader and the workers.
    pub(super) items: Room,
    /// For plans, between the workers and the caller.
    pub(super) plans: Allowance,
}

impl Bounds {
    pub(super) fn new() -> Self {
        Self {
            items: Room::default(),
            plans: Allowance::new(),
        }
    }

    /// Nothing more is taken.
    pub(super) fn close(&self) {
        self.items.close();
        self.plans.close();
    }
}
