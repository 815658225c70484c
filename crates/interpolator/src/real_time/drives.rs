//! The power of the drives as the real-time thread sees it, and whose position counts.
//!
//! ```text
//!          Enable            all have power, at rest for 100 ms: hand-over
//!   Off ───────────► Enabling ───────────────────────────────────────────► On ◄─► homing
//!    ▲  ◄─────────────  │ lost, or too slow                                │
//!    └──────────────────┴── Disable, a drive's fault: at rest              │
//!    └── all power lost, feedback lost for long, far from the demand ──────┘ at once
//! ```
//!
//! While off, setpoints repeat what the drives report. With the hand-over that position is frozen,
//! and setpoints continue it.

use crate::real_time::output::Output;
use crate::real_time::stop_requests::StopRequests;
use crate::shared::config::Config;
use crate::shared::fault::Fault;
use crate::shared::message::observation::Observation;
use glidepath_link::{Command, FaultCause, MachineState, Power};
use heapless::spsc::Consumer;

/// All drives are to have been at rest with power for so long.
const SETTLED_NS: u64 = 100_000_000;
/// How long drives may take to have power.
const ENABLING_NS: u64 = 10_000_000_000;
/// How long a drive may look for its home.
const HOMING_NS: u64 = 300_000_000_000;
/// How long a drive may take to begin, or to say that it found its home after it ended.
const ANSWER_NS: u64 = 2_000_000_000;

/// The consequence of what the drives say.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Consequence {
    /// The motion is to stop on the path.
    pub(crate) fault: Option<Fault>,
    /// Power is gone: the setpoints repeat what the drives report from now on.
    pub(crate) is_cut: bool,
    /// The position is taken over from the drives.
    pub(crate) is_handed_over: bool,
}

impl Consequence {
    fn fault(cause: FaultCause, joints: u32, drive_fault: u32) -> Self {
        Self {
            fault: Some(Fault {
                joint: (joints != 0).then(|| joints.trailing_zeros() as usize),
                drive_fault,
                ..Fault::new(cause, 0, 0)
            }),
            ..Self::default()
        }
    }

    /// What the drives said last is older than it may be.
    fn outdated(age_ns: u64, allowed_ns: u64) -> Self {
        #[allow(clippy::cast_precision_loss, reason = "for people")]
        let seconds = |ns: u64| ns as f64 * 1e-9;
        Self {
            fault: Some(Fault {
                value: seconds(age_ns),
                limit: seconds(allowed_ns),
                ..Fault::new(FaultCause::FeedbackLost, 0, 0)
            }),
            ..Self::default()
        }
    }
}

/// A search for home by the drives.
#[derive(Debug, Clone, Copy, Default)]
struct Homing {
    /// The joints that look for it, one bit each; none if nobody does.
    joints: u32,
    /// Those that have begun.
    begun: u32,
    ticks: u64,
    /// Ticks since anything was expected of the drives.
    silent_ticks: u64,
}

/// The drives, as far as the real-time thread has to know.
#[derive(Debug)]
pub(crate) struct Drives {
    /// Joints of the machine, one bit each.
    all: u32,
    power: Power,
    /// Power goes when the motion has come to rest.
    goes_off: bool,
    ticks: u64,
    settled_ticks: u64,
    homing: Homing,
    seen: Observation,
    /// Ticks since that was sent.
    seen_ticks: u64,
    /// The last hand-over that was asked for and done.
    handover: u64,
    limits: u32,
    period_ns: u64,
    stale_ns: u64,
    off_ns: u64,
}

impl Drives {
    pub(crate) fn new(config: &Config) -> Self {
        let ns = |time: core::time::Duration| u64::try_from(time.as_nanos()).unwrap_or(u64::MAX);
        Self {
            all: config.joints(),
            power: config.feedback.map_or(Power::Simulated, |_| Power::Off),
            goes_off: false,
            ticks: 0,
            settled_ticks: 0,
            homing: Homing::default(),
            seen: Observation::none(),
            seen_ticks: 0,
            handover: 0,
            limits: 0,
            period_ns: config.period_ns,
            stale_ns: config.feedback.map_or(u64::MAX, |f| ns(f.stale_after)),
            off_ns: config.feedback.map_or(u64::MAX, |f| ns(f.off_after)),
        }
    }

    pub(crate) const fn power(&self) -> Power {
        self.power
    }

    /// No feedback is configured: the drives are taken to do what they are told.
    pub(crate) const fn are_simulated(&self) -> bool {
        matches!(self.power, Power::Simulated)
    }

    pub(crate) const fn period_ns(&self) -> u64 {
        self.period_ns
    }

    /// What was last seen of the drives.
    pub(crate) const fn seen(&self) -> &Observation {
        &self.seen
    }

