//! The home search of one joint, phase by phase.
//!
//! ```text
//!  on the switch already: back off ─► search ─► same signs: retreat ─► latch ─► (arm) index ─► latched
//!                                        └────── opposite signs ────────▲
//! ```
//!
//! Every phase is a motion to a bound, ended by what it looks for: a stop, and a pause in which
//! switches and joints come to rest. A phase that gets to its bound has not found it.

use super::index::{IndexSeen, Kept};
use crate::shared::config::homing::{IndexPulse, JointHoming, Kind};

/// After a stop, switches and joints are given so long to come to rest.
const PAUSE_NS: u64 = 100_000_000;
/// How long a drive may take to be ready for an index pulse: one that is asked by its mailbox takes some tenths of a
/// second.
const ARM_NS: u64 = 5_000_000_000;
/// How long a drive may take at the end of the way to tell what it has kept: one that is asked by its mailbox takes some
/// tenths of a second for that, too.
const TELL_NS: u64 = 2_000_000_000;
/// How far a joint swings at rest, mm or degrees; and by how much time a sample may be beside what the drive keeps, s.
const SWINGS: f64 = 0.01;
const BESIDE_T: f64 = 0.005;
/// Ways that begin beside the edge are as long as a way past it and back, and a little.
const BESIDE_R: f64 = 2.0;

/// What is known of a joint in a turn.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Seen {
    pub(crate) now_ns: u64,
    /// Where it was told to be, as the drive counts.
    pub(crate) place: f64,
    /// Where it is, as the drive counts.
    pub(crate) actual: f64,
    /// It has taken the last order, and is at rest.
    pub(crate) rests: bool,
    /// Its switch is closed.
    pub(crate) is_closed: bool,
    /// Where the switch first closed and opened since the edges were last forgotten.
    pub(crate) rising: Option<f64>,
    pub(crate) falling: Option<f64>,
    /// What is known of its index pulse.
    pub(crate) index: IndexSeen,
}

/// Why a joint did not find its home.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub(crate) enum SearchFailure {
    #[error("its switch did not close within {0} mm")]
    NoSwitch(f64),
    #[error("its switch did not open within {0} mm")]
    StuckSwitch(f64),
    #[error("there was no edge of its switch within {0} mm")]
    NoEdge(f64),
    #[error("there was no index pulse within {0} mm")]
    NoIndex(f64),
    #[error("its switch opened again behind the edge: the cam is shorter than the way past it")]
    OpenAgain,
    #[error("its switch, which is shared, is closed before the search begins")]
    SharedSwitch,
    #[error("its drive does not latch the index pulse that is configured")]
    NoLatch,
    #[error(
        "its drive was not ready to keep the index pulse within {0} s: does its servo stack have it do that, and does the \
         joint not stand on the pulse?"
    )]
    NotArmed(u64),
    #[error("its drive was not ready any more for the index pulse while the joint moved")]
    Disarmed,
    #[error(
        "the joint stands on its index pulse where it sets out: jog it off, and look for its home again"
    )]
    OnPulse,
    #[error(
        "its drive says that the index pulse was at {0:.4}, which is not on the way from {1:.4} to {2:.4}"
    )]
    Elsewhere(f64, f64, f64),
}

/// The next step of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Step {
    Wait,
    /// Forget the edges, and go there at most so fast.
    Go {
        place: f64,
        v: f64,
    },
    Stop,
    /// What is to be added to the drive's count is known.
    Found {
        offset: f64,
    },
    Failed(SearchFailure),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    BackOff,
    Search,
    Retreat,
    Latch,
    Index,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Stage {
    Begin,
    /// Its drive is to be ready for the index pulse.
    Arming {
        since_ns: u64,
        /// It was seen not to be: what it is ready for since, or keeps, it was asked by this search.
        was_not: bool,
    },
    Going,
    /// At the end of its way: its drive may have kept the index pulse, and not have told it yet.
    Awaiting {
        since_ns: u64,
    },
    Stopping,
    Pausing {
        since_ns: u64,
    },
}

/// The search of a joint.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HomeSearch {
    settings: JointHoming,
    kind: Kind,
    phase: Phase,
    stage: Stage,
    has_begun: bool,
    index_before: u64,
    /// Where it set out.
    from: f64,
    latched: f64,
}

