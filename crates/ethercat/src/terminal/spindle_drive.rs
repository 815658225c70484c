//! A spindle on a drive in velocity mode, cycle by cycle.
//!
//! ```text
//!        is to turn        has power            is to stand, and stands
//!  Off ─────────────► Enabling ─────► Turning ──────────────────────────► Off
//!   ▲                    │ too slow    │  ▲ │ its power is gone
//!   │                    │             │  │ └► Failed
//!   │                    │             ▼  │ at rest, and back in its mode of velocity
//!   │                    │          Orienting: stands, is to stand at an angle
//!   └─ Resetting ◄── Failed ◄── from anywhere, when the drive says so
//! ```
//!
//! The speed is led along a ramp, in every mode, and power goes when the spindle stands: a drive that
//! loses its power in motion lets the tool run out. At an angle it is held with power.

use super::orienting::{Angle, Orienting};
use super::spindle_settings::SpindleSettings;
use super::spindle_wiring::{SpindleInputs, SpindleOutputs, WiredSpindle};
use crate::event::Event;
use crate::state;
use glidepath_link::{DriveState, Feedback, SpindleFlags};

const DISABLE_VOLTAGE: u16 = 0x00;
const SHUTDOWN: u16 = 0x06;
const SWITCH_ON: u16 = 0x07;
const ENABLE_OPERATION: u16 = 0x0f;
const RESET_FAULT: u16 = 0x80;
/// How long the drive may take to have power, ns.
const PATIENCE_NS: u64 = 5_000_000_000;
/// How long the drive may take to reset a fault, ns.
const RESET_NS: u64 = 1_000_000_000;
/// How long the speed has to be near before it counts, ns.
const SETTLED_NS: u64 = 20_000_000;
/// A pause between two cycles counts as so long at most, ns: the speed does not step.
const LONGEST_NS: u64 = 20_000_000;
/// The time constant of the load that is told, ns: torque trembles with the teeth of a tool.
const LOAD_NS: f64 = 1e8;
/// "Generic error" by CiA 301, of a drive that does not tell its own.
const ANY_FAULT: u16 = 0x1000;
/// Cyclic synchronous position, as 0x6060 has it.
const CYCLIC_POSITION: i8 = 8;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Phase {
    Off,
    /// It is on its way to power, since then, ns.
    Enabling(u64),
    Turning,
    /// It is led in position, to an angle and at it, or to rest from there; `None` before its drive is in that mode.
    Orienting(Option<Orienting>),
    /// It has a fault, or did not get power; to be reset by the operator.
    Failed,
    /// That was asked for, since then, ns.
    Resetting(u64),
}

/// One cycle of a spindle.
#[derive(Debug, Clone, Copy)]
pub(super) struct SpindleCycle {
    pub(super) now_ns: u64,
    /// The speed that is commanded, rev/min, negative counterclockwise; 0 to stand.
    pub(super) wanted_rpm: f64,
    /// The speed as the program gave it, without the operator's override, rev/min.
    pub(super) programmed_rpm: f64,
    /// The angle at which it is to stand, if it is to stand at one.
    pub(super) angle: Option<Angle>,
    /// Whether its device is there.
    pub(super) is_present: bool,
    /// Whether what it told is of this cycle: not where another device did not take part.
    pub(super) is_heard: bool,
    /// The operator has reset what there was.
    pub(super) resets: bool,
    /// Another speed is commanded already, and its time has not come.
    pub(super) is_due: bool,
}

/// A spindle at work.
#[derive(Debug)]
pub(super) struct SpindleDrive {
    wired: WiredSpindle,
    phase: Phase,
    /// The speed that it is told, rev/min.
    told_rpm: f64,
    actual_rpm: f64,
    /// Its load, smoothed, as a part of its rated torque.
    load_r: f64,
    /// Since when its speed is near what is commanded, ns.
    near_ns: Option<u64>,
    last_ns: u64,
    wanted_rpm: f64,
    /// The angle at which it is to stand; `None` as well where it is turned to none.
    angle: Option<Angle>,
    said: SpindleInputs,
    is_present: bool,
    is_due: bool,
    /// Its last fault, 0 if it did not get power.
    failed: Option<u16>,
}

