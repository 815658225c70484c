//! The rule of the still axis: an axis that the program leaves alone does not move.

use super::matched_sample::MatchedSample;
use super::settling::settling_ticks;
use crate::violation::{ViolationKind, ViolationList};
use glidepath_geometry::{AXES, Axis};
use std::collections::VecDeque;

/// How far an axis that the program leaves alone may be from its coordinate, mm or degrees: a
/// hundredth of a micrometre, less than the step of a drive and than anything that shows on a part.
/// What is evaluated between two frames is rounded, and splines through dense lines fade out without
/// ever being at the coordinate to the bit.
pub const STILL_MM: f64 = 1e-5;

/// What is known of the axes.
#[derive(Debug)]
pub(crate) struct StillAxes {
    settling_ticks: u64,
    axes: [StillAxis; AXES],
}

#[derive(Debug, Default)]
struct StillAxis {
    last_move: LastMove,
    /// Samples off their coordinate, as long as it is open whether the motion comes to a move that
    /// changes it within the settling time.
    open: VecDeque<Off>,
    /// Samples before those, each further off than the one before: if that leads to a move that
    /// changes the coordinate, it is the rounding of a corner.
    growing: Option<Growing>,
}

/// What there is of the last move that changed the coordinate.
#[derive(Debug, Default, Clone, Copy)]
enum LastMove {
    /// Nothing: the axis has come to its coordinate since, or was there from the beginning.
    #[default]
    Over,
    /// The last tick at which the motion may have been on it.
    At(u64),
    /// It was longer ago than the settling time, and the axis has come nearer to its coordinate in
    /// every sample since: the end of a rounding. Distance of the last sample, mm.
    Fading(f64),
}

/// A sample of an axis off its coordinate.
#[derive(Debug, Clone, Copy)]
struct Off {
    tick: u64,
    line: u32,
    off_mm: f64,
}

/// Samples off their coordinate: the first, how many, and the last one's distance.
#[derive(Debug, Clone, Copy)]
struct Growing {
    first: Off,
    count: u64,
    off_mm: f64,
}

impl StillAxes {
    pub(crate) fn new(period_t: f64) -> Self {
        Self {
            settling_ticks: settling_ticks(period_t, 0.0),
            axes: core::array::from_fn(|_| StillAxis::default()),
        }
    }

    /// The next sample.
    pub(crate) fn next(&mut self, place: &MatchedSample, found: &mut ViolationList) {
        let settled = place.tick.saturating_sub(self.settling_ticks);
        for axis in Axis::ALL {
            let i = axis.index();
            let state = &mut self.axes[i];
            if place.still[i] && state.is_quiet() && is_near(place.position[i], place.level[i]) {
                continue;
            }
            state.settle(axis, settled, found);
            if !place.still[i] {
                // What is still open is within the settling time of this move, and what leads to
                // it is the rounding of its corner.
                state.open.clear();
                state.growing = None;
                state.last_move = LastMove::At(place.tick);
                continue;
            }
            let level = place.level[i];
            if place.rested_at.is_some_and(|at| is_near(at[i], level)) {
                state.settle(axis, u64::MAX, found);
                state.tell(axis, found);
                state.last_move = LastMove::Over;
            }
            let off = Off {
                tick: place.tick,
                line: place.line,
                off_mm: place.position[i] - level,
            };
            if state.is_settled(settled, off.off_mm) && !is_near(place.position[i], level) {
                state.open.push_back(off);
            }
        }
    }

    /// Where the motion is on the program is not known any more.
    pub(crate) fn lose(&mut self, tick: u64) {
        for axis in &mut self.axes {
            axis.open.clear();
            axis.growing = None;
            axis.last_move = LastMove::At(tick);
        }
    }

    /// The motion has ended.
    pub(crate) fn finish(&mut self, found: &mut ViolationList) {
        for axis in Axis::ALL {
            let state = &mut self.axes[axis.index()];
            state.settle(axis, u64::MAX, found);
            state.tell(axis, found);
        }
    }
}

impl StillAxis {
    /// True if nothing is open: as nearly always.
    fn is_quiet(&self) -> bool {
        matches!(self.last_move, LastMove::Over) && self.open.is_empty() && self.growing.is_none()
    }

    /// Whether a sample is to be judged; `settled` is the tick before which a move was long ago.
    fn is_settled(&mut self, settled: u64, off_mm: f64) -> bool {
        if let LastMove::At(tick) = self.last_move
            && tick < settled
        {
            self.last_move = LastMove::Fading(f64::INFINITY.copysign(off_mm));
        }
        match self.last_move {
            LastMove::Over => true,
            LastMove::At(_) => false,
            LastMove::Fading(before_mm) => {
                let fades = off_mm.abs() > STILL_MM && is_further(before_mm, off_mm);
                self.last_move = if fades {
                    LastMove::Fading(off_mm)
                } else {
                    LastMove::Over
                };
                !fades
            }
        }
    }

    /// Takes the open samples before a tick out: they are not within the settling time of a move.
    fn settle(&mut self, axis: Axis, before: u64, found: &mut ViolationList) {
        while let Some(off) = self.open.front().copied().filter(|off| off.tick < before) {
            self.open.pop_front();
            let goes_on = |growing: &Growing| {
                off.tick == growing.first.tick + growing.count
                    && is_further(off.off_mm, growing.off_mm)
            };
            match &mut self.growing {
                Some(growing) if goes_on(growing) => {
                    growing.count += 1;
                    growing.off_mm = off.off_mm;
                }
                _ => {
                    self.tell(axis, found);
                    self.growing = Some(Growing {
                        first: off,
                        count: 1,
                        off_mm: off.off_mm,
                    });
                }
            }
        }
    }

    /// Tells of the samples that lead to no move: one of them with the largest distance, and counts
    /// the others.
    fn tell(&mut self, axis: Axis, found: &mut ViolationList) {
        let Some(growing) = self.growing.take() else {
            return;
        };
        let off_mm = growing.off_mm.abs();
        let kind = ViolationKind::NotStill { axis, off_mm };
        found.push(growing.first.tick, growing.first.line, kind);
        found.count += growing.count - 1;
    }
}

/// True if a distance is larger than another, to the same side.
fn is_further(off_mm: f64, than_mm: f64) -> bool {
    off_mm.abs() > than_mm.abs() && off_mm.is_sign_negative() == than_mm.is_sign_negative()
}

fn is_near(position: f64, level: f64) -> bool {
    (position - level).abs() <= STILL_MM
}
