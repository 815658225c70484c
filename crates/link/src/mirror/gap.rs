//! Gaps in the numbers of setpoints.

use crate::Setpoint;

/// Setpoints that were published and never came.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Gap {
    /// Number of the first that is missing.
    pub first: u64,
    /// Number of the last that is missing.
    pub last: u64,
}

impl Gap {
    /// How many are missing.
    #[must_use]
    pub const fn count(self) -> u64 {
        self.last - self.first + 1
    }
}

/// What is known of the numbers so far.
#[derive(Debug, Default)]
pub(super) struct Gaps {
    /// Life of the interpolator, and the number after the highest of it.
    next: Option<(u64, u64)>,
}

impl Gaps {
    /// The gap before a setpoint, if there is one. A new life of the interpolator counts anew.
    pub(super) const fn next(&mut self, setpoint: &Setpoint) -> Option<Gap> {
        let (boot_id, number) = (setpoint.boot_id, setpoint.number);
        let expected = match self.next {
            Some((life, next)) if life == boot_id => next,
            _ => number,
        };
        if number >= expected {
            self.next = Some((boot_id, number + 1));
        }
        if number > expected {
            Some(Gap {
                first: expected,
                last: number - 1,
            })
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable as _;

    #[test]
    fn a_gap_is_told_with_its_numbers_and_a_new_life_is_none() {
        let mut gaps = Gaps::default();
        let mut next = |boot_id, number| {
            gaps.next(&Setpoint {
                boot_id,
                number,
                ..Setpoint::zeroed()
            })
        };
        assert_eq!(next(1, 40), None);
        assert_eq!(next(1, 41), None);
        let gap = next(1, 45).expect("three are missing");
        assert_eq!((gap.first, gap.last, gap.count()), (42, 44, 3));
        // The last one again, as a subscriber that comes late is given it.
        assert_eq!(next(1, 45), None);
        assert_eq!(next(1, 46), None);
        assert_eq!(next(2, 9), None);
        assert_eq!(next(2, 10), None);
    }
}
