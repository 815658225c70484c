//! Searches for the index pulse of encoders: the unit of a drive's touch probe, which keeps the zero impulse while the
//! interpolator asks for that.
//!
//! ```text
//!  Lent to the probe ──asked──► Clearing ──off for some cycles──► Arming ──on is seen──► Armed ──the impulse──► kept
//!         ▲                                                                                │
//!         └──────────── off for some cycles ──── Returning ◄──────── not asked any more ───┤
//!                                                     └◄── not asked any more ── Lost ◄── off, or away
//! ```
//!
//! A place that was kept before it was asked for is of another turn, so a unit is off until that is certain. And one that
//! was ready and is not any more may have missed the impulse: the joint moves, so the next one would be of another turn.
//! It is not ready again before somebody asks anew.

use super::probing::Seen;
use super::settings::ProbeUse;
use super::unit::{FALLING, ProbeInputs, RISING};
use glidepath_geometry::AXES;
use glidepath_link::Feedback;

/// For how long, and for how many cycles, a unit has to be seen off: what is seen is as old as the way to the drive and
/// back, and drives look at their units more seldom than at their targets.
const OFF_NS: u64 = 10_000_000;
const OFF_CYCLES: u64 = 8;

#[derive(Debug, Clone, Copy, PartialEq, Default)]
enum Phase {
    /// The probe has the unit.
    #[default]
    Lent,
    Clearing(u64),
    Arming,
    Armed,
    Kept(f64),
    /// It was ready, and is not any more.
    Lost,
    Returning(u64),
}

impl Phase {
    /// The next one by what the drive answers; a unit is off when it was seen so in so many cycles.
    fn next(self, is_asked: bool, seen: &Seen<'_>, off_cycles: u64) -> Self {
        let is_off = seen.is_present && !seen.inputs.is_on();
        let off = |cycles: u64| if is_off { cycles + 1 } else { 0 };
        match self {
            Self::Lent if is_asked => Self::Clearing(0),
            Self::Lent => Self::Lent,
            Self::Returning(cycles) if is_asked => Self::Clearing(off(cycles)),
            Self::Returning(cycles) if off(cycles) >= off_cycles => Self::Lent,
            Self::Returning(cycles) => Self::Returning(off(cycles)),
            _ if !is_asked => Self::Returning(0),
            // A drive that is away forgets.
            Self::Armed | Self::Kept(_) if !seen.is_present => Self::Lost,
            Self::Arming if !seen.is_present => Self::Clearing(0),
            Self::Clearing(cycles) if off(cycles) >= off_cycles => Self::Arming,
            Self::Clearing(cycles) => Self::Clearing(off(cycles)),
            // What it keeps already is what it has not forgotten.
            Self::Arming if seen.inputs.is_on() && seen.inputs.has(RISING | FALLING) => {
                Self::Clearing(0)
            }
            Self::Arming if seen.inputs.is_on() => Self::Armed,
            Self::Armed if is_off => Self::Lost,
            Self::Armed if seen.inputs.has(RISING) => Self::Kept(seen.latched(0)),
            Self::Arming | Self::Armed | Self::Kept(_) | Self::Lost => self,
        }
    }

    /// The first one of a drive that has begun anew.
    const fn anew(self) -> Self {
        match self {
            Self::Lent | Self::Returning(_) | Self::Clearing(_) => Self::Lent,
            Self::Arming | Self::Armed | Self::Kept(_) | Self::Lost => Self::Lost,
        }
    }
}

/// The units of all drives.
#[derive(Debug)]
pub(crate) struct IndexSearches {
    units: Vec<Phase>,
    /// The joints whose index pulse is asked for, one bit each.
    asked: u32,
    off_cycles: u64,
}

impl IndexSearches {
    /// Those of so many drives, which are seen so often.
    pub(crate) fn new(drives: usize, period_ns: u64) -> Self {
        Self {
            units: vec![Phase::default(); drives],
            asked: 0,
            off_cycles: OFF_CYCLES.max(OFF_NS.div_ceil(period_ns.max(1))),
        }
    }

