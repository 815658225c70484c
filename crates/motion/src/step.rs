//! The motion of a period, as far as places beside it are concerned.

use glidepath_geometry::AxisVector;

/// The motion of a period: where the machine is at both ends of it, and its velocity there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    pub(crate) from: [AxisVector; 2],
    pub(crate) to: [AxisVector; 2],
    pub(crate) period_t: f64,
}

impl Step {
    /// The part of the period, from one on, after which the motion is nearest to a place that it comes to;
    /// `None` if it comes nearer until the end. Where it goes away from the place already, that is at once.
    ///
    /// A corner is rounded, so the motion passes beside it, and at a sharp one the path position goes by the
    /// corner before the motion is nearest to it, or after that.
    pub(crate) fn nearest_to(&self, place: &AxisVector, from_part: f64) -> Option<f64> {
        if self.comes_nearer(place, from_part) {
            self.turns_from(place, from_part, 1.0)
        } else {
            Some(from_part)
        }
    }

    /// The part of the period, between two, after which the motion has come to a place and begins to go away from
    /// it; `None` if it does not.
    pub(crate) fn turns_from(
        &self,
        place: &AxisVector,
        from_part: f64,
        to_part: f64,
    ) -> Option<f64> {
        if !self.comes_nearer(place, from_part) || self.comes_nearer(place, to_part) {
            return None;
        }
        let (mut low, mut high) = (from_part, to_part);
        // To a billionth of the period.
        for _ in 0..30 {
            let middle = 0.5 * (low + high);
            if self.comes_nearer(place, middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(high)
    }

    /// True if the distance from a place becomes less after a part of the period.
    fn comes_nearer(&self, place: &AxisVector, part: f64) -> bool {
        let [position, direction] = self.at(part);
        (position - place).dot(&direction) < 0.0
    }

    /// The cubic through both ends, and its derivative by the part of the period.
    fn at(&self, u: f64) -> [AxisVector; 2] {
        let ([p0, v0], [p1, v1]) = (self.from, self.to);
        let (v0, v1) = (v0 * self.period_t, v1 * self.period_t);
        let step = p1 - p0;
        let (c2, c3) = (3.0 * step - 2.0 * v0 - v1, v0 + v1 - 2.0 * step);
        [
            p0 + ((c3 * u + c2) * u + v0) * u,
            (3.0 * c3 * u + 2.0 * c2) * u + v0,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f64, y: f64) -> AxisVector {
        let mut point = AxisVector::zeros();
        (point[0], point[1]) = (x, y);
        point
    }

    #[test]
    fn a_place_beside_a_straight_step_is_nearest_at_its_foot() {
        let velocity = point(250.0, 0.0);
        let step = Step {
            from: [point(0.0, 0.0), velocity],
            to: [point(1.0, 0.0), velocity],
            period_t: 0.004,
        };
        let part = step.nearest_to(&point(0.7, 0.02), 0.1);
        assert!(
            part.is_some_and(|part| (part - 0.7).abs() < 1e-8),
            "{part:?}"
        );
        assert_eq!(step.nearest_to(&point(0.05, 0.02), 0.1), Some(0.1));
        assert_eq!(step.nearest_to(&point(1.2, 0.02), 0.1), None);
    }

    #[test]
    fn where_a_motion_turns_round_it_is_nearest_to_what_is_ahead() {
        // There and back within the period: furthest half-way.
        let step = Step {
            from: [point(0.0, 0.0), point(10.0, 0.0)],
            to: [point(0.0, 0.0), point(-10.0, 0.0)],
            period_t: 0.004,
        };
        let part = step.nearest_to(&point(1.0, 0.0), 0.0);
        assert!(
            part.is_some_and(|part| (part - 0.5).abs() < 1e-8),
            "{part:?}"
        );
    }
}
