//! Where a motion has gone, for one that goes back along its path and onward again.

use glidepath_geometry::AxisVector;
use glidepath_link::Setpoint;
use std::collections::VecDeque;

/// Frames behind the furthest that are kept: more than a motion can go back.
const KEPT: u64 = 1 << 17;

/// A place that was passed: program time, and where that was.
#[derive(Debug, Clone, Copy)]
struct Place {
    sequence: u64,
    fraction: f64,
    position: AxisVector,
}

impl Place {
    fn of(setpoint: &Setpoint) -> Self {
        Self {
            sequence: setpoint.sequence,
            fraction: setpoint.fraction,
            position: setpoint.position.into(),
        }
    }

    fn is_before(&self, other: &Self) -> bool {
        (self.sequence, self.fraction) < (other.sequence, other.fraction)
    }
}

/// The places that were passed, two a frame at most.
#[derive(Debug, Default)]
pub(crate) struct Passed(VecDeque<Place>);

impl Passed {
    /// How far a setpoint is from where the motion has gone, mm or degrees, if it is behind the
    /// furthest; else it is the furthest from now on.
    pub(crate) fn off_mm(&mut self, setpoint: &Setpoint) -> Option<f64> {
        let now = Place::of(setpoint);
        if self
            .0
            .back()
            .is_some_and(|furthest| now.is_before(furthest))
        {
            return Some(self.off_chord_mm(&now));
        }
        let same = |place: Option<&Place>| place.is_some_and(|p| p.sequence == now.sequence);
        let nth_last = |n: usize| self.0.len().checked_sub(n).and_then(|k| self.0.get(k));
        if same(nth_last(1)) && same(nth_last(2)) {
            self.0.pop_back();
        }
        self.0.push_back(now);
        while self
            .0
            .front()
            .is_some_and(|p| p.sequence + KEPT < now.sequence)
        {
            self.0.pop_front();
        }
        None
    }

    /// From the chord between the places before and after it.
    fn off_chord_mm(&self, now: &Place) -> f64 {
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
    use bytemuck::Zeroable as _;

    fn at(sequence: u64, fraction: f64, x: f64) -> Setpoint {
        let mut setpoint = Setpoint {
            sequence,
            fraction,
            ..Setpoint::zeroed()
        };
        setpoint.position[0] = x;
        setpoint
    }

    #[test]
    fn what_is_behind_is_held_against_where_it_went() {
        let mut passed = Passed::default();
        for k in 0..5_u32 {
            let x = f64::from(k);
            assert_eq!(passed.off_mm(&at(u64::from(k), 0.0, x)), None);
        }
        let off = |passed: &mut Passed, setpoint| passed.off_mm(&setpoint).unwrap();
        assert!(off(&mut passed, at(2, 0.5, 2.4)) < 1e-12);
        assert!((off(&mut passed, at(2, 0.5, 3.4)) - 0.4).abs() < 1e-12);
        let mut aside = at(1, 0.25, 1.25);
        aside.position[1] = 0.03;
        assert!((off(&mut passed, aside) - 0.03).abs() < 1e-12);
        assert_eq!(passed.off_mm(&at(4, 0.0, 4.0)), None, "it stands there");
        assert_eq!(passed.off_mm(&at(5, 0.0, 5.0)), None);
    }

    #[test]
    fn a_slow_motion_keeps_two_places_a_frame() {
        let mut passed = Passed::default();
        for k in 0..1000_u32 {
            let hundredths = f64::from(k % 100) * 0.01;
            let x = f64::from(k / 100) + hundredths;
            assert_eq!(passed.off_mm(&at(u64::from(k / 100), hundredths, x)), None);
        }
        assert!(passed.0.len() <= 20, "{}", passed.0.len());
        assert!(passed.off_mm(&at(3, 0.4, 3.4)).unwrap() < 1e-9);
    }
}