    /// The bus has come up: drives begin anew.
    pub(crate) fn begin(&mut self) {
        for unit in &mut self.units {
            *unit = unit.anew();
        }
    }

    /// The joints whose index pulse is asked for.
    pub(crate) const fn ask(&mut self, joints: u32) {
        self.asked = joints;
    }

    /// What the unit of a drive is to do, if it is not the probe's.
    pub(crate) fn used(&self, nth: usize) -> Option<ProbeUse> {
        match self.units.get(nth)? {
            Phase::Lent => None,
            Phase::Clearing(_) | Phase::Lost | Phase::Returning(_) => Some(ProbeUse::Off),
            Phase::Arming | Phase::Armed | Phase::Kept(_) => Some(ProbeUse::Index),
        }
    }

    /// A sample of all drives: what is known of their index pulses.
    pub(crate) fn sample<'a>(
        &mut self,
        feedback: &mut Feedback,
        drives: impl Iterator<Item = Seen<'a>>,
    ) {
        for (unit, seen) in self.units.iter_mut().zip(drives) {
            let joint = seen.settings.joint.min(AXES - 1);
            let bit = 1 << joint;
            let is_asked = seen.settings.index.is_some() && self.asked & bit != 0;
            *unit = unit.next(is_asked, &seen, self.off_cycles);
            match *unit {
                Phase::Armed => feedback.index_armed |= bit,
                Phase::Kept(place) => {
                    feedback.index_armed |= bit;
                    feedback.index_kept |= bit;
                    feedback.index_position[joint] = place;
                }
                _ => {}
            }
        }
    }

    /// What the probe sees of a drive: nothing while its unit is not the probe's.
    pub(crate) fn left_of<'a>(&self, nth: usize, seen: Seen<'a>) -> Seen<'a> {
        if self.used(nth).is_none() {
            return seen;
        }
        Seen {
            inputs: ProbeInputs::default(),
            is_present: false,
            ..seen
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::DriveSettings;

    /// What the unit comes to by what is seen of its status, one cycle each; `None` where the drive is away.
    fn through(from: Phase, statuses: &[Option<u8>]) -> Phase {
        let settings = DriveSettings::of_1000_counts();
        statuses.iter().fold(from, |phase, status| {
            let seen = Seen {
                settings: &settings,
                inputs: ProbeInputs {
                    status: status.unwrap_or(0),
                    places: [0; 2],
                },
                is_present: status.is_some(),
                added: 0.25,
                places: &[],
                newest: 0,
            };
            phase.next(true, &seen, 10)
        })
    }

    #[test]
    fn a_unit_that_keeps_something_already_is_not_ready() {
        let cleared = through(Phase::Lent, &[Some(0); 11]);
        assert_eq!(cleared, Phase::Arming);
        assert_eq!(through(cleared, &[Some(0), Some(1)]), Phase::Armed);
        for kept in [3, 5, 7] {
            assert_eq!(through(cleared, &[Some(kept)]), Phase::Clearing(0));
        }
    }

    #[test]
    fn a_unit_that_was_ready_and_is_not_any_more_stays_so_while_it_is_asked_for() {
        for lost in [Some(0), None] {
            let mut statuses = vec![lost];
            statuses.extend([Some(0); 20]);
            statuses.extend([Some(1); 20]);
            assert_eq!(through(Phase::Armed, &statuses), Phase::Lost);
        }
        // What is kept is known, but not to a drive that has begun anew.
        assert_eq!(through(Phase::Kept(1.0), &[Some(0)]), Phase::Kept(1.0));
        assert_eq!(through(Phase::Kept(1.0), &[None]), Phase::Lost);
    }

    #[test]
    fn what_is_kept_is_where_the_joint_is_by_its_encoder_on_the_load() {
        assert_eq!(through(Phase::Armed, &[Some(3)]), Phase::Kept(0.25));
    }

    #[test]
    fn a_unit_is_off_for_ten_milliseconds_and_eight_cycles() {
        for (period_ns, cycles) in [(250_000, 40), (1_000_000, 10), (4_000_000, 8)] {
            assert_eq!(IndexSearches::new(1, period_ns).off_cycles, cycles);
        }
    }
}