impl SpindleDrive {
    pub(super) const fn new(wired: WiredSpindle) -> Self {
        Self {
            wired,
            phase: Phase::Off,
            told_rpm: 0.0,
            actual_rpm: 0.0,
            load_r: 0.0,
            near_ns: None,
            last_ns: 0,
            wanted_rpm: 0.0,
            angle: None,
            said: SpindleInputs::REST,
            is_present: true,
            is_due: false,
            failed: None,
        }
    }

    /// Which of the devices that are no drives it is.
    pub(super) const fn nth(&self) -> usize {
        self.wired.nth
    }

    const fn settings(&self) -> &SpindleSettings {
        &self.wired.settings
    }

    /// The number of its fault, 0 if it did not get power; `None` without.
    pub(super) const fn failed(&self) -> Option<u16> {
        self.failed
    }

    /// Whether it has no power, or nobody can take it.
    pub(super) const fn is_off(&self) -> bool {
        !self.is_present || matches!(self.phase, Phase::Off | Phase::Failed)
    }

    /// A cycle: what it tells, and what it is told.
    pub(super) fn cycle(
        &mut self,
        cycle: SpindleCycle,
        inputs: &[u8],
        image: &mut [u8],
        tell: &mut dyn FnMut(Event),
    ) {
        let said = self.wired.take(inputs);
        let since_ns = cycle.now_ns.saturating_sub(self.last_ns).min(LONGEST_NS);
        (self.last_ns, self.is_present, self.is_due) =
            (cycle.now_ns, cycle.is_present, cycle.is_due);
        let most = self.settings().max_rpm;
        self.wanted_rpm = cycle.wanted_rpm.clamp(-most, most);
        let was = self.angle;
        self.angle = cycle
            .angle
            .filter(|_| self.settings().orientation.is_some());
        if self.angle != was {
            self.near_ns = None;
        }
        self.said = said;
        // Unheard it is taken to follow: the bus is not kept from coming up again by what is not known.
        self.actual_rpm = if cycle.is_heard {
            self.settings().rpm(said.actual)
        } else {
            self.told_rpm
        };
        self.smooth_load(said.torque, since_ns);
        let state = state::of(said.status);
        self.fail_by(state, said, tell);
        let control = self.step(&cycle, state, since_ns, tell);
        // What a program asks for beyond its highest speed is never reached; an operator has that at most.
        let is_reachable = cycle.programmed_rpm <= most;
        self.judge_speed(cycle.now_ns, is_reachable);
        let outputs = self.outputs(control);
        self.wired.put(image, &outputs);
    }

    /// Takes the torque of a cycle into the load.
    #[allow(clippy::cast_precision_loss, reason = "some milliseconds")]
    fn smooth_load(&mut self, torque: Option<i16>, since_ns: u64) {
        let now_r = torque.map_or(0.0, |torque| f64::from(torque).abs() * 1e-3);
        let share = 1.0 - (-(since_ns as f64) / LOAD_NS).exp();
        self.load_r += share * (now_r - self.load_r);
    }

    /// What it is told. Where it is not led in position it is told where it is, so that it stays there when
    /// its mode becomes that.
    fn outputs(&self, control: u16) -> SpindleOutputs {
        let (mode, place) = match self.phase {
            Phase::Orienting(Some(way)) => (CYCLIC_POSITION, way.target()),
            Phase::Orienting(None) => (CYCLIC_POSITION, self.said.place),
            _ => (self.settings().mode.code(), self.said.place),
        };
        SpindleOutputs {
            control,
            mode,
            velocity: self.settings().counts(self.told_rpm),
            place,
        }
    }

