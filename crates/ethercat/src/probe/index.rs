//! Searches for the index pulse of encoders: the unit of a drive's touch probe, which keeps the zero impulse while the
//! interpolator asks for that.
//!
//! ```text
//!  Lent to the probe ──asked──► Clearing ──off for some cycles──► Arming ──on is seen──► Armed ──the impulse──► kept
//!         ▲                                                                                │
//!         └──────────── off for some cycles ──── Returning ◄──────── not asked any more ───┘
//! ```
//!
//! A place that was kept before it was asked for is of another turn, so a unit is off until that is certain.

use super::probing::Seen;
use super::settings::ProbeUse;
use super::unit::{ProbeInputs, RISING};
use glidepath_geometry::AXES;
use glidepath_link::Feedback;

/// Cycles in a row for which a unit has to be seen off: what is seen is as old as the way to the drive and back.
const OFF_CYCLES: u32 = 8;

#[derive(Debug, Clone, Copy, PartialEq, Default)]
enum Phase {
    /// The probe has the unit.
    #[default]
    Lent,
    Clearing(u32),
    Arming,
    Armed,
    Kept(f64),
    Returning(u32),
}

impl Phase {
    /// The next one by what the drive answers. `place` turns counts into a place.
    fn next(self, is_asked: bool, seen: &Seen<'_>) -> Self {
        let is_off = seen.is_present && !seen.inputs.is_on();
        let off = |cycles: u32| if is_off { cycles + 1 } else { 0 };
        match self {
            Self::Lent if is_asked => Self::Clearing(0),
            Self::Lent => Self::Lent,
            Self::Returning(cycles) if is_asked => Self::Clearing(off(cycles)),
            Self::Returning(cycles) if off(cycles) >= OFF_CYCLES => Self::Lent,
            Self::Returning(cycles) => Self::Returning(off(cycles)),
            _ if !is_asked => Self::Returning(0),
            // A drive that is away forgets.
            _ if !seen.is_present => Self::Clearing(0),
            Self::Clearing(cycles) if off(cycles) >= OFF_CYCLES => Self::Arming,
            Self::Clearing(cycles) => Self::Clearing(off(cycles)),
            Self::Arming if seen.inputs.is_on() => Self::Armed,
            Self::Armed if is_off => Self::Clearing(1),
            Self::Armed if seen.inputs.has(RISING) => {
                Self::Kept(seen.settings.place(seen.inputs.places[0]))
            }
            same => same,
        }
    }
}

/// The units of all drives.
#[derive(Debug)]
pub(crate) struct IndexSearches {
    units: Vec<Phase>,
    /// The joints whose index pulse is asked for, one bit each.
    asked: u32,
}

impl IndexSearches {
    /// Those of so many drives.
    pub(crate) fn new(drives: usize) -> Self {
        Self {
            units: vec![Phase::default(); drives],
            asked: 0,
        }
    }

    /// The bus has come up: drives begin anew.
    pub(crate) fn begin(&mut self) {
        self.units.fill(Phase::default());
    }

    /// The joints whose index pulse is asked for.
    pub(crate) const fn ask(&mut self, joints: u32) {
        self.asked = joints;
    }

    /// What the unit of a drive is to do, if it is not the probe's.
    pub(crate) fn used(&self, nth: usize) -> Option<ProbeUse> {
        match self.units.get(nth)? {
            Phase::Lent => None,
            Phase::Clearing(_) | Phase::Returning(_) => Some(ProbeUse::Off),
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
            *unit = unit.next(is_asked, &seen);
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
