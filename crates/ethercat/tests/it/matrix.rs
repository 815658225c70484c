//! The matrix of what goes wrong with the bus and with drives, at moments that the number of the
//! case decides.
//!
//! `GLIDEPATH_BUS_FAULTS` cases are run, `GLIDEPATH_BUS_FAULTS_SEED` chooses other moments.

use crate::machine::{Case, Hands, Outcome, Setup, run, run_on};
use crate::wire::Fate;
use glidepath_emulator::{InjectedFault, Segment, SyncRecord};
use glidepath_ethercat::{BusFault, DriveSettings, Event};
use glidepath_link::{Command, FaultCause, MachineState};
use std::collections::BTreeMap;

const PROGRAM: &str = "G21 G91 G64 P0.02 G1 X30 Y12 F9000\nX-24 Y16\nX12 Y-30 Z8\nM2\n";
const AGAIN: &str = "G21 G91 G1 X-5 Y5 F6000\nM2\n";

/// What goes wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    FrameLate,
    FrameReordered,
    FrameLost,
    AnswerLost,
    CounterShort,
    Drift,
    Emergency,
    BurstLost,
    CablePulled,
    DriveFault,
    LeftOp,
    NoVoltage,
    Stuck,
    Reboot,
    RefusedEnable,
    BridgeKilled,
    InterpolatorKilled,
}

const KINDS: [Kind; 17] = [
    Kind::FrameLate,
    Kind::FrameReordered,
    Kind::FrameLost,
    Kind::AnswerLost,
    Kind::CounterShort,
    Kind::Drift,
    Kind::Emergency,
    Kind::BurstLost,
    Kind::CablePulled,
    Kind::DriveFault,
    Kind::LeftOp,
    Kind::NoVoltage,
    Kind::Stuck,
    Kind::Reboot,
    Kind::RefusedEnable,
    Kind::BridgeKilled,
    Kind::InterpolatorKilled,
];

/// What is to follow from it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Expected {
    /// The program goes on to its end, and nobody notices.
    GoesOn,
    /// Rest, a fault of one of these causes, and no power.
    Fault(&'static [FaultCause]),
    /// Power does not come.
    StaysOff,
    /// Rest, with power: nobody leads any more.
    Rest,
    /// Rest, without power, and nobody is there to say so.
    Silence,
}

impl Kind {
    const fn expected(self) -> Expected {
        use FaultCause::{Drive, EnableLost, FeedbackLost, FollowingError};
        match self {
            Self::FrameLate
            | Self::FrameReordered
            | Self::FrameLost
            | Self::AnswerLost
            | Self::CounterShort
            | Self::Drift
            | Self::Emergency => Expected::GoesOn,
            // Whoever sees it first.
            Self::BurstLost | Self::CablePulled => {
                Expected::Fault(&[FeedbackLost, EnableLost, Drive, FollowingError])
            }
            Self::DriveFault | Self::LeftOp | Self::Reboot => Expected::Fault(&[Drive]),
            Self::NoVoltage => Expected::Fault(&[EnableLost]),
            Self::Stuck => Expected::Fault(&[FollowingError, Drive]),
            Self::RefusedEnable => Expected::StaysOff,
            Self::BridgeKilled => Expected::Silence,
            Self::InterpolatorKilled => Expected::Rest,
        }
    }
}

/// Numbers from a number (splitmix64).
struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % sides
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    /// Power, and the program.
    Before,
    /// It happened at that tick.
    After(u64),
    /// The operator mends it.
    Recovery,
    /// A second program runs.
    Again,
}

/// Ticks in which nobody does anything after something went wrong: 1.6 s.
const HANDS_OFF: u64 = 400;
const MOST_TICKS: u64 = 8000;

#[derive(Debug)]
struct Trial {
    kind: Kind,
    joint: usize,
    /// Ticks into the motion.
    moment: u64,
    /// Frames, where it is about frames.
    frames: u64,
    part: Part,
    asked: u64,
    began: Option<u64>,
    left_frames: u64,
    has_power: bool,
}

impl Trial {
    fn new(kind: Kind, dice: &mut Dice) -> Self {
        let frames = match kind {
            Kind::BurstLost => 3 + dice.roll(30),
            Kind::CablePulled => u64::MAX,
            _ => 1 + dice.roll(2),
        };
        Self {
            kind,
            joint: dice.roll(3) as usize,
            moment: 5 + dice.roll(160),
            frames,
            part: Part::Before,
            asked: 0,
            began: None,
            left_frames: 0,
            has_power: false,
        }
    }

