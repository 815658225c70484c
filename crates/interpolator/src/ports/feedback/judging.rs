//! The judgement of what the drives say: following errors, joints that are apart, and joints on
//! their way home.

use super::drive_monitor::DriveMonitor;
use super::following::Finding;
use super::joint_ownership::Joints;
use crate::ports::homing::{HomingInputs, IndexSeen, Outcome, Seen};
use crate::shared::config::homing::IndexPulse;
use crate::shared::fault::Fault;
use crate::shared::message::{Order, TickReport};
use glidepath_kinematics::JOINTS;
use glidepath_link::{FaultCause, Power};

/// After a hand-over, joints are not judged for so long.
const SETTLING_NS: u64 = 100_000_000;

/// Share of what is allowed by which two joints of an axis may be apart before power goes.
const APART_CUT_R: f64 = 2.0;

/// Two joints of an axis are apart.
fn apart_fault(joint: usize, difference: f64, allowed: f64, report: &TickReport) -> Fault {
    let (line, sequence) = report.place();
    Fault {
        joint: Some(joint),
        value: difference,
        limit: allowed,
        ..Fault::new(FaultCause::FollowingError, line, sequence)
    }
}

impl DriveMonitor {
    /// Compares the joints with their demands. Returns what is to be ordered for it, and what is to
    /// be told.
    pub(crate) fn judge(&mut self, report: &TickReport) -> (Option<Order>, Option<String>) {
        let joints = self.ownership.joints();
        let loss = self.judge_loss(&joints, report);
        if loss.is_some() {
            return (loss, None);
        }
        if report.power != Power::On {
            self.following.rest();
            return (None, None);
        }
        let is_stopping = report.fault.is_some() || self.ordered;
        let judged = self.all & joints.enabled & !report.setpoint.home;
        let (mut order, mut told) = (None, None);
        let (line, sequence) = report.place();
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
                ..Fault::new(FaultCause::FollowingError, line, sequence)
            };
            match found {
                None => {}
                Some(Finding::Warn(error, limit)) => {
                    told = Some(format!(
                        "joint J{joint} follows with an error of {error:.4} mm or °, where {limit:.4} is allowed"
                    ));
                }
                Some(Finding::Stop(error, limit)) => {
                    order = order.or(Some(Order::Fault(fault(error, limit))));
                }
                Some(Finding::Cut(error, limit)) => order = Some(Order::Cut(fault(error, limit))),
            }
        }
        if order.is_none() && !self.sequencer.is_busy() {
            order = self.judge_pairs(&joints, report);
        }
        let contact = self.judge_contact(report);
        order = order.or(contact);
        self.ordered |= order.is_some();
        (order, told)
    }

    /// Whether the probe touched something that nobody looked for.
    fn judge_contact(&mut self, report: &TickReport) -> Option<Order> {
        let is_touched = self.probe.take_touched() && report.fault.is_none();
        let (line, sequence) = report.place();
        is_touched.then(|| Order::Fault(Fault::new(FaultCause::ProbeContact, line, sequence)))
    }

    /// Whether the two joints of an axis are apart.
    fn judge_pairs(&self, joints: &Joints, report: &TickReport) -> Option<Order> {
        self.pairs.iter().find_map(|pair| {
            let apart = self.apart(joints, pair)?;
            let fault = apart_fault(pair.joints.1, apart, pair.difference, report);
            if apart > APART_CUT_R * pair.difference {
                return Some(Order::Cut(fault));
            }
            (apart > pair.difference && report.fault.is_none()).then_some(Order::Fault(fault))
        })
    }

    /// What is known of why a fault was latched, beside the fault.
    pub(crate) fn explain(&mut self, fault: &Fault) -> Option<String> {
        let (cause, why) = self.why.take()?;
        (cause == fault.cause).then_some(why)
    }

    /// Sees to joints on their way home. Returns what is to be ordered for it.
    pub(crate) fn advance_homing(&mut self, report: &TickReport, now_ns: u64) -> Option<Order> {
        if !self.sequencer.is_busy() {
            return None;
        }
        let joints = self.ownership.joints();
        let mut seen = [Seen::default(); JOINTS];
        for (joint, seen) in seen.iter_mut().enumerate() {
            let homing = self.settings.joints[joint].homing;
            let index = homing.and_then(|homing| homing.index);
            *seen = Seen {
                now_ns,
                place: report.setpoint.joint_position[joint],
                actual: joints.position[joint],
                rests: false,
                is_closed: joints.home_switch & (1 << joint) != 0,
                rising: joints.edges[joint].rising,
                falling: joints.edges[joint].falling,
                index: match index {
                    None => IndexSeen::default(),
                    Some(IndexPulse::Input(input)) => IndexSeen {
                        latched: self.ownership.latched(joint, input),
                        ..IndexSeen::default()
                    },
                    Some(IndexPulse::Drive) => IndexSeen {
                        kept: self.ownership.index_kept(joint),
                        ..IndexSeen::default()
                    },
                },
            };
        }
        let (order, outcome) = self.sequencer.turn(&HomingInputs {
            now_ns,
            moved: report.moved,
            seen: &seen,
        });
        self.ownership.forget_edges(self.sequencer.take_forgotten());
        let order = order.map(Order::Joints);
        match outcome {
            Outcome::Pending => order,
            Outcome::Home {
                joints: home,
                offset,
            } => {
                for joint in (0..JOINTS).filter(|joint| home & (1 << joint) != 0) {
                    // At its home a joint is where its table says, on neither side of its play, however it came there.
                    let place = report.setpoint.joint_position[joint] + offset[joint];
                    self.offset[joint] = offset[joint] + self.added(joint, place);
                    self.found_in[joint] = joints.boot_id[joint];
                }
                self.found |= home;
                self.handover += 1;
                order
            }
            Outcome::Failed { joint, why } => {
                let fault = Fault {
                    joint: Some(joint),
                    ..Fault::new(FaultCause::Homing, 0, 0)
                };
                self.why = Some((FaultCause::Homing, why.to_string()));
                Some(Order::Fault(fault))
            }
            Outcome::Apart {
                joint,
                difference,
                allowed,
            } => {
                let fault = apart_fault(joint, difference, allowed, report);
                let why = "it and the other joint of its axis went apart on their way home";
                self.why = Some((FaultCause::FollowingError, why.to_owned()));
                Some(Order::Fault(fault))
            }
        }
    }
}
