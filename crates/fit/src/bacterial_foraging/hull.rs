//! The line, plane or space in which points lie.

use crate::point::Point;

/// Points that are no further beside it, as a share of how far they spread, lie in a line or plane.
const FLAT_R: f64 = 1e-9;

/// The smallest of line, plane and space through points, with directions that are perpendicular to
/// each other. A coordinate that all points share is that of every point of it, exactly.
#[derive(Debug, Clone)]
pub(super) struct Hull {
    origin: Point,
    directions: Vec<Point>,
}

impl Hull {
    /// Of at least two points that differ.
    pub(super) fn of(points: &[Point]) -> Self {
        let origin = points.first().copied().unwrap_or_default();
        let mut rests: Vec<Point> = points.iter().map(|point| point - origin).collect();
        let furthest = |rests: &[Point]| {
            let size = |rest: &Point| rest.norm_squared();
            let far = rests.iter().max_by(|a, b| size(a).total_cmp(&size(b)));
            far.copied().unwrap_or_default()
        };
        let spread = furthest(&rests).norm();
        let mut directions = Vec::new();
        while directions.len() < 3 {
            let far = furthest(&rests);
            if far.norm() <= FLAT_R * spread {
                break;
            }
            let direction = far.normalize();
            for rest in &mut rests {
                *rest -= direction * rest.dot(&direction);
            }
            directions.push(direction);
        }
        Self { origin, directions }
    }

    pub(super) const fn dimensions(&self) -> usize {
        self.directions.len()
    }

    /// A point of it, by its way along each direction.
    pub(super) fn point(&self, at: &[f64]) -> Point {
        let along = at.iter().zip(&self.directions);
        along.fold(self.origin, |sum, (way, direction)| sum + direction * *way)
    }

    /// The ways to a point along each direction.
    pub(super) fn place(&self, point: &Point) -> Vec<f64> {
        let out = point - self.origin;
        let ways = self.directions.iter();
        ways.map(|direction| out.dot(direction)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_as_small_as_the_points_allow_and_keeps_what_they_share() {
        let spiral = |k: u32, z: f64| {
            let t = f64::from(k);
            Point::new(t.cos() * t, t.sin() * t, z)
        };
        let flat: Vec<Point> = (0..20).map(|k| spiral(k, -0.3)).collect();
        let hull = Hull::of(&flat);
        assert_eq!(hull.dimensions(), 2);
        for point in &flat {
            let there = hull.point(&hull.place(point));
            assert!((there - point).norm() < 1e-13);
            #[allow(clippy::float_cmp, reason = "to the bit")]
            let same = there.z == -0.3;
            assert!(same, "{there}");
        }
        // In a plane that slants.
        let slanting: Vec<Point> = flat.iter().map(|p| Point::new(p.x, p.y, p.x)).collect();
        assert_eq!(Hull::of(&slanting).dimensions(), 2);
        let line: Vec<Point> = (0..9).map(|k| Point::repeat(f64::from(k) * 0.1)).collect();
        assert_eq!(Hull::of(&line).dimensions(), 1);
        let space: Vec<Point> = (0..9).map(|k| spiral(k, f64::from(k * k))).collect();
        assert_eq!(Hull::of(&space).dimensions(), 3);
    }
}
