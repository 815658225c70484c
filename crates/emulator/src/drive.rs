//! An emulated drive with its motor: what happens at every SYNC0.
//!
//! The motor follows its target with a lag of first order, so that at a speed v it is v·τ behind:
//! `x += (target − x) (1 − e^(−T/τ))`; or it has loops and inertia. A motor without current stands: it has a
//! brake.

use crate::dictionary::{
    AxisObjects, FOLLOWING_TIMEOUT, FOLLOWING_WINDOW, HOME_OFFSET, HOMING_METHOD, HOMING_SPEED,
    MOST_TORQUE, QUICK_STOP, TORQUE_LIMITS,
};
use crate::drive_io::{Inputs, Outputs};
use crate::injected_fault::InjectedFault;
use crate::position_loop::{Motor, PositionLoop, Told};
use crate::power::Power;
use crate::settings::{DriveSettings, HomeSwitch};
use crate::spindle::SpindleMotor;
use crate::touch_probe::{ProbeUnits, TouchProbe};
use crate::way::{Way, Ways};

const CYCLIC_POSITION: i8 = 8;
const HOMING: i8 = 6;
/// Homing methods that take the present position for home.
const HERE: [u32; 2] = [35, 37];

/// The drive's own number of a following error.
const FOLLOWING_ERROR: u16 = 0x8611;
/// The same for a bus that is lost while there is power.
const BUS_LOST: u16 = 0x7500;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Homing {
    No,
    Under,
    Done,
    Failed,
}

/// The state of a drive.
#[derive(Debug, Clone)]
pub(crate) struct Drive {
    lag_t: f64,
    range: Option<(i32, i32)>,
    brake_t: f64,
    home: Option<HomeSwitch>,
    spindle: Option<SpindleMotor>,
    loops: Option<PositionLoop>,
    /// Where its loops are, while they follow.
    motor: Option<Motor>,
    power: Power,
    /// Where the motor is, counts from zero of its encoder.
    place: f64,
    /// What is added to that in what is told.
    offset: f64,
    /// counts/s.
    velocity: f64,
    /// What of its torque a spindle needs, -1 to 1.
    torque_r: f64,
    outputs: Outputs,
    fault: u16,
    /// How long the following error was too large, s.
    behind_t: f64,
    /// How long it has been on its way to "operation enabled", s.
    opening_t: f64,
    homing: Homing,
    refuses_power: bool,
    has_voltage: bool,
    is_stuck: bool,
    touch_probe: Option<TouchProbe>,
    probe_units: ProbeUnits,
    /// 0x60FD.
    digital: u32,
    /// Its last ways, if somebody looks at them.
    pub(crate) ways: Option<Ways>,
}

impl Drive {
    pub(crate) fn new(settings: &DriveSettings, axis: usize) -> Self {
        Self {
            lag_t: settings.lag_t,
            range: settings.range,
            brake_t: settings.brake_t,
            home: settings.home,
            spindle: settings.spindle,
            loops: settings.position_loop,
            motor: None,
            power: Power::SwitchOnDisabled,
            place: settings.start_counts.get(axis).copied().unwrap_or(0).into(),
            offset: 0.0,
            velocity: 0.0,
            torque_r: 0.0,
            outputs: Outputs::default(),
            fault: 0,
            behind_t: 0.0,
            opening_t: 0.0,
            homing: Homing::No,
            refuses_power: false,
            has_voltage: true,
            is_stuck: false,
            touch_probe: settings.touch_probe,
            probe_units: ProbeUnits::default(),
            digital: 0,
            ways: None,
        }
    }

    /// The drive after its supply was away for a moment.
    pub(crate) fn rebooted(&self, settings: &DriveSettings) -> Self {
        Self {
            place: self.place,
            digital: self.digital,
            ways: self.ways.clone(),
            ..Self::new(settings, 0)
        }
    }

