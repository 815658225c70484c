//! The record of program lines, from a sender to the planner's service: lines to be executed one
//! after the other as one job; and the record of what came of them.
//!
//! ```text
//!   lines ──LinesRequest──► taken ──► read ──► executed
//!         ◄──LinesReply──── how far it has come, what was refused, how the machine is set up
//! ```

use super::check::{Fields, RecordError};
use super::code::coded;
use super::{JobWish, LongText, Record, Text};
use glidepath_geometry::AXES;
use iceoryx2::prelude::ZeroCopySend;

/// Coordinate systems that a reply tells: G54 to G59.3.
pub const TOLD_SYSTEMS: usize = 9;

coded! {
    /// The wish of a client about a job that is made of lines.
    pub enum LinesWish {
        /// The lines are to be executed. The first of a job that is not known begin it.
        Execute = 1,
        /// How it stands. Without a job: how the machine is set up.
        Ask = 2,
        /// It ends behind what was read.
        Close = 3,
        /// It is to end: it does not begin, or the motion comes to rest on the path.
        Cancel = 4,
        /// There is no job: as soon as nothing is executed, the modes and offsets in force are to be those of a machine
        /// that was switched on. It is asked again, with the same number, until it is [`LinesState::Done`].
        Reset = 5,
    }
}

impl LinesWish {
    /// The wish about the job as such.
    #[must_use]
    pub const fn of_job(self) -> JobWish {
        match self {
            Self::Execute => JobWish::Execute,
            Self::Ask | Self::Close | Self::Reset => JobWish::Ask,
            Self::Cancel => JobWish::Cancel,
        }
    }
}

/// Lines to be executed, or a question about those that were sent.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.LinesRequest.v2")]
pub struct LinesRequest {
    /// Who asks: any number that no other client has.
    pub client: u64,
    /// Counts the client's jobs, from 1; 0 asks about none.
    pub number: u64,
    /// When the job was asked for, ns of the host's steady clock, the same in every request for it. An abort
    /// after that ends it.
    pub asked_ns: u64,
    /// The number of the first of the lines in the job, from 1. Lines that were taken before are passed over.
    pub first: u64,
    /// How much motion may be planned ahead of what is executed before lines are read no further, s, > 0.
    pub ahead_t: f64,
    /// Code of a [`LinesWish`].
    pub wish: u32,
    /// Must be zero.
    pub reserved: u32,
    /// Who sends the lines, for people.
    pub name: Text,
    /// The lines, each with a line feed at its end.
    pub text: LongText,
}

impl LinesRequest {
    /// The wish about the job.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn wish(&self) -> Result<LinesWish, RecordError> {
        Fields(Self::NAME).code("wish", self.wish)
    }
}

impl Record for LinesRequest {
    const NAME: &'static str = "glidepath.LinesRequest.v2";

    fn check(&self) -> Result<(), RecordError> {
        let fields = Fields(Self::NAME);
        self.wish()?;
        fields.zero("reserved", self.reserved)?;
        fields.range("ahead_t", self.ahead_t, f64::MIN_POSITIVE, 3600.0)?;
        self.name.check(Self::NAME, "name")?;
        self.text.check(Self::NAME, "text")
    }
}

coded! {
    /// The state of a job that is made of lines.
    pub enum LinesState {
        /// The service knows nothing of it, or was asked about none.
        Unknown = 1,
        /// Lines are taken, read and executed, or a reset is not done yet.
        Open = 2,
        /// All that was read was executed, or a reset is done.
        Done = 3,
        /// Likewise, and the line that was read last ended a program.
        ProgramEnd = 4,
        /// It has not begun: see the text.
        NotBegun = 5,
        /// The motion ended before it did: by an abort, a fault or its client.
        Failed = 6,
    }
}

/// The answer about a job that is made of lines.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.LinesReply.v1")]
pub struct LinesReply {
    /// The client of the request.
    pub client: u64,
    /// The number of the request.
    pub number: u64,
    /// Lines of the job that were taken.
    pub taken: u64,
    /// Lines of it that were read and not refused. One that ends at rest, or asks a probe or an input, counts
    /// when it was executed.
    pub read: u64,
    /// Code of a [`LinesState`].
    pub state: u32,
    /// 1 if the line behind those was refused: it has no effect, and the job ends in front of it.
    pub is_refused: u32,
    /// Byte of that line, from 1; 0 if the refusal is about no place.
    pub refused_column: u32,
    /// 1 if lines in front of it were still to be executed when it was refused.
    pub refused_in_motion: u32,
    /// How much motion is planned ahead of what is executed, s; above 0 as long as anything that was read is not
    /// executed.
    pub ahead_t: f64,
    /// Where the zero of programs is for what is executed now: machine coordinates, with all offsets.
    pub zero: [f64; AXES],
    /// The zeros of G54 to G59.3, machine coordinates, behind the line read last.
    pub systems: [[f64; AXES]; TOLD_SYSTEMS],
    /// The places of G28 and G30.
    pub references: [[f64; AXES]; 2],
    /// The offset of G92.
    pub shift: [f64; AXES],
    /// The offset of the tool.
    pub tool: [f64; AXES],
    /// Where the probe found what it looked for last, or where the machine came to rest: machine coordinates.
    pub probe: [f64; AXES],
    /// 1 if it found it.
    pub probe_made: u32,
    /// How often the lines of senders had the probe look.
    pub probes: u32,
    /// The stable name of the diagnostic of a line that was refused.
    pub diagnostic: Text,
    /// The codes and words in force behind the line read last, as a line would say them.
    pub words: Text,
    /// More about the line that was refused, or about the end of the job, for people.
    pub text: LongText,
}

impl LinesReply {
    /// The state of the job.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn state(&self) -> Result<LinesState, RecordError> {
        Fields(Self::NAME).code("state", self.state)
    }
}

impl Record for LinesReply {
    const NAME: &'static str = "glidepath.LinesReply.v1";

    fn check(&self) -> Result<(), RecordError> {
        let fields = Fields(Self::NAME);
        self.state()?;
        fields.flags("is_refused", self.is_refused, 1)?;
        fields.flags("refused_in_motion", self.refused_in_motion, 1)?;
        fields.flags("probe_made", self.probe_made, 1)?;
        fields.finite("ahead_t", self.ahead_t)?;
        fields.all_finite("zero", &self.zero)?;
        for system in self.systems.iter().chain(&self.references) {
            fields.all_finite("systems", system)?;
        }
        fields.all_finite("shift", &self.shift)?;
        fields.all_finite("tool", &self.tool)?;
        fields.all_finite("probe", &self.probe)?;
        self.diagnostic.check(Self::NAME, "diagnostic")?;
        self.words.check(Self::NAME, "words")?;
        self.text.check(Self::NAME, "text")
    }
}
