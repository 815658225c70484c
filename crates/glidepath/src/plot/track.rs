//! The tool's track in bounded memory.
//!
//! Points are taken as they come. When there are too many, those that show least are dropped: the
//! ones nearest to the straight line between their neighbours, with a difference in feed counted as
//! a distance. Two neighbours are never dropped together, so that no bend is lost in one go.

use super::bound::Bound;

/// Points kept at most.
const CAPACITY: usize = 12_000;

/// A point of the track.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TrackPoint {
    /// X, Y, Z in mm.
    pub(super) at: [f64; 3],
    /// mm/s.
    pub(super) feed_v: f64,
    /// True if the way to here was a rapid move.
    pub(super) rapid: bool,
    /// The kind of limit that binds on the way to here, if it is known.
    pub(super) bound: Option<Bound>,
}

#[derive(Debug, Clone, Default)]
pub(super) struct MotionTrace {
    points: Vec<TrackPoint>,
    max_feed_v: f64,
    low: [f64; 3],
    high: [f64; 3],
}

impl MotionTrace {
    pub(super) fn push(&mut self, point: TrackPoint) {
        #[allow(
            clippy::float_cmp,
            reason = "a machine at rest repeats its position exactly"
        )]
        match self.points.last() {
            None => (self.low, self.high) = (point.at, point.at),
            Some(last) if last.at == point.at => return,
            Some(_) => {}
        }
        for (i, value) in point.at.into_iter().enumerate() {
            self.low[i] = self.low[i].min(value);
            self.high[i] = self.high[i].max(value);
        }
        if !point.rapid {
            self.max_feed_v = self.max_feed_v.max(point.feed_v);
        }
        self.points.push(point);
        if self.points.len() >= CAPACITY {
            self.thin();
        }
    }

    pub(super) fn points(&self) -> &[TrackPoint] {
        &self.points
    }

    /// Largest feed outside rapid moves, mm/s.
    pub(super) const fn max_feed_v(&self) -> f64 {
        self.max_feed_v
    }

    /// True if it is known what binds.
    pub(super) fn has_bounds(&self) -> bool {
        self.points.iter().any(|point| point.bound.is_some())
    }

    /// The same track in coordinates with another zero.
    pub(super) fn seen_from(&self, zero: [f64; 3]) -> Self {
        let shift = |at: [f64; 3]| core::array::from_fn(|i| at[i] - zero[i]);
        let mut seen = self.clone();
        for point in &mut seen.points {
            point.at = shift(point.at);
        }
        (seen.low, seen.high) = (shift(self.low), shift(self.high));
        seen
    }

    fn thin(&mut self) {
        let extent = (0..3)
            .map(|i| self.high[i] - self.low[i])
            .fold(0.0, f64::max)
            .max(f64::MIN_POSITIVE);
        // A change from slow to fast shows as much as a bend of 2 % of the picture.
        let mm_per_feed = 0.02 * extent / self.max_feed_v.max(f64::MIN_POSITIVE);
        let worth: Vec<f64> = self
            .points
            .windows(3)
            .map(|three| worth(three, mm_per_feed).max(worth_of_bound(three, extent)))
            .collect();
        let mut sorted = worth.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        let threshold = sorted.get(2 * sorted.len() / 3).copied().unwrap_or(0.0);
        let mut dropped_before = false;
        let mut index = 0;
        self.points.retain(|_| {
            // `worth` begins with the second point and ends with the last but one.
            let drop = !dropped_before
                && index > 0
                && worth
                    .get(index - 1)
                    .is_some_and(|worth| *worth <= threshold);
            index += 1;
            dropped_before = drop;
            !drop
        });
    }
}

/// A change of what binds shows as much as a bend of half a percent of the picture.
fn worth_of_bound(three: &[TrackPoint], extent: f64) -> f64 {
    let changes = three.windows(2).any(|pair| pair[0].bound != pair[1].bound);
    if changes { 0.005 * extent } else { 0.0 }
}

/// What the middle one of three points shows, in mm.
fn worth(three: &[TrackPoint], mm_per_feed: f64) -> f64 {
    let [a, b, c] = three else {
        return f64::INFINITY;
    };
    if a.rapid != b.rapid || b.rapid != c.rapid {
        return f64::INFINITY;
    }
    let difference =
        |p: &TrackPoint, q: &TrackPoint| [p.at[0] - q.at[0], p.at[1] - q.at[1], p.at[2] - q.at[2]];
    let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let (chord, to_b) = (difference(c, a), difference(b, a));
    let length2 = dot(chord, chord);
    let along = if length2 > 0.0 {
        (dot(to_b, chord) / length2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let away = [0, 1, 2].map(|i| to_b[i] - along * chord[i]);
    let feed = (b.feed_v - (c.feed_v - a.feed_v).mul_add(along, a.feed_v)).abs();
    dot(away, away).sqrt().max(feed * mm_per_feed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f64, y: f64) -> TrackPoint {
        TrackPoint {
            at: [x, y, 0.0],
            feed_v: 10.0,
            rapid: false,
            bound: None,
        }
    }

    #[test]
    fn corners_outlive_the_points_of_straight_lines() {
        let mut track = MotionTrace::default();
        let side = 40_000_u32;
        for i in 0..=side {
            track.push(point(f64::from(i) / 1000.0, 0.0));
        }
        for i in 1..=side {
            track.push(point(40.0, f64::from(i) / 1000.0));
        }
        assert!(track.points().len() < CAPACITY);
        assert!(track.points().contains(&point(40.0, 0.0)), "the corner");
        assert_eq!(track.points().first(), Some(&point(0.0, 0.0)));
        assert_eq!(track.points().last(), Some(&point(40.0, 40.0)));
        let seen = track.seen_from([10.0, 0.0, 1.0]);
        assert_eq!(
            seen.points().last(),
            Some(&TrackPoint {
                at: [30.0, 40.0, -1.0],
                ..point(0.0, 0.0)
            })
        );
    }

    #[test]
    fn rest_is_one_point() {
        let mut track = MotionTrace::default();
        (0..9).for_each(|_| track.push(point(1.0, 2.0)));
        assert_eq!(track.points().len(), 1);
    }
}