    /// The joints whose positions are those that their drives report.
    pub(crate) const fn following(&self) -> u32 {
        match self.power {
            Power::Off | Power::Enabling => self.all,
            Power::Simulated | Power::On => self.homing.joints,
        }
    }

    /// The joints that are to have power.
    const fn enable(&self) -> u32 {
        match self.power {
            Power::Off => 0,
            Power::Simulated | Power::Enabling | Power::On => self.all,
        }
    }

    /// Whether they have power and follow, so that joints may be moved each for itself.
    pub(crate) const fn are_on(&self) -> bool {
        matches!(self.power, Power::On) && self.homing.joints == 0 && !self.goes_off
    }

    /// Whether a program may begin.
    pub(crate) const fn are_ready(&self) -> bool {
        match self.power {
            Power::Simulated => true,
            Power::On => self.homing.joints == 0 && self.seen.homed == self.all && !self.goes_off,
            Power::Off | Power::Enabling => false,
        }
    }

    /// The joints that know where they are, one bit each.
    pub(crate) const fn homed(&self) -> u32 {
        if self.are_simulated() {
            self.all
        } else {
            self.seen.homed
        }
    }

    /// The state of the machine while no epoch is open and no fault latched.
    pub(crate) const fn state_at_rest(&self) -> MachineState {
        match self.power {
            Power::Off | Power::Enabling => MachineState::Off,
            Power::On if self.homing.joints != 0 => MachineState::Homing,
            Power::On if self.seen.homed != self.all => MachineState::NotHomed,
            Power::On | Power::Simulated => MachineState::Idle,
        }
    }

    /// Carries out a command about drives.
    pub(crate) fn carry_out(&mut self, command: Command, is_open: bool) {
        match command {
            Command::Enable if self.power == Power::Off => {
                self.power = Power::Enabling;
                (self.ticks, self.settled_ticks) = (0, 0);
            }
            Command::Abort => {
                self.abort_homing();
            }
            Command::Disable if self.power != Power::Simulated => self.goes_off = true,
            Command::Home(joints) if self.power == Power::On && !is_open => {
                self.homing = Homing {
                    joints,
                    ..Homing::default()
                };
            }
            Command::Enable
            | Command::Disable
            | Command::Home(_)
            | Command::Ping
            | Command::Hold
            | Command::Resume
            | Command::FeedOverride(_)
            | Command::RapidOverride(_)
            | Command::StopAtEndOfBlock
            | Command::SingleBlock(_)
            | Command::Reset
            | Command::Step
            | Command::SetPosition { .. }
            | Command::Unhome(_)
            | Command::Return
            | Command::Acknowledge { .. }
            | Command::JogOverride(_)
            | Command::SpindleOverride(_)
            | Command::Reverse
            | Command::Forward
            | Command::Job { .. }
            | Command::Tell => {}
        }
    }

    /// Takes the power: the motion is over.
    pub(crate) fn cut(&mut self) {
        self.power = Power::Off;
        self.goes_off = false;
        self.homing = Homing::default();
    }

    /// The time since the oldest sample.
    fn age_ns(&self) -> u64 {
        let since_ns = self.seen_ticks.saturating_mul(self.period_ns);
        self.seen.age_ns.saturating_add(since_ns)
    }

    const fn ticks_in(&self, time_ns: u64) -> u64 {
        time_ns / self.period_ns
    }

    /// One tick of a machine whose drives answer: takes what the ports thread sends, and sees to
    /// what follows. Returns whether power is gone, so that an open epoch is over.
    #[inline(never)]
    pub(crate) fn attend(
        &mut self,
        observations: &mut Consumer<'_, Observation>,
        output: &mut Output,
        requests: &mut StopRequests,
        is_open: bool,
        (line, sequence): (u32, u64),
    ) -> bool {
        while let Some(observation) = observations.dequeue() {
            self.seen = observation;
            self.seen_ticks = 0;
            requests.adapt(observation.adaptive_r);
        }
        let rests = !is_open && output.published().is_at_rest() && output.joints_rest();
        let consequence = self.watch(rests, requests.fault().is_some());
        if let Some(fault) = consequence.fault {
            requests.fail(Fault {
                line,
                sequence,
                ..fault
            });
        }
        if consequence.is_cut {
            output.begin_reference();
        }
        if consequence.is_handed_over {
            output.hand_over(&self.seen);
        }
        output.command_drives(self.enable(), self.homing.joints);
        consequence.is_cut
    }

