//! The configuration that an interpolator is started with.

pub(crate) mod feedback;
pub(crate) mod homing;
pub(crate) mod stops;
pub(crate) mod superposition;

use crate::shared::m_code_waits::MCodeWaits;
use core::time::Duration;
use feedback::FeedbackSettings;
use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::{
    AxisList, JOINTS, JointCompensation, JointLimits, JointWatch, Kinematics as _, Mechanism,
    Trivial,
};
use glidepath_link::ALL_JOINTS;
use glidepath_program::{Limits, TAP_OVERTRAVEL};
use glidepath_realtime::{Mode, Request};
use homing::JointBounds;
use stops::StopSettings;
use superposition::Superposition;

/// The soft limits: where the axes may be, mm or degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SoftLimits {
    /// Lowest position of each axis.
    pub lowest: AxisVector,
    /// Highest position of each axis.
    pub highest: AxisVector,
}

impl SoftLimits {
    /// Anywhere.
    #[must_use]
    pub fn none() -> Self {
        Self {
            lowest: AxisVector::repeat(f64::NEG_INFINITY),
            highest: AxisVector::repeat(f64::INFINITY),
        }
    }

    /// Those of a motion from a place: an axis that stands outside may stay there and come inwards, but goes no
    /// further out.
    pub(crate) fn beginning_at(&self, place: &AxisVector) -> Self {
        Self {
            lowest: self.lowest.inf(place),
            highest: self.highest.sup(place),
        }
    }
}

/// The scheduling of the threads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RealTime {
    /// Whether the interpolator may run without some of what follows.
    pub mode: Mode,
    /// What the real-time thread asks for. The thread that serves the ports asks for a priority
    /// that is lower by ten, on any processor.
    pub request: Request,
}

impl RealTime {
    /// Ordinary threads: for tests and for machines on a desk.
    #[must_use]
    pub fn none() -> Self {
        Self {
            mode: Mode::BestEffort,
            request: Request::default(),
        }
    }
}

/// The settings of moving by hand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JogSettings {
    /// Top speed of each axis in a jog, mm/s or °/s. Above that of its limits it is without effect.
    pub velocity: AxisVector,
    /// The same where the machine does not know where it is.
    pub unhomed_velocity: AxisVector,
    /// Top speed of the way back to the path, mm/s.
    pub return_v: f64,
    /// A jog that goes on as long as it is demanded stops when the last demand is so old.
    pub time_out: Duration,
    /// A wheel that gives a velocity stands when it counted nothing for so long.
    pub wheel_quiet: Duration,
    /// The axis that goes last on the way back to the path.
    pub tool_axis: Axis,
}

impl JogSettings {
    /// As fast as the limits allow, a tenth of that where the machine does not know where it is.
    #[must_use]
    pub fn new(limits: &Limits) -> Self {
        Self {
            velocity: limits.velocity,
            unhomed_velocity: limits.velocity * 0.1,
            return_v: Limits::UNLIMITED,
            time_out: Duration::from_millis(150),
            wheel_quiet: Duration::from_millis(100),
            tool_axis: Axis::Z,
        }
    }
}

/// Axes that may be moved by two joints.
const GANTRIES: usize = 4;

/// A second joint that moves an axis of its own joint. It follows the other, and is squared when
/// both find their home.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gantry {
    /// The joint that it follows, by its index.
    pub master: usize,
    /// By how much the two may differ, mm or degrees, > 0. Beyond it the motion stops.
    pub difference: f64,
}

/// Everything an interpolator depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Config {
    /// Interpolation period, ns: 1 to 10⁹, the same as the planner's.
    pub period_ns: u64,
    /// What each axis can do. Frames that ask for more are refused.
    pub limits: Limits,
    /// What each axis can do whatever the others do at the same time: where joints are not axes, less, so
    /// that no joint has more to do than it can. Motion by hand keeps to that.
    pub hand_limits: Limits,
    /// Where each axis may be. Frames outside are refused.
    pub soft_limits: SoftLimits,
    /// What turns axes into joints.
    pub mechanism: Mechanism,
    /// What each joint can do; without meaning where every axis has a drive of its own. Frames that
    /// ask for more are refused.
    pub joint_limits: JointLimits,
    /// What is taken out of where each joint is told to be; nothing where joints are not axes. It lives as long as
    /// the process, so that the real-time thread reads it without owning or counting anything.
    pub compensation: [Option<&'static JointCompensation>; JOINTS],
    /// What moves an axis in addition to programs; only where joints are axes. Its share of the axis' limits, and its
    /// range of the travel, are not in `limits` and `soft_limits`.
    pub superposition: Option<Superposition>,
    /// Second joints. They come after those of the mechanism, in this order; only where joints are
    /// axes.
    pub gantries: [Option<Gantry>; GANTRIES],
    /// Where the machine stands at the start.
    pub start_position: AxisVector,
    /// Most frames the planner keeps published ahead of the executed one: at rest in the middle of
    /// a trajectory, motion goes on when so many have come, or less.
    pub horizon_frames: u64,
    /// How the machine is moved by hand.
    pub jog: JogSettings,
    /// How the threads are scheduled.
    pub real_time: RealTime,
    /// Ticks that may be missed within a second before the motion stops with a fault; `None` for
    /// any number.
    pub missed_ticks_allowed: Option<u64>,
    /// How long the machine waits in the middle of a trajectory for more frames, or for a planner
    /// without any to repeat its last one, before that is a fault; `None` for ever.
    pub planner_lost_after: Option<Duration>,
    /// How the drives' feedback is judged; `None` if there is none: then the drives are taken to do
    /// what the setpoints say, and always to be on and homed.
    pub feedback: Option<FeedbackSettings>,
    /// The M codes that are to be answered before the motion goes on.
    pub m_code_waits: MCodeWaits,
    /// What stops spindle and coolant together with the motion.
    pub stops: StopSettings,
    /// The least and the highest spindle override, ratios.
    pub spindle_override: [f64; 2],
    /// Revolutions for which a tap goes on at most from where the spindle is told to turn back, > 0.
    /// There it stops in its hole, with a fault.
    pub tap_overtravel: f64,
    /// Ends the process at the first system call of the real-time thread other than the sleep and
    /// the clock. For tests; [`run`](crate::run) does not return then.
    pub forbid_system_calls: bool,
}

