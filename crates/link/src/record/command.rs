//! The command record, from any client to the interpolator, and the record of its answer.

use super::check::{Fields, RecordError};
use super::code::coded;
use super::{ALL_JOINTS, EventId, HIGHEST_JOINT, JobPhase, Record, Text};
use iceoryx2::prelude::ZeroCopySend;

coded! {
    /// The commands, without their argument.
    pub enum CommandKind {
        /// See [`Command::Ping`].
        Ping = 1,
        /// See [`Command::Hold`].
        Hold = 2,
        /// See [`Command::Resume`].
        Resume = 3,
        /// See [`Command::FeedOverride`].
        FeedOverride = 4,
        /// See [`Command::RapidOverride`].
        RapidOverride = 5,
        /// See [`Command::Abort`].
        Abort = 6,
        /// See [`Command::StopAtEndOfBlock`].
        StopAtEndOfBlock = 7,
        /// See [`Command::SingleBlock`].
        SingleBlock = 8,
        /// See [`Command::Reset`].
        Reset = 9,
        /// See [`Command::Step`].
        Step = 10,
        /// See [`Command::Enable`].
        Enable = 11,
        /// See [`Command::Disable`].
        Disable = 12,
        /// See [`Command::SetPosition`].
        SetPosition = 13,
        /// See [`Command::Home`].
        Home = 14,
        /// See [`Command::Unhome`].
        Unhome = 15,
        /// See [`Command::Return`].
        Return = 16,
        /// See [`Command::Acknowledge`].
        Acknowledge = 17,
        /// See [`Command::JogOverride`].
        JogOverride = 18,
        /// See [`Command::Tell`].
        Tell = 19,
        /// See [`Command::Reverse`].
        Reverse = 20,
        /// See [`Command::Forward`].
        Forward = 21,
        /// See [`Command::Job`].
        Job = 22,
        /// See [`Command::SpindleOverride`].
        SpindleOverride = 23,
    }
}

/// Number of commands.
pub const COMMAND_KINDS: usize = CommandKind::ALL.len();

/// A command with its argument.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Command {
    /// Answer, do nothing.
    Ping,
    /// Feed hold: come to rest on the path.
    Hold,
    /// Go on after a hold, a program stop or the end of a block.
    Resume,
    /// Set the feed override, a ratio of up to [`super::OVERRIDE_MAX`]; below 0 the motion goes back
    /// along the path.
    FeedOverride(f64),
    /// Set the rapid override, a ratio from 0 to [`super::OVERRIDE_MAX`].
    RapidOverride(f64),
    /// Come to rest on the path and end the epoch.
    Abort,
    /// Come to rest at the end of the present block, or of the first after it at which that is
    /// possible.
    StopAtEndOfBlock,
    /// Rest at the end of every block, or do so no longer.
    SingleBlock(bool),
    /// Clear a latched fault.
    Reset,
    /// At rest on the path, go on to the end of the block, and rest there.
    Step,
    /// Give the drives power, and take the position over from them.
    Enable,
    /// Come to rest on the path, end the epoch, and take the power from the drives.
    Disable,
    /// From now on a joint's present position has another number. It is not homed then.
    SetPosition {
        /// Which, 0 to 8.
        joint: u32,
        /// Where it stands, mm or degrees.
        position: f64,
    },
    /// Look for the home of these joints, one bit each, J0 lowest.
    Home(u32),
    /// These joints do not know any more where they are.
    Unhome(u32),
    /// Go back to the path, after a jog in a hold.
    Return,
    /// What an awaited event asked for was done, or has failed.
    Acknowledge {
        /// Which event.
        event: EventId,
        /// Whether it was done.
        done: bool,
    },
    /// Set the part of their speed that jogs have, a ratio from 0 to 1.
    JogOverride(f64),
    /// Set the spindle override, a ratio of up to [`super::OVERRIDE_MAX`] and within what the machine allows.
    SpindleOverride(f64),
    /// Go back along the path, at the override that is in force.
    Reverse,
    /// Go onward along the path.
    Forward,
    /// What the program says to people: the text of the request becomes the message of the status.
    Tell,
    /// How a planner's job stands; the text of the request says what is being done. To be sent anew at
    /// least every second: a job of which nothing is heard does not begin.
    Job {
        /// A number that no other job has.
        number: u64,
        /// How it stands.
        phase: JobPhase,
        /// When somebody asked for it, ns of the host's steady clock; 0 where nobody knows. A job that was
        /// asked for before an abort does not begin, however late its planner hears of it.
        asked_ns: u64,
        /// Whether it is a stream of segments.
        is_stream: bool,
    },
}

