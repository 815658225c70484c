//! A stop as it is kept: a fall, then ramps.

use crate::ramp::Ramp;

/// Most ramps of a stop.
const RAMPS: usize = 8;
/// Most ticks of a fall.
const TICKS: usize = 48;

/// A ramp that begins some ticks from now, or from the end of the one before.
#[derive(Debug, Clone, Copy)]
pub(super) struct Later {
    pub(super) in_ticks: u32,
    pub(super) ramp: Ramp,
}

/// A fall: the slope after each of its ticks (see [`super::fall`]). In single precision, so that a
/// stop stays small; what is tried is what is kept.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slopes {
    pub(super) in_ticks: u32,
    taken: u8,
    len: u8,
    values: [f32; TICKS],
}

impl Slopes {
    /// A fall that begins so many ticks from now, without a tick so far.
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

/// A stop.
#[derive(Debug, Clone, Copy)]
pub(super) struct Steps {
    fall: Slopes,
    ramps: [Later; RAMPS],
    /// Ramps that have begun, and all of them.
    begun: usize,
    len: usize,
}

impl Steps {
    pub(super) const fn new() -> Self {
        Self::after(Slopes::new(0))
    }

    /// What begins with a fall.
    pub(super) const fn after(fall: Slopes) -> Self {
        let none = Later {
            in_ticks: 0,
            ramp: Ramp::NONE,
        };
        Self {
            fall,
            ramps: [none; RAMPS],
            begun: 0,
            len: 0,
        }
    }

    /// Nothing is left in it.
    pub(super) const fn clear(&mut self) {
        self.fall.clear();
        (self.begun, self.len) = (0, 0);
    }

    /// Becomes another stop. Copies what there is of it, mostly a small part of its room.
    pub(super) fn copy(&mut self, other: &Self) {
        self.fall.clear();
        if other.fall.is_left() {
            self.fall = other.fall;
        }
        (self.begun, self.len) = (other.begun, other.len);
        for (slot, later) in self.ramps.iter_mut().zip(&other.ramps).take(other.len) {
            *slot = *later;
        }
    }

    /// Appends a ramp; false if there are too many.
    pub(super) fn push(&mut self, later: Later) -> bool {
        let Some(free) = self.ramps.get_mut(self.len) else {
            return false;
        };
        *free = later;
        self.len += 1;
        true
    }

    /// Whether there is nothing in it.
    pub(super) const fn is_empty(&self) -> bool {
        self.begun == self.len && !self.fall.is_left()
    }

    /// The ramp that begins next.
    fn next(&mut self) -> Option<&mut Later> {
        let left = self.ramps.get_mut(self.begun..self.len)?;
        left.first_mut()
    }

    /// Ticks until it begins, or goes on; `None` at its end.
    pub(super) fn in_ticks(&self) -> Option<u32> {
        if self.fall.is_left() {
            return Some(self.fall.in_ticks);
        }
        let left = self.ramps.get(self.begun..self.len)?;
        left.first().map(|later| later.in_ticks)
    }

    /// All begin so many ticks later.
    pub(super) fn delay(&mut self, ticks: u32) {
        if self.fall.is_left() {
            self.fall.in_ticks += ticks;
        } else if let Some(first) = self.next() {
            first.in_ticks += ticks;
        }
    }

    /// One tick has passed, at a rate with a slope: the ramp that begins now, if one does.
    pub(super) fn count_down(&mut self, rate: f64, slope: f64) -> Option<Ramp> {
        if self.fall.is_left() {
            if self.fall.in_ticks > 0 {
                self.fall.in_ticks -= 1;
                return None;
            }
            let to = *self.fall.values.get(usize::from(self.fall.taken))?;
            self.fall.taken += 1;
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
