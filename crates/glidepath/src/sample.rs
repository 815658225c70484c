//! A sample: one setpoint as reports and plots see it, whether it was planned or received.

use glidepath_audit::diagnosis::{Binding, Deviation, Diagnosis};
use glidepath_geometry::AxisVector;
use glidepath_kinematics::JointVector;
use glidepath_link::{MachineState, Setpoint};
use glidepath_program::{Frame, FrameFlags};

/// The machine at one tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TickSample {
    /// Index on the period grid.
    pub tick: u64,
    /// Seconds since tick 0.
    pub time_t: f64,
    /// Source line of the motion, 0 before the first.
    pub line: u32,
    /// What the machine does, one lower-case word.
    pub state: &'static str,
    /// True in a rapid move.
    pub rapid: bool,
    /// The limit that binds, where that is known.
    pub binding: Option<Binding>,
    /// How far it is from the programmed path, where that is known.
    pub deviation: Option<Deviation>,
    /// The speed that the program wants, mm/s, infinite for a rapid; 0 where that is not known.
    pub programmed_v: f64,
    /// Rate of path position, mm/s.
    pub feed_v: f64,
    /// Path position since the start of the program, mm.
    pub path_s: f64,
    /// mm or degrees.
    pub position: AxisVector,
    /// mm/s or °/s.
    pub velocity: AxisVector,
    /// mm/s² or °/s².
    pub acceleration: AxisVector,
    /// Positions of the joints, mm or degrees.
    pub joints: JointVector,
}

impl TickSample {
    /// The sample of a planned frame, whose joints are `joints`.
    #[must_use]
    pub fn planned(frame: &Frame, period_t: f64, joints: JointVector) -> Self {
        Self {
            tick: frame.sequence,
            #[allow(
                clippy::cast_precision_loss,
                reason = "2^53 periods are a million years"
            )]
            time_t: frame.sequence as f64 * period_t,
            line: frame.line,
            state: "running",
            rapid: frame.flags.contains(FrameFlags::RAPID),
            binding: None,
            deviation: None,
            programmed_v: 0.0,
            feed_v: frame.path_v,
            path_s: frame.path_s,
            position: frame.position,
            velocity: frame.velocity,
            acceleration: frame.acceleration,
            joints,
        }
    }

    /// The same sample, with the limit that binds in the period it ends, and what the diagnosis
    /// knows of its place.
    #[must_use]
    pub const fn diagnosed(self, binding: Binding, diagnosis: &Diagnosis) -> Self {
        Self {
            binding: Some(binding),
            deviation: Some(diagnosis.deviation()),
            programmed_v: diagnosis.feed_v(),
            ..self
        }
    }

    /// The sample of a setpoint that was received.
    #[must_use]
    pub fn received(setpoint: &Setpoint, period_t: f64) -> Self {
        Self {
            tick: setpoint.tick,
            #[allow(
                clippy::cast_precision_loss,
                reason = "2^53 periods are a million years"
            )]
            time_t: setpoint.tick as f64 * period_t,
            line: setpoint.line,
            state: setpoint.state().map_or("unknown", MachineState::name),
            rapid: setpoint.has(FrameFlags::RAPID),
            binding: None,
            deviation: None,
            programmed_v: 0.0,
            feed_v: setpoint.feed_v,
            path_s: setpoint.path_s,
            position: setpoint.position.into(),
            velocity: setpoint.velocity.into(),
            acceleration: setpoint.acceleration.into(),
            joints: setpoint.joint_position.into(),
        }
    }
}
