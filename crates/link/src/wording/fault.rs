//! Faults: what happened, where, and what clears it.

use super::amount::apart;
use crate::record::{FaultCause, FrameRefusal, RecordError, Status};
use core::fmt;
use glidepath_geometry::Axis;

impl FaultCause {
    /// Every cause.
    pub fn all() -> impl Iterator<Item = Self> {
        (1..0x200).filter_map(Self::from_code)
    }

    /// What happened.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Frame(refusal) => refusal.text(),
            Self::PlannerLost => "no more frames came: the planner died or hangs",
            Self::MissedTicks => "too many ticks were missed",
            Self::Output => "a computed setpoint broke a limit",
            Self::Ports => {
                "a port to other processes failed, or the thread that serves the ports hangs"
            }
            Self::RealTime => "the real-time thread died",
            Self::FeedbackLost => "the drives no longer say where they are",
            Self::FollowingError => "a joint is too far from where it is to be",
            Self::Drive => "a drive reports a fault",
            Self::EnableLost => "a drive lost its power",
            Self::AuxTimeout => "an event was not acknowledged in time",
            Self::AuxFailed => "what an event asked for has failed",
            Self::ProbeContact => "the probe touched outside of a probing move",
            Self::SpindleSpeed => {
                "in a thread the spindle left 50 to 109 % of its speed, and the thread is not finished"
            }
            Self::SpindleAngle => "in a thread the spindle's angle was not told, or made no sense",
            Self::ThreadLost => {
                "in a thread the axes could not follow the spindle, or frames ran out"
            }
            Self::TapOvertravel => {
                "a tap went on into its hole for spindle.overtravel revolutions, and stands in it: \
                 the spindle did not turn back"
            }
            Self::LimitSwitch => "a joint stands at its limit switch",
            Self::Homing => "a joint did not find its home",
            Self::SetpointsLost => "the drives heard no setpoints",
            Self::DeviceLost => "a device on the bus of the drives is lost",
            Self::BusLost => "the bus of the drives was lost",
            Self::SpindleDrive => "the drive of the spindle has failed",
            Self::SpindleGear => "the gear of the spindle is not in",
        }
    }

    /// The remedy of the fault: what to do about it. It ends in what clears the fault.
    #[must_use]
    pub const fn remedy(self) -> &'static str {
        match self {
            Self::Frame(FrameRefusal::Elsewhere) => {
                "`glidepath reset`, then start the program again"
            }
            Self::Frame(_) => {
                "keep the recording and report it, unless two planners ran; `glidepath reset`"
            }
            Self::PlannerLost => {
                "read in the planner's log why; `glidepath reset`, then start the program again; where it is a \
                 file, --resume goes on with it, or says why that cannot be"
            }
            Self::MissedTicks => {
                "`glidepath doctor` says what keeps this host from being in time; `glidepath reset`"
            }
            Self::Output => "keep the recording and report it; `glidepath reset`",
            Self::Ports => "read in the interpolator's log what failed; `glidepath reset`",
            Self::RealTime => {
                "read in the interpolator's log why; start it again: `glidepath interpolator`"
            }
            Self::FeedbackLost => {
                "see that the servo stack runs and nothing holds it up; `glidepath reset`, then \
                 `glidepath enable` where the power is gone, and `glidepath home` where joints are not \
                 homed"
            }
            Self::FollowingError => {
                "look what keeps the joint back; `glidepath disable`, `glidepath reset`, \
                 `glidepath enable`"
            }
            Self::Drive => "mend what the drive reports; `glidepath reset`, `glidepath enable`",
            Self::EnableLost => {
                "release the emergency stop, or mend what took the power; `glidepath reset`, \
                 `glidepath enable`"
            }
            Self::AuxTimeout => {
                "answer in time, or give timeout_s of the M code more; `glidepath reset`"
            }
            Self::AuxFailed => "mend what failed; `glidepath reset`",
            Self::ProbeContact => {
                "look what the probe touched; `glidepath reset`, then jog it free"
            }
            Self::SpindleSpeed | Self::ThreadLost => {
                "free the tool by hand, and begin the thread again with a slower spindle; \
                 `glidepath reset`"
            }
            Self::SpindleAngle => {
                "free the tool by hand, and look at the spindle's encoder; `glidepath reset`"
            }
            Self::TapOvertravel => {
                "free the tap by hand, and look why the spindle did not turn back; `glidepath reset`"
            }
            Self::LimitSwitch => {
                "`glidepath reset`, jog the joint off the switch, and compare the soft limits with it"
            }
            Self::Homing => {
                "look at the joint's switch, and at the direction of its search; `glidepath reset`, \
                 then `glidepath enable` where the power is gone, and `glidepath home`"
            }
            Self::SetpointsLost => {
                "`glidepath doctor` says what holds this host up; `glidepath reset`, `glidepath enable`"
            }
            Self::DeviceLost => {
                "look at its supply, and at the cable before it; `glidepath reset`, `glidepath enable`"
            }
            Self::BusLost => {
                "look at the supply of its devices, and at the cable to them; `glidepath reset`, \
                 `glidepath enable`"
            }
            Self::SpindleDrive => "mend what the drive reports; `glidepath reset`",
            Self::SpindleGear => {
                "look at the gearbox, and at the input that tells the gear; `glidepath reset`, then M41 to M45"
            }
        }
    }

    /// What its numbers are: of which power of the time.
    const fn per_time(self) -> &'static str {
        match self {
            Self::Frame(FrameRefusal::Velocity) => "/s",
            Self::Frame(FrameRefusal::Acceleration) => "/s²",
            Self::Frame(FrameRefusal::Jerk) => "/s³",
            Self::Frame(
                FrameRefusal::NotFinite
                | FrameRefusal::Malformed
                | FrameRefusal::Period
                | FrameRefusal::Epoch
                | FrameRefusal::Sequence
                | FrameRefusal::Discontinuous
                | FrameRefusal::SoftLimit
                | FrameRefusal::NotAtRest
                | FrameRefusal::Elsewhere,
            )
            | Self::PlannerLost
            | Self::MissedTicks
            | Self::Output
            | Self::Ports
            | Self::RealTime
            | Self::FeedbackLost
            | Self::FollowingError
            | Self::Drive
            | Self::EnableLost
            | Self::AuxTimeout
            | Self::LimitSwitch
            | Self::Homing
            | Self::AuxFailed
            | Self::SpindleSpeed
            | Self::SpindleAngle
            | Self::ThreadLost
            | Self::ProbeContact
            | Self::TapOvertravel
            | Self::SetpointsLost
            | Self::DeviceLost
            | Self::BusLost
            | Self::SpindleDrive
            | Self::SpindleGear => "",
        }
    }

    /// Whether whoever found it has said more in the status' last error.
    const fn is_explained(self) -> bool {
        matches!(self, Self::AuxFailed | Self::Homing | Self::Ports)
    }
}

