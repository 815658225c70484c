//! The valley-first search for the speed along pieces of path.
//!
//! 1. Drive the whole run with one S-curve as if nothing but the ends bounded it.
//! 2. Of the pieces on which it is too fast, take the slowest one, with top speed V.
//! 3. Drive the run again, nowhere faster than V. It then cruises at V around that piece, or near
//!    it. What lies before the piece, as far as the cruise, is a run of its own from the old start
//!    to V; what lies after it likewise from V to the old end. Go on with each from step 1.
//!
//! ```text
//!   cap  ‾‾‾‾‾‾|__        ____|‾‾‾‾‾‾‾
//!                 |__    |
//!                    |___|  ← slowest violated piece: junctions at its two ends, speed V
//! ```
//!
//! The end speeds never exceed a cap inside that is still to be violated: caps are taken in rising
//! order, and lowering the peak of an S-curve lowers it everywhere. So every step is feasible, and
//! there is nothing to go back on.

use super::piece_sequence::{Leg, PieceSequence};
use crate::scurve::{PathLimits, Profile};

/// A speed above a cap by less than this is rounding.
pub(crate) const SPEED_ROUNDING_R: f64 = 1e-9;

/// The limits that S-curves are made with.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Limiting {
    /// The weakest of the pieces that an S-curve touches; of all of them, these.
    Weakest(PathLimits),
    /// These everywhere.
    Fixed(PathLimits),
}

/// Finds the speed along a run.
pub(crate) struct ValleyFirst<'a> {
    pub sequence: &'a PieceSequence<'a>,
    /// The top speed on each piece.
    pub caps_v: &'a [f64],
    pub limiting: Limiting,
}

/// A part of the run, to be driven from one speed to another.
#[derive(Clone, Copy)]
pub(crate) struct Section {
    pub from_s: f64,
    pub to_s: f64,
    pub entry_v: f64,
    pub exit_v: f64,
}

impl ValleyFirst<'_> {
    /// S-curves along a section; `None` if it is too short for the change of speed.
    pub(crate) fn drive(&self, section: Section) -> Option<Vec<Leg>> {
        let (Limiting::Weakest(outer) | Limiting::Fixed(outer)) = self.limiting;
        let mut legs = Vec::new();
        self.drive_section(section, outer, &mut legs)?;
        Some(legs)
    }

    fn touched(&self, section: Section) -> core::ops::Range<usize> {
        self.sequence.touched(section.from_s, section.to_s)
    }

    fn own_limits(&self, section: Section, outer: PathLimits) -> PathLimits {
        let Limiting::Weakest(_) = self.limiting else {
            return outer;
        };
        self.sequence.pieces[self.touched(section)]
            .iter()
            .map(|piece| piece.limit.change)
            .reduce(PathLimits::weaker)
            .unwrap_or(outer)
    }

    fn drive_section(
        &self,
        section: Section,
        outer: PathLimits,
        legs: &mut Vec<Leg>,
    ) -> Option<()> {
        let own = self.own_limits(section, outer);
        let (used, profile, violated) = self.unbounded(section, own, outer)?;
        let Some(slowest) = violated else {
            legs.push(Leg {
                from_s: section.from_s,
                profile,
            });
            return Some(());
        };
        // Not below the ends, whose speeds are given.
        let cap_v = self.caps_v[slowest]
            .max(section.entry_v)
            .max(section.exit_v);
        let capped = Self::profile(section, cap_v, used)?;
        let (cruise_from_s, cruise_to_s) = capped.cruise_s();
        let (cruise_from_s, cruise_to_s) =
            (section.from_s + cruise_from_s, section.from_s + cruise_to_s);
        // Junctions need a speed that is cruised at: at the ends of the slow piece, or at the end of the
        // cruise that is next to it.
        let before_s = self.sequence.starts_s[slowest].min(cruise_to_s);
        let after_s = self.sequence.starts_s[slowest + 1].max(cruise_from_s);

        let mut middle = section;
        if before_s >= cruise_from_s && before_s > section.from_s {
            self.drive_section(
                Section {
                    to_s: before_s,
                    exit_v: cap_v,
                    ..section
                },
                used,
                legs,
            )?;
            middle = Section {
                from_s: before_s,
                entry_v: cap_v,
                ..middle
            };
        }
        let goes_on = after_s <= cruise_to_s && after_s < section.to_s;
        if goes_on {
            middle = Section {
                to_s: after_s,
                exit_v: cap_v,
                ..middle
            };
        }
        legs.push(Leg {
            from_s: middle.from_s,
            profile: Self::profile(middle, cap_v, used)?,
        });
        if goes_on {
            self.drive_section(
                Section {
                    from_s: after_s,
                    entry_v: cap_v,
                    ..section
                },
                used,
                legs,
            )?;
        }
        Some(())
    }

    /// The S-curve with only the ends given, by the section's own limits, or by those of the
    /// section it was cut from where its own make it too fast on a piece slower than its ends.
    fn unbounded(
        &self,
        section: Section,
        own: PathLimits,
        outer: PathLimits,
    ) -> Option<(PathLimits, Profile, Option<usize>)> {
        let ends_v = section.entry_v.max(section.exit_v);
        let highest_v = self.caps_v[self.touched(section)]
            .iter()
            .copied()
            .fold(ends_v, f64::max);
        let mut found = None;
        for limits in [own, outer] {
            let profile = Self::profile(section, highest_v, limits)?;
            let violated = self.slowest_violated(section, &profile);
            found = Some((limits, profile, violated));
            let sound =
                violated.is_none_or(|m| self.caps_v[m] >= ends_v * (1.0 - SPEED_ROUNDING_R));
            if sound {
                break;
            }
        }
        found
    }

    fn profile(section: Section, top_v: f64, limits: PathLimits) -> Option<Profile> {
        Profile::new(
            section.entry_v,
            section.exit_v,
            section.to_s - section.from_s,
            top_v,
            limits,
        )
    }

    fn slowest_violated(&self, section: Section, profile: &Profile) -> Option<usize> {
        let mut slowest: Option<usize> = None;
        for m in self.touched(section) {
            let top_v = self.caps_v[m];
            if profile.peak_v() <= top_v * (1.0 + SPEED_ROUNDING_R)
                || slowest.is_some_and(|s| self.caps_v[s] <= top_v)
            {
                continue;
            }
            let from_s = self.sequence.starts_s[m].max(section.from_s) - section.from_s;
            let to_s = self.sequence.starts_s[m + 1].min(section.to_s) - section.from_s;
            let greatest_v = profile.greatest_speed_between(from_s, to_s);
            if greatest_v > top_v * (1.0 + SPEED_ROUNDING_R) {
                slowest = Some(m);
            }
        }
        slowest
    }
}
