//! The motion state of one axis, or of the way along a line, and the bounds on it.

/// Position, velocity and acceleration, in the unit of the axis by s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Motion {
    /// Position.
    pub(crate) x: f64,
    /// Velocity.
    pub(crate) v: f64,
    /// Acceleration.
    pub(crate) a: f64,
}

impl Motion {
    /// At rest.
    pub(crate) const fn at(x: f64) -> Self {
        Self { x, v: 0.0, a: 0.0 }
    }

    /// After a time t ≥ 0 with a constant jerk.
    pub(crate) fn after(&self, t: f64, jerk: f64) -> Self {
        let a = self.a + jerk * t;
        Self {
            x: self.x + t * (self.v + t * (0.5 * self.a + t * (jerk / 6.0))),
            v: self.v + t * (self.a + 0.5 * t * jerk),
            a,
        }
    }

    /// The same seen from the other side.
    pub(super) fn mirrored(&self, side: f64) -> Self {
        Self {
            x: self.x * side,
            v: self.v * side,
            a: self.a * side,
        }
    }
}

/// The largest amounts of velocity (≥ 0), acceleration and jerk (> 0).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) v: f64,
    pub(crate) a: f64,
    pub(crate) j: f64,
}

impl Bounds {
    /// The same with another velocity.
    pub(crate) const fn with_speed(self, v: f64) -> Self {
        Self { v, ..self }
    }
}
