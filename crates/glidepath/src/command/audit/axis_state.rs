//! What the check of continuity knows of one axis, or of what is superposed to it.

use glidepath_geometry::Axis;
use glidepath_link::Setpoint;

/// An axis from one setpoint to the next, mm or degrees.
pub(super) struct AxisState {
    pub(super) axis: Axis,
    /// It is what is superposed to the axis, and not its position.
    pub(super) is_superposed: bool,
    pub(super) limits: [f64; 3],
    /// The ends of its travel, or of what may be superposed to it.
    pub(super) travel: [f64; 2],
    /// The same, and the place beyond them where what goes on began: there it may stand, and come inwards.
    pub(super) reach: [f64; 2],
    /// Last differences of first and second order.
    pub(super) differences: [f64; 2],
    pub(super) magnitude: f64,
    /// Samples in a row.
    pub(super) run: u32,
}

impl AxisState {
    pub(super) fn new(axis: Axis, limits: [f64; 3], travel: [f64; 2]) -> Self {
        Self {
            axis,
            is_superposed: false,
            limits,
            travel,
            reach: travel,
            differences: [0.0; 2],
            magnitude: 0.0,
            run: 0,
        }
    }

    /// Where it is.
    pub(super) fn place(&self, setpoint: &Setpoint) -> f64 {
        let values = if self.is_superposed {
            &setpoint.superposed
        } else {
            &setpoint.position
        };
        values.get(self.axis.index()).copied().unwrap_or(0.0)
    }

    /// What is judged from now on began here.
    pub(super) const fn begin_at(&mut self, place: f64) {
        let [low, high] = self.travel;
        self.reach = [low.min(place), high.max(place)];
    }

    /// What it is called.
    pub(super) fn name(&self) -> String {
        if self.is_superposed {
            format!("the superposition of {}", self.axis)
        } else {
            self.axis.to_string()
        }
    }

    /// What its ends are the ends of.
    pub(super) const fn range_word(&self) -> &'static str {
        if self.is_superposed {
            "range"
        } else {
            "travel"
        }
    }
}
