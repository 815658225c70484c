//! The jog, motion by hand: jogs from rest, jogs away from the path while a program is held, and
//! the way back.
//!
//! ```text
//!             demand                         arrived, let go, unheard of for 150 ms, hold, abort
//!   at rest ──────────► the axes are the jog's ──────────► coming to rest ──► at rest,
//!      ▲                  │  ▲  another demand                                 perhaps away
//!      └──────────────────┘  └──────────────┘                                  from the path
//! ```
//!
//! A demand is followed in the tick that sees it, from whatever the axes are doing: there is no plan
//! to wait for. What it may do is in three hands:
//!
//! * [`holder`]: whose demand counts, and for how long. Nothing sets out because of a demand that is
//!   old, or was there before jogging was possible.
//! * [`jog_motion`]: how the axes get to what is wanted, inside the limits, straight where they can.
//! * [`clearance`]: whether the next step may be done: only if the stop from its end was played
//!   through, and stays in travel, within reach, and inside the limits of the joints.
//!
//! While a program is held, program time stands and what is published is the path's position and the
//! way that the axes are away from it. The program goes on only after a return, which ends where the
//! jog began, to the bit.

mod clearance;
mod heard_demand;
mod holder;
mod jog_motion;
mod line;
mod speeds;
mod travel;
mod way_back;
mod wheel;

pub(crate) use line::AxesMotion;
pub(crate) use wheel::Wheel;

use crate::shared::config::{Config, JogSettings, SoftLimits};
use crate::shared::message::jog_demand::{Demand, Jogged};
use crate::shared::tracker::{Bounds, Motion, Profile};
use clearance::Clearance;
use glidepath_geometry::{AXES, Axis, AxisVector};
use glidepath_kinematics::JOINTS;
use glidepath_link::JogMode;
use glidepath_program::Limits;
use holder::Holder;
use jog_motion::{Goal, JogMotion};
use travel::Travel;
use way_back::WayBack;

/// What the tick knows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JogContext {
    /// When the tick is due.
    pub(crate) now_ns: u64,
    /// Where the axes were published last.
    pub(crate) position: AxisVector,
    /// Whether a jog may begin.
    pub(crate) may_start: bool,
    /// Whether a program is held there: where the jog begins is then to be found again.
    pub(crate) is_on_path: bool,
    /// The joints that know where they are, one bit each.
    pub(crate) homed: u32,
}

/// What moves the axes by hand.
#[derive(Debug)]
pub(crate) struct Jog {
    settings: JogSettings,
    limits: Limits,
    soft_limits: SoftLimits,
    period_t: f64,
    /// How far ahead of an axis the place may be that its wheel was turned to.
    ahead: AxisVector,
    clearance: Clearance,
    holder: Holder,
    /// Stops so far, by orders.
    stops: u64,
    wheel: Wheel,
    /// What is followed.
    demand: Option<Demand>,
    goal: Goal,
    jog_motion: JogMotion,
    /// A step was not allowed: nothing moves before something else is wanted.
    blocked: bool,
    /// The speed that the joints can do, as it was looked up last.
    joint_v: f64,
    override_ratio: f64,
    /// Where the present jog began.
    began_at: AxisVector,
    /// The axes that knew where they are then.
    is_homed: [bool; AXES],
    /// The axis of each joint, where joints are axes.
    of_joint: Option<[Option<Axis>; JOINTS]>,
    /// Joints of the machine, one bit each.
    joints: u32,
    /// Where the program was held, if the axes may be away from there.
    path: Option<AxisVector>,
    way_back: WayBack,
}

impl Jog {
    pub(crate) fn new(config: &Config) -> Self {
        let settings = config.jog;
        let mut limits = config.hand_limits;
        limits.velocity = limits.velocity.inf(&settings.velocity);
        let ns = |t: core::time::Duration| u64::try_from(t.as_nanos()).unwrap_or(u64::MAX);
        Self {
            settings,
            limits,
            soft_limits: config.soft_limits,
            period_t: config.period_t(),
            ahead: stopping_distances(&limits),
            clearance: Clearance::new(config),
            holder: Holder::new(ns(settings.time_out), config.period_ns),
            stops: 0,
            wheel: Wheel::new(ns(settings.wheel_quiet)),
            demand: None,
            goal: Goal::Stop,
            jog_motion: JogMotion::at_rest(config.start_position),
            blocked: false,
            joint_v: f64::INFINITY,
            override_ratio: 1.0,
            began_at: config.start_position,
            is_homed: [true; AXES],
            of_joint: config.axis_of_joint(),
            joints: config.joints(),
            path: None,
            way_back: WayBack::NONE,
        }
    }

    /// True while the setpoints are the jog's: it moves the axes, or they are away from the path.
    pub(crate) const fn owns_axes(&self) -> bool {
        self.is_active() || self.path.is_some()
    }

    /// True while something is followed or comes to rest.
    pub(crate) const fn is_active(&self) -> bool {
        self.demand.is_some() || self.is_returning() || !self.jog_motion.is_resting()
    }

    /// True on the way back to the path.
    pub(crate) const fn is_returning(&self) -> bool {
        !self.way_back.is_done()
    }

    /// How far the axes are from where the program is held.
    pub(crate) fn away(&self) -> AxisVector {
        self.path.map_or_else(AxisVector::zeros, |path| {
            self.jog_motion.motion().position - path
        })
    }

    /// What part of the jog's speeds is left, 0 to 1.
    pub(crate) const fn set_override(&mut self, ratio: f64) {
        self.override_ratio = ratio;
    }

    pub(crate) const fn override_ratio(&self) -> f64 {
        self.override_ratio
    }

    /// Whose demand was followed last.
    pub(crate) fn jogged(&self) -> Jogged {
        self.holder.jogged()
    }

