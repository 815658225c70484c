//! The services of an instance: their names and how much each holds.

/// Planner to interpolator.
pub(crate) const FRAMES: &str = "glidepath/frames";
/// Interpolator to servo stacks.
pub(crate) const SETPOINTS: &str = "glidepath/setpoints";
/// Interpolator to everybody.
pub(crate) const STATUS: &str = "glidepath/status";
/// Interpolator to whatever works spindle, coolant, tools and outputs.
pub(crate) const AUXILIARY: &str = "glidepath/auxiliary";
/// Everybody to the interpolator.
pub(crate) const COMMANDS: &str = "glidepath/commands";
/// Other programs to a listening planner.
pub(crate) const SEGMENTS: &str = "glidepath/segments";

/// Operators to the planner's service.
pub(crate) const JOBS: &str = "glidepath/jobs";

/// Senders of lines to the planner's service.
pub(crate) const LINES: &str = "glidepath/lines";

/// Servo stacks to the interpolator.
pub(crate) const FEEDBACK: &str = "glidepath/feedback";
/// Operators' panels to the interpolator.
pub(crate) const JOG: &str = "glidepath/jog";

/// Publishers of a topic and senders of frames: one that works, and one that bridges to another
/// host or comes in the place of a dead one that is not yet cleaned up.
pub(crate) const SENDERS: usize = 2;
/// Servo stacks and panels: one for every joint, and as many that are dead and not yet cleaned up.
pub(crate) const PEERS: usize = 18;
/// Feedback under way from each stack: those of a period at 1 kHz, and of a turn that came late.
pub(crate) const FEEDBACK_DEPTH: usize = 16;
/// Demands under way from each panel. Only the last counts.
pub(crate) const JOG_DEPTH: usize = 4;
/// Clients of a request-response service.
pub(crate) const CLIENTS: usize = 16;

/// The capacity of the services. All processes of an instance use the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Capacity {
    /// Frames under way from planner to interpolator, ≥ 2.
    pub frames: usize,
    /// Setpoints a subscriber may be behind before it loses the oldest, ≥ 1.
    pub setpoints: usize,
    /// Subscribers of setpoints, and of status, ≥ 1.
    pub subscribers: usize,
}

impl Default for Capacity {
    fn default() -> Self {
        Self {
            frames: 256,
            // Four seconds at 4 ms: on a busy host an ordinary process may not run for half a
            // second.
            setpoints: 1024,
            subscribers: 16,
        }
    }
}
