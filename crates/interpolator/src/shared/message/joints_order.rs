//! The orders to joints that are moved each for itself, and what became of them: messages between
//! the two threads.

use glidepath_kinematics::JOINTS;

/// An order to joints. Places and velocities are as the drives count.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct JointsOrder {
    /// Counts the orders.
    pub(crate) number: u64,
    /// The joints are taken over with this one: without it, nobody obeys who was not taken over.
    pub(crate) begins: bool,
    /// The joints are given back once they are at rest.
    pub(crate) ends: bool,
    /// The joints that set out for a place, one bit each.
    pub(crate) go: u32,
    /// Those that come to rest.
    pub(crate) stop: u32,
    pub(crate) place: [f64; JOINTS],
    /// Most speed on the way, > 0.
    pub(crate) v: [f64; JOINTS],
    /// The joints whose drives are to keep where their next index pulse is, until the next order.
    pub(crate) index: u32,
}

impl JointsOrder {
    /// Nothing.
    pub(crate) const fn none(number: u64) -> Self {
        Self {
            number,
            begins: false,
            ends: false,
            go: 0,
            stop: 0,
            place: [0.0; JOINTS],
            v: [0.0; JOINTS],
            index: 0,
        }
    }

    /// Whether it moves or stops nobody.
    pub(crate) const fn is_empty(&self) -> bool {
        !self.begins && !self.ends && self.go == 0 && self.stop == 0
    }
}

/// The outcome of the orders.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Moved {
    /// Whether the joints are moved each for itself.
    pub(crate) is_active: bool,
    /// The number of the last order that was taken.
    pub(crate) number: u64,
    /// The joints at rest, one bit each.
    pub(crate) rests: u32,
}