    /// Its drive reports a fault.
    fn fail_by(&mut self, state: DriveState, said: SpindleInputs, tell: &mut dyn FnMut(Event)) {
        let is_faulted = matches!(state, DriveState::Fault | DriveState::FaultReaction);
        let is_known = matches!(self.phase, Phase::Failed | Phase::Resetting(_));
        if self.is_present && is_faulted && !is_known {
            let code = said.fault.filter(|code| *code != 0).unwrap_or(ANY_FAULT);
            self.fail(code);
            tell(Event::SpindleFault(code));
        }
    }

    const fn fail(&mut self, code: u16) {
        (self.phase, self.failed) = (Phase::Failed, Some(code));
    }

    /// The controlword.
    fn step(
        &mut self,
        cycle: &SpindleCycle,
        state: DriveState,
        since_ns: u64,
        tell: &mut dyn FnMut(Event),
    ) -> u16 {
        let is_on = state == DriveState::OperationEnabled;
        match self.phase {
            Phase::Off => {
                self.told_rpm = 0.0;
                if self.is_to_work() && cycle.is_present {
                    self.phase = Phase::Enabling(cycle.now_ns);
                }
                DISABLE_VOLTAGE
            }
            Phase::Enabling(_) if !self.is_to_work() && !is_on => {
                self.phase = Phase::Off;
                DISABLE_VOLTAGE
            }
            Phase::Enabling(_) if is_on => {
                // One that still runs out is taken over as it turns.
                self.told_rpm = self.actual_rpm;
                self.phase = Phase::Turning;
                ENABLE_OPERATION | self.settings().mode.ramp_bits()
            }
            Phase::Enabling(begun_ns) => {
                if cycle.now_ns.saturating_sub(begun_ns) > PATIENCE_NS {
                    self.fail(0);
                    tell(Event::SpindleWithoutPower(state));
                    return DISABLE_VOLTAGE;
                }
                way_to_power(state)
            }
            Phase::Turning | Phase::Orienting(_) if !is_on && cycle.is_present => {
                self.told_rpm = 0.0;
                self.fail(0);
                tell(Event::SpindleWithoutPower(state));
                DISABLE_VOLTAGE
            }
            Phase::Turning => self.turn(since_ns),
            Phase::Orienting(way) => {
                self.orient(way, since_ns);
                ENABLE_OPERATION
            }
            Phase::Failed => {
                self.told_rpm = 0.0;
                if cycle.resets {
                    (self.failed, self.phase) = (None, Phase::Resetting(cycle.now_ns));
                }
                DISABLE_VOLTAGE
            }
            // Bit 7 has to rise once, when its reaction is over.
            Phase::Resetting(since_ns) => match state {
                DriveState::Fault | DriveState::FaultReaction
                    if cycle.now_ns.saturating_sub(since_ns) > RESET_NS =>
                {
                    // It is told as a new one.
                    self.phase = Phase::Off;
                    DISABLE_VOLTAGE
                }
                DriveState::Fault => RESET_FAULT,
                DriveState::FaultReaction => DISABLE_VOLTAGE,
                _ => {
                    self.phase = Phase::Off;
                    DISABLE_VOLTAGE
                }
            },
        }
    }

    /// Whether it is to turn, or to stand at an angle.
    fn is_to_work(&self) -> bool {
        self.wanted_rpm != 0.0 || self.angle.is_some()
    }

    /// Goes its way to an angle, or to rest where it is to stand at none any more.
    #[allow(clippy::cast_precision_loss, reason = "some milliseconds")]
    fn orient(&mut self, way: Option<Orienting>, since_ns: u64) {
        let (Some(guide), true) = (self.settings().guide(), self.is_present) else {
            return;
        };
        let is_led = self.said.mode == CYCLIC_POSITION;
        let (Some(mut way), true) = (way, is_led) else {
            self.phase = match self.angle {
                Some(angle) if is_led => {
                    Phase::Orienting(Some(Orienting::begin(&guide, self.said.place, angle)))
                }
                Some(_) => Phase::Orienting(None),
                None => Phase::Turning,
            };
            return;
        };
        let rests = way.step(&guide, since_ns as f64 * 1e-9, self.angle);
        self.phase = if rests && self.angle.is_none() {
            Phase::Turning
        } else {
            Phase::Orienting(Some(way))
        };
    }

