//! What the ports thread keeps of the drives.

use super::claims::{Claims, Joints};
use super::demands::Demands;
use super::following::{Finding, FollowingErrors};
use super::observation::Observation;
use super::settings::FeedbackSettings;
use crate::config::Config;
use crate::message::{Fault, Order, Report};
use glidepath_geometry::AxisVector;
use glidepath_kinematics::{JOINTS, JointVector, Kinematics as _, Mechanism};
use glidepath_link::{Command, FaultCause, Feedback, MachineState, Power, Status};

/// Slower than this a joint is at rest, mm/s or °/s: more than a count in a millisecond.
const REST_V: f64 = 1.0;
/// After a hand-over, joints are not judged for so long.
const SETTLING_NS: u64 = 100_000_000;

/// The drives as their feedback shows them.
#[derive(Debug)]
pub(crate) struct DriveBook {
    settings: FeedbackSettings,
    mechanism: Mechanism,
    /// Joints of the machine, one bit each, as all that follow.
    all: u32,
    /// Those that have to find their home.
    homes: u32,
    claims: Claims,
    demands: Demands,
    following: FollowingErrors,
    /// What is added to the drives' count.
    offset: JointVector,
    /// Joints whose drives say that they know where they are, and are not believed.
    unhomed: u32,
    handover: u64,
    /// Where the axes were last, to choose among positions that belong to the same joints.
    near: AxisVector,
    was_on: bool,
    /// Whether an error was ordered for and the thread has not yet latched it.
    ordered: bool,
}

impl DriveBook {
    pub(crate) fn new(config: &Config, settings: FeedbackSettings) -> Self {
        let all = config.joints();
        let ns = |time: core::time::Duration| u64::try_from(time.as_nanos()).unwrap_or(u64::MAX);
        let homes = (0..JOINTS)
            .filter(|joint| settings.joints.get(*joint).is_some_and(|joint| joint.homes))
            .fold(0, |mask, joint| mask | 1 << joint);
        Self {
            settings,
            mechanism: config.mechanism,
            all,
            homes: homes & all,
            claims: Claims::new(all, ns(settings.off_after), ns(settings.stale_after)),
            demands: Demands::new(),
            following: FollowingErrors::default(),
            offset: JointVector::zeros(),
            unhomed: 0,
            handover: 0,
            near: config.start_position,
            was_on: false,
            ordered: false,
        }
    }

    /// Takes what a stack sends.
    ///
    /// # Errors
    /// Why it is not used, for the log; an empty text if that was said before.
    pub(crate) fn take(&mut self, feedback: &Feedback, now_ns: u64) -> Result<(), String> {
        self.claims.take(feedback, now_ns)
    }

    /// Takes note of a setpoint that was published.
    pub(crate) fn note(&mut self, report: &Report) {
        let is_on = report.power == Power::On;
        if is_on && !self.was_on {
            self.following.begin();
        }
        self.was_on = is_on;
        self.ordered &= report.fault.is_none() && is_on;
        self.demands.push(&report.setpoint);
    }

    /// What the real-time thread is to know now.
    pub(crate) fn observe(&mut self, report: &Report, now_ns: u64) -> Observation {
        let joints = self.claims.joints();
        let setpoint = &report.setpoint;
        let follows = if report.power == Power::On {
            setpoint.home
        } else {
            self.all
        };
        let mut position = JointVector::zeros();
        for joint in (0..JOINTS).filter(|joint| self.all & (1 << joint) != 0) {
            let counted = if follows & (1 << joint) == 0 {
                setpoint.joint_position[joint]
            } else {
                joints.position[joint]
            };
            position[joint] = counted + self.offset[joint];
        }
        let age_ns = self.age_ns(&joints, now_ns);
        let axes = self.mechanism.forward(&position, &self.near);
        if let Ok(axes) = axes {
            self.near = axes;
        }
        let lowest_fault = joints.fault.trailing_zeros() as usize;
        Observation {
            age_ns,
            is_known: age_ns != u64::MAX && axes.is_ok(),
            rests: joints.velocity.iter().all(|v| v.abs() < REST_V),
            joints: position,
            axes: self.near,
            offset: self.offset,
            enabled: joints.enabled,
            homed: self.homed(&joints),
            homing: joints.homing,
            faults: joints.fault,
            limits: joints.limits,
            fault_code: joints.fault_code.get(lowest_fault).copied().unwrap_or(0),
            handover: self.handover,
        }
    }

    /// How old the oldest sample of a joint is.
    fn age_ns(&self, joints: &Joints, now_ns: u64) -> u64 {
        if joints.claimed != self.all {
            return u64::MAX;
        }
        let samples = joints.sample_ns.iter().enumerate();
        samples
            .filter(|(joint, _)| self.all & (1 << joint) != 0)
            .map(|(_, sample_ns)| now_ns.saturating_sub(*sample_ns))
            .max()
            .unwrap_or(0)
    }

    fn homed(&self, joints: &Joints) -> u32 {
        (self.all & !self.homes) | (joints.homed & !self.unhomed & self.homes)
    }

