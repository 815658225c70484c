//! The status record, from the interpolator to everybody: what it does and how well.

mod check;

use super::check::{Fields, RecordError};
use super::{
    CodeWords, ContactKind, EndOfEpoch, FRAME_REFUSALS, FaultCause, FreezeReason, Grants, JobStage,
    MachineState, MotionMode, Power, Quantiles, Record as _, SpindleFlags, SuperpositionState,
    Text, event,
};
use glidepath_geometry::{AXES, Axis};
use glidepath_program::Event;
use iceoryx2::prelude::ZeroCopySend;

/// The status of the interpolator: what it does and how well. Counts are of this life of it.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.Status.v16")]
pub struct Status {
    /// Identifies one life of the interpolator.
    pub boot_id: u64,
    /// When this was true, ns of `CLOCK_MONOTONIC`. A reader takes an old one for a dead
    /// interpolator.
    pub updated_ns: u64,
    /// Interpolation period, ns.
    pub period_ns: u64,
    /// Last tick on the time grid.
    pub tick: u64,
    /// The present or last epoch, 0 before the first.
    pub epoch: u64,
    /// Frames of the epoch accepted so far: the sequence of the next one expected.
    pub frames_received: u64,
    /// Frames of the epoch whose instant has come: one more than the sequence executed last.
    pub frames_executed: u64,
    /// Frames accepted but not yet reached.
    pub queue_depth: u32,
    /// Most frames it can hold.
    pub queue_capacity: u32,
    /// Its process.
    pub pid: u32,
    /// Code of a [`MachineState`].
    pub state: u32,
    /// Code of an [`EndOfEpoch`].
    pub end_of_epoch: u32,
    /// Code of a latched [`FaultCause`], 0 for none.
    pub fault: u32,
    /// Source line of the latched fault, 0 if it has none.
    pub fault_line: u32,
    /// Axis of the latched fault, as its index plus one, 0 if it has none.
    pub fault_axis: u32,
    /// Joint of the latched fault, as its index plus one, 0 if it has none.
    pub fault_joint: u32,
    /// The drive's own number of its fault, 0 if there is none.
    pub drive_fault: u32,
    /// Sequence of the frame the latched fault is about.
    pub fault_sequence: u64,
    /// What was measured at the latched fault, in units of the limit it broke.
    pub fault_value: f64,
    /// The limit that was broken.
    pub fault_limit: f64,
    /// Source line being executed, 0 before the first.
    pub line: u32,
    /// Bits of [`Grants`].
    pub grants: u32,
    /// Block of the program being executed, 0 before the first: see
    /// [`super::SetpointFrame::block`].
    pub block: u32,
    /// 1 if the machine rests at the end of every block, 0 if not.
    pub single_block: u32,
    /// The program of the present or last epoch: see [`super::SetpointFrame::program`].
    pub program: u64,
    /// Where the machine stood when that program began, mm or degrees. A planner that goes on with
    /// the program in a new epoch changes neither.
    pub program_start: [f64; AXES],
    /// Axis positions as last commanded, mm or degrees.
    pub position: [f64; AXES],
    /// How far the axes are from the path: see [`super::Setpoint::away`].
    pub away: [f64; AXES],
    /// Code of a [`Power`].
    pub power: u32,
    /// Code of a [`MotionMode`].
    pub mode: u32,
    /// The joints that the machine has, one bit each, J0 lowest.
    pub joints: u32,
    /// The joints whose drives say that they have power.
    pub enabled: u32,
    /// The joints that know where they are.
    pub homed: u32,
    /// The joints whose drives report a fault.
    pub drive_faults: u32,
    /// See [`super::Setpoint::reference`].
    pub reference: u64,
    /// How old the oldest feedback of a joint is, ns; 0 if none is configured, `u64::MAX` before
    /// the first.
    pub feedback_age_ns: u64,
    /// Joint positions as the drives reported them last, in the machine's own count, mm or degrees.
    pub joint_actual: [f64; AXES],
    /// What was commanded of each joint for the moment of its last feedback, less what it reported,
    /// mm or degrees.
    pub following_error: [f64; AXES],
    /// The largest magnitude of that since power came on.
    pub following_peak: [f64; AXES],
    /// Sequence of the frame whose event is awaited; means something if the next field does.
    pub awaited_sequence: u64,
    /// Since when it is awaited, ns of `CLOCK_MONOTONIC`; 0 if nothing is.
    pub awaited_since_ns: u64,
    /// The event's number, as in a setpoint.
    pub awaited_value: f64,
    /// The event's code, as in a setpoint; 0 if nothing is awaited.
    pub awaited_kind: u32,
    /// Its source line.
    pub awaited_line: u32,
    /// Its words, where it is an M code of the machine's own.
    pub awaited_words: CodeWords,
    /// Where the axes really were when the probe found what it looked for in this epoch, mm or
    /// degrees.
    pub contact: [f64; AXES],
    /// Code of a [`ContactKind`].
    pub contact_kind: u32,
    /// 1 if the last epoch was left before the event of its block was done: an M code that nobody
    /// answered, or a program stop that nobody let pass. 0 if not, and while one is open.
    pub unanswered: u32,
    /// Path position, mm.
    pub path_s: f64,
    /// Path position of the first setpoint of the block, mm.
    pub block_path_s: f64,
    /// Rate of path position, mm/s.
    pub feed_v: f64,
    /// Feed override as commanded; below 0 if the motion is to go back along the path.
    pub feed_override: f64,
    /// Rapid override as commanded.
    pub rapid_override: f64,
    /// Part of their speed that jogs have, as commanded, 0 to 1.
    pub jog_override: f64,
    /// Override as executed.
    pub effective_override: f64,
    /// What an input, and the spindle at a feed per revolution, make of both overrides, -1 to 1;
    /// below 0 it turns the motion round. 1 where nothing slows programs down.
    pub adaptive_feed: f64,
    /// Ticks run.
    pub ticks: u64,
    /// Ticks that were not run because the one before took until after them.
    pub missed_ticks: u64,
    /// Ticks that began late, within their period.
    pub late_ticks: u64,
    /// Setpoints handed to the transport.
    pub setpoints_published: u64,
    /// Setpoints lost inside the interpolator.
    pub setpoints_lost: u64,
    /// Stops in reserve that were begun: for want of frames, or because no later stop was found.
    pub reserve_stops: u64,
    /// Ticks in which a motion that had begun slowed or stood for want of frames.
    pub starved_ticks: u64,
    /// Commands served.
    pub commands_served: u64,
    /// Commands refused, among those served.
    pub commands_refused: u64,
    /// Frames refused, by cause: see [`super::FrameRefusal::index`].
    pub frames_refused: [u64; FRAME_REFUSALS],
    /// How late ticks began.
    pub lateness: Quantiles,
    /// How long the work of a tick took, before and at its deadline.
    pub work: Quantiles,
    /// How long the host took to wake the thread before a tick.
    pub latency: Quantiles,
    /// From the deadline of a tick to its setpoint published: whoever subscribes has it.
    pub response: Quantiles,
    /// The number of the job that a planner has told of last, 0 for none.
    pub job_number: u64,
    /// The number that the next epoch has to have. An abort uses it up, so that nothing begins that
    /// was under way.
    pub next_epoch: u64,
    /// Code of a [`JobStage`].
    pub job_stage: u32,
    /// 1 if the job begins held, 0 if not.
    pub job_held: u32,
    /// The last error, for people.
    pub last_error: Text,
    /// The last thing that happened (a change of state, missed ticks, …), for people.
    pub last_event: Text,
    /// What the program of the present or last epoch said last to people: `(MSG, …)`, `(DEBUG, …)`,
    /// the comment of a stop. Empty before it said anything.
    pub message: Text,
    /// The job that a planner has told of last, and what is being done for it, for people.
    pub job: Text,
    /// Why that job does not begin, for people; empty if it may.
    pub job_end: Text,
    /// The client of the jog whose demand was followed last; 0 before the first. While the machine jogs it is whoever
    /// jogs.
    pub jog_client: u64,
    /// The number of that demand: what this client asked for with it has begun, or has been done.
    pub jog_number: u64,
    /// Speed of the spindle as it was measured last, rev/s, negative if it turns backwards; means something
    /// if [`SpindleFlags::SPEED`] is set.
    pub spindle_v: f64,
    /// Bits of [`SpindleFlags`].
    pub spindle_flags: u32,
    /// Code of a [`SuperpositionState`].
    pub superposition: u32,
    /// See [`super::Setpoint::superposed`].
    pub superposed: [f64; AXES],
    /// Code of a [`FreezeReason`].
    pub freeze_reason: u32,
    /// 1 if the job that a planner has told of last is a stream of segments, 0 if not.
    pub job_stream: u32,
    /// Spindle override as commanded; the [`super::Auxiliary`] has what is in force.
    pub spindle_override: f64,
    /// Load of the spindle as it was measured last: the magnitude of its torque as a part of its rated one; means
    /// something if [`SpindleFlags::LOAD`] is set.
    pub spindle_load: f64,
}