    fn begin(&mut self, around: &JogContext) {
        self.jog_motion = JogMotion::at_rest(around.position);
        self.clearance.begin();
        self.clearance.follow(&around.position);
        self.began_at = around.position;
        self.is_homed = self.homed_axes(around.homed);
        if around.is_on_path && self.path.is_none() {
            self.path = Some(around.position);
        }
    }

    /// The axes all of whose joints know where they are.
    fn homed_axes(&self, joints: u32) -> [bool; AXES] {
        let Some(of_joint) = &self.of_joint else {
            // Every joint has to do with every axis.
            return [joints == self.joints; AXES];
        };
        let mut homed = [true; AXES];
        for (joint, axis) in of_joint.iter().enumerate() {
            let slot = axis.and_then(|axis| homed.get_mut(axis.index()));
            if let Some(slot) = slot.filter(|_| joints & (1 << joint) == 0) {
                *slot = false;
            }
        }
        homed
    }

    /// Whoever jogs does so no longer.
    fn let_go(&mut self) {
        self.demand = None;
        self.goal = Goal::Stop;
        self.way_back = WayBack::NONE;
    }

    /// A hold, an abort, or the power is taken: what was demanded before moves nothing, also if it is still on its way.
    pub(crate) fn stop(&mut self) {
        self.stops += 1;
        self.cancel();
    }

    /// Ends a jog or a return from elsewhere. Who jogs has to let go before beginning another.
    pub(crate) fn cancel(&mut self) {
        self.holder.shut_out();
        self.let_go();
    }

    /// Begins the way back to the path, the tool axis last. Returns whether there is one.
    pub(crate) fn go_back(&mut self, around: &JogContext) -> bool {
        let Some(path) = self.path.filter(|_| !self.is_active()) else {
            return false;
        };
        self.begin(around);
        self.blocked = false;
        self.way_back = WayBack::to(&path, &around.position, self.settings.tool_axis);
        self.head_back();
        true
    }

    /// The drives have lost their power: nothing is followed any more, and nothing comes to rest.
    pub(crate) fn end(&mut self) {
        self.cancel();
        self.demand = None;
        self.way_back = WayBack::NONE;
        self.path = None;
        self.jog_motion = JogMotion::at_rest(self.jog_motion.motion().position);
    }

    /// The epoch has ended: there is no path to be away from.
    pub(crate) const fn forget_path(&mut self) {
        self.path = None;
    }

    /// One period of the motion. To be called while the axes are the jog's.
    pub(crate) fn step(&mut self, now_ns: u64) -> AxesMotion {
        self.watch_demand(now_ns);
        let position = self.jog_motion.motion().position;
        let travel = self.travel(&position);
        let mut next = self.jog_motion;
        if self.blocked || self.goal == Goal::Stop {
            next.brake();
            next.advance(self.period_t);
            self.jog_motion = next;
        } else {
            self.look_up_joint_speed(&position);
            next.aim(&self.goal, &travel, &self.jog_limits());
            next.advance(self.period_t);
            if self.clearance.admits(&next, &travel) {
                self.jog_motion = next;
            } else {
                // The stop from here was played through before.
                self.blocked = true;
                self.jog_motion.brake();
                self.jog_motion.advance(self.period_t);
            }
        }
        let motion = self.jog_motion.motion();
        self.clearance.follow(&motion.position);
        if self.jog_motion.is_resting() {
            self.come_to_rest(&motion.position);
        }
        motion
    }

    /// Looks whether what is followed is still to be.
    fn watch_demand(&mut self, now_ns: u64) {
        match self.demand.map(|demand| demand.mode) {
            Some(JogMode::Continuous) if self.holder.is_overdue(now_ns) => self.let_go(),
            Some(JogMode::WheelVelocity) => {
                let speed = self.wheel.speed(now_ns);
                if speed.amax() > 0.0 {
                    self.goal = Goal::Speeds(speed);
                } else {
                    self.let_go();
                }
            }
            _ => {}
        }
    }

    fn travel(&self, position: &AxisVector) -> Travel {
        // A path that is held may be outside, where its program began: the way back leads there.
        let path = self
            .path
            .as_ref()
            .map(|path| self.soft_limits.beginning_at(path));
        let soft_limits = path.as_ref().unwrap_or(&self.soft_limits);
        Travel::from(soft_limits, position, &self.began_at, &self.is_homed)
    }

    /// Nothing moves: what was wanted is done, or cannot be.
    fn come_to_rest(&mut self, position: &AxisVector) {
        let is_pressed = self
            .demand
            .is_some_and(|demand| demand.mode == JogMode::Continuous);
        if is_pressed {
            return; // At the end of the way; the key is still down.
        }
        if self.is_returning() && !self.blocked {
            self.way_back.reach(position);
            self.head_back();
            if self.is_returning() {
                return;
            }
        }
        self.way_back = WayBack::NONE;
        self.demand = None;
        self.goal = Goal::Stop;
        self.holder.release();
        if self.path == Some(*position) {
            self.path = None;
        }
    }

    /// Heads for the next place of the way back, if there is one left.
    fn head_back(&mut self) {
        if let Some(place) = self.way_back.next() {
            self.goal = Goal::Place(place);
        }
    }
}

/// How far every axis goes when it stops from full speed.
fn stopping_distances(limits: &Limits) -> AxisVector {
    limits
        .velocity
        .zip_zip_map(&limits.acceleration, &limits.jerk, |v, a, j| {
            let from = Motion { x: 0.0, v, a: 0.0 };
            if v < Limits::UNLIMITED {
                Profile::to_stop(from, &Bounds { v, a, j }).end().x
            } else {
                0.0
            }
        })
}
