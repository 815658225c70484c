//! A case of the matrix: what goes wrong, when, and what must follow.

use glidepath_link::{FaultCause, FrameRefusal};

/// What goes wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fault {
    /// The planner is killed.
    KillPlanner,
    /// The planner stands still, and goes on before the machine gives it up.
    StopPlannerBriefly,
    /// The planner stands still until the machine has given it up.
    StopPlannerForLong,
    /// The interpolator is killed.
    KillInterpolator,
    /// The servo is killed, one of two subscribers.
    KillServo,
    /// A client is killed while it sends a command.
    KillClient,
    /// What an M code waits for is answered late, or too late.
    AnswerLate,
    /// A program in a pipe has a pause.
    PausePipe,
    /// Some byte of a frame has another value.
    CorruptFrame,
    /// A frame comes twice.
    RepeatFrame,
    /// A frame is missing.
    SkipFrame,
    /// A number of a frame is infinite or not a number.
    SpoilNumber,
    /// A frame is off its place.
    MoveFrame,
    /// A frame is far outside of the travel.
    MoveFrameFar,
    /// A frame's velocity is not that of the motion.
    ChangeVelocity,
    /// A frame says that it is of an epoch before.
    OldEpoch,
    /// A frame says that it is of an epoch to come.
    NewEpoch,
}

impl Fault {
    pub(super) const ALL: [Self; 17] = [
        Self::KillPlanner,
        Self::StopPlannerBriefly,
        Self::StopPlannerForLong,
        Self::KillInterpolator,
        Self::KillServo,
        Self::KillClient,
        Self::AnswerLate,
        Self::PausePipe,
        Self::CorruptFrame,
        Self::RepeatFrame,
        Self::SkipFrame,
        Self::SpoilNumber,
        Self::MoveFrame,
        Self::MoveFrameFar,
        Self::ChangeVelocity,
        Self::OldEpoch,
        Self::NewEpoch,
    ];

    /// Whether the motion may, or must, come to the end of the program all the same.
    pub(super) const fn may_complete(self) -> bool {
        matches!(
            self,
            Self::StopPlannerBriefly
                | Self::KillServo
                | Self::KillClient
                | Self::AnswerLate
                | Self::PausePipe
                | Self::RepeatFrame
                // Not every byte matters to the motion.
                | Self::CorruptFrame
        )
    }

    /// Whether `cause` is a right one to stop for.
    pub(super) const fn may_cause(self, cause: FaultCause) -> bool {
        use FrameRefusal::{Acceleration, Discontinuous, Jerk, NotFinite, SoftLimit, Velocity};
        let FaultCause::Frame(refusal) = cause else {
            return match cause {
                FaultCause::PlannerLost => {
                    matches!(self, Self::KillPlanner | Self::StopPlannerForLong)
                }
                FaultCause::AuxTimeout => matches!(self, Self::AnswerLate),
                _ => false,
            };
        };
        match self {
            Self::CorruptFrame => true,
            // A frame that is not counted in leaves a gap before the next.
            Self::SkipFrame | Self::NewEpoch => matches!(refusal, FrameRefusal::Sequence),
            // There is none before the first.
            Self::OldEpoch => matches!(refusal, FrameRefusal::Sequence | FrameRefusal::Malformed),
            Self::SpoilNumber => matches!(refusal, NotFinite),
            Self::MoveFrame => matches!(refusal, Velocity | Acceleration | Jerk),
            Self::MoveFrameFar => matches!(refusal, SoftLimit),
            Self::ChangeVelocity => matches!(refusal, Discontinuous),
            _ => false,
        }
    }
}

/// What the machine is doing when it goes wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Situation {
    /// It moves at the programmed feed.
    FullSpeed,
    /// It passes a corner.
    Corner,
    /// The operator has just held it.
    Hold,
    /// The operator has just changed the feed override.
    Override,
    /// The operator has just asked for a stop at the end of the block.
    BlockEnd,
    /// The operator has just switched to single block.
    SingleBlock,
    /// The operator has just turned the motion round.
    WayBack,
}

impl Situation {
    pub(super) const ALL: [Self; 7] = [
        Self::FullSpeed,
        Self::Corner,
        Self::Hold,
        Self::Override,
        Self::BlockEnd,
        Self::SingleBlock,
        Self::WayBack,
    ];
}

/// One case, with everything about it that chance decides.
#[derive(Debug, Clone, Copy)]
pub(super) struct Case {
    pub(super) fault: Fault,
    pub(super) situation: Situation,
    pub(super) chance: Chance,
}

/// Every cell of the matrix in turn, in an order that `seed` decides, as often as it takes.
pub(super) fn cases(count: usize, seed: u64) -> Vec<Case> {
    let mut chance = Chance(seed);
    let mut cases = Vec::with_capacity(count);
    // Every fault once before any comes again, and of each every situation.
    let (mut faults, mut situations) = (Vec::new(), Fault::ALL.map(|_| Vec::new()));
    while cases.len() < count {
        if faults.is_empty() {
            faults.extend(0..Fault::ALL.len());
        }
        let fault = faults.swap_remove(chance.below(faults.len()));
        let left: &mut Vec<_> = &mut situations[fault];
        if left.is_empty() {
            left.extend(Situation::ALL);
        }
        let situation = left.swap_remove(chance.below(left.len()));
        let fault = Fault::ALL[fault];
        cases.push(Case {
            fault,
            situation,
            chance: Chance(chance.next()),
        });
    }
    cases
}

/// Numbers that look random and depend on the seed only (SplitMix64: Steele, Lea, Flood 2014).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Chance(u64);

impl Chance {
    pub(crate) const fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub(super) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `end` > 0.
    pub(crate) fn below(&mut self, end: usize) -> usize {
        usize::try_from(self.next() % end as u64).unwrap()
    }

    /// A number from `low` to `high`.
    pub(super) fn between(&mut self, low: u64, high: u64) -> u64 {
        low + self.next() % (high - low + 1)
    }

    pub(crate) fn millis(&mut self, low: u64, high: u64) -> std::time::Duration {
        std::time::Duration::from_millis(self.between(low, high))
    }
}