impl FrameRefusal {
    /// The text of the refusal: what is wrong with the frame.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::NotFinite => "a frame was refused: a number in it is not finite",
            Self::Malformed => "a frame was refused: it is malformed",
            Self::Period => "a frame was refused: it was planned with another period",
            Self::Epoch => "a frame was refused: it is of an epoch that cannot run now",
            Self::Sequence => "a frame was refused: one before it is missing",
            Self::Discontinuous => "a frame was refused: it does not follow from the one before",
            Self::Velocity => "a frame was refused: it is above the velocity limit",
            Self::Acceleration => "a frame was refused: it is above the acceleration limit",
            Self::Jerk => "a frame was refused: it is above the jerk limit",
            Self::SoftLimit => "a frame was refused: it is outside the soft limits",
            Self::NotAtRest => "a frame was refused: it is not at rest where it must be",
            Self::Elsewhere => "a frame was refused: it does not start where the machine stands",
        }
    }
}

/// A fault with what is known of its place, in one clause.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaultReport {
    /// What happened.
    pub cause: FaultCause,
    /// The axis, if it has one.
    pub axis: Option<Axis>,
    /// The joint, by its index, if it has one.
    pub joint: Option<usize>,
    /// What the drive of the joint says about it, 0 for nothing.
    pub drive_fault: u32,
    /// What was found, in the unit of the limit. Of setpoints that were lost how long there were none, s; of a
    /// device that is lost its place in the line, below 0 where that is not known.
    pub value: f64,
    /// What is allowed, mm or degrees by the time that the cause has, s for an age, or a count; 0 for nothing.
    pub limit: f64,
    /// Source line, 0 for none.
    pub line: u32,
}

