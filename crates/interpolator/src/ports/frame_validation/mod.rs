//! The validation of frames for the real-time thread.
//!
//! A frame is data from another process. It passes if its numbers are finite, it continues the open
//! epoch (or opens one, at rest, where the machine stands), it follows from the frame before it,
//! and its positions are within the limits of every axis, by the same differences that are
//! published. The first frame of an open epoch that does not pass is a fault, and the epoch gets no
//! more: the motion stops on the frames that did pass.

mod differences;

use crate::shared::config::{Config, SoftLimits};
use crate::shared::fault::Fault;
use crate::shared::m_code_waits::MCodeWaits;
use crate::shared::rest::{SAME_POSITION, is_at_rest};
use differences::{above, jump, outside};
use glidepath_geometry::AxisVector;
use glidepath_kinematics::{JointFault, JointViolation, JointWatch, Quantity};
use glidepath_link::{FaultCause, FrameRefusal, MachineState, Record, RecordError, SetpointFrame};
use glidepath_program::{Event, FrameFlags, Limits};

/// By how much the number of an epoch may be above that of the last. Planners count by one; a frame
/// that took the highest number of all would leave none for the planners after it.
const EPOCH_STEP_MAX: u64 = 1 << 16;
const SYNC: FrameFlags = FrameFlags::SYNC;
/// What became of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum FrameVerdict {
    /// For the real-time thread.
    Pass,
    /// Seen before: a planner that was not sure sends again.
    Known,
    /// Opens an epoch while the present one still moves: offer it again later.
    Later,
    /// Of an epoch that has ended, or does not begin any more: it was on its way before its planner heard of that.
    Late,
    /// The frame is not of the trajectory that is executed; that is nothing to stop for.
    Refused(FrameRefusal),
    /// The trajectory cannot go on.
    Fault(Fault),
}

/// What the ports thread knows of the machine.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MachineSnapshot {
    pub(crate) state: MachineState,
    pub(crate) position: AxisVector,
    /// The last epoch the real-time thread opened, and whether it still is.
    pub(crate) epoch: u64,
    pub(crate) is_open: bool,
}

/// The last frame that passed, with the differences up to it.
#[derive(Debug, Clone, Copy)]
struct Last {
    frame: SetpointFrame,
    first: AxisVector,
    second: AxisVector,
}

/// The judge of frames.
#[derive(Debug)]
pub(crate) struct FrameValidator {
    period_ns: u64,
    m_code_waits: MCodeWaits,
    period_t: f64,
    limits: Limits,
    soft_limits: SoftLimits,
    /// Those of the epoch, which may have begun outside.
    travel: SoftLimits,
    joints: Option<JointWatch>,
    /// The epoch that frames passed of, 0 before the first.
    epoch: u64,
    last: Option<Last>,
    /// The epoch had a frame that did not pass.
    broken: bool,
    /// No epoch up to this number begins any more.
    barred: u64,
    /// What follows the spindle may come: it was announced.
    is_pass: bool,
}

impl FrameValidator {
    pub(crate) fn new(config: &Config) -> Self {
        Self {
            period_ns: config.period_ns,
            m_code_waits: config.m_code_waits,
            period_t: config.period_t(),
            limits: config.limits,
            soft_limits: config.soft_limits,
            travel: config.soft_limits,
            joints: config.joint_watch(),
            epoch: 0,
            last: None,
            broken: false,
            barred: 0,
            is_pass: false,
        }
    }

    /// The number that the next epoch has to have.
    pub(crate) fn next_epoch(&self, machine_epoch: u64) -> u64 {
        self.epoch.max(machine_epoch).max(self.barred) + 1
    }

    /// No epoch up to this number begins any more: it was aborted before it began, or did not begin
    /// as it should have.
    pub(crate) fn bar(&mut self, epoch: u64) {
        self.barred = self.barred.max(epoch);
    }

    /// The epoch that frames passed of, if the real-time thread has not opened it, and may yet.
    pub(crate) fn opening(&self, machine_epoch: u64) -> Option<u64> {
        let is_opening = self.epoch > machine_epoch && !self.broken && !self.is_barred(self.epoch);
        is_opening.then_some(self.epoch)
    }

    /// The same, also where no more frames of it pass: what did pass is still under way.
    pub(crate) fn entering(&self, machine_epoch: u64) -> Option<u64> {
        let is_entering = self.epoch > machine_epoch && !self.is_barred(self.epoch);
        is_entering.then_some(self.epoch)
    }

