//! A lathe cycle whose profile is being read.

use crate::execute::lathe_cycle::profile::LatheProfile;
use crate::execute::line_origin::SourceLine;
use crate::execute::motion::speed::Pace;
use crate::execute::state::fanuc_modal::Repeating;
use crate::execute::state::program_state::State;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::LatheCycle;

/// A cycle whose profile is being read.
#[derive(Debug)]
pub(crate) struct OpenLatheCycle {
    /// The block of the cycle: its line, the line of the program it is executed by, and what was
    /// read.
    pub(super) source: SourceLine,
    pub(super) line: u32,
    pub(super) block: Block,
    /// Calls in progress around it.
    pub(super) level: usize,
    pub(super) words: LatheCycleWords,
    pub(super) profile: LatheProfile,
    /// The state from before the profile was read.
    pub(super) state: State,
}

impl OpenLatheCycle {
    /// A cycle of FANUC, whose profile has been read.
    pub(crate) const fn of_fanuc(
        source: SourceLine,
        line: u32,
        block: Block,
        words: LatheCycleWords,
        profile: LatheProfile,
        state: State,
    ) -> Self {
        Self {
            source,
            line,
            block,
            level: 0,
            words,
            profile,
            state,
        }
    }
}

impl OpenLatheCycle {
    /// At which speed the tool goes to the first point of the profile: on a FANUC as the profile's first
    /// block says, in LinuxCNC's language at rapid.
    pub(super) fn infeed(&self) -> Pace {
        if self.block.dialect == Dialect::Fanuc && self.profile.begins_at_feed {
            Pace::Feed
        } else {
            Pace::Rapid
        }
    }
}

impl LatheCycleWords {
    /// One pass along the profile.
    pub(crate) const fn along_profile() -> Self {
        Self::of_fanuc(LatheCycle::Finish, 1.0, 0.0, None)
    }

    /// Roughing of FANUC: the profile itself has the allowances.
    pub(crate) const fn of_fanuc(
        cycle: LatheCycle,
        increment_mm: f64,
        retract_mm: f64,
        repeating: Option<Repeating>,
    ) -> Self {
        Self {
            cycle,
            distance_mm: 0.0,
            end_mm: 0.0,
            finishing: 1,
            increment_mm,
            retract_mm,
            first_level: 1.0,
            repeating,
        }
    }
}

/// The words of a cycle, mm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LatheCycleWords {
    pub(super) cycle: LatheCycle,
    /// Distance from the profile, of the first finishing pass or of all roughing.
    pub(super) distance_mm: f64,
    /// Distance of the last finishing pass.
    pub(super) end_mm: f64,
    pub(super) finishing: u32,
    pub(super) increment_mm: f64,
    pub(super) retract_mm: f64,
    /// How many depths below the start the first pass is: none to LinuxCNC, one to FANUC.
    pub(super) first_level: f64,
    /// The passes of G73.
    pub(super) repeating: Option<Repeating>,
}
