//! A kept stop: perhaps a greedy slow-down, then ramps; mostly there is no slow-down.

use crate::real_time::ramp::Ramp;
use crate::shared::track_capacity::TRACK_CAPACITY;

/// Most ramps of a stop. A search that would need more counts as lost; with room for more a stop takes more
/// cache lines of a tick.
const RAMPS: usize = 8;
/// Most ticks of a greedy slow-down: the frames at hand.
pub(super) const TICKS: usize = TRACK_CAPACITY;

/// A ramp that begins some ticks from now, or from the end of the one before.
#[derive(Debug, Clone, Copy)]
pub(super) struct DelayedRamp {
    pub(super) in_ticks: u32,
    pub(super) ramp: Ramp,
}

/// A greedy slow-down (see [`super::greedy_slow_down`]) that begins some ticks from now: where its slopes
/// are.
#[derive(Debug, Clone, Copy)]
pub(super) struct KeptSlowDown {
    in_ticks: u32,
    /// How many of its ticks are over, and how many there are.
    taken: u16,
    len: u16,
    /// Which of the two in [`SlowDownSlopes`].
    side: u8,
}

impl KeptSlowDown {
    const NONE: Self = Self {
        in_ticks: 0,
        taken: 0,
        len: 0,
        side: 0,
    };

    const fn is_left(&self) -> bool {
        self.taken < self.len
    }
}

/// The slopes after each of their ticks of two greedy slow-downs: of the stop in reserve, and of one that
/// may replace it. They stay where they are, so that a stop is small. In single precision; what is tried
/// is what is kept.
#[derive(Debug)]
pub(super) struct SlowDownSlopes {
    sides: Box<[[f32; TICKS]; 2]>,
    /// The side that is not that of the stop in reserve.
    spare: u8,
}

impl SlowDownSlopes {
    /// Room for both. Allocates all it will ever use.
    pub(super) fn new() -> Self {
        Self {
            sides: Box::new([[0.0; TICKS]; 2]),
            spare: 0,
        }
    }

    /// Writes a slow-down of so many ticks down, the last one first, that begins some ticks from now.
    pub(super) fn write_back(
        &mut self,
        in_ticks: u32,
        len: u16,
        slopes: impl Iterator<Item = f32>,
    ) -> KeptSlowDown {
        let side = self.spare;
        if let Some(values) = self.sides.get_mut(usize::from(side)) {
            let values = values.iter_mut().take(usize::from(len)).rev();
            for (value, slope) in values.zip(slopes) {
                *value = slope;
            }
        }
        KeptSlowDown {
            in_ticks,
            taken: 0,
            len,
            side,
        }
    }

    /// The slow-down that was written last is that of the stop in reserve from now on.
    pub(super) const fn keep(&mut self) {
        self.spare ^= 1;
    }

    fn slope(&self, slow_down: &KeptSlowDown) -> Option<f32> {
        let values = self.sides.get(usize::from(slow_down.side))?;
        values.get(usize::from(slow_down.taken)).copied()
    }
}

/// A stop: how the rate gets to 0, played through and within the limits.
#[derive(Debug, Clone, Copy)]
pub(super) struct KeptStop {
    slow_down: KeptSlowDown,
    ramps: [DelayedRamp; RAMPS],
    /// How many of the ramps have begun, and how many there are.
    begun: usize,
    len: usize,
}

impl KeptStop {
    /// A stop with nothing in it.
    pub(super) const fn new() -> Self {
        Self::after(KeptSlowDown::NONE)
    }

    /// A stop that begins with a slow-down, without ramps so far.
    pub(super) const fn after(slow_down: KeptSlowDown) -> Self {
        let none = DelayedRamp {
            in_ticks: 0,
            ramp: Ramp::NONE,
        };
        Self {
            slow_down,
            ramps: [none; RAMPS],
            begun: 0,
            len: 0,
        }
    }

    /// Leaves nothing in it.
    pub(super) const fn clear(&mut self) {
        self.slow_down = KeptSlowDown::NONE;
        (self.begun, self.len) = (0, 0);
    }

    /// Becomes another stop. Copies what there is of it, mostly a small part of its room.
    pub(super) fn copy(&mut self, other: &Self) {
        self.slow_down = other.slow_down;
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

    /// Whether a slow-down is left of it.
    pub(super) const fn descends(&self) -> bool {
        self.slow_down.is_left()
    }

    /// Whether there is nothing in it.
    pub(super) const fn is_empty(&self) -> bool {
        self.begun == self.len && !self.slow_down.is_left()
    }

    /// The ramp that begins next.
    fn next(&mut self) -> Option<&mut DelayedRamp> {
        let left = self.ramps.get_mut(self.begun..self.len)?;
        left.first_mut()
    }

    /// Ticks until the stop begins, or goes on; `None` at its end.
    pub(super) fn in_ticks(&self) -> Option<u32> {
        if self.slow_down.is_left() {
            return Some(self.slow_down.in_ticks);
        }
        let left = self.ramps.get(self.begun..self.len)?;
        left.first().map(|delayed| delayed.in_ticks)
    }

    /// Puts the whole stop off by so many ticks.
    pub(super) fn delay(&mut self, ticks: u32) {
        if self.slow_down.is_left() {
            self.slow_down.in_ticks += ticks;
        } else if let Some(first) = self.next() {
            first.in_ticks += ticks;
        }
    }

    /// One tick has passed, at a rate with a slope: the ramp that begins now, if one does.
    pub(super) fn count_down(
        &mut self,
        rate: f64,
        slope: f64,
        slopes: &SlowDownSlopes,
    ) -> Option<Ramp> {
        if self.slow_down.is_left() {
            if self.slow_down.in_ticks > 0 {
                self.slow_down.in_ticks -= 1;
                return None;
            }
            let to = slopes.slope(&self.slow_down)?;
            self.slow_down.taken += 1;
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