impl HomeSearch {
    /// `None` if the joint cannot be homed so, which the configuration refuses.
    pub(crate) fn new(settings: &JointHoming) -> Option<Self> {
        Some(Self {
            settings: *settings,
            kind: settings.kind().ok()?,
            phase: Phase::Search,
            stage: Stage::Begin,
            has_begun: false,
            index_before: 0,
            from: 0.0,
            latched: 0.0,
        })
    }

    /// One turn. `may_set_out` is false while another joint that moves the same axis is not ready.
    pub(crate) fn step(&mut self, seen: &Seen, may_set_out: bool) -> Step {
        if !core::mem::replace(&mut self.has_begun, true) {
            match self.kind {
                Kind::Here => {
                    return Step::Found {
                        offset: self.settings.offset - seen.place,
                    };
                }
                Kind::Absolute => {
                    return Step::Found {
                        offset: self.settings.offset,
                    };
                }
                Kind::Index => self.phase = Phase::Index,
                Kind::Switch | Kind::SwitchThenIndex if seen.is_closed => {
                    if self.settings.is_shared {
                        return Step::Failed(SearchFailure::SharedSwitch);
                    }
                    self.phase = Phase::BackOff;
                }
                Kind::Switch | Kind::SwitchThenIndex => {}
            }
        }
        match self.stage {
            Stage::Begin => self.begin(seen),
            Stage::Arming { since_ns, was_not } => {
                let was_not = was_not || seen.index.kept == Kept::No;
                self.stage = Stage::Arming { since_ns, was_not };
                self.arm(since_ns, seen, may_set_out)
            }
            Stage::Going | Stage::Awaiting { .. } => self.go_on(seen),
            Stage::Stopping if seen.rests => {
                let since_ns = seen.now_ns;
                self.stage = Stage::Pausing { since_ns };
                Step::Wait
            }
            Stage::Pausing { since_ns } if seen.now_ns >= since_ns + PAUSE_NS => {
                self.stage = Stage::Begin;
                self.next_phase(seen)
            }
            Stage::Stopping | Stage::Pausing { .. } => Step::Wait,
        }
    }

    /// Velocity of the present phase, with its sign, and the most way of it.
    fn way(&self) -> (f64, f64) {
        let JointHoming {
            search_v,
            latch_v,
            search_travel,
            clearance,
            ..
        } = self.settings;
        match self.phase {
            Phase::BackOff => (-search_v, search_travel),
            Phase::Search => (search_v, search_travel),
            Phase::Retreat => (-search_v, BESIDE_R * clearance),
            Phase::Latch => (latch_v, BESIDE_R * clearance),
            // Onto the switch there is no more room than past its edge.
            Phase::Index
                if self.kind == Kind::SwitchThenIndex && self.settings.latches_rising() =>
            {
                (latch_v, clearance)
            }
            Phase::Index => (latch_v, search_travel),
        }
    }

    /// Whether its drive is to keep where the next index pulse is.
    pub(crate) fn asks_index(&self) -> bool {
        let is_under_way = matches!(
            self.stage,
            Stage::Arming { .. } | Stage::Going | Stage::Awaiting { .. }
        );
        self.phase == Phase::Index && is_under_way && self.is_kept_by_drive()
    }

    /// Whether it stands until its drive is ready for the index pulse.
    pub(crate) fn waits_for_drive(&self, seen: &Seen) -> bool {
        matches!(self.stage, Stage::Arming { .. }) && !self.is_armed(seen)
    }

    /// Whether its drive is ready for an index pulse, and has been asked for that by this search.
    fn is_armed(&self, seen: &Seen) -> bool {
        matches!(self.stage, Stage::Arming { was_not: true, .. }) && seen.index.kept == Kept::Armed
    }

    fn is_kept_by_drive(&self) -> bool {
        self.settings.index == Some(IndexPulse::Drive)
    }

    fn begin(&mut self, seen: &Seen) -> Step {
        if self.phase == Phase::Index {
            if self.is_kept_by_drive() {
                self.stage = Stage::Arming {
                    since_ns: seen.now_ns,
                    was_not: seen.index.kept == Kept::No,
                };
                return Step::Wait;
            }
            let Some((count, _)) = seen.index.latched else {
                return Step::Failed(SearchFailure::NoLatch);
            };
            self.index_before = count;
        }
        self.set_out(seen)
    }

