//! What the ports thread tells the real-time thread about the drives, every turn.

use glidepath_geometry::AxisVector;
use glidepath_kinematics::JointVector;
use glidepath_link::SpindleFlags;

/// The drives at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Observation {
    /// How old the oldest sample of a joint was; `u64::MAX` if there is none of some joint.
    pub(crate) age_ns: u64,
    /// Whether it is known where the joints are, and what that means for the axes.
    pub(crate) is_known: bool,
    /// Whether every joint is at rest.
    pub(crate) rests: bool,
    /// Where the joints are that follow themselves (those without power, and those that look for
    /// their home), and where the others were told to be: in the machine's count.
    pub(crate) joints: JointVector,
    /// The axes there.
    pub(crate) axes: AxisVector,
    /// What is to be added to what the drives count.
    pub(crate) offset: JointVector,
    /// Joints by what their drives say, one bit each.
    pub(crate) enabled: u32,
    pub(crate) homed: u32,
    pub(crate) homing: u32,
    pub(crate) faults: u32,
    pub(crate) limits: u32,
    /// The number that the drive of the lowest joint with a fault gives it.
    pub(crate) fault_code: u32,
    /// Counts how often the position got another meaning: a new number asks for a hand-over.
    pub(crate) handover: u64,
    /// Digital inputs and spindle, of all stacks together.
    pub(crate) digital_in: u64,
    pub(crate) spindle: SpindleFlags,
    /// Number of the last setpoint that every stack has played.
    pub(crate) played: u64,
    /// The epoch in which the probe has found what it looked for, 0 if it has not.
    pub(crate) contact_in: u64,
}

impl Observation {
    /// Before the first.
    pub(crate) fn none() -> Self {
        Self {
            age_ns: u64::MAX,
            is_known: false,
            rests: false,
            joints: JointVector::zeros(),
            axes: AxisVector::zeros(),
            offset: JointVector::zeros(),
            enabled: 0,
            homed: 0,
            homing: 0,
            faults: 0,
            limits: 0,
            fault_code: 0,
            handover: 0,
            digital_in: 0,
            spindle: SpindleFlags(0),
            played: 0,
            contact_in: 0,
        }
    }
}