impl Command {
    /// The command without its argument.
    #[must_use]
    pub const fn kind(self) -> CommandKind {
        match self {
            Self::Ping => CommandKind::Ping,
            Self::Hold => CommandKind::Hold,
            Self::Resume => CommandKind::Resume,
            Self::FeedOverride(_) => CommandKind::FeedOverride,
            Self::RapidOverride(_) => CommandKind::RapidOverride,
            Self::Abort => CommandKind::Abort,
            Self::StopAtEndOfBlock => CommandKind::StopAtEndOfBlock,
            Self::SingleBlock(_) => CommandKind::SingleBlock,
            Self::Reset => CommandKind::Reset,
            Self::Step => CommandKind::Step,
            Self::Enable => CommandKind::Enable,
            Self::Disable => CommandKind::Disable,
            Self::SetPosition { .. } => CommandKind::SetPosition,
            Self::Home(_) => CommandKind::Home,
            Self::Unhome(_) => CommandKind::Unhome,
            Self::Return => CommandKind::Return,
            Self::Acknowledge { .. } => CommandKind::Acknowledge,
            Self::JogOverride(_) => CommandKind::JogOverride,
            Self::SpindleOverride(_) => CommandKind::SpindleOverride,
            Self::Tell => CommandKind::Tell,
            Self::Reverse => CommandKind::Reverse,
            Self::Forward => CommandKind::Forward,
            Self::Job { .. } => CommandKind::Job,
        }
    }

    /// Whether it brings the machine to rest.
    #[must_use]
    pub const fn stops(self) -> bool {
        matches!(
            self,
            Self::Hold | Self::Abort | Self::Disable | Self::StopAtEndOfBlock
        )
    }

    /// Whether axes that rest may move by it, or get power.
    #[must_use]
    pub const fn sets_out(self) -> bool {
        matches!(
            self,
            Self::Resume
                | Self::Step
                | Self::Return
                | Self::Reverse
                | Self::Forward
                | Self::Enable
                | Self::Home(_)
        )
    }
}

/// A command on its way.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.CommandRequest.v8")]
pub struct CommandRequest {
    /// Who asks: any number the client keeps, for the log.
    pub client: u64,
    /// Counts the client's commands; the reply repeats it.
    pub number: u64,
    /// The command's argument: a ratio, a position, 1 and 0 for on and off, done and failed, or the
    /// code of a [`JobPhase`]; 0 if it has none.
    pub value: f64,
    /// Code of a [`CommandKind`].
    pub kind: u32,
    /// The index of a joint for [`CommandKind::SetPosition`], one bit for each joint for
    /// [`CommandKind::Home`] and [`CommandKind::Unhome`], else 0.
    pub joints: u32,
    /// Which event is acknowledged, else 0.
    pub event: EventId,
    /// Which job is told of, else 0.
    pub job: u64,
    /// When it, or the job that is told of, was asked for, ns of the host's steady clock; 0 if that is not
    /// known. What was asked for before the machine was stopped moves nothing, however late it comes.
    pub asked_ns: u64,
    /// 1 if the job that is told of is a stream of segments, else 0.
    pub job_stream: u32,
    /// Must be zero.
    pub reserved: u32,
    /// Why what an event asked for has failed, what the program says, what is being done for a job, or why the
    /// motion is aborted, for people; else empty.
    pub text: Text,
}

impl CommandRequest {
    /// The record of a command.
    #[must_use]
    pub fn new(client: u64, number: u64, command: Command) -> Self {
        let mut record = Self {
            client,
            number,
            value: 0.0,
            kind: command.kind().code(),
            joints: 0,
            event: EventId::default(),
            job: 0,
            asked_ns: 0,
            job_stream: 0,
            reserved: 0,
            text: Text::default(),
        };
        match command {
            Command::FeedOverride(ratio)
            | Command::RapidOverride(ratio)
            | Command::JogOverride(ratio)
            | Command::SpindleOverride(ratio) => record.value = ratio,
            Command::SingleBlock(on) => record.value = f64::from(u8::from(on)),
            Command::SetPosition { joint, position } => {
                (record.joints, record.value) = (joint, position);
            }
            Command::Home(joints) | Command::Unhome(joints) => record.joints = joints,
            Command::Acknowledge { event, done } => {
                (record.event, record.value) = (event, f64::from(u8::from(done)));
            }
            Command::Job {
                number,
                phase,
                asked_ns,
                is_stream,
            } => {
                record.job_stream = is_stream.into();
                (record.job, record.asked_ns) = (number, asked_ns);
                record.value = f64::from(phase.code());
            }
            Command::Ping
            | Command::Hold
            | Command::Resume
            | Command::Abort
            | Command::StopAtEndOfBlock
            | Command::Reset
            | Command::Step
            | Command::Enable
            | Command::Disable
            | Command::Return
            | Command::Reverse
            | Command::Forward
            | Command::Tell => {}
        }
        record
    }