    /// Whether an epoch does not begin any more.
    pub(crate) const fn is_barred(&self, epoch: u64) -> bool {
        epoch <= self.barred
    }

    /// Frames of the epoch that passed.
    pub(crate) fn received(&self) -> u64 {
        self.last.map_or(0, |last| last.frame.sequence + 1)
    }

    /// Learns what became of the machine.
    pub(crate) fn note(&mut self, machine: &MachineSnapshot) {
        // After a fault, what was under way is dropped: nothing of it will ever be opened.
        self.broken |= machine.state == MachineState::Faulted;
    }

    /// Judges a frame.
    pub(crate) fn judge(
        &mut self,
        frame: &SetpointFrame,
        machine: &MachineSnapshot,
    ) -> FrameVerdict {
        if let Err(error) = frame.check() {
            return self.refuse(frame, refusal_of(&error));
        }
        if self.is_barred(frame.epoch) {
            return FrameVerdict::Late;
        }
        if frame.epoch > self.epoch {
            // Out of the middle of another trajectory: no epoch is to wait, nor to be given up, for it.
            if frame.sequence != 0 || !frame.has(FrameFlags::FIRST) {
                return FrameVerdict::Refused(FrameRefusal::Epoch);
            }
            let verdict = self.open(frame, machine);
            // Its planner has no other first frame: it is to hear that this epoch does not begin.
            if matches!(verdict, FrameVerdict::Refused(_)) && self.is_in_reach(frame.epoch) {
                self.bar(frame.epoch);
            }
            return verdict;
        }
        // An epoch that passed its first frame but is not open any more has ended.
        let is_over = machine.epoch >= frame.epoch && !machine.is_open;
        if frame.epoch < self.epoch {
            return FrameVerdict::Refused(FrameRefusal::Epoch);
        }
        if is_over || self.broken {
            return FrameVerdict::Late;
        }
        let Some(last) = self.last else {
            return FrameVerdict::Refused(FrameRefusal::Epoch);
        };
        if frame.sequence <= last.frame.sequence {
            return FrameVerdict::Known;
        }
        let next = self.follows(frame, &last);
        match next.and_then(|next| self.joints_follow(frame).map(|()| next)) {
            Ok(next) => {
                self.is_pass = announces_pass(frame)
                    || (self.is_pass && (frame.has(SYNC) || !last.frame.has(SYNC)));
                self.last = Some(next);
                FrameVerdict::Pass
            }
            Err(fault) => {
                self.broken = true;
                FrameVerdict::Fault(fault)
            }
        }
    }

    /// A frame whose fields cannot be trusted, not even its epoch: a fault if one is open.
    fn refuse(&mut self, frame: &SetpointFrame, refusal: FrameRefusal) -> FrameVerdict {
        if self.last.is_none() || self.broken || self.is_barred(self.epoch) {
            return FrameVerdict::Refused(refusal);
        }
        self.broken = true;
        FrameVerdict::Fault(Fault::new(
            FaultCause::Frame(refusal),
            frame.line,
            frame.sequence,
        ))
    }

    /// Whether a planner may have counted up to this number.
    fn is_in_reach(&self, epoch: u64) -> bool {
        epoch.saturating_sub(self.epoch.max(self.barred)) <= EPOCH_STEP_MAX
    }

    /// The first frame of a new epoch.
    fn open(&mut self, frame: &SetpointFrame, machine: &MachineSnapshot) -> FrameVerdict {
        if !self.is_in_reach(frame.epoch) {
            return FrameVerdict::Refused(FrameRefusal::Epoch);
        }
        let pending = self.opening(machine.epoch).is_some();
        let moves = machine.is_open && machine.state != MachineState::Starved;
        if pending || moves {
            return FrameVerdict::Later;
        }
        if machine.state == MachineState::Jogging {
            return FrameVerdict::Refused(FrameRefusal::NotAtRest);
        }
        let can_begin = !matches!(
            machine.state,
            MachineState::Faulted
                | MachineState::Off
                | MachineState::NotHomed
                | MachineState::Homing
        );
        if !can_begin {
            return FrameVerdict::Refused(FrameRefusal::Epoch);
        }
        if frame.period_ns != self.period_ns {
            return FrameVerdict::Refused(FrameRefusal::Period);
        }
        if !is_at_rest(frame) {
            return FrameVerdict::Refused(FrameRefusal::NotAtRest);
        }
        if (AxisVector::from(frame.position) - machine.position).amax() > SAME_POSITION {
            return FrameVerdict::Refused(FrameRefusal::Elsewhere);
        }
        if let Some(joints) = &mut self.joints {
            joints.rest();
        }
        if let Err(fault) = self.joints_follow(frame)
            && let FaultCause::Frame(refusal) = fault.cause
        {
            return FrameVerdict::Refused(refusal);
        }
        self.epoch = frame.epoch;
        self.travel = self.soft_limits.beginning_at(&machine.position);
        self.broken = false;
        self.is_pass = announces_pass(frame);
        let zero = AxisVector::zeros();
        self.last = Some(Last {
            frame: *frame,
            first: zero,
            second: zero,
        });
        FrameVerdict::Pass
    }

