//! Positions, rates and rows of the axes in the space of the window, and back.

use super::ScaledPath;
use glidepath_geometry::AxisVector;

impl<const D: usize> ScaledPath<D> {
    /// A row on positions or rates of the axes as one on those in the window.
    pub(in crate::in_tube::window) fn inside_row(&self, row: &AxisVector) -> [f64; D] {
        let mut part = [0.0; D];
        for k in 0..self.moving {
            part[k] = row[self.axes[k]] * self.unit[k];
        }
        part
    }

    /// A rate in the window as one of the axes.
    pub(in crate::in_tube::window) fn outside_rate(&self, rate: &[f64; D]) -> AxisVector {
        let mut outside = AxisVector::zeros();
        for k in 0..self.moving {
            outside[self.axes[k]] = rate[k] * self.unit[k];
        }
        outside
    }

    /// A position in the space of the window.
    pub(crate) fn inside(&self, position: &AxisVector) -> [f64; D] {
        let mut point = [0.0; D];
        for k in 0..self.moving {
            let i = self.axes[k];
            point[k] = (position[i] - self.origin[i]) / self.unit[k];
        }
        point
    }

    /// A point of the window as a position; axes that do not move are those of the origin, and a
    /// coordinate at which a piece leaves its axis alone is that of the program to the bit.
    pub(crate) fn outside(&self, point: &[f64; D]) -> AxisVector {
        let mut position = self.origin;
        for k in 0..self.moving {
            let i = self.axes[k];
            let level = self.levels[k].binary_search_by(|level| level.0.total_cmp(&point[k]));
            match level.ok().and_then(|at| self.levels[k].get(at)) {
                Some((_, programmed)) => position[i] = *programmed,
                None => position[i] += point[k] * self.unit[k],
            }
        }
        position
    }
}
