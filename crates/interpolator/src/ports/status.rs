//! The status record, and what it is worked out from.

use crate::ports::block_starts::BlockStarts;
use crate::ports::frame_validation::FrameValidator;
use crate::shared::config::Config;
use crate::shared::message::{FRAMES, TickReport};
use crate::shared::track_capacity::TRACK_CAPACITY;
use crate::shared::track_capacity::frames_kept;
use glidepath_geometry::AXES;
use glidepath_kinematics::{JOINTS, JointCompensation};
use glidepath_link::{
    EndOfEpoch, FrameRefusal, Grants, MachineState, MotionMode, Quantiles, Setpoint, SetpointFrame,
    Status, Text,
};
use glidepath_realtime::{Histogram, Item, Mode};

/// The status, and what it is worked out from.
pub(crate) struct StatusBook {
    pub(crate) status: Status,
    block_starts: BlockStarts,
    /// The first frame of an epoch that the real-time thread has not opened.
    entering: Option<SetpointFrame>,
    /// The file that was begun last, and where the machine stood then: lines may have been executed since.
    begun: Option<(u64, [f64; AXES])>,
    /// What is taken out of where joints are told to be.
    compensation: [Option<&'static JointCompensation>; JOINTS],
    lateness: Histogram,
    work: Histogram,
    latency: Histogram,
    response: Histogram,
}

impl StatusBook {
    pub(crate) fn new(config: &Config, boot_id: u64) -> Self {
        let status = Status {
            boot_id,
            period_ns: config.period_ns,
            pid: std::process::id(),
            queue_capacity: u32::try_from(TRACK_CAPACITY + FRAMES).unwrap_or(u32::MAX),
            state: MachineState::Idle.code(),
            joints: config.joints(),
            enabled: config.joints(),
            homed: config.joints(),
            end_of_epoch: EndOfEpoch::None.code(),
            position: config.start_position.into(),
            adaptive_feed: 1.0,
            ..<Status as bytemuck::Zeroable>::zeroed()
        };
        Self {
            status,
            block_starts: BlockStarts::new(frames_kept(config.period_t())),
            entering: None,
            begun: None,
            compensation: config.compensation,
            lateness: Histogram::new(),
            work: Histogram::new(),
            latency: Histogram::new(),
            response: Histogram::new(),
        }
    }

    /// Counts a tick.
    pub(crate) fn count(&mut self, report: &TickReport) {
        if let Some(frame) = self
            .entering
            .take_if(|frame| frame.epoch <= report.setpoint.epoch)
            && frame.epoch == report.setpoint.epoch
        {
            self.enter(&frame);
        }
        if report.setpoint.block != self.status.block {
            self.status.block = report.setpoint.block;
            let path_s = report.setpoint.path_s;
            self.status.block_path_s = self.block_starts.enter(self.status.block, path_s);
        }
        self.lateness.record(report.setpoint.lateness_ns);
        if report.setpoint.number > 0 {
            self.work.record(report.timing.work_ns);
            self.latency.record(report.timing.latency_ns);
        }
    }

    /// Counts a setpoint that has been published: whoever subscribes to it has it by then.
    pub(crate) fn published(&mut self, setpoint: &Setpoint, now_ns: u64) {
        self.status.setpoints_published += 1;
        let response_ns = now_ns.saturating_sub(setpoint.scheduled_ns);
        self.response.record(response_ns);
    }

    /// Counts a refused frame. Returns whether it is the first for its reason.
    pub(crate) fn refused(&mut self, refusal: FrameRefusal) -> bool {
        let Some(count) = self.status.frames_refused.get_mut(refusal.index()) else {
            return false;
        };
        *count += 1;
        *count == 1
    }

    /// A frame passed to the real-time thread.
    pub(crate) fn passed(&mut self, frame: &SetpointFrame) {
        if frame.sequence > 0 {
            return;
        }
        // One that waits goes on: what it said is still to be read.
        if self.status.state != MachineState::Waiting.code() {
            self.message("");
            // Nor is what was told of an error before of the motion that begins.
            self.last_error("");
        }
        self.entering = Some(*frame);
    }

    /// An epoch has begun. The first frame of a program tells which program that is, and where it
    /// starts; that of a planner that goes on with one tells of a block of the same, also behind lines. One that is
    /// aborted before it begins leaves what can be resumed as it was.
    fn enter(&mut self, frame: &SetpointFrame) {
        let begins = frame.block == 0 || frame.path_s <= 0.0;
        let begun = self.begun.filter(|_| !begins);
        let begun = begun.filter(|(program, _)| *program == frame.program);
        if begins || frame.program != self.status.program {
            self.block_starts.forget();
            self.status.program = frame.program;
            self.status.program_start = begun.map_or(frame.position, |(_, start)| start);
        }
        if begins && frame.program != 0 {
            self.begun = Some((frame.program, frame.position));
        }
    }

    pub(crate) fn last_error(&mut self, text: &str) {
        self.status.last_error = Text::new(text);
    }

    /// What the program says.
    pub(crate) fn message(&mut self, text: &str) {
        self.status.message = Text::new(text);
    }

    pub(crate) fn last_event(&mut self, text: &str) {
        self.status.last_event = Text::new(text);
    }