impl fmt::Display for FaultReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.cause.text())?;
        self.write_loss(f)?;
        if let Some(joint) = self.joint {
            write!(f, ", joint J{joint}")?;
        }
        if self.drive_fault != 0 {
            write!(f, ", the drive's number {}", self.drive_fault)?;
        }
        if let Some(axis) = self.axis {
            write!(f, ", axis {axis}")?;
        }
        if self.limit != 0.0 && self.cause == FaultCause::FeedbackLost {
            let (age, allowed) = apart(self.value, self.limit);
            write!(
                f,
                ": what they said last is {age} s old, where {allowed} s is allowed"
            )?;
        } else if self.value != 0.0 && self.cause == FaultCause::MissedTicks {
            // Counts, which are whole.
            let (missed, allowed) = (self.value, self.limit);
            write!(f, ": {missed} within a second, where {allowed} are allowed")?;
        } else if self.limit != 0.0 && !self.cause.is_loss() {
            let (value, limit) = apart(self.value, self.limit);
            // Which joints turn is known to the mechanism alone.
            let (unit, per_time) = (self.axis.map(unit), self.cause.per_time());
            let unit = unit.map_or_else(
                || format!("mm{per_time} or °{per_time}"),
                |unit| format!("{unit}{per_time}"),
            );
            write!(f, ", {value} where {limit} {unit} is allowed")?;
        }
        if self.line > 0 {
            write!(f, ", line {}", self.line)?;
        }
        Ok(())
    }
}

impl FaultReport {
    /// What a servo stack has lost, in its own unit.
    fn write_loss(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (cause, value) = (self.cause, self.value);
        if cause == FaultCause::SetpointsLost && value > 0.0 {
            write!(f, " for {:.0} ms", value * 1e3)
        } else if cause == FaultCause::DeviceLost && value >= 0.0 {
            write!(f, ": the one at position {value:.0} of the line")
        } else if cause == FaultCause::DeviceLost {
            f.write_str(": one that says that it is in OP")
        } else if cause == FaultCause::SpindleDrive && value > 0.0 {
            write!(f, ": its number {value:.0}")
        } else if cause == FaultCause::SpindleDrive {
            f.write_str(": it has no power")
        } else if cause == FaultCause::SpindleGear && value > 0.0 {
            write!(f, ": gear {value:.0} (M{:.0})", 40.0 + value)
        } else if cause == FaultCause::SpindleGear {
            f.write_str(": inputs tell none, and no program has named one")
        } else {
            Ok(())
        }
    }
}

const fn unit(axis: Axis) -> &'static str {
    if axis.is_rotary() { "°" } else { "mm" }
}

impl Status {
    /// The latched fault, if there is one.
    ///
    /// # Errors
    ///
    /// A cause that this version does not know.
    pub fn fault_report(&self) -> Result<Option<FaultReport>, RecordError> {
        Ok(self.fault()?.map(|cause| FaultReport {
            cause,
            axis: self.fault_axis(),
            joint: self.fault_joint(),
            drive_fault: self.drive_fault,
            value: self.fault_value,
            limit: self.fault_limit,
            line: self.fault_line,
        }))
    }

    /// The latched fault in words, if there is one, with what whoever found it says.
    #[must_use]
    pub fn fault_text(&self) -> Option<String> {
        let report = self.fault_report().ok().flatten()?;
        let (mut text, said) = (report.to_string(), self.last_error.as_str());
        if report.cause.is_explained() && !said.is_empty() && !text.contains(said) {
            text.push_str(": ");
            text.push_str(said);
        }
        Some(text)
    }
}

#[cfg(test)]
mod tests;
