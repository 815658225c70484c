//! Why the motion was stopped, as both threads tell each other and people.

use core::fmt;
use glidepath_geometry::Axis;
use glidepath_link::{FaultCause, FrameRefusal};

/// Why the motion was stopped, with what is known of where that was.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fault {
    pub(crate) cause: FaultCause,
    pub(crate) line: u32,
    pub(crate) sequence: u64,
    pub(crate) axis: Option<Axis>,
    /// The joint, by its index, and what its drive says about it.
    pub(crate) joint: Option<usize>,
    pub(crate) drive_fault: u32,
    /// What was found, and what is allowed, in the unit of the limit.
    pub(crate) value: f64,
    pub(crate) limit: f64,
}

impl Fault {
    pub(crate) const fn new(cause: FaultCause, line: u32, sequence: u64) -> Self {
        Self {
            cause,
            line,
            sequence,
            axis: None,
            joint: None,
            drive_fault: 0,
            value: 0.0,
            limit: 0.0,
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.cause {
            FaultCause::Frame(refusal) => {
                write!(f, "frame {} refused: {}", self.sequence, describe(refusal))?;
            }
            FaultCause::PlannerLost => write!(f, "no frames from the planner")?,
            FaultCause::MissedTicks => write!(f, "too many missed ticks")?,
            FaultCause::Output => write!(f, "a setpoint would break a limit")?,
            FaultCause::Ports => write!(f, "the ports are not served")?,
            FaultCause::RealTime => write!(f, "the real-time thread died")?,
            FaultCause::FeedbackLost => write!(f, "the drives do not say where they are")?,
            FaultCause::FollowingError => write!(f, "a joint is too far from where it is to be")?,
            FaultCause::Drive => write!(f, "a drive reports a fault")?,
            FaultCause::EnableLost => write!(f, "a drive lost its power")?,
            FaultCause::AuxTimeout => write!(f, "an event was not acknowledged in time")?,
            FaultCause::AuxFailed => write!(f, "what an event asked for has failed")?,
            FaultCause::SpindleSpeed => write!(f, "the spindle left its speed in a thread")?,
            FaultCause::SpindleAngle => write!(f, "the spindle's angle was lost in a thread")?,
            FaultCause::ThreadLost => write!(f, "the axes could not follow the spindle")?,
            FaultCause::ProbeContact => write!(f, "the probe touched outside of a probing move")?,
            FaultCause::TapOvertravel => write!(f, "a tap went on into its hole for too long")?,
            FaultCause::LimitSwitch => write!(f, "a joint stands at its limit switch")?,
            FaultCause::Homing => write!(f, "a joint did not find its home")?,
        }
        if let Some(joint) = self.joint {
            write!(f, ", joint J{joint}")?;
            if self.drive_fault != 0 {
                write!(f, " (the drive's number {})", self.drive_fault)?;
            }
            if self.limit > 0.0 {
                write!(f, ": {} (allowed {})", self.value, self.limit)?;
            }
        }
        if let Some(axis) = self.axis {
            write!(f, ", axis {axis}: {} (allowed {})", self.value, self.limit)?;
        }
        if self.line > 0 {
            write!(f, ", line {}", self.line)?;
        }
        Ok(())
    }
}

const fn describe(refusal: FrameRefusal) -> &'static str {
    match refusal {
        FrameRefusal::NotFinite => "a number is not finite",
        FrameRefusal::Malformed => "malformed",
        FrameRefusal::Period => "planned with another period",
        FrameRefusal::Epoch => "of an epoch that cannot run now",
        FrameRefusal::Sequence => "a gap in the sequence",
        FrameRefusal::Discontinuous => "does not follow from the frame before",
        FrameRefusal::Velocity => "above the velocity limit",
        FrameRefusal::Acceleration => "above the acceleration limit",
        FrameRefusal::Jerk => "above the jerk limit",
        FrameRefusal::SoftLimit => "outside the soft limits",
        FrameRefusal::NotAtRest => "not at rest where it must be",
        FrameRefusal::Elsewhere => "does not start where the machine stands",
    }
}
