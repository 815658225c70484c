//! The positions that a motion has passed, for one that goes back along its path and onward again.

use glidepath_geometry::AxisVector;
use std::collections::VecDeque;

/// Frames behind the furthest that are kept: more than a motion can go back.
const KEPT: u64 = 1 << 17;

/// A place that was passed: program time, and where that was.
#[derive(Debug, Clone, Copy)]
struct PassedPlace {
    sequence: u64,
    fraction: f64,
    position: AxisVector,
}

impl PassedPlace {
    fn is_before(&self, other: &Self) -> bool {
        (self.sequence, self.fraction) < (other.sequence, other.fraction)
    }
}

/// The places that a motion has passed, two a frame at most.
#[derive(Debug, Clone, Default)]
pub struct Passed(VecDeque<PassedPlace>);

impl Passed {
    /// The next place of the motion, at a program time: a frame, and the part of a period past it.
    /// Behind the furthest time so far, gives how far it is from where the motion has gone then, mm
    /// or degrees; it is to be judged by the limits alone ([`crate::Audit::sample_away`]). Else it
    /// is the furthest from now on.
    pub fn off_mm(
        &mut self,
        (sequence, fraction): (u64, f64),
        position: &AxisVector,
    ) -> Option<f64> {
        let now = PassedPlace {
            sequence,
            fraction,
            position: *position,
        };
        if self.0.back().is_some_and(|last| now.is_before(last)) {
            return Some(self.off_chord_mm(&now));
        }
        let same = |place: Option<&PassedPlace>| place.is_some_and(|p| p.sequence == now.sequence);
        let nth_last = |n: usize| self.0.len().checked_sub(n).and_then(|k| self.0.get(k));
        if same(nth_last(1)) && same(nth_last(2)) {
            self.0.pop_back();
        }
        self.0.push_back(now);
        while (self.0.front()).is_some_and(|p| p.sequence + KEPT < now.sequence) {
            self.0.pop_front();
        }
        None
    }

    /// From the chord between the places before and after it.
    fn off_chord_mm(&self, now: &PassedPlace) -> f64 {
        let after = self.0.partition_point(|place| place.is_before(now));
        let (Some(to), from) = (self.0.get(after), after.checked_sub(1)) else {
            return f64::INFINITY;
        };
        let from = from.and_then(|k| self.0.get(k)).unwrap_or(to);
        let (chord, away) = (to.position - from.position, now.position - from.position);
        let length2 = chord.norm_squared();
        let part = if length2 > 0.0 {
            (away.dot(&chord) / length2).clamp(0.0, 1.0)
        } else {
            0.0
        };
        (away - chord * part).norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(passed: &mut Passed, sequence: u32, fraction: f64, [x, y]: [f64; 2]) -> Option<f64> {
        let mut position = AxisVector::zeros();
        (position[0], position[1]) = (x, y);
        passed.off_mm((sequence.into(), fraction), &position)
    }

    #[test]
    fn what_is_behind_is_held_against_where_it_went() {
        let mut passed = Passed::default();
        for k in 0..5_u32 {
            assert_eq!(at(&mut passed, k, 0.0, [f64::from(k), 0.0]), None);
        }
        assert!(at(&mut passed, 2, 0.5, [2.4, 0.0]).unwrap() < 1e-12);
        assert!((at(&mut passed, 2, 0.5, [3.4, 0.0]).unwrap() - 0.4).abs() < 1e-12);
        assert!((at(&mut passed, 1, 0.25, [1.25, 0.03]).unwrap() - 0.03).abs() < 1e-12);
        assert_eq!(at(&mut passed, 4, 0.0, [4.0, 0.0]), None, "it stands there");
        assert_eq!(at(&mut passed, 5, 0.0, [5.0, 0.0]), None);
    }

    #[test]
    fn a_slow_motion_keeps_two_places_a_frame() {
        let mut passed = Passed::default();
        for k in 0..1000_u32 {
            let hundredths = f64::from(k % 100) * 0.01;
            let x = f64::from(k / 100) + hundredths;
            assert_eq!(at(&mut passed, k / 100, hundredths, [x, 0.0]), None);
        }
        assert!(passed.0.len() <= 20, "{}", passed.0.len());
        assert!(at(&mut passed, 3, 0.4, [3.4, 0.0]).unwrap() < 1e-9);
    }
}
