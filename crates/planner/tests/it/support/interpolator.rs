//! An interpolator that executes one frame a tick and tells its status: no scaling, no checks, no
//! clock. It is driven by the planner's own pauses, so tests run as fast as they can and always
//! alike.

use std::collections::VecDeque;
use std::time::Duration;

use glidepath_geometry::AxisVector;
use glidepath_link::{
    Command, CommandReply, CommandRequest, EndOfEpoch, FaultCause, JobPhase, JobStage,
    MachineState, Publisher, Server, SetpointFrame, Status, Subscriber, Text, Transport,
};
use glidepath_program::FrameFlags;

use super::items::PERIOD_NS;

const BOOT_ID: u64 = 77;

pub(crate) struct Interpolator {
    frames: Box<dyn Subscriber<SetpointFrame>>,
    status: Box<dyn Publisher<Status>>,
    commands: Box<dyn Server<CommandRequest, CommandReply>>,
    queue: VecDeque<SetpointFrame>,
    capacity: usize,
    /// Frames that must be queued before it moves on after starving.
    pub(crate) resume_at: usize,
    now_ns: u64,
    due_ns: u64,
    state: MachineState,
    end: EndOfEpoch,
    epoch: u64,
    received: u64,
    fault: Option<FaultCause>,
    pub(crate) position: AxisVector,
    pub(crate) executed: Vec<SetpointFrame>,
    pub(crate) deepest: usize,
    pub(crate) starved: u64,
    /// Times the last frame came again.
    pub(crate) repeated: u64,
    /// What it was told that the program says.
    pub(crate) told: Vec<String>,
    /// The job told of last, and how it stands.
    job: (u64, JobStage),
    /// What was being done for jobs.
    pub(crate) doings: Vec<String>,
    /// Why the job does not begin.
    job_end: &'static str,
    /// No epoch up to this number begins.
    barred: u64,
    /// Refuses the first frame of an epoch.
    pub(crate) refuses: bool,
}

impl Interpolator {
    pub(crate) fn new(transport: &dyn Transport, capacity: usize) -> Self {
        Self {
            frames: transport.frame_source().unwrap(),
            status: transport.status_sink().unwrap(),
            commands: transport.command_server().unwrap(),
            queue: VecDeque::new(),
            capacity,
            resume_at: 1,
            now_ns: 0,
            due_ns: 0,
            state: MachineState::Idle,
            end: EndOfEpoch::None,
            epoch: 0,
            received: 0,
            fault: None,
            position: AxisVector::zeros(),
            executed: Vec::new(),
            deepest: 0,
            starved: 0,
            repeated: 0,
            told: Vec::new(),
            job: (0, JobStage::None),
            doings: Vec::new(),
            job_end: "",
            barred: 0,
            refuses: false,
        }
    }

    /// How the job told of last stands.
    pub(crate) const fn job_stage(&self) -> JobStage {
        self.job.1
    }

    /// The number that the next epoch has to have.
    fn next_epoch(&self) -> u64 {
        self.epoch.max(self.barred) + 1
    }

    /// The job that is to come does not begin.
    pub(crate) fn end_job(&mut self, stage: JobStage, why: &'static str) {
        if matches!(self.job.1, JobStage::Waiting | JobStage::Preparing) {
            self.barred = self.next_epoch();
            (self.job.1, self.job_end) = (stage, why);
        }
    }

    fn hear_job(&mut self, number: u64, phase: JobPhase, text: &str) {
        if self.doings.last().is_none_or(|last| last != text) {
            self.doings.push(text.to_owned());
        }
        if self.job.0 != number {
            (self.job, self.job_end) = ((number, JobStage::Waiting), "");
        }
        self.job.1 = match (self.job.1, phase) {
            (JobStage::Waiting, JobPhase::Preparing) if self.state == MachineState::Idle => {
                JobStage::Preparing
            }
            (JobStage::Aborted | JobStage::Refused, _) => self.job.1,
            (_, JobPhase::Over) => JobStage::Over,
            (stage, _) => stage,
        };
    }

    /// Lets time pass.
    pub(crate) fn pass(&mut self, time: Duration) {
        self.now_ns += u64::try_from(time.as_nanos()).unwrap();
        while self.due_ns <= self.now_ns {
            self.due_ns += PERIOD_NS;
            self.tick();
        }
    }

    pub(crate) fn fail(&mut self, cause: FaultCause) {
        (self.state, self.fault) = (MachineState::Faulted, Some(cause));
        if self.end == EndOfEpoch::Open {
            self.end = EndOfEpoch::Faulted;
        }
        self.queue.clear();
    }