    /// Brings the status up to date. `waiting` frames are between the threads.
    pub(crate) fn write(
        &mut self,
        report: &TickReport,
        frame_validator: &FrameValidator,
        waiting: u64,
        now_ns: u64,
    ) {
        let setpoint = &report.setpoint;
        let opening = frame_validator.entering(setpoint.epoch);
        let is_newer = opening.is_some();
        let status = &mut self.status;
        status.updated_ns = now_ns;
        status.tick = setpoint.tick;
        status.epoch = opening.unwrap_or(setpoint.epoch);
        status.next_epoch = frame_validator.next_epoch(setpoint.epoch);
        status.frames_received = frame_validator.received();
        status.frames_executed = if is_newer { 0 } else { report.frames_executed };
        status.queue_depth = u32::try_from(report.queue_depth + waiting).unwrap_or(u32::MAX);
        status.state = report.state.code();
        status.end_of_epoch = if is_newer {
            EndOfEpoch::Open
        } else {
            report.end_of_epoch
        }
        .code();
        status.line = setpoint.line;
        status.position = setpoint.position;
        status.away = setpoint.away;
        status.superposed = setpoint.superposed;
        let (superposition, freeze_reason) = report.superposition;
        status.superposition = superposition.code();
        status.freeze_reason = freeze_reason.code();
        status.reference = setpoint.reference;
        status.joint_actual = setpoint.joint_position;
        for (joint, by) in self.compensation.iter().enumerate() {
            if let Some(by) = by {
                let at = &mut status.joint_actual[joint];
                *at = by.nominal(*at, report.sides[joint]);
            }
        }
        status.mode = mode(report).code();
        status.power = report.power.code();
        status.path_s = setpoint.path_s;
        status.feed_v = setpoint.feed_v;
        status.feed_override = report.feed_override;
        status.rapid_override = report.rapid_override;
        status.jog_override = report.jog_override;
        status.jog_client = report.jogged.client;
        status.jog_number = report.jogged.number;
        status.effective_override = setpoint.effective_override;
        status.ticks = setpoint.number + 1;
        status.missed_ticks = setpoint.missed_ticks;
        status.late_ticks = report.late_ticks;
        status.setpoints_lost = report.reports_lost;
        status.reserve_stops = report.reserve_stops;
        status.starved_ticks = report.starved_ticks;
        status.single_block = report.single_block.into();
        status.lateness = quantiles(&self.lateness);
        status.work = quantiles(&self.work);
        status.latency = quantiles(&self.latency);
        status.response = quantiles(&self.response);
        status.unanswered = (report.is_unanswered && !is_newer).into();
        let awaited = report.awaited;
        status.awaited_sequence = awaited.map_or(0, |awaited| awaited.sequence);
        status.awaited_since_ns = awaited.map_or(0, |awaited| awaited.since_ns);
        status.awaited_value = awaited.map_or(0.0, |awaited| awaited.event_value);
        status.awaited_kind = awaited.map_or(0, |awaited| awaited.event_kind);
        status.awaited_line = awaited.map_or(0, |awaited| awaited.line);
        self.write_fault(report);
    }

    fn write_fault(&mut self, report: &TickReport) {
        let status = &mut self.status;
        let fault = report.fault;
        status.fault = fault.map_or(0, |fault| fault.cause.code());
        status.fault_line = fault.map_or(0, |fault| fault.line);
        status.fault_sequence = fault.map_or(0, |fault| fault.sequence);
        let axis = fault.and_then(|fault| fault.axis);
        status.fault_axis = axis.map_or(0, |axis| u32::try_from(axis.index() + 1).unwrap_or(0));
        let joint = fault.and_then(|fault| fault.joint);
        status.fault_joint = joint.map_or(0, |joint| u32::try_from(joint + 1).unwrap_or(0));
        status.drive_fault = fault.map_or(0, |fault| fault.drive_fault);
        let finite = |value: f64| if value.is_finite() { value } else { 0.0 };
        status.fault_value = fault.map_or(0.0, |fault| finite(fault.value));
        status.fault_limit = fault.map_or(0.0, |fault| finite(fault.limit));
    }
}

/// What moves the axes.
fn mode(report: &TickReport) -> MotionMode {
    match report.state {
        MachineState::Jogging if report.is_returning => MotionMode::Return,
        MachineState::Jogging => MotionMode::Jog,
        MachineState::Homing => MotionMode::Homing,
        MachineState::Idle
        | MachineState::Running
        | MachineState::Holding
        | MachineState::Held
        | MachineState::Starving
        | MachineState::Starved
        | MachineState::ProgramStop
        | MachineState::Stopping
        | MachineState::Faulted
        | MachineState::Waiting
        | MachineState::Awaiting
        | MachineState::Off
        | MachineState::NotHomed
        | MachineState::Preparing => match report.end_of_epoch {
            EndOfEpoch::Open if report.feed_override.is_sign_negative() => MotionMode::Backwards,
            EndOfEpoch::Open => MotionMode::Program,
            EndOfEpoch::None
            | EndOfEpoch::Completed
            | EndOfEpoch::Aborted
            | EndOfEpoch::Faulted
            | EndOfEpoch::Tripped => MotionMode::None,
        },
    }
}

fn quantiles(histogram: &Histogram) -> Quantiles {
    let q = histogram.quantiles();
    Quantiles {
        p50_ns: q.p50_ns,
        p99_ns: q.p99_ns,
        p999_ns: q.p999_ns,
        max_ns: q.max_ns,
    }
}

/// The grants as bits.
pub(crate) fn grants_of(grants: &glidepath_realtime::Grants, mode: Mode) -> Grants {
    let bits = [
        (Item::Scheduling, Grants::FIFO),
        (Item::Affinity, Grants::PINNED),
        (Item::MemoryLock, Grants::MEMORY_LOCKED),
        (Item::StackPrefault, Grants::PREFAULTED),
        (Item::CpuDmaLatency, Grants::DMA_LATENCY),
    ];
    let start = if mode == Mode::BestEffort {
        Grants::BEST_EFFORT
    } else {
        Grants::default()
    };
    bits.into_iter()
        .filter(|&(item, _)| grants.is_granted(item))
        .fold(start, |all, (_, bit)| all.with(bit))
}