    pub(crate) const fn inject(&mut self, upset: InjectedFault) {
        match upset {
            InjectedFault::Fault(code) => self.fail(code),
            InjectedFault::RefusesPower(refuses) => self.refuses_power = refuses,
            InjectedFault::NoVoltage(is_away) => {
                self.has_voltage = !is_away;
                if is_away && self.power.drives() {
                    self.power = Power::SwitchOnDisabled;
                }
            }
            InjectedFault::Stuck(is_stuck) => self.is_stuck = is_stuck,
            InjectedFault::ProbeOff(are_off) => self.probe_units.are_off = are_off,
            InjectedFault::Emergency(_) | InjectedFault::Drop(_) | InjectedFault::Reboot => {}
        }
    }

    const fn fail(&mut self, code: u16) {
        self.fault = code;
        self.power = if self.power.drives() {
            Power::FaultReaction
        } else {
            Power::Fault
        };
    }

    /// The bus is lost: a drive with power does not wait for it.
    pub(crate) const fn lose_bus(&mut self) {
        if matches!(self.power, Power::Enabled | Power::QuickStop) {
            self.fail(BUS_LOST);
        }
    }

    /// Where the motor is, as it is told.
    pub(crate) const fn told_place(&self) -> f64 {
        self.place + self.offset
    }

    #[allow(clippy::cast_possible_truncation, reason = "a drive wraps, too")]
    fn actual(&self) -> i32 {
        let counts = self.told_place().round() as i64;
        self.range.map_or(counts as i32, |(lowest, highest)| {
            let (lowest, highest) = (i64::from(lowest), i64::from(highest));
            (lowest + (counts - lowest).rem_euclid(highest - lowest + 1)) as i32
        })
    }

    /// Where its target is: round the shorter way, where the counter goes round.
    fn target(&self) -> f64 {
        let target = f64::from(self.outputs.target) - self.offset;
        let Some((lowest, highest)) = self.range else {
            return target;
        };
        let count = f64::from(highest) - f64::from(lowest) + 1.0;
        self.place + (target - self.place + 0.5 * count).rem_euclid(count) - 0.5 * count
    }

    /// What it tells.
    #[allow(clippy::cast_possible_truncation, reason = "it saturates")]
    pub(crate) fn inputs(&self) -> Inputs {
        let follows = matches!(self.power, Power::Enabled) && self.outputs.mode == CYCLIC_POSITION;
        let mut status = self.power.status() | 0x200;
        if self.has_voltage {
            status |= 0x10;
        }
        if follows {
            status |= 0x1000;
        }
        if self.outputs.mode == HOMING {
            status |= match self.homing {
                Homing::Done => 0x1400,
                Homing::Failed => 0x2000,
                Homing::No => 0x0400,
                Homing::Under => 0,
            };
        }
        Inputs {
            status,
            actual: self.actual(),
            mode: self.outputs.mode,
            fault: self.fault,
            velocity: self.velocity.round() as i32,
            speed_rpm: self.speed_rpm().round() as i16,
            torque: (1e3 * self.torque_r).round() as i16,
            digital: self.digital,
            probe: (self.probe_units.status, self.probe_units.places),
        }
    }

    /// How far a spindle has turned at a time, not before that of the last step.
    pub(crate) fn revolutions(&self, now_ns: u64) -> Option<f64> {
        let motor = self.spindle.as_ref()?;
        self.ways.as_ref()?;
        Some(self.place_at(now_ns) / motor.counts_per_rev)
    }

    /// Where the motor is at a time, not before that of the last step: it goes on as it went. Counts.
    #[allow(clippy::cast_precision_loss, reason = "a period")]
    pub(crate) fn place_at(&self, now_ns: u64) -> f64 {
        let last_ns = self.ways.as_ref().map_or(now_ns, Ways::last_ns);
        let since_ns = now_ns.saturating_sub(last_ns);
        self.place + self.velocity * since_ns as f64 * 1e-9
    }

    /// How fast a spindle turns, rev/min.
    fn speed_rpm(&self) -> f64 {
        let motor = self.spindle.as_ref();
        motor.map_or(0.0, |motor| self.velocity / motor.of_rpm(1.0))
    }