    /// What follows from what the drives say. `rests` if nothing moves and no epoch is open,
    /// `has_fault` if one is latched already.
    fn watch(&mut self, rests: bool, has_fault: bool) -> Consequence {
        self.seen_ticks += 1;
        let consequence = match self.power {
            Power::Simulated => Consequence::default(),
            Power::Off => {
                self.goes_off = false;
                self.take_over_if_asked(true)
            }
            Power::Enabling => self.watch_enabling(),
            Power::On => self.watch_on(rests, has_fault),
        };
        if consequence.is_cut {
            self.cut();
        }
        consequence
    }

    fn watch_enabling(&mut self) -> Consequence {
        self.ticks += 1;
        let seen = &self.seen;
        let fails = self.age_ns() > self.stale_ns || seen.faults != 0 || !seen.is_known;
        if fails || self.goes_off || self.ticks > self.ticks_in(ENABLING_NS) {
            return Consequence {
                is_cut: true,
                ..Consequence::default()
            };
        }
        self.settled_ticks = if seen.enabled == self.all && seen.rests {
            self.settled_ticks + 1
        } else {
            0
        };
        if self.settled_ticks <= self.ticks_in(SETTLED_NS) {
            return Consequence::default();
        }
        self.power = Power::On;
        self.limits = seen.limits;
        self.hand_over()
    }

    fn watch_on(&mut self, rests: bool, has_fault: bool) -> Consequence {
        let seen = self.seen;
        let lost = self.all & !seen.enabled;
        let cut = |mut consequence: Consequence| {
            consequence.is_cut = true;
            consequence
        };
        if self.age_ns() > self.off_ns {
            return cut(Consequence::outdated(self.age_ns(), self.off_ns));
        }
        // Nobody follows any more, so there is nothing to lead.
        if lost == self.all || (lost != 0 && rests) {
            return cut(Consequence::fault(FaultCause::EnableLost, lost, 0));
        }
        if self.goes_off && rests {
            return cut(Consequence::default());
        }
        let hit = seen.limits & !self.limits & !self.homing.joints;
        self.limits = seen.limits;
        if has_fault {
            // The first cause stays; what takes the power still does.
            self.goes_off |= (lost | seen.faults) != 0;
            self.abort_homing();
            return self.take_over_if_asked(rests);
        }
        if seen.faults != 0 {
            self.goes_off = true;
            return Consequence::fault(FaultCause::Drive, seen.faults, seen.fault_code);
        }
        if lost != 0 {
            self.goes_off = true;
            return Consequence::fault(FaultCause::EnableLost, lost, 0);
        }
        if self.age_ns() > self.stale_ns {
            return Consequence::outdated(self.age_ns(), self.stale_ns);
        }
        if hit != 0 {
            return Consequence::fault(FaultCause::LimitSwitch, hit, 0);
        }
        if self.homing.joints != 0 {
            return self.watch_homing();
        }
        self.take_over_if_asked(rests)
    }

    /// Follows the drives on their way home.
    fn watch_homing(&mut self) -> Consequence {
        let (seen, joints) = (self.seen, self.homing.joints);
        self.homing.ticks += 1;
        self.homing.begun |= (seen.homing | !seen.homed) & joints;
        let has_begun = self.homing.begun == joints;
        let goes_on = seen.homing & joints != 0;
        let is_done = has_begun && !goes_on && seen.homed & joints == joints;
        if is_done && seen.rests {
            self.homing = Homing::default();
            return self.hand_over();
        }
        self.homing.silent_ticks = if goes_on {
            0
        } else {
            self.homing.silent_ticks + 1
        };
        let is_late = self.homing.silent_ticks > self.ticks_in(ANSWER_NS)
            || self.homing.ticks > self.ticks_in(HOMING_NS);
        if is_late {
            let missing = joints & !(seen.homed & !seen.homing);
            let missing = if missing == 0 { joints } else { missing };
            return self.end_homing(missing);
        }
        Consequence::default()
    }

    fn end_homing(&mut self, missing: u32) -> Consequence {
        self.homing = Homing::default();
        Consequence {
            is_handed_over: self.seen.is_known,
            ..Consequence::fault(FaultCause::Homing, missing, 0)
        }
    }

    /// Nobody looks for home any more.
    fn abort_homing(&mut self) {
        if self.homing.joints != 0 {
            self.homing = Homing::default();
            // Where the joints stop is not where they were when they set out.
            self.handover = u64::MAX;
        }
    }

    fn hand_over(&mut self) -> Consequence {
        self.handover = self.seen.handover;
        Consequence {
            is_handed_over: self.seen.is_known,
            ..Consequence::default()
        }
    }

    fn take_over_if_asked(&mut self, may: bool) -> Consequence {
        if may && self.seen.is_known && self.seen.handover != self.handover {
            self.hand_over()
        } else {
            Consequence::default()
        }
    }
}