/// Drives that have said nothing for so long are silent: nobody knows where they are, ns.
const SILENT_NS: u64 = 500_000_000;

impl Status {
    /// Whether drives that are to say where they are have said nothing for half a second, or nothing yet.
    #[must_use]
    pub const fn drives_are_silent(&self) -> bool {
        self.feedback_age_ns > SILENT_NS
    }

    /// The state of the machine.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn state(&self) -> Result<MachineState, RecordError> {
        Fields(Self::NAME).code("state", self.state)
    }

    /// The end of the epoch.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn end_of_epoch(&self) -> Result<EndOfEpoch, RecordError> {
        Fields(Self::NAME).code("end_of_epoch", self.end_of_epoch)
    }

    /// The event that is awaited, if one is.
    ///
    /// # Errors
    ///
    /// An unknown code, or a number that does not fit it.
    pub fn awaited_event(&self) -> Result<Option<Event>, RecordError> {
        event::decode(Self::NAME, self.awaited_kind, self.awaited_value)
    }

    /// The latched fault.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn fault(&self) -> Result<Option<FaultCause>, RecordError> {
        match self.fault {
            0 => Ok(None),
            code => Fields(Self::NAME).code("fault", code).map(Some),
        }
    }

    /// The axis of the latched fault, if it has one.
    #[must_use]
    pub fn fault_axis(&self) -> Option<Axis> {
        let index = usize::try_from(self.fault_axis).ok()?.checked_sub(1)?;
        Axis::ALL.get(index).copied()
    }

    /// The joint of the latched fault, if it has one.
    #[must_use]
    pub fn fault_joint(&self) -> Option<usize> {
        usize::try_from(self.fault_joint).ok()?.checked_sub(1)
    }

    /// Whether the drives have power.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn power(&self) -> Result<Power, RecordError> {
        Fields(Self::NAME).code("power", self.power)
    }

    /// The mode of motion: what moves the axes.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn mode(&self) -> Result<MotionMode, RecordError> {
        Fields(Self::NAME).code("mode", self.mode)
    }

    /// The finding of the probe in this epoch.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn contact(&self) -> Result<ContactKind, RecordError> {
        Fields(Self::NAME).code("contact_kind", self.contact_kind)
    }

    /// The state of the spindle, as its drive tells.
    #[must_use]
    pub const fn spindle(&self) -> SpindleFlags {
        SpindleFlags(self.spindle_flags)
    }

    /// The stage of the job that a planner has told of last.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn job_stage(&self) -> Result<JobStage, RecordError> {
        Fields(Self::NAME).code("job_stage", self.job_stage)
    }

    /// Whether the job under way is a stream of segments: of its coordinates, offsets and tools nobody knows but the
    /// program that streams.
    #[must_use]
    pub fn is_of_stream(&self) -> bool {
        self.job_stage == JobStage::Begun.code() && self.job_stream == 1
    }

    /// The state of the superposition.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn superposition(&self) -> Result<SuperpositionState, RecordError> {
        Fields(Self::NAME).code("superposition", self.superposition)
    }

    /// The reason why it is frozen.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn freeze_reason(&self) -> Result<FreezeReason, RecordError> {
        Fields(Self::NAME).code("freeze_reason", self.freeze_reason)
    }

    /// The real-time grants.
    #[must_use]
    pub const fn grants(&self) -> Grants {
        Grants(self.grants)
    }
}
