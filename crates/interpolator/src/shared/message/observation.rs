//! The observation of the drives, which the ports thread tells the real-time thread every turn.

use super::superposition_demand::SuperpositionDemand;
use glidepath_geometry::AxisVector;
use glidepath_kinematics::JointVector;
use glidepath_link::SpindleFlags;

/// Angle and speed of the spindle at one moment, from its samples up to then.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Turn {
    /// When the last sample was measured, ns of `CLOCK_MONOTONIC`; 0 if nobody measures it.
    pub(crate) sample_ns: u64,
    /// Revolutions, never wrapped, whole at the index.
    pub(crate) angle: f64,
    /// rev/s.
    pub(crate) speed: f64,
    /// rev/s².
    pub(crate) acceleration: f64,
    /// There were samples enough to believe that.
    pub(crate) is_settled: bool,
    /// Index pulses so far; `None` if nobody counts them.
    pub(crate) index_count: Option<u64>,
}

impl Turn {
    /// Nobody measures it.
    pub(crate) const NONE: Self = Self {
        sample_ns: 0,
        angle: 0.0,
        speed: 0.0,
        acceleration: 0.0,
        is_settled: false,
        index_count: None,
    };

    /// Angle and speed at a moment near now.
    #[allow(clippy::cast_precision_loss, reason = "moments near each other")]
    pub(crate) fn at(&self, at_ns: u64) -> (f64, f64) {
        let t = if at_ns >= self.sample_ns {
            (at_ns - self.sample_ns) as f64
        } else {
            -((self.sample_ns - at_ns) as f64)
        } * 1e-9;
        (
            self.angle + t * (self.speed + 0.5 * t * self.acceleration),
            self.speed + t * self.acceleration,
        )
    }
}

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
    /// The angle of the spindle, of the stack that measures it.
    pub(crate) turn: Turn,
    /// Number of the last setpoint that every stack has played.
    pub(crate) played: u64,
    /// The epoch in which the probe has found what it looked for, 0 if it has not.
    pub(crate) contact_in: u64,
    /// What slows the program down, 0 to 1.
    pub(crate) adaptive_r: f64,
    /// What is to be added to the motion of an axis.
    pub(crate) superposition: SuperpositionDemand,
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
            turn: Turn::NONE,
            played: 0,
            contact_in: 0,
            adaptive_r: 1.0,
            superposition: SuperpositionDemand::Silent,
        }
    }
}
