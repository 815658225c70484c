//! A stop as it is kept: a greedy descent, then ramps; mostly one of the two is empty.

use crate::ramp::Ramp;

/// Most ramps of a stop.
const RAMPS: usize = 8;
/// Most ticks of a greedy descent.
const TICKS: usize = 48;

/// A ramp that begins some ticks from now, or from the end of the one before.
#[derive(Debug, Clone, Copy)]
pub(super) struct DelayedRamp {
    pub(super) in_ticks: u32,
    pub(super) ramp: Ramp,
}

/// A greedy descent: the slope after each of its ticks (see [`super::greedy_descent`]). In single
/// precision, so that a stop stays small; what is tried is what is kept.
#[derive(Debug, Clone, Copy)]
pub(super) struct DescentSlopes {
    pub(super) in_ticks: u32,
    taken: u8,
    len: u8,
    values: [f32; TICKS],
}

impl DescentSlopes {
    /// A descent that begins so many ticks from now, without a tick so far.
    pub(super) const fn new(in_ticks: u32) -> Self {
        Self {
            in_ticks,
            taken: 0,
            len: 0,
            values: [0.0; TICKS],
        }
    }

    /// Appends a tick; `None` if there are too many.
    pub(super) fn then(mut self, slope: f32) -> Option<Self> {
        *self.values.get_mut(usize::from(self.len))? = slope;
        self.len += 1;
        Some(self)
    }

    const fn clear(&mut self) {
        (self.in_ticks, self.taken, self.len) = (0, 0, 0);
    }

    const fn is_left(&self) -> bool {
        self.taken < self.len
    }
}

/// A stop: how the rate gets to 0, played through and within the limits.
#[derive(Debug, Clone, Copy)]
pub(super) struct KeptStop {
    descent: DescentSlopes,
    ramps: [DelayedRamp; RAMPS],
    /// How many of the ramps have begun, and how many there are.
    begun: usize,
    len: usize,
}

impl KeptStop {
    /// A stop with nothing in it.
    pub(super) const fn new() -> Self {
        Self::after(DescentSlopes::new(0))
    }

    /// A stop that begins with a descent, without ramps so far.
    pub(super) const fn after(descent: DescentSlopes) -> Self {
        let none = DelayedRamp {
            in_ticks: 0,
            ramp: Ramp::NONE,
        };
        Self {
            descent,
            ramps: [none; RAMPS],
            begun: 0,
            len: 0,
        }
    }

    /// Leaves nothing in it.
    pub(super) const fn clear(&mut self) {
        self.descent.clear();
        (self.begun, self.len) = (0, 0);
    }

    /// Becomes another stop. Copies what there is of it, mostly a small part of its room.
    pub(super) fn copy(&mut self, other: &Self) {
        self.descent.clear();
        if other.descent.is_left() {
            self.descent = other.descent;
        }
        (self.begun, self.len) = (other.begun, other.len);
        for (slot, delayed) in self.ramps.iter_mut().zip(&other.ramps).take(other.len) {
            *slot = *delayed;
        }
    }

    /// Appends a ramp; false if there are too many.
    pub(super) fn push(&mut self, delayed: DelayedRamp) -> bool {
        let Some(free) = self.ramps.get_mut(self.len) else {
            return false;
        };
        *free = delayed;
        self.len += 1;
        true
    }

    /// Whether there is nothing in it.
    pub(super) const fn is_empty(&self) -> bool {
        self.begun == self.len && !self.descent.is_left()
    }

    /// The ramp that begins next.
    fn next(&mut self) -> Option<&mut DelayedRamp> {
        let left = self.ramps.get_mut(self.begun..self.len)?;
        left.first_mut()
    }

    /// Ticks until the stop begins, or goes on; `None` at its end.
    pub(super) fn in_ticks(&self) -> Option<u32> {
        if self.descent.is_left() {
            return Some(self.descent.in_ticks);
        }
        let left = self.ramps.get(self.begun..self.len)?;
        left.first().map(|delayed| delayed.in_ticks)
    }

    /// Puts the whole stop off by so many ticks.
    pub(super) fn delay(&mut self, ticks: u32) {
        if self.descent.is_left() {
            self.descent.in_ticks += ticks;
        } else if let Some(first) = self.next() {
            first.in_ticks += ticks;
        }
    }

    /// One tick has passed, at a rate with a slope: the ramp that begins now, if one does.
    pub(super) fn count_down(&mut self, rate: f64, slope: f64) -> Option<Ramp> {
        if self.descent.is_left() {
            if self.descent.in_ticks > 0 {
                self.descent.in_ticks -= 1;
                return None;
            }
            let to = *self.descent.values.get(usize::from(self.descent.taken))?;
            self.descent.taken += 1;
            return Ramp::tick_to(rate, slope, f64::from(to));
        }
        let next = self.next()?;
        if next.in_ticks > 0 {
            next.in_ticks -= 1;
            return None;
        }
        let ramp = next.ramp;
        self.begun += 1;
        Some(ramp)
    }
}
