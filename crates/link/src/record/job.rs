//! An operator to the planner's service: a line, or a program in a file, to be executed.

use super::check::{Fields, RecordError};
use super::code::coded;
use super::{LongText, Record};
use iceoryx2::prelude::ZeroCopySend;

coded! {
    /// What is to be executed.
    pub enum JobKind {
        /// The text as a line of a program.
        Line = 1,
        /// The program in the file that the text names, in a way that the service can read.
        File = 2,
    }
}

/// Something to execute. Sent again with the same `client` and `number`, it asks how it stands.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.JobRequest.v1")]
pub struct JobRequest {
    /// Who asks: any number that no other client has.
    pub client: u64,
    /// Counts the client's jobs.
    pub number: u64,
    /// Code of a [`JobKind`].
    pub kind: u32,
    /// The line of a file to begin with, 0 for its beginning.
    pub from_line: u32,
    /// At which of the times that this line is executed, from 1; 0 if it begins with none.
    pub pass: u32,
    /// 1 if what was told of the beginning is agreed to, 0 if not.
    pub confirmed: u32,
    /// The line, or the name of the file.
    pub text: LongText,
}

impl JobRequest {
    /// A line, or a file from its beginning.
    #[must_use]
    pub fn new(client: u64, number: u64, kind: JobKind, text: &str) -> Self {
        Self {
            client,
            number,
            kind: kind.code(),
            from_line: 0,
            pass: 0,
            confirmed: 0,
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
}

impl Record for JobRequest {
    const NAME: &'static str = "glidepath.JobRequest.v1";

    fn check(&self) -> Result<(), RecordError> {
        let fields = Fields(Self::NAME);
        self.kind()?;
        fields.flags("confirmed", self.confirmed, 1)?;
        self.text.check(Self::NAME, "text")
    }
}

coded! {
    /// How a job stands.
    pub enum JobState {
        /// It is being read, planned or executed.
        Running = 1,
        /// It was executed to its end.
        Done = 2,
        /// It was refused; nothing has changed, and nothing moved.
        Refused = 3,
        /// It ended before its end: by an abort or a fault.
        Failed = 4,
        /// The service does something else.
        Busy = 5,
        /// The machine is not ready for it.
        NotReady = 6,
        /// It begins in a way that has to be agreed to: see the text, and send it again, confirmed.
        ToConfirm = 7,
    }
}

/// How a job stands.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.JobReply.v1")]
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

    /// How the job stands.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn state(&self) -> Result<JobState, RecordError> {
        Fields(Self::NAME).code("state", self.state)
    }
}

impl Record for JobReply {
    const NAME: &'static str = "glidepath.JobReply.v1";

    fn check(&self) -> Result<(), RecordError> {
        self.state()?;
        Fields(Self::NAME).zero("reserved", self.reserved)?;
        self.text.check(Self::NAME, "text")
    }
}