    /// The same with the time at which it was asked for, ns of the host's steady clock.
    #[must_use]
    pub const fn asked_at(self, asked_ns: u64) -> Self {
        Self { asked_ns, ..self }
    }

    /// The same with a word for people, cut where it is too long.
    #[must_use]
    pub fn saying(self, text: &str) -> Self {
        Self {
            text: Text::new(text),
            ..self
        }
    }

    /// The command.
    ///
    /// # Errors
    ///
    /// An unknown code or an argument out of range.
    pub fn command(&self) -> Result<Command, RecordError> {
        let fields = Fields(Self::NAME);
        fields.finite("value", self.value)?;
        self.check_joints()?;
        fields.zero("reserved", self.reserved)?;
        let is_of_job = self.kind == CommandKind::Job.code();
        fields.flags("job_stream", self.job_stream, is_of_job.into())?;
        Ok(match fields.code::<CommandKind>("kind", self.kind)? {
            CommandKind::Ping => Command::Ping,
            CommandKind::Hold => Command::Hold,
            CommandKind::Resume => Command::Resume,
            CommandKind::FeedOverride => {
                fields.signed_override("value", self.value)?;
                Command::FeedOverride(self.value)
            }
            CommandKind::RapidOverride => {
                fields.override_ratio("value", self.value)?;
                Command::RapidOverride(self.value)
            }
            CommandKind::Abort => Command::Abort,
            CommandKind::StopAtEndOfBlock => Command::StopAtEndOfBlock,
            CommandKind::SingleBlock => Command::SingleBlock(self.switch()?),
            CommandKind::Reset => Command::Reset,
            CommandKind::Step => Command::Step,
            CommandKind::Enable => Command::Enable,
            CommandKind::Disable => Command::Disable,
            CommandKind::SetPosition => Command::SetPosition {
                joint: self.joints,
                position: self.value,
            },
            CommandKind::Home => Command::Home(self.joints),
            CommandKind::Unhome => Command::Unhome(self.joints),
            CommandKind::Return => Command::Return,
            CommandKind::Tell => Command::Tell,
            CommandKind::Reverse => Command::Reverse,
            CommandKind::Forward => Command::Forward,
            CommandKind::Acknowledge => Command::Acknowledge {
                event: self.event,
                done: self.switch()?,
            },
            CommandKind::Job => Command::Job {
                number: self.job,
                phase: fields.code("value", fields.whole("value", self.value)?)?,
                asked_ns: self.asked_ns,
                is_stream: self.job_stream == 1,
            },
            CommandKind::JogOverride => {
                fields.range("value", self.value, 0.0, 1.0)?;
                Command::JogOverride(self.value)
            }
            CommandKind::SpindleOverride => {
                fields.override_ratio("value", self.value)?;
                Command::SpindleOverride(self.value)
            }
        })
    }

    fn switch(&self) -> Result<bool, RecordError> {
        let fields = Fields(Self::NAME);
        fields.range("value", self.value, 0.0, 1.0)?;
        Ok(fields.whole("value", self.value)? == 1)
    }

    fn check_joints(&self) -> Result<(), RecordError> {
        let fields = Fields(Self::NAME);
        match CommandKind::from_code(self.kind) {
            Some(CommandKind::SetPosition) => {
                fields.range("joints", f64::from(self.joints), 0.0, HIGHEST_JOINT)
            }
            Some(CommandKind::Home | CommandKind::Unhome) => {
                fields.flags("joints", self.joints, ALL_JOINTS)
            }
            Some(
                CommandKind::Ping
                | CommandKind::Hold
                | CommandKind::Resume
                | CommandKind::FeedOverride
                | CommandKind::RapidOverride
                | CommandKind::Abort
                | CommandKind::StopAtEndOfBlock
                | CommandKind::SingleBlock
                | CommandKind::Reset
                | CommandKind::Step
                | CommandKind::Enable
                | CommandKind::Disable
                | CommandKind::Return
                | CommandKind::Acknowledge
                | CommandKind::JogOverride
                | CommandKind::SpindleOverride
                | CommandKind::Tell
                | CommandKind::Reverse
                | CommandKind::Forward
                | CommandKind::Job,
            )
            | None => fields.zero("joints", self.joints),
        }
    }
}

impl Record for CommandRequest {
    const NAME: &'static str = "glidepath.CommandRequest.v8";

    fn check(&self) -> Result<(), RecordError> {
        self.command()?;
        self.text.check(Self::NAME, "text")
    }
}
