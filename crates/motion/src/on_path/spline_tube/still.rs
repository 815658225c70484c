//! Coordinates that a program leaves alone, and how a curve comes to them and leaves them.
//!
//! Where all samples in the reach of a control point have the same coordinate, the curve belongs there. A
//! spline of least jerk swings about it instead, each swing some 4 % of the one before: an axis that has
//! nothing to do would move to and fro. So in a row of such control points the curve may come to the
//! coordinate, and it may leave it, each from one side and without turning round; those between are put on
//! it. A spline turns round no more often than its control points do.

use super::knots::DEGREE;
use super::sample::Sample;
use core::ops::Range;

/// The coordinates that belong to control points, as far as they are left alone.
#[derive(Debug, Clone)]
pub(super) struct StillCoordinates<const D: usize> {
    levels: Vec<[Option<f64>; D]>,
    /// Axes that have a coordinate left alone.
    is_any: [bool; D],
    /// For each sample, the first of those with the same coordinate in a row, by axis.
    same_since: Vec<[usize; D]>,
}

impl<const D: usize> StillCoordinates<D> {
    pub(super) const fn new() -> Self {
        Self {
            levels: Vec::new(),
            is_any: [false; D],
            same_since: Vec::new(),
        }
    }

    /// Finds them for the control points of a spline, whose knots these are.
    pub(super) fn find(&mut self, knots: &[f64], samples: &[Sample<D>]) {
        self.find_same(samples);
        self.levels.clear();
        self.is_any = [false; D];
        let (mut first, mut last) = (0, 0);
        for i in 0..knots.len().saturating_sub(DEGREE + 1) {
            let (from_t, to_t) = (knots[i], knots[i + DEGREE + 1]);
            while first + 1 < samples.len() && samples[first + 1].foot_t <= from_t {
                first += 1;
            }
            while last + 1 < samples.len() && samples[last].foot_t < to_t {
                last += 1;
            }
            let (since, reached) = (&self.same_since[last], &samples[last].point);
            let level: [_; D] =
                core::array::from_fn(|axis| (since[axis] <= first).then_some(reached[axis]));
            for (is_any, level) in self.is_any.iter_mut().zip(&level) {
                *is_any |= level.is_some();
            }
            self.levels.push(level);
        }
    }

    fn find_same(&mut self, samples: &[Sample<D>]) {
        self.same_since.clear();
        let mut since = [0; D];
        for (j, sample) in samples.iter().enumerate() {
            let before = &samples[j.saturating_sub(1)].point;
            #[allow(
                clippy::float_cmp,
                reason = "a coordinate that is left alone is copied"
            )]
            for axis in 0..D {
                if sample.point[axis] != before[axis] {
                    since[axis] = j;
                }
            }
            self.same_since.push(since);
        }
    }

    /// Puts the free control points where they belong.
    pub(super) fn hold(&self, control: &mut [[f64; D]], free: &Range<usize>) {
        for axis in (0..D).filter(|&axis| self.is_any[axis]) {
            let mut from = 0;
            while from < self.levels.len() {
                let level = self.levels[from][axis];
                let alike = self.levels[from..].iter();
                let to = from + alike.take_while(|of| of[axis] == level).count();
                if let Some(level) = level {
                    let off = |i: usize| control[i][axis] - level;
                    // What comes to the coordinate ends where it would go beyond, or away again.
                    let comes = if from == 0 && free.start == 0 {
                        from
                    } else {
                        fading_end(from..to, off)
                    };
                    let leaves = if to == self.levels.len() {
                        to
                    } else {
                        from + to - fading_end(from..to, |i| off(from + to - 1 - i))
                    };
                    let held = comes.max(free.start)..leaves.min(free.end);
                    for point in control.get_mut(held).into_iter().flatten() {
                        point[axis] = level;
                    }
                }
                from = to;
            }
        }
    }
}

/// Where a row of distances ends that keeps its side and becomes no larger.
fn fading_end(places: Range<usize>, off: impl Fn(usize) -> f64) -> usize {
    let mut before = off(places.start);
    for i in places.clone() {
        let now = off(i);
        if now * before < 0.0 || now.abs() > before.abs() {
            return i;
        }
        before = now;
    }
    places.end
}