    pub(crate) fn reset(&mut self) {
        (self.state, self.fault) = (MachineState::Idle, None);
    }

    pub(crate) fn abort(&mut self) {
        self.end_job(JobStage::Aborted, "aborted before anything moved");
        if self.end == EndOfEpoch::Open {
            self.end = EndOfEpoch::Aborted;
        }
        self.state = MachineState::Idle;
        self.queue.clear();
    }

    pub(crate) const fn state(&self) -> MachineState {
        self.state
    }

    pub(crate) const fn end(&self) -> EndOfEpoch {
        self.end
    }

    fn tick(&mut self) {
        self.serve();
        self.receive();
        self.execute();
        let status = self.status_record();
        self.status.publish(&status).unwrap();
    }

    fn serve(&mut self) {
        let mut commands = Vec::new();
        let state = self.state;
        let mut answer = |request: &CommandRequest| {
            commands.push((request.command().unwrap(), *request));
            CommandReply::new(BOOT_ID, request.number, Ok(()), state, "")
        };
        while self.commands.serve(&mut answer).unwrap() {}
        for (command, request) in commands {
            match command {
                Command::Tell => self.told.push(request.text.as_str().to_owned()),
                Command::Abort => self.abort(),
                Command::Reset => self.reset(),
                Command::Job { number, phase, .. } => {
                    self.hear_job(number, phase, request.text.as_str());
                }
                other => panic!("not simulated: {other:?}"),
            }
        }
    }

    fn receive(&mut self) {
        while self.queue.len() < self.capacity {
            let Some(frame) = self.frames.take().unwrap() else {
                break;
            };
            if self.state == MachineState::Faulted {
                continue;
            }
            if frame.epoch <= self.barred {
                continue;
            }
            if frame.epoch != self.epoch && self.refuses {
                self.end_job(JobStage::Refused, "it stands elsewhere");
                continue;
            }
            if frame.epoch != self.epoch {
                if self.job.1 == JobStage::Preparing {
                    self.job.1 = JobStage::Begun;
                }
                assert_eq!(self.state, MachineState::Idle, "a new epoch while one runs");
                assert!(frame.has(FrameFlags::FIRST), "an epoch without beginning");
                assert_eq!(
                    AxisVector::from(frame.position),
                    self.position,
                    "starts elsewhere"
                );
                (self.epoch, self.received, self.end) = (frame.epoch, 0, EndOfEpoch::Open);
                self.state = MachineState::Running;
            } else if self.end != EndOfEpoch::Open {
                continue;
            }
            if frame.sequence + 1 == self.received {
                self.repeated += 1;
                continue;
            }
            assert_eq!(frame.sequence, self.received, "a gap");
            self.received += 1;
            self.queue.push_back(frame);
        }
        self.deepest = self.deepest.max(self.queue.len());
    }

    fn execute(&mut self) {
        if self.state == MachineState::Starved && self.queue.len() >= self.resume_at {
            self.state = MachineState::Running;
        }
        if self.state != MachineState::Running {
            return;
        }
        let Some(frame) = self.queue.pop_front() else {
            self.state = MachineState::Starved;
            self.starved += 1;
            return;
        };
        self.position = AxisVector::from(frame.position);
        if frame.has(FrameFlags::LAST) {
            (self.state, self.end) = (MachineState::Idle, EndOfEpoch::Completed);
        }
        self.executed.push(frame);
    }

    fn status_record(&self) -> Status {
        let mut status: Status = bytemuck::Zeroable::zeroed();
        status.boot_id = BOOT_ID;
        status.updated_ns = self.due_ns;
        status.period_ns = PERIOD_NS;
        status.epoch = self.epoch;
        status.frames_received = self.received;
        status.frames_executed = self.received - self.queue.len() as u64;
        status.state = self.state.code();
        status.end_of_epoch = self.end.code();
        status.fault = self.fault.map_or(0, FaultCause::code);
        status.position = self.position.into();
        status.block = self.executed.last().map_or(0, |frame| frame.block);
        status.last_error = Text::new("");
        status.next_epoch = self.next_epoch();
        (status.job_number, status.job_stage) = (self.job.0, self.job.1.code());
        status.job_end = Text::new(self.job_end);
        if self.job.1 == JobStage::Preparing && self.state == MachineState::Idle {
            status.state = MachineState::Preparing.code();
        }
        status
    }
}
