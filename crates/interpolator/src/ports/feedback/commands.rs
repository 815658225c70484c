//! The commands about drives and joints: whether they are possible, and what concerns the count.

use super::drive_monitor::DriveMonitor;
use super::joint_ownership::Joints;
use crate::shared::message::TickReport;
use glidepath_kinematics::JOINTS;
use glidepath_link::{Command, MachineState, Power, UnmetPrecondition};

/// How far from zero a joint may be said to be, mm or degrees: as far as the ends of a travel may be.
const FARTHEST_SAID: f64 = 1e6;

impl DriveMonitor {
    /// Judges a command about drives and joints, and carries out what concerns their count. Returns
    /// whether the real-time thread has to know of it.
    ///
    /// # Errors
    /// Why it is not possible.
    pub(crate) fn command(
        &mut self,
        command: Command,
        report: &TickReport,
        now_ns: u64,
    ) -> Result<bool, UnmetPrecondition> {
        match command {
            Command::Enable => self.enable(report, now_ns).map(|()| true),
            Command::SetPosition { joint, position } => self
                .set_position(joint as usize, position, report)
                .map(|()| false),
            Command::Home(mask) => self.home(mask, report, now_ns),
            Command::Unhome(mask) => {
                refuse_at_fault(report)?;
                refuse(rests(report), UnmetPrecondition::NotAtRest)?;
                self.unhomed |= mask & self.all;
                self.search.give_up(mask);
                self.found &= !mask;
                Ok(false)
            }
            Command::Abort if report.state != MachineState::Faulted => {
                self.sequencer.drop_job();
                self.search.give_up(self.all);
                Ok(true)
            }
            Command::Disable => {
                self.search.give_up(self.all);
                Ok(true)
            }
            Command::Ping
            | Command::Hold
            | Command::Resume
            | Command::FeedOverride(_)
            | Command::RapidOverride(_)
            | Command::StopAtEndOfBlock
            | Command::SingleBlock(_)
            | Command::Step
            | Command::Return
            | Command::Acknowledge { .. }
            | Command::JogOverride(_)
            | Command::SpindleOverride(_)
            | Command::Reverse
            | Command::Forward
            | Command::Job { .. }
            | Command::Tell => Ok(true),
            Command::Reset => {
                self.sequencer.drop_job();
                self.reset(report, now_ns).map(|()| true)
            }
            // Without a program, what is left to abort is a latched fault. Where that cannot be cleared now, nothing is.
            Command::Abort => {
                self.sequencer.drop_job();
                Ok(self.reset(report, now_ns).is_ok())
            }
        }
    }

    /// Whether a fault would not come again at once: a joint that does not stand where it was told
    /// to be is not led from there, nor one whose drive is silent or reports a fault. Without power nobody is led.
    fn reset(&self, report: &TickReport, now_ns: u64) -> Result<(), UnmetPrecondition> {
        if report.power != Power::On {
            return Ok(());
        }
        let joints = self.ownership.joints();
        refuse(
            self.is_fresh(&joints, now_ns),
            UnmetPrecondition::NoPosition,
        )?;
        refuse(joints.fault == 0, UnmetPrecondition::DriveFault)?;
        let mut pairs = self.pairs.iter();
        let are_apart = pairs.any(|pair| {
            let apart = self.apart(&joints, pair);
            apart.is_some_and(|apart| apart > pair.difference)
        });
        let stays_apart = self.following.is_beyond() || are_apart;
        refuse(!stays_apart, UnmetPrecondition::StaysApart)
    }

    /// Whether joints are on their way home by the controller, or about to be.
    pub(crate) const fn is_homing(&self) -> bool {
        self.sequencer.is_busy()
    }

