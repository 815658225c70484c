//! The home search of one joint, phase by phase.
//!
//! ```text
//!  on the switch already: back off ─► search ─► same signs: retreat ─► latch ─► index ─► latched
//!                                        └────── opposite signs ────────▲
//! ```
//!
//! Every phase is a motion to a bound, ended by what it looks for: a stop, and a pause in which
//! switches and joints come to rest. A phase that gets to its bound has not found it.

use crate::shared::config::homing::{JointHoming, Kind};

/// After a stop, switches and joints are given so long to come to rest.
const PAUSE_NS: u64 = 100_000_000;
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
    /// How many index pulses were latched, and where the last one was.
    pub(crate) index: Option<(u64, f64)>,
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
    Going,
    Stopping,
    Pausing { since_ns: u64 },
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
            latched: 0.0,
        })
    }

    /// One turn.
    pub(crate) fn step(&mut self, seen: &Seen) -> Step {
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
            Stage::Going => self.go_on(seen),
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

    fn begin(&mut self, seen: &Seen) -> Step {
        if self.phase == Phase::Index {
            let Some((count, _)) = seen.index else {
                return Step::Failed(SearchFailure::NoLatch);
            };
            self.index_before = count;
        }
        self.stage = Stage::Going;
        let (v, way) = self.way();
        Step::Go {
            place: seen.place + way.copysign(v),
            v: v.abs(),
        }
    }

    fn go_on(&mut self, seen: &Seen) -> Step {
        let found = match self.phase {
            Phase::Search => seen.is_closed.then_some(seen.actual),
            Phase::BackOff | Phase::Retreat => (!seen.is_closed).then_some(seen.actual),
            Phase::Latch if self.settings.latches_rising() => seen.rising,
            Phase::Latch => seen.falling,
            Phase::Index => {
                let latched = seen.index.filter(|(count, _)| *count != self.index_before);
                latched.map(|(_, position)| position)
            }
        };
        if let Some(place) = found {
            self.latched = place;
            self.stage = Stage::Stopping;
            return Step::Stop;
        }
        if !seen.rests {
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