    /// Whether a frame continues the motion within the limits.
    fn follows(&self, frame: &SetpointFrame, last: &Last) -> Result<Last, Fault> {
        let fault = |refusal| Fault::new(FaultCause::Frame(refusal), frame.line, frame.sequence);
        if frame.sequence != last.frame.sequence + 1 {
            return Err(fault(FrameRefusal::Sequence));
        }
        if frame.period_ns != self.period_ns {
            return Err(fault(FrameRefusal::Period));
        }
        // By the clock it would be another thread.
        if frame.has(SYNC) && !self.is_pass {
            return Err(fault(FrameRefusal::Malformed));
        }
        let must_rest = [FrameFlags::LAST, FrameFlags::PROGRAM_STOP];
        let is_m_code_wait = self.m_code_waits.of_frame(frame).is_some();
        if (is_m_code_wait || must_rest.iter().any(|&flag| frame.has(flag))) && !is_at_rest(frame) {
            return Err(fault(FrameRefusal::NotAtRest));
        }
        let on_axis = |refusal, (axis, value, limit)| Fault {
            axis,
            value,
            limit,
            ..fault(refusal)
        };
        if let Some(found) = outside(frame, &self.travel) {
            return Err(on_axis(FrameRefusal::SoftLimit, found));
        }
        let t = self.period_t;
        let first = AxisVector::from(frame.position) - AxisVector::from(last.frame.position);
        let second = first - last.first;
        let third = second - last.second;
        for (refusal, difference, scale, limit) in [
            (FrameRefusal::Velocity, &first, t, &self.limits.velocity),
            (
                FrameRefusal::Acceleration,
                &second,
                t * t,
                &self.limits.acceleration,
            ),
            (FrameRefusal::Jerk, &third, t * t * t, &self.limits.jerk),
        ] {
            if let Some(found) = above(difference, scale, limit) {
                return Err(on_axis(refusal, found));
            }
        }
        if let Some((refusal, found)) = jump([&last.frame, frame], &self.limits, t) {
            return Err(on_axis(refusal, found));
        }
        Ok(Last {
            frame: *frame,
            first,
            second,
        })
    }

    /// Whether the joints can do a frame.
    fn joints_follow(&mut self, frame: &SetpointFrame) -> Result<(), Fault> {
        let Some(joints) = &mut self.joints else {
            return Ok(());
        };
        joints
            .take(&AxisVector::from(frame.position))
            .map_err(|fault| {
                let refusal = match fault {
                    JointFault::Position(_) => FrameRefusal::SoftLimit,
                    JointFault::Limit(violation) => match violation.quantity {
                        Quantity::Lowest | Quantity::Highest => FrameRefusal::SoftLimit,
                        Quantity::Velocity => FrameRefusal::Velocity,
                        Quantity::Acceleration => FrameRefusal::Acceleration,
                        Quantity::Jerk => FrameRefusal::Jerk,
                    },
                };
                let found = Fault::new(FaultCause::Frame(refusal), frame.line, frame.sequence);
                match fault {
                    JointFault::Limit(JointViolation { value, limit, .. }) => Fault {
                        value,
                        limit,
                        ..found
                    },
                    JointFault::Position(_) => found,
                }
            })
    }
}

/// Whether the motion behind a frame is to follow the spindle.
fn announces_pass(frame: &SetpointFrame) -> bool {
    matches!(frame.event(), Ok(Some(Event::Synchronise { .. })))
}

const fn refusal_of(error: &RecordError) -> FrameRefusal {
    match error {
        RecordError::NotFinite { .. } => FrameRefusal::NotFinite,
        _ => FrameRefusal::Malformed,
    }
}

#[cfg(test)]
mod tests;
