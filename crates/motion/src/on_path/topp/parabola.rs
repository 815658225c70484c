//! The square of the speed on an interval, as a parabola over three coefficients of its spline.

/// b, b′ and b″ at a place, over three coefficients.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Taylor {
    pub(crate) value: [f64; 3],
    pub(crate) slope: [f64; 3],
    pub(crate) second: [f64; 3],
}

/// The parabola of an interval, over its three coefficients.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Parabola {
    pub(crate) start: Taylor,
    pub(crate) end: Taylor,
}

impl Parabola {
    /// `lengths`: of the interval before (0 if there is none), its own, and of the one after. A quadratic
    /// B-spline with one coefficient for the middle of each interval: a tangent of b at a knot leads
    /// through the coefficients to either side.
    pub(crate) fn new(lengths: [f64; 3]) -> Self {
        let [before, own, after] = lengths;
        let (left, right) = (before + own, own + after);
        let start_slope = [-2.0 / left, 2.0 / left, 0.0];
        let end_slope = [0.0, -2.0 / right, 2.0 / right];
        let second = core::array::from_fn(|i| (end_slope[i] - start_slope[i]) / own);
        Self {
            start: Taylor {
                value: [own / left, before / left, 0.0],
                slope: start_slope,
                second,
            },
            end: Taylor {
                value: [0.0, after / right, own / right],
                slope: end_slope,
                second,
            },
        }
    }

    /// The same of an interval of that length where b has no slope at its start or end: b is the coefficient of
    /// the interval there, and that beyond it counts for nothing.
    pub(crate) fn level_at(mut self, own: f64, [is_start, is_end]: [bool; 2]) -> Self {
        for (place, is_level) in [(&mut self.start, is_start), (&mut self.end, is_end)] {
            if is_level {
                (place.value, place.slope) = ([0.0, 1.0, 0.0], [0.0; 3]);
            }
        }
        let (start, end) = (self.start.slope, self.end.slope);
        let second = core::array::from_fn(|i| (end[i] - start[i]) / own);
        (self.start.second, self.end.second) = (second, second);
        self
    }

    /// b, b′ and b″ at the start for some coefficients.
    pub(crate) fn at_start(&self, x: &[f64]) -> [f64; 3] {
        [self.start.value, self.start.slope, self.start.second]
            .map(|of| of[0] * x[0] + of[1] * x[1] + of[2] * x[2])
    }

    /// b in the middle: of the Bézier points, which are the values at both ends and the coefficient.
    pub(crate) fn middle(&self) -> [f64; 3] {
        let (start, end) = (self.start.value, self.end.value);
        let inner = [0.0, 2.0, 0.0];
        core::array::from_fn(|i| 0.25 * (start[i] + inner[i] + end[i]))
    }
}
