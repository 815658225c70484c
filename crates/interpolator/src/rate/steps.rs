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

    const fn is_left(&self) -> bool {
        self.taken < self.len
    }
}

/// A stop.
#[derive(Debug, Clone, Copy)]
pub(super) struct Steps {
    fall: Slopes,
    ramps: [Option<Later>; RAMPS],
}

impl Steps {
    pub(super) const fn new() -> Self {
        Self::after(Slopes::new(0))
    }

    /// What begins with a fall.
    pub(super) const fn after(fall: Slopes) -> Self {
        Self {
            fall,
            ramps: [None; RAMPS],
        }
    }

    /// Appends a ramp; false if there are too many.
    pub(super) fn push(&mut self, later: Later) -> bool {
        let free = self.ramps.iter_mut().find(|step| step.is_none());
        free.is_some_and(|step| step.replace(later).is_none())
    }

    /// Whether there is nothing in it.
    pub(super) const fn is_empty(&self) -> bool {
        let [first, ..] = &self.ramps;
        first.is_none() && !self.fall.is_left()
    }

    /// Ticks until it begins, or goes on; `None` at its end.
    pub(super) fn in_ticks(&self) -> Option<u32> {
        if self.fall.is_left() {
            return Some(self.fall.in_ticks);
        }
        let [first, ..] = &self.ramps;
        first.as_ref().map(|later| later.in_ticks)
    }

    /// All begin so many ticks later.
    pub(super) const fn delay(&mut self, ticks: u32) {
        if self.fall.is_left() {
            self.fall.in_ticks += ticks;
        } else if let [Some(first), ..] = &mut self.ramps {
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
        let [first, ..] = &mut self.ramps;
        let next = first.as_mut()?;
        if next.in_ticks > 0 {
            next.in_ticks -= 1;
            return None;
        }
        let ramp = next.ramp;
        *first = None;
        self.ramps.rotate_left(1);
        Some(ramp)
    }
}