    fn happen(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        let mut upset = |upset| segment.inject(self.joint, upset, hands.now_ns);
        match self.kind {
            Kind::Emergency => upset(InjectedFault::Emergency(0x8611)),
            Kind::DriveFault => upset(InjectedFault::Fault(0x3210)),
            Kind::LeftOp => upset(InjectedFault::Drop(0x1a)),
            Kind::NoVoltage => upset(InjectedFault::NoVoltage(true)),
            Kind::Stuck => upset(InjectedFault::Stuck(true)),
            Kind::Reboot => upset(InjectedFault::Reboot),
            Kind::BridgeKilled => hands.wants.killed = true,
            Kind::InterpolatorKilled => hands.wants.interpolator = Some(false),
            Kind::Drift | Kind::RefusedEnable => {}
            _ => self.left_frames = self.frames,
        }
    }

    fn mend(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        self.left_frames = 0;
        for mended in [
            InjectedFault::NoVoltage(false),
            InjectedFault::Stuck(false),
            InjectedFault::RefusesPower(false),
        ] {
            segment.inject(self.joint, mended, hands.now_ns);
        }
        if self.kind == Kind::InterpolatorKilled {
            hands.wants.interpolator = Some(true);
        }
    }

    /// What was to follow has followed, and nothing else.
    fn judge(&self, hands: &Hands<'_>) {
        let (status, seen) = (hands.status.unwrap(), (hands.state(), hands.events));
        let fault = status.fault().unwrap();
        match self.kind.expected() {
            Expected::Fault(causes) => {
                assert_eq!(
                    hands.state(),
                    Some(MachineState::Faulted),
                    "{self:?} {seen:?}"
                );
                assert!(
                    fault.is_some_and(|fault| causes.contains(&fault)),
                    "{fault:?} {self:?} {seen:?}"
                );
                assert!(!self.has_power, "{self:?} {seen:?}");
            }
            Expected::StaysOff => {
                assert_eq!(
                    (hands.state(), fault),
                    (Some(MachineState::Off), None),
                    "{seen:?}"
                );
                assert!(!self.has_power, "{self:?} {seen:?}");
                let is_told = |event: &Event| matches!(event, Event::Trouble(BusFault::NotEnabled(joint, _)) if *joint == self.joint);
                assert!(hands.events.iter().any(is_told), "{self:?} {seen:?}");
            }
            Expected::Rest => assert!(
                self.has_power
                    && hands
                        .events
                        .iter()
                        .any(|event| matches!(event, Event::Silence(_))),
                "{seen:?}"
            ),
            Expected::GoesOn | Expected::Silence => {}
        }
    }

    fn operate(&mut self, hands: &mut Hands<'_>) {
        if hands.tick.saturating_sub(self.asked) < 30 {
            return;
        }
        let command = match hands.state() {
            Some(MachineState::Faulted) => Command::Reset,
            Some(MachineState::Off) => Command::Enable,
            _ => return,
        };
        self.asked = hands.tick;
        hands.wants.command = Some(command);
    }
}

impl Case for Trial {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        let said = (
            hands
                .status
                .map(|s| (s.fault_joint, s.joint_actual, s.following_error)),
            hands.last.map(|s| s.joint_position),
            hands.state(),
            hands.status.map(|status| status.fault()),
            hands.events,
        );
        assert!(
            hands.tick < MOST_TICKS,
            "{self:?} comes to no end: {said:?}"
        );
        // What was said long ago says nothing.
        let newest = hands
            .feedback
            .filter(|f| f.sample_ns + 100_000_000 > hands.now_ns);
        self.has_power = newest.is_some_and(|feedback| feedback.enabled != 0);
        let is_idle = hands.state() == Some(MachineState::Idle);
        match self.part {
            Part::Before => {
                if self.kind == Kind::RefusedEnable && hands.tick == 1 {
                    segment.inject(self.joint, InjectedFault::RefusesPower(true), hands.now_ns);
                }
                self.operate(hands);
                if self.kind == Kind::RefusedEnable && hands.tick > 2000 {
                    self.part = Part::After(hands.tick);
                }
                if is_idle && self.began.is_none() {
                    self.began = Some(hands.tick);
                    hands.wants.program = Some(PROGRAM);
                }
                if self
                    .began
                    .is_some_and(|began| hands.tick > began + 5 + self.moment)
                {
                    self.happen(hands, segment);
                    self.part = Part::After(hands.tick);
                }
            }
            Part::After(_) if self.kind.expected() == Expected::GoesOn => {
                if is_idle {
                    assert!(hands.status.unwrap().fault().unwrap().is_none());
                    hands.wants.end = true;
                }
            }
            Part::After(at) => {
                if hands.tick > at + HANDS_OFF {
                    self.judge(hands);
                    self.mend(hands, segment);
                    self.part = Part::Recovery;
                    self.asked = hands.tick;
                }
            }
            Part::Recovery => {
                self.operate(hands);
                if is_idle {
                    hands.wants.program = Some(AGAIN);
                    self.part = Part::Again;
                    self.asked = hands.tick;
                }
            }
            Part::Again => {
                if is_idle && hands.tick > self.asked + 50 {
                    hands.wants.end = true;
                }
            }
        }
    }

    fn fate(&mut self, now_ns: u64) -> Fate {
        if self.left_frames == 0 {
            return Fate::Whole;
        }
        self.left_frames -= 1;
        match self.kind {
            Kind::FrameLate => Fate::Late(1_700_000 + now_ns % 1_000_000),
            Kind::FrameReordered => Fate::Late(4_500_000),
            Kind::AnswerLost => Fate::LostOnTheWayBack,
            Kind::CounterShort => Fate::Short,
            _ => Fate::LostOnTheWay,
        }
    }
}

