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
//!
//! Gears are changed at rest and without power, in `Off`; or, where the motor turns to and fro meanwhile, with
//! power in `Shifting`, which a spindle at rest gets to from `Turning`, and goes back from.

mod shifting;
mod told;

use super::gearbox::Gearbox;
use super::orienting::{Angle, Orienting};
use super::spindle_settings::SpindleSettings;
use super::spindle_wiring::{SpindleInputs, SpindleOutputs, WiredSpindle};
use crate::event::Event;
use crate::state;
use glidepath_link::DriveState;

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
/// It did not get power, or lost it.
const NO_POWER: SpindleLoss = SpindleLoss::Drive(0);
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
    /// Its motor turns to and fro until a gear is in.
    Shifting,
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
    /// The gear in which it is to turn, 0 for the one that is in.
    pub(super) gear: u32,
    /// That was commanded in this cycle.
    pub(super) is_gear_asked: bool,
    /// All digital inputs by their numbers.
    pub(super) inputs: u64,
    /// Nobody is to be obeyed.
    pub(super) is_safe: bool,
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
    /// The settings in the gear that is in.
    present: SpindleSettings,
    gearbox: Option<Gearbox>,
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
    failed: Option<SpindleLoss>,
}

/// What is lost of a spindle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SpindleLoss {
    /// Its drive has this fault, or 0 where it did not get power, or lost it.
    Drive(u16),
    /// This gear is not in, 0 where nobody said which one is to be.
    Gear(u32),
}

impl SpindleDrive {
    pub(super) fn new(wired: WiredSpindle) -> Self {
        let gears = wired.settings.gears;
        // While none is known, speeds are those of the fastest one.
        let first = gears.as_ref().and_then(|gears| gears.fastest());
        Self {
            present: first.map_or(wired.settings, |gear| wired.settings.in_gear(gear)),
            gearbox: gears.map(Gearbox::new),
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
        &self.present
    }

    /// The gear whose output is to be on; `None` without gears.
    pub(super) fn put_in(&self) -> Option<u32> {
        self.gearbox.as_ref().map(Gearbox::put_in)
    }

    /// What is lost of it; `None` if nothing is.
    pub(super) const fn failed(&self) -> Option<SpindleLoss> {
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
        let has_gear = self.change_gear(&cycle, tell);
        let most = self.settings().max_rpm;
        let wanted_rpm = if has_gear { cycle.wanted_rpm } else { 0.0 };
        self.wanted_rpm = wanted_rpm.clamp(-most, most);
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
            velocity: match &self.gearbox {
                Some(gearbox) if self.phase == Phase::Shifting => {
                    let motor_rpm = gearbox.swing_rpm(self.last_ns);
                    self.wired.settings.counts(motor_rpm)
                }
                _ => self.settings().counts(self.told_rpm),
            },
            place,
        }
    }

    /// Its drive reports a fault.
    fn fail_by(&mut self, state: DriveState, said: SpindleInputs, tell: &mut dyn FnMut(Event)) {
        let is_faulted = matches!(state, DriveState::Fault | DriveState::FaultReaction);
        let is_known = matches!(self.phase, Phase::Failed | Phase::Resetting(_));
        if self.is_present && is_faulted && !is_known {
            let code = said.fault.filter(|code| *code != 0).unwrap_or(ANY_FAULT);
            self.fail(SpindleLoss::Drive(code));
            tell(Event::SpindleFault(code));
        }
    }

    const fn fail(&mut self, loss: SpindleLoss) {
        (self.phase, self.failed) = (Phase::Failed, Some(loss));
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
                if self.is_to_work(cycle) && cycle.is_present {
                    self.phase = Phase::Enabling(cycle.now_ns);
                }
                DISABLE_VOLTAGE
            }
            Phase::Enabling(_) if !self.is_to_work(cycle) && !is_on => {
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
                    self.fail(NO_POWER);
                    tell(Event::SpindleWithoutPower(state));
                    return DISABLE_VOLTAGE;
                }
                way_to_power(state)
            }
            Phase::Turning | Phase::Orienting(_) | Phase::Shifting
                if !is_on && cycle.is_present =>
            {
                self.told_rpm = 0.0;
                self.fail(NO_POWER);
                tell(Event::SpindleWithoutPower(state));
                DISABLE_VOLTAGE
            }
            Phase::Turning => self.turn(cycle, since_ns),
            Phase::Shifting => {
                if !self.swings(cycle) {
                    self.told_rpm = self.actual_rpm;
                    self.phase = Phase::Turning;
                }
                ENABLE_OPERATION | self.settings().mode.ramp_bits()
            }
            Phase::Orienting(way) => {
                self.orient(way, since_ns);
                ENABLE_OPERATION
            }
            Phase::Failed => {
                self.told_rpm = 0.0;
                if cycle.resets {
                    if let Some(gearbox) = &mut self.gearbox {
                        gearbox.reset();
                    }
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

    /// Whether it is to turn, to stand at an angle, or to turn to and fro until a gear is in.
    fn is_to_work(&self, cycle: &SpindleCycle) -> bool {
        self.wanted_rpm != 0.0 || self.angle.is_some() || self.swings(cycle)
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
    fn turn(&mut self, cycle: &SpindleCycle, since_ns: u64) -> u16 {
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
        if is_to_stand && self.has_settled() {
            if self.angle.is_some() {
                self.near_ns = None;
                self.phase = Phase::Orienting(None);
                return ENABLE_OPERATION;
            }
            if self.swings(cycle) {
                self.phase = Phase::Shifting;
                return ENABLE_OPERATION | self.settings().mode.ramp_bits();
            }
            self.phase = Phase::Off;
            return SHUTDOWN;
        }
        ENABLE_OPERATION | self.settings().mode.ramp_bits()
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
