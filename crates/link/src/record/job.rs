//! The job record, from an operator to the planner's service: a line, some lines, or a program in a file, to be
//! executed; the record of its answer; and the stages of a job as the interpolator knows them.

use super::check::{Fields, RecordError};
use super::code::coded;
use super::{LongText, Record};
use iceoryx2::prelude::ZeroCopySend;

/// How many times its tolerance a program may use, at least and at most.
pub const TOLERANCE_RATIOS: core::ops::RangeInclusive<f64> = 0.1..=10.0;

coded! {
    /// The kind of a job.
    pub enum JobKind {
        /// The text as a line of a program.
        Line = 1,
        /// The program in the file that the text names, in a way that the service can read.
        File = 2,
        /// The lines of the text, one after the other: the first that fails is the last. Nobody else gets in between.
        /// They are read as `LinuxCNC` does, whatever dialect programs are in.
        Sequence = 3,
    }
}

coded! {
    /// The wish of a client about a job.
    pub enum JobWish {
        /// It is to be executed. Sent again with the same `client` and `number`, it asks how the job
        /// stands.
        Execute = 1,
        /// How it stands. A service that knows nothing of it does not begin it.
        Ask = 2,
        /// It is to end: it does not begin, or the motion comes to rest on the path.
        Cancel = 3,
    }
}

/// A request about a job: to execute a line or a file, or a wish about one handed in before.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.JobRequest.v5")]
pub struct JobRequest {
    /// Who asks: any number that no other client has.
    pub client: u64,
    /// Counts the client's jobs.
    pub number: u64,
    /// When the job was asked for, ns of the host's steady clock, the same in every request for it. An abort
    /// after that ends it, also where the service has not heard of it yet.
    pub asked_ns: u64,
    /// The fingerprint of the program that was looked at and is meant: of a file that has become another program
    /// since nothing is executed. 0 if the file is meant whatever is in it.
    pub program: u64,
    /// How many times the tolerance of the configuration and of the program the motion of a file may use, in
    /// [`TOLERANCE_RATIOS`]; 1: as they say. One that goes on where it was left keeps what it began with.
    pub tolerance_ratio: f64,
    /// Code of a [`JobKind`].
    pub kind: u32,
    /// The line of a file to begin with, 0 for its beginning.
    pub from_line: u32,
    /// At which of the times that this line is executed, from 1; 0 if it begins with none.
    pub pass: u32,
    /// 1 if what was told of the beginning is agreed to, 0 if not.
    pub confirmed: u32,
    /// 1 if the file is to go on where it was left, 0 if not.
    pub resumes: u32,
    /// Code of a [`JobWish`].
    pub wish: u32,
    /// The line or lines, or the name of the file.
    pub text: LongText,
}

impl JobRequest {
    /// A line, lines, or a file from its beginning, whatever is in it.
    #[must_use]
    pub fn new(client: u64, number: u64, kind: JobKind, text: &str, asked_ns: u64) -> Self {
        Self {
            client,
            number,
            asked_ns,
            program: 0,
            tolerance_ratio: 1.0,
            kind: kind.code(),
            from_line: 0,
            pass: 0,
            confirmed: 0,
            resumes: 0,
            wish: JobWish::Execute.code(),
            text: LongText::new(text),
        }
    }

    /// What is to be executed.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn kind(&self) -> Result<JobKind, RecordError> {
        Fields(Self::NAME).code("kind", self.kind)
    }

    /// The wish about the job.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn wish(&self) -> Result<JobWish, RecordError> {
        Fields(Self::NAME).code("wish", self.wish)
    }

    /// The same job with another wish.
    #[must_use]
    pub const fn wishing(self, wish: JobWish) -> Self {
        Self {
            wish: wish.code(),
            ..self
        }
    }
}

impl Record for JobRequest {
    const NAME: &'static str = "glidepath.JobRequest.v5";

    fn check(&self) -> Result<(), RecordError> {
        let fields = Fields(Self::NAME);
        self.kind()?;
        self.wish()?;
        let (low, high) = TOLERANCE_RATIOS.into_inner();
        fields.range("tolerance_ratio", self.tolerance_ratio, low, high)?;
        fields.flags("confirmed", self.confirmed, 1)?;
        fields.flags("resumes", self.resumes, 1)?;
        self.text.check(Self::NAME, "text")
    }
}

coded! {
    /// The state of a job, as its client is told.
    pub enum JobState {
        /// It waits for the machine, or is read, checked, planned or executed: the text says which.
        Running = 1,
        /// It was executed to its end.
        Done = 2,
        /// It was refused; nothing has changed, and nothing moved.
        Refused = 3,
        /// It ended before its end: by an abort, a fault or its client.
        Failed = 4,
        /// The service does something else.
        Busy = 5,
        /// The machine is not ready for it.
        NotReady = 6,
        /// It begins in a way that has to be agreed to: see the text, and send it again, confirmed.
        ToConfirm = 7,
        /// The service knows nothing of the job: another one was told of it.
        Unknown = 8,
        /// The file is not the program that was looked at. Nothing has changed, and nothing moved.
        Changed = 9,
    }
}

/// The answer to a request about a job.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.JobReply.v3")]
pub struct JobReply {
    /// The client of the request.
    pub client: u64,
    /// The number of the request.
    pub number: u64,
    /// Code of a [`JobState`].
    pub state: u32,
    /// Must be zero.
    pub reserved: u32,
    /// More, for people.
    pub text: LongText,
}

impl JobReply {
    /// The answer to a request.
    #[must_use]
    pub fn new(request: &JobRequest, state: JobState, text: &str) -> Self {
        Self {
            client: request.client,
            number: request.number,
            state: state.code(),
            reserved: 0,
            text: LongText::new(text),
        }
    }

    /// The state of the job.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn state(&self) -> Result<JobState, RecordError> {
        Fields(Self::NAME).code("state", self.state)
    }
}

impl Record for JobReply {
    const NAME: &'static str = "glidepath.JobReply.v3";

    fn check(&self) -> Result<(), RecordError> {
        self.state()?;
        Fields(Self::NAME).zero("reserved", self.reserved)?;
        self.text.check(Self::NAME, "text")
    }
}

coded! {
    /// The phase of a job, as its planner tells the interpolator.
    pub enum JobPhase {
        /// It waits for the machine to be ready.
        Waiting = 1,
        /// It takes the machine, to be read, checked and planned; from then on it is executed.
        Preparing = 2,
        /// It is over, or is given up.
        Over = 3,
    }
}

coded! {
    /// The stage of the job that a planner has told of last, at the interpolator.
    pub enum JobStage {
        /// None has told of any.
        None = 0,
        /// It waits for the machine to be ready.
        Waiting = 1,
        /// It has the machine: it is read, checked and planned, and nothing moves.
        Preparing = 2,
        /// Its first frame was accepted.
        Begun = 3,
        /// Its planner says that it is over, or it has come to its end.
        Over = 4,
        /// It was aborted before anything moved.
        Aborted = 5,
        /// It does not begin for another reason.
        Refused = 6,
    }
}