    /// Waits at rest until its drive is ready for the index pulse.
    fn arm(&mut self, since_ns: u64, seen: &Seen, may_set_out: bool) -> Step {
        if self.is_armed(seen) {
            return if may_set_out {
                self.set_out(seen)
            } else {
                Step::Wait
            };
        }
        let was_not = matches!(self.stage, Stage::Arming { was_not: true, .. });
        match seen.index.kept {
            // Which side of the pulse that is nobody knows.
            Kept::At(_) if was_not => Step::Failed(SearchFailure::OnPulse),
            _ if seen.now_ns > since_ns + ARM_NS => {
                Step::Failed(SearchFailure::NotArmed(ARM_NS / 1_000_000_000))
            }
            Kept::No | Kept::Armed | Kept::At(_) => Step::Wait,
        }
    }

    fn set_out(&mut self, seen: &Seen) -> Step {
        (self.stage, self.from) = (Stage::Going, seen.actual);
        let (v, way) = self.way();
        Step::Go {
            place: seen.place + way.copysign(v),
            v: v.abs(),
        }
    }

    fn go_on(&mut self, seen: &Seen) -> Step {
        // It may have passed the pulse, and what it is ready for later is that of another turn.
        if self.asks_index() && seen.index.kept == Kept::No {
            return Step::Failed(SearchFailure::Disarmed);
        }
        let found = match self.phase {
            Phase::Search => seen.is_closed.then_some(seen.actual),
            Phase::BackOff | Phase::Retreat => (!seen.is_closed).then_some(seen.actual),
            Phase::Latch if self.settings.latches_rising() => seen.rising,
            Phase::Latch => seen.falling,
            Phase::Index if self.is_kept_by_drive() => seen.index.kept.place(),
            Phase::Index => {
                let latched = seen.index.latched;
                let latched = latched.filter(|(count, _)| *count != self.index_before);
                latched.map(|(_, position)| position)
            }
        };
        if let Some(place) = found {
            if self.asks_index()
                && let Some(why) = self.beside_way(place, seen)
            {
                return Step::Failed(why);
            }
            self.latched = place;
            self.stage = Stage::Stopping;
            return Step::Stop;
        }
        if !seen.rests {
            return Step::Wait;
        }
        if self.asks_index() && self.waits_at_end(seen) {
            return Step::Wait;
        }
        let (_, way) = self.way();
        Step::Failed(match self.phase {
            Phase::Search => SearchFailure::NoSwitch(way),
            Phase::BackOff | Phase::Retreat => SearchFailure::StuckSwitch(way),
            Phase::Latch => SearchFailure::NoEdge(way),
            Phase::Index => SearchFailure::NoIndex(way),
        })
    }

    /// At the end of its way: whether its drive may still tell what it has kept.
    const fn waits_at_end(&mut self, seen: &Seen) -> bool {
        let Stage::Awaiting { since_ns } = self.stage else {
            self.stage = Stage::Awaiting {
                since_ns: seen.now_ns,
            };
            return true;
        };
        seen.now_ns <= since_ns + TELL_NS
    }

    /// Why the joint cannot have passed its index pulse at a place since it set out, if it cannot.
    fn beside_way(&self, place: f64, seen: &Seen) -> Option<SearchFailure> {
        let latch_v = self.settings.latch_v;
        let ahead = |place: f64| (place - self.from) * latch_v.signum();
        if ahead(place).abs() <= SWINGS {
            return Some(SearchFailure::OnPulse);
        }
        let beyond = ahead(seen.actual) + SWINGS + latch_v.abs() * BESIDE_T;
        let is_on_way = (0.0..=beyond).contains(&ahead(place));
        (!is_on_way).then_some(SearchFailure::Elsewhere(place, self.from, seen.actual))
    }

    fn next_phase(&mut self, seen: &Seen) -> Step {
        self.phase = match self.phase {
            Phase::BackOff => Phase::Search,
            Phase::Search if !seen.is_closed => {
                return Step::Failed(SearchFailure::OpenAgain);
            }
            Phase::Search if self.settings.latches_rising() => Phase::Retreat,
            Phase::Search | Phase::Retreat => Phase::Latch,
            Phase::Latch if self.kind == Kind::SwitchThenIndex => Phase::Index,
            Phase::Latch | Phase::Index => {
                return Step::Found {
                    offset: self.settings.offset - self.latched,
                };
            }
        };
        self.begin(seen)
    }
}

#[cfg(test)]
mod tests;