    /// Compares the joints with their demands. Returns what is to be ordered for it, and what is to
    /// be told.
    pub(crate) fn judge(&mut self, report: &Report) -> (Option<Order>, Option<String>) {
        let joints = self.claims.joints();
        if report.power != Power::On {
            self.following.rest();
            return (None, None);
        }
        let is_stopping = report.fault.is_some() || self.ordered;
        let judged = self.all & joints.enabled & !report.setpoint.home;
        let (mut order, mut told) = (None, None);
        for joint in (0..JOINTS).filter(|joint| judged & (1 << joint) != 0) {
            let sample_ns = joints.sample_ns[joint];
            if sample_ns < self.demands.since_ns().saturating_add(SETTLING_NS) {
                continue;
            }
            let Some(demand) = self.demands.at(joint, sample_ns) else {
                continue;
            };
            let (position, allowed) = (joints.position[joint], &self.settings.joints[joint]);
            let found = self
                .following
                .judge(joint, &demand, position, allowed, is_stopping);
            let fault = |value, limit| Fault {
                joint: Some(joint),
                value,
                limit,
                ..Fault::new(
                    FaultCause::FollowingError,
                    report.setpoint.line,
                    report.setpoint.sequence,
                )
            };
            match found {
                None => {}
                Some(Finding::Warn(error, limit)) => {
                    told = Some(format!(
                        "joint J{joint} follows with an error of {error:.4} (allowed {limit:.4})"
                    ));
                }
                Some(Finding::Stop(error, limit)) => {
                    order = order.or(Some(Order::Fault(fault(error, limit))));
                }
                Some(Finding::Cut(error, limit)) => order = Some(Order::Cut(fault(error, limit))),
            }
        }
        self.ordered |= order.is_some();
        (order, told)
    }

    /// Judges a command about drives and joints, and carries out what concerns their count. Returns
    /// whether the real-time thread has to know of it.
    ///
    /// # Errors
    /// Why it is not possible.
    pub(crate) fn command(
        &mut self,
        command: Command,
        report: &Report,
        now_ns: u64,
    ) -> Result<bool, String> {
        use MachineState::{Idle, NotHomed, Off};
        let joints = self.claims.joints();
        let refuse = |is_possible: bool, why: &str| {
            if is_possible {
                Ok(())
            } else {
                Err(why.to_owned())
            }
        };
        match command {
            Command::Enable => {
                let is_clear = report.state != MachineState::Faulted;
                refuse(is_clear, "a fault is latched: reset it first")?;
                let is_off = report.state == Off && report.power == Power::Off;
                refuse(is_off, "the drives are on, or were asked to be")?;
                let stale_ns = self.settings.stale_after.as_nanos();
                let is_fresh = u128::from(self.age_ns(&joints, now_ns)) <= stale_ns;
                refuse(is_fresh, "the drives do not say where they are")?;
                refuse(joints.fault == 0, "a drive reports a fault")?;
                Ok(true)
            }
            Command::SetPosition { joint, position } => {
                refuse(
                    matches!(report.state, Off | NotHomed | Idle),
                    "the machine has to be at rest, without a program",
                )?;
                let joint = joint as usize;
                let is_own = joint < JOINTS && self.all & (1 << joint) != 0;
                refuse(is_own, "the machine has no such joint")?;
                let counted = if report.power == Power::On {
                    report.setpoint.joint_position[joint]
                } else {
                    refuse(
                        joints.claimed & (1 << joint) != 0,
                        "nobody says where it is",
                    )?;
                    joints.position[joint]
                };
                self.offset[joint] = position - counted;
                self.unhomed |= 1 << joint;
                self.handover += 1;
                Ok(false)
            }
            Command::Home(mask) => {
                refuse(
                    matches!(report.state, NotHomed | Idle),
                    "the drives have to be on and at rest, without a program",
                )?;
                let can = mask != 0 && mask & !self.homes == 0;
                refuse(
                    can,
                    "not all of these joints have a drive that finds a home",
                )?;
                for joint in (0..JOINTS).filter(|joint| mask & (1 << joint) != 0) {
                    self.offset[joint] = 0.0;
                }
                self.unhomed &= !mask;
                Ok(true)
            }
            Command::Unhome(mask) => {
                refuse(
                    matches!(report.state, Off | NotHomed | Idle),
                    "the machine has to be at rest, without a program",
                )?;
                self.unhomed |= mask & self.all;
                Ok(false)
            }
            _ => Ok(true),
        }
    }

    /// Writes what is known of the drives.
    pub(crate) fn write(&self, status: &mut Status, now_ns: u64) {
        let joints = self.claims.joints();
        status.enabled = joints.enabled;
        status.homed = self.homed(&joints);
        status.drive_faults = joints.fault;
        status.feedback_age_ns = self.age_ns(&joints, now_ns);
        status.joint_actual = (JointVector::from(joints.position) + self.offset).into();
        status.following_error = self.following.errors();
        status.following_peak = self.following.peaks();
    }
}