    /// A step of `step_t` seconds, with what the master said last.
    pub(crate) fn step(&mut self, step_t: f64, outputs: Outputs, objects: AxisObjects<'_>) {
        let resets = outputs.control & 0x80 != 0 && self.outputs.control & 0x80 == 0;
        let starts_homing = outputs.control & 0x10 != 0 && self.outputs.control & 0x10 == 0;
        self.outputs = outputs;
        if resets && self.power == Power::Fault {
            self.fault = 0;
        }
        self.change_power(step_t, resets);
        if self.spindle.is_some() {
            self.turn(step_t, objects);
            return;
        }
        let before = self.place;
        let ramp = f64::from(objects.value(QUICK_STOP)).max(1.0);
        match self.power {
            Power::QuickStop | Power::FaultReaction => self.ramp_down(step_t, ramp),
            Power::Enabled if self.is_stuck || objects.value(MOST_TORQUE) == 0 => {}
            Power::Enabled if outputs.mode == HOMING => {
                self.go_home(step_t, starts_homing, objects);
            }
            Power::Enabled if outputs.mode == CYCLIC_POSITION => self.follow(step_t, objects),
            _ => {}
        }
        if self.power != Power::Enabled || outputs.mode != CYCLIC_POSITION {
            self.motor = None;
        }
        if outputs.mode != HOMING {
            self.homing = Homing::No;
        }
        self.velocity = (self.place - before) / step_t;
        self.watch_following(step_t, objects);
    }

    /// A spindle turns, and comes to rest by its own torque where it is told to stop.
    fn turn(&mut self, step_t: f64, objects: AxisObjects<'_>) {
        let Some(motor) = self.spindle else {
            return;
        };
        let told = match self.power {
            _ if self.is_stuck || objects.value(MOST_TORQUE) == 0 => None,
            Power::Enabled if self.outputs.mode == CYCLIC_POSITION => {
                // Its loop of position asks for all of the way in one step, as far as the torque goes.
                let behind = self.outputs.target.wrapping_sub(self.actual());
                Some(f64::from(behind) / step_t)
            }
            Power::Enabled => {
                let Outputs { mode, control, .. } = self.outputs;
                let targets = (self.outputs.velocity, self.outputs.speed_rpm);
                motor.told((mode, control), targets)
            }
            Power::QuickStop | Power::FaultReaction => Some(0.0),
            _ => None,
        };
        let before = self.velocity;
        self.velocity = motor.next(before, told, step_t);
        let gain_rpm = (self.velocity - before) / motor.of_rpm(1.0);
        self.torque_r = told.map_or(0.0, |_| gain_rpm / (motor.torque_rpm_per_s * step_t));
        self.place += self.velocity * step_t;
        if self.power == Power::FaultReaction && self.velocity == 0.0 {
            self.power = Power::Fault;
        }
    }

    /// The end of a step: the way that was done in it, and what the touch probe is to do from here on.
    pub(crate) fn end_step(&mut self, (from_ns, to_ns): (u64, u64), from: f64) {
        let is_led = self.power == Power::Enabled && self.outputs.mode == CYCLIC_POSITION;
        let way = Way {
            from_ns,
            to_ns,
            from,
            to: self.told_place(),
            lag_t: if is_led && self.loops.is_none() {
                self.lag_t
            } else {
                0.0
            },
        };
        if let Some(ways) = &mut self.ways {
            ways.push(way);
        }
        self.pass_zero(&way);
        if self.touch_probe.is_some() {
            self.probe_units.step(self.outputs.probe, to_ns);
        }
    }

    /// The zero impulse of its encoder, if that was on the way.
    #[allow(clippy::cast_possible_truncation, reason = "a drive wraps, too")]
    fn pass_zero(&mut self, way: &Way) {
        let Some((probe, zero)) = self
            .touch_probe
            .and_then(|probe| Some((probe, probe.zero?)))
        else {
            return;
        };
        let rises = zero.rises(way.from - self.offset, way.to - self.offset);
        if let Some(place) = rises.map(|place| place + self.offset) {
            let told = (place.round() as i64 as i32).wrapping_add(probe.off_counts);
            self.probe_units.pass_zero(way.passes_ns(place), told);
        }
    }