impl Config {
    /// A machine with the given limits and period, without soft limits, at zero, on ordinary
    /// threads, that 0.6 s of motion is published ahead for.
    #[must_use]
    pub fn new(limits: Limits, period_ns: u64) -> Self {
        Self {
            period_ns,
            limits,
            hand_limits: limits,
            soft_limits: SoftLimits::none(),
            mechanism: Mechanism::Trivial(Trivial::new(AxisList::new(&Axis::ALL))),
            joint_limits: JointLimits::NONE,
            compensation: [None; JOINTS],
            superposition: None,
            gantries: [None; GANTRIES],
            start_position: AxisVector::zeros(),
            horizon_frames: 600_000_000 / period_ns.max(1),
            jog: JogSettings::new(&limits),
            real_time: RealTime::none(),
            missed_ticks_allowed: None,
            planner_lost_after: Some(Duration::from_secs(2)),
            feedback: None,
            m_code_waits: MCodeWaits::NONE,
            stops: StopSettings::default(),
            spindle_override: [0.5, 1.2],
            tap_overtravel: TAP_OVERTRAVEL,
            forbid_system_calls: false,
        }
    }

    /// The judge of the joints' motion, where joints are not axes.
    #[must_use]
    pub fn joint_watch(&self) -> Option<JointWatch> {
        let is_trivial = matches!(self.mechanism, Mechanism::Trivial(_));
        (!is_trivial).then(|| JointWatch::new(self.mechanism, self.joint_limits, self.period_t()))
    }

    /// The joints of the machine, one bit each, J0 lowest.
    #[must_use]
    pub fn joints(&self) -> u32 {
        let count = self.mechanism.joints() + self.gantries.iter().flatten().count();
        let count = u32::try_from(count).unwrap_or(u32::BITS);
        ALL_JOINTS & 1_u32.checked_shl(count).map_or(u32::MAX, |bit| bit - 1)
    }

    /// Second joints by their index, with what they follow.
    pub(crate) fn second_joints(&self) -> impl Iterator<Item = (usize, Gantry)> {
        let first = self.mechanism.joints();
        let gantries = self.gantries.into_iter().flatten().enumerate();
        gantries.map(move |(index, gantry)| (first + index, gantry))
    }

    /// The axis of each joint, where joints are axes.
    pub(crate) fn axis_of_joint(&self) -> Option<[Option<Axis>; JOINTS]> {
        let Mechanism::Trivial(trivial) = &self.mechanism else {
            return None;
        };
        let mut of_joint = [None; JOINTS];
        for (slot, axis) in of_joint.iter_mut().zip(trivial.axes.iter()) {
            *slot = Some(axis);
        }
        for (joint, gantry) in self.second_joints() {
            let axis = of_joint.get(gantry.master).copied().flatten();
            if let Some(slot) = of_joint.get_mut(joint) {
                *slot = axis;
            }
        }
        Some(of_joint)
    }

    /// The limits of each joint.
    #[must_use]
    pub fn joint_bounds(&self) -> [JointBounds; JOINTS] {
        let mut bounds = self.joint_limits.0.map(|limit| JointBounds {
            velocity: limit.velocity,
            acceleration: limit.acceleration,
            jerk: limit.jerk,
        });
        let of_joint = self.axis_of_joint().unwrap_or_default();
        for (bounds, axis) in bounds.iter_mut().zip(of_joint) {
            let Some(axis) = axis.map(Axis::index) else {
                continue;
            };
            let of = |limits: &AxisVector| limits.get(axis).copied().unwrap_or(f64::MAX);
            *bounds = JointBounds {
                velocity: of(&self.limits.velocity),
                acceleration: of(&self.limits.acceleration),
                jerk: of(&self.limits.jerk),
            };
        }
        bounds
    }

    /// The period in seconds.
    #[must_use]
    pub fn period_t(&self) -> f64 {
        Duration::from_nanos(self.period_ns).as_secs_f64()
    }
}