    fn enable(&self, report: &TickReport, now_ns: u64) -> Result<(), UnmetPrecondition> {
        let joints = self.ownership.joints();
        let is_clear = report.state != MachineState::Faulted;
        refuse(is_clear, UnmetPrecondition::FaultLatched)?;
        let is_off = report.state == MachineState::Off && report.power == Power::Off;
        refuse(is_off, UnmetPrecondition::PowerAsked)?;
        refuse(
            self.is_fresh(&joints, now_ns),
            UnmetPrecondition::NoPosition,
        )?;
        refuse(self.has_pose, UnmetPrecondition::NoPose)?;
        refuse(joints.fault == 0, UnmetPrecondition::DriveFault)
    }

    /// Whether the drives say where they are.
    fn is_fresh(&self, joints: &Joints, now_ns: u64) -> bool {
        let stale_ns = self.settings.stale_after.as_nanos();
        u128::from(self.age_ns(joints, now_ns)) <= stale_ns
    }

    fn set_position(
        &mut self,
        joint: usize,
        position: f64,
        report: &TickReport,
    ) -> Result<(), UnmetPrecondition> {
        refuse_at_fault(report)?;
        refuse(rests(report), UnmetPrecondition::NotAtRest)?;
        refuse(
            position.abs() <= FARTHEST_SAID,
            UnmetPrecondition::NoSuchPosition,
        )?;
        let is_own = joint < JOINTS && self.all & (1 << joint) != 0;
        refuse(is_own, UnmetPrecondition::NoSuchJoint)?;
        let is_second = self.pairs.iter().any(|pair| pair.joints.1 == joint);
        refuse(!is_second, UnmetPrecondition::SecondJoint)?;
        let counted = if report.power == Power::On {
            report.setpoint.joint_position[joint]
        } else {
            let joints = self.ownership.joints();
            refuse(
                joints.claimed & (1 << joint) != 0,
                UnmetPrecondition::Unreported,
            )?;
            joints.position[joint]
        };
        let place = self.place_of(joint, position);
        let offset = place + self.added(joint, place) - counted;
        let shift = offset - self.offset[joint];
        self.offset[joint] = offset;
        self.unhomed |= 1 << joint;
        self.search.give_up(1 << joint);
        self.found &= !(1 << joint);
        for pair in self.pairs.iter().filter(|pair| pair.joints.0 == joint) {
            self.offset[pair.joints.1] += shift;
            self.found &= !(1 << pair.joints.1);
        }
        self.handover += 1;
        Ok(())
    }

    fn home(
        &mut self,
        mask: u32,
        report: &TickReport,
        now_ns: u64,
    ) -> Result<bool, UnmetPrecondition> {
        refuse_at_fault(report)?;
        let is_homing = report.state == MachineState::Homing;
        refuse(!is_homing, UnmetPrecondition::HomingAlready)?;
        refuse(
            report.state != MachineState::Off,
            UnmetPrecondition::NeedsPower,
        )?;
        refuse(rests(report), UnmetPrecondition::NotAtRest)?;
        let can = mask != 0 && mask & !self.homes == 0;
        refuse(can, UnmetPrecondition::NoHome)?;
        let here = mask & self.sequencer.joints();
        if here != 0 {
            let is_free = report.power == Power::On && !self.sequencer.is_busy();
            refuse(is_free, UnmetPrecondition::HomingAlready)?;
            let begun = self.sequencer.begin(here, now_ns);
            self.found &= !begun;
            return Ok(false);
        }
        for joint in (0..JOINTS).filter(|joint| mask & (1 << joint) != 0) {
            self.offset[joint] = 0.0;
        }
        self.unhomed |= mask;
        self.search.begin(mask, now_ns);
        Ok(true)
    }
}

fn refuse_at_fault(report: &TickReport) -> Result<(), UnmetPrecondition> {
    let is_clear = report.state != MachineState::Faulted;
    refuse(is_clear, UnmetPrecondition::FaultLatched)
}

const fn refuse(is_possible: bool, why: UnmetPrecondition) -> Result<(), UnmetPrecondition> {
    if is_possible { Ok(()) } else { Err(why) }
}

fn rests(report: &TickReport) -> bool {
    use MachineState::{Idle, NotHomed, Off};
    matches!(report.state, Off | NotHomed | Idle)
}