/// No target is further from the one before than the guard allows for the time between.
fn assert_guarded(drive: &DriveSettings, records: &[SyncRecord], case: &str) {
    let mut held_ns = 0;
    for pair in records.windows(2) {
        let passed_ns = pair[1].at_ns.saturating_sub(pair[0].at_ns);
        // A frame that was lost leaves the target where it was, and its number, too.
        held_ns += passed_ns;
        if pair[0].follows && pair[1].follows {
            let step = f64::from(pair[1].target) - f64::from(pair[0].target);
            let most = drive.guard_counts(held_ns);
            assert!(
                step.abs() <= most,
                "{case}: J{} steps by {step} counts, {most}",
                drive.joint
            );
        }
        if pair[1].index != pair[0].index {
            held_ns = 0;
        }
    }
}

/// Nobody moves and nobody has power in the end.
fn assert_rests(records: &[SyncRecord], case: &str) {
    let tail = &records[records.len() - 10..];
    let last = tail[9];
    let stands = |record: &SyncRecord| record.actual.abs_diff(last.actual) <= 2;
    assert!(
        !last.follows && tail.iter().all(stands),
        "{case}: {tail:#?}"
    );
}

fn setup(kind: Kind, dice: &mut Dice) -> Setup {
    let period_ns = [1_000_000, 2_000_000, 4_000_000][dice.roll(3) as usize];
    let mut setup = Setup::absolute(period_ns);
    setup.phase_ns = dice.roll(4_000_000);
    if kind == Kind::Drift {
        for drive in &mut setup.emulated {
            drive.drift_ppm = dice.roll(201) as f64 - 100.0;
        }
    }
    setup
}

fn assert_outcome(setup: &Setup, outcome: &Outcome, case: &str) {
    for (drive, records) in setup.drives.iter().zip(&outcome.records) {
        assert_guarded(drive, records, case);
        assert_rests(records, case);
    }
}

/// The bridge is started again beside drives that nobody has led meanwhile.
fn assert_restarts(setup: &Setup, outcome: &Outcome, case: &str) {
    let (segment, end_ns) = (outcome.left.0.clone(), outcome.left.1 + 2_000_000_000);
    let mut again = Trial::new(Kind::Drift, &mut Dice(1));
    let outcome = run_on(setup, &mut again, segment, end_ns);
    assert_outcome(setup, &outcome, case);
    // Power came when it was asked for, and not with the start.
    let first = outcome.setpoints.iter().find(|s| s.enable != 0).unwrap();
    let early = |r: &&SyncRecord| r.follows && r.at_ns < first.scheduled_ns && r.at_ns > end_ns;
    assert!(
        outcome.records.iter().flatten().find(early).is_none(),
        "{case}"
    );
}

fn number(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().unwrap())
}

#[test]
fn whatever_goes_wrong_with_the_bus() {
    let cases = number("GLIDEPATH_BUS_FAULTS", 17);
    let seed = number("GLIDEPATH_BUS_FAULTS_SEED", 0);
    let mut table: BTreeMap<Kind, (u32, u64, u64)> = BTreeMap::new();
    for case in 0..cases {
        let kind = KINDS[case as usize % KINDS.len()];
        let mut dice = Dice(seed.wrapping_mul(1_000_003) + case);
        let setup = setup(kind, &mut dice);
        let mut trial = Trial::new(kind, &mut dice);
        let name = format!(
            "case {case}, {kind:?}, bus {} ms",
            setup.bus.period_ns / 1_000_000
        );
        let outcome = run(&setup, &mut trial);
        assert_outcome(&setup, &outcome, &name);
        if kind == Kind::BridgeKilled {
            assert_restarts(&setup, &outcome, &name);
        }
        let row = table.entry(kind).or_default();
        row.0 += 1;
        row.1 += outcome.counts.lost + outcome.counts.short;
        row.2 += outcome.counts.restarts;
    }
    for (kind, (cases, frames, restarts)) in table {
        let (kind, expected) = (format!("{kind:?}"), format!("{:?}", kind.expected()));
        eprintln!(
            "{kind:20} {cases:4} cases  {frames:6} frames lost or short  {restarts:4} restarts  {expected}"
        );
    }
}