    /// Whether it stands at the angle that it is to stand at.
    fn is_at_angle(&self) -> bool {
        let Phase::Orienting(Some(way)) = self.phase else {
            return false;
        };
        let guide = self.settings().guide();
        way.has_arrived() && guide.is_some_and(|guide| way.is_near(&guide, self.said.place))
    }

    /// Follows its ramp, and gives its power back when it is to stand and stands.
    #[allow(clippy::cast_precision_loss, reason = "some milliseconds")]
    fn turn(&mut self, since_ns: u64) -> u16 {
        let is_turned = self.settings().orientation.is_some();
        if is_turned && self.said.mode != self.settings().mode.code() {
            // Its drive comes from position, where it stands.
            self.told_rpm = 0.0;
            return ENABLE_OPERATION;
        }
        let step = self.settings().ramp_rpm_per_s * since_ns as f64 * 1e-9;
        let apart = self.wanted_rpm - self.told_rpm;
        self.told_rpm += apart.clamp(-step, step);
        let is_to_stand = self.wanted_rpm == 0.0 && self.told_rpm == 0.0;
        if is_to_stand
            && self
                .near_ns
                .is_some_and(|since| self.last_ns >= since + SETTLED_NS)
        {
            if self.angle.is_some() {
                self.near_ns = None;
                self.phase = Phase::Orienting(None);
                return ENABLE_OPERATION;
            }
            self.phase = Phase::Off;
            return SHUTDOWN;
        }
        ENABLE_OPERATION | self.settings().mode.ramp_bits()
    }

    /// Since when it turns as fast as it is to, or stands.
    fn judge_speed(&mut self, now_ns: u64, is_reachable: bool) {
        let near_rpm = if self.wanted_rpm == 0.0 {
            self.settings().still_rpm()
        } else {
            self.settings().near_rpm(self.wanted_rpm)
        };
        let is_led = (self.told_rpm - self.wanted_rpm).abs() <= 0.0 && is_reachable;
        let is_near = match self.phase {
            Phase::Orienting(_) => self.is_at_angle(),
            _ => (self.actual_rpm - self.wanted_rpm).abs() <= near_rpm,
        };
        if is_led && is_near && self.is_present {
            self.near_ns.get_or_insert(now_ns);
        } else {
            self.near_ns = None;
        }
    }

    /// Adds what is known of it.
    pub(super) fn tell(&self, feedback: &mut Feedback) {
        if !self.is_present {
            feedback.spindle_flags |= SpindleFlags::FAULT.0;
            return;
        }
        feedback.spindle_v = self.actual_rpm / 60.0;
        feedback.spindle_load = self.load_r;
        let is_settled = self
            .near_ns
            .is_some_and(|since| self.last_ns >= since + SETTLED_NS)
            && !self.is_due;
        let stands = self.wanted_rpm == 0.0;
        let mut set = |flag: SpindleFlags, is: bool| {
            feedback.spindle_flags |= if is { flag.0 } else { 0 };
        };
        set(SpindleFlags::SPEED, true);
        set(SpindleFlags::LOAD, self.settings().tells_load);
        set(
            SpindleFlags::AT_SPEED,
            is_settled && !stands && self.phase == Phase::Turning,
        );
        set(SpindleFlags::STOPPED, is_settled && stands);
        let is_held = matches!(self.phase, Phase::Orienting(Some(_)));
        set(
            SpindleFlags::ORIENTED,
            is_settled && is_held && self.angle.is_some(),
        );
        set(SpindleFlags::FAULT, self.failed.is_some());
    }
}

/// The next step to power.
const fn way_to_power(state: DriveState) -> u16 {
    match state {
        DriveState::SwitchOnDisabled => SHUTDOWN,
        DriveState::Ready => SWITCH_ON,
        DriveState::SwitchedOn | DriveState::OperationEnabled => ENABLE_OPERATION,
        _ => DISABLE_VOLTAGE,
    }
}