    /// An edge at the input of its touch probe.
    #[allow(clippy::cast_possible_truncation, reason = "a drive wraps, too")]
    pub(crate) fn capture(&mut self, rises: bool, at_ns: u64, sources: [u32; 2]) {
        let place = self.ways.as_ref().and_then(|ways| ways.at(at_ns));
        let place = place.unwrap_or_else(|| self.told_place()).round() as i64 as i32;
        if let Some(probe) = self.touch_probe {
            let place = place.wrapping_add(probe.off_counts);
            self.probe_units.capture(rises, at_ns, place, sources);
        }
    }

    /// A bit of its digital inputs is high or low.
    pub(crate) const fn set_digital(&mut self, bit: u8, is_high: bool) {
        let mask = 1 << (bit & 31);
        self.digital = if is_high {
            self.digital | mask
        } else {
            self.digital & !mask
        };
    }

    fn change_power(&mut self, step_t: f64, resets: bool) {
        let control = self.outputs.control;
        let may = self.has_voltage && !self.refuses_power;
        let next = self.power.next(control, resets, may);
        if next == Power::Enabled && self.power == Power::SwitchedOn {
            self.opening_t += step_t;
            if self.opening_t < self.brake_t {
                return;
            }
        }
        self.opening_t = 0.0;
        self.power = next;
    }

    fn ramp_down(&mut self, step_t: f64, ramp: f64) {
        let speed = (self.velocity.abs() - ramp * step_t).max(0.0);
        if !self.is_stuck {
            self.place += speed.copysign(self.velocity) * step_t;
        }
        if speed <= 0.0 && self.power == Power::FaultReaction {
            self.power = Power::Fault;
        }
    }

    fn follow(&mut self, step_t: f64, objects: AxisObjects<'_>) {
        let target = self.target();
        if let Some(loops) = self.loops {
            let motor = self
                .motor
                .get_or_insert_with(|| Motor::standing(loops, self.place));
            let told = Told {
                target,
                velocity: self.outputs.velocity_offset.into(),
                torque: self.outputs.torque_offset.into(),
            };
            let most = TORQUE_LIMITS.map(|limit| {
                let most = objects.value(limit).min(objects.value(MOST_TORQUE));
                f64::from(most)
            });
            self.place = motor.step(self.place, step_t, told, most.into());
            return;
        }
        let share = if self.lag_t > 0.0 {
            1.0 - (-step_t / self.lag_t).exp()
        } else {
            1.0
        };
        self.place += (target - self.place) * share;
    }

    fn watch_following(&mut self, step_t: f64, objects: AxisObjects<'_>) {
        let window = objects.value(FOLLOWING_WINDOW);
        let follows = self.power == Power::Enabled && self.outputs.mode == CYCLIC_POSITION;
        let behind = self.target() - self.place;
        if !follows || window == u32::MAX || behind.abs() <= f64::from(window) {
            self.behind_t = 0.0;
            return;
        }
        self.behind_t += step_t;
        if self.behind_t * 1e3 > f64::from(objects.value(FOLLOWING_TIMEOUT)) {
            self.behind_t = 0.0;
            self.fail(FOLLOWING_ERROR);
        }
    }

    #[allow(
        clippy::cast_possible_wrap,
        clippy::cast_precision_loss,
        reason = "the offset is a signed object; places are far below 2⁵³"
    )]
    fn go_home(&mut self, step_t: f64, starts: bool, objects: AxisObjects<'_>) {
        if starts {
            self.homing = Homing::Under;
        }
        if self.outputs.control & 0x10 == 0 && self.homing == Homing::Under {
            self.homing = Homing::No;
        }
        if self.homing != Homing::Under {
            return;
        }
        let home = if HERE.contains(&objects.value(HOMING_METHOD)) {
            self.place
        } else if let Some(home) = self.home {
            home.at_counts as f64
        } else {
            self.homing = Homing::Failed;
            return;
        };
        let away = home - self.place;
        let way = f64::from(objects.value(HOMING_SPEED)).max(1.0) * step_t;
        if away.abs() > way {
            self.place += way.copysign(away);
            return;
        }
        self.place = home;
        self.offset = f64::from(objects.value(HOME_OFFSET) as i32) - home;
        self.homing = Homing::Done;
    }
}
