//! The states and codes of a status: what the interpolator is doing, and why it stopped.

use super::code::coded;
use super::feedback::Loss;

coded! {
    /// The state of the machine: what the interpolator is doing.
    pub enum MachineState {
        /// At rest without an epoch; ready for one: all joints have power and know where they are.
        Idle = 1,
        /// On the path, program time advances.
        Running = 2,
        /// On the path, slowing for a feed hold.
        Holding = 3,
        /// At rest on the path by a feed hold.
        Held = 4,
        /// On the path, slowing because frames run low.
        Starving = 5,
        /// At rest on the path, waiting for frames.
        Starved = 6,
        /// At rest on the path until the operator goes on (M0, M1, M60, end of a block).
        ProgramStop = 7,
        /// On the path, slowing to end the epoch: abort or fault.
        Stopping = 8,
        /// At rest with a latched cause; needs a reset.
        Faulted = 9,
        /// At rest where the motion known so far ends, until there is more.
        Waiting = 10,
        /// At rest on the path until an event was acknowledged.
        Awaiting = 11,
        /// Moved by hand: the axes follow an operator's demand.
        Jogging = 12,
        /// A joint looks for its home.
        Homing = 13,
        /// The drives have no power, or nobody knows where they are: the setpoints repeat what the
        /// drives report.
        Off = 14,
        /// At rest with power, but a joint does not know where it is: no program starts.
        NotHomed = 15,
        /// At rest for a job that is read, checked and planned: the machine is taken, and nothing
        /// moves yet. In a status and in answers alone; setpoints say that the machine is idle.
        Preparing = 16,
    }
}

impl MachineState {
    /// Whether the machine may be moving.
    #[must_use]
    pub const fn is_moving(self) -> bool {
        matches!(
            self,
            Self::Running
                | Self::Holding
                | Self::Starving
                | Self::Stopping
                | Self::Jogging
                | Self::Homing
        )
    }
}

coded! {
    /// Whether the drives have power, as far as the interpolator knows.
    pub enum Power {
        /// No feedback is configured: the drives are taken to do what the setpoints say.
        Simulated = 0,
        /// Off: not asked for, refused by a drive, or lost.
        Off = 1,
        /// Asked for; not all drives have it, or they are not yet at rest.
        Enabling = 2,
        /// On.
        On = 3,
    }
}

coded! {
    /// The finding of a probe.
    pub enum ContactKind {
        /// Nothing yet.
        None = 0,
        /// What it looked for, on its way.
        Made = 1,
        /// That it was so from the beginning.
        AlreadySo = 2,
    }
}

coded! {
    /// The mode of motion: what moves the axes.
    pub enum MotionMode {
        /// Nothing: no epoch is open, and nobody jogs.
        None = 0,
        /// A program.
        Program = 1,
        /// An operator, by hand.
        Jog = 2,
        /// A search for home.
        Homing = 3,
        /// The way back to the path, after a jog in a hold.
        Return = 4,
        /// A program, back along its path.
        Backwards = 5,
    }
}

coded! {
    /// The end of the epoch of a status.
    pub enum EndOfEpoch {
        /// No epoch yet.
        None = 0,
        /// It has not ended.
        Open = 1,
        /// Its last frame was executed.
        Completed = 2,
        /// By an abort command.
        Aborted = 3,
        /// By a fault.
        Faulted = 4,
        /// By the contact that it looked for; the rest of its way was left out.
        Tripped = 5,
    }
}

coded! {
    /// The reason why a frame was refused. The code is the index of its counter in a status, plus
    /// one.
    pub enum FrameRefusal {
        /// A number is infinite or not a number.
        NotFinite = 1,
        /// Unknown flags or codes, or a number out of range.
        Malformed = 2,
        /// Sampled with another period than the interpolator's.
        Period = 3,
        /// It is of an epoch that is over, or of a new one while the present one runs.
        Epoch = 4,
        /// A gap in the sequence.
        Sequence = 5,
        /// Position, velocity or acceleration does not follow from the frame before.
        Discontinuous = 6,
        /// Above an axis' velocity limit.
        Velocity = 7,
        /// Above an axis' acceleration limit.
        Acceleration = 8,
        /// Above an axis' jerk limit.
        Jerk = 9,
        /// Outside an axis' soft limits.
        SoftLimit = 10,
        /// The first frame of an epoch is not at rest.
        NotAtRest = 11,
        /// The first frame of an epoch is not where the machine stands.
        Elsewhere = 12,
    }
}

/// Number of reasons for which frames are refused.
pub const FRAME_REFUSALS: usize = 12;

impl FrameRefusal {
    /// The index of its counter in a status.
    #[must_use]
    pub const fn index(self) -> usize {
        self.code() as usize - 1
    }
}

/// The cause of a fault: why the interpolator stopped by itself. Latched until reset.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FaultCause {
    /// A frame was refused.
    Frame(FrameRefusal),
    /// Starved for longer than configured: the planner died or hangs.
    PlannerLost,
    /// More missed ticks than configured.
    MissedTicks,
    /// A computed setpoint was not finite or broke a limit.
    Output,
    /// A port to other processes failed, or the thread that serves the ports died or hangs.
    Ports,
    /// The real-time thread died: nothing commands the drives any more.
    RealTime,
    /// The drives no longer say where they are.
    FeedbackLost,
    /// A joint is further from where it is to be than allowed.
    FollowingError,
    /// A drive reports a fault.
    Drive,
    /// A drive lost its power although it was to have it: emergency stop, or a fault without a word.
    EnableLost,
    /// An event was not acknowledged in time.
    AuxTimeout,
    /// A joint stands at one of its limit switches.
    LimitSwitch,
    /// A joint did not find its home.
    Homing,
    /// What an event asked for has failed.
    AuxFailed,
    /// In a thread the spindle turned slower or faster than the axes can follow, or stood.
    SpindleSpeed,
    /// In a thread the angle of the spindle was not told any more, or made no sense.
    SpindleAngle,
    /// In a thread the axes could not follow the spindle, or frames ran out.
    ThreadLost,
    /// The probe touched something although nothing was looked for.
    ProbeContact,
    /// A rigid tap went on into its hole as far as it may: the spindle did not turn back in time.
    TapOvertravel,
    /// A servo stack heard no setpoints for longer than its patience.
    SetpointsLost,
    /// A device on the bus of a servo stack is lost.
    DeviceLost,
    /// The bus of a servo stack was lost, and outputs that were on with it.
    BusLost,
    /// The drive of the spindle reports a fault, or has no power.
    SpindleDrive,
    /// The gear in which the spindle is to turn is not in.
    SpindleGear,
}

impl FaultCause {
    /// Added to the code of a frame's refusal.
    const FRAME: u32 = 0x100;

    /// The code in a status; 0 stands for no fault.
    #[must_use]
    pub const fn code(self) -> u32 {
        match self {
            Self::PlannerLost => 1,
            Self::MissedTicks => 2,
            Self::Output => 3,
            Self::Ports => 4,
            Self::RealTime => 5,
            Self::FeedbackLost => 6,
            Self::FollowingError => 7,
            Self::Drive => 8,
            Self::EnableLost => 9,
            Self::AuxTimeout => 10,
            Self::LimitSwitch => 11,
            Self::Homing => 12,
            Self::AuxFailed => 13,
            Self::SpindleSpeed => 14,
            Self::SpindleAngle => 15,
            Self::ThreadLost => 16,
            Self::ProbeContact => 17,
            Self::TapOvertravel => 18,
            Self::SetpointsLost => 19,
            Self::DeviceLost => 20,
            Self::BusLost => 21,
            Self::SpindleDrive => 22,
            Self::SpindleGear => 23,
            Self::Frame(refusal) => Self::FRAME + refusal.code(),
        }
    }

    /// The cause of a code; `None` if this version does not know it.
    #[must_use]
    pub const fn from_code(code: u32) -> Option<Self> {
        match code {
            1 => Some(Self::PlannerLost),
            2 => Some(Self::MissedTicks),
            3 => Some(Self::Output),
            4 => Some(Self::Ports),
            5 => Some(Self::RealTime),
            6 => Some(Self::FeedbackLost),
            7 => Some(Self::FollowingError),
            8 => Some(Self::Drive),
            9 => Some(Self::EnableLost),
            10 => Some(Self::AuxTimeout),
            11 => Some(Self::LimitSwitch),
            12 => Some(Self::Homing),
            13 => Some(Self::AuxFailed),
            14 => Some(Self::SpindleSpeed),
            15 => Some(Self::SpindleAngle),
            16 => Some(Self::ThreadLost),
            17 => Some(Self::ProbeContact),
            18 => Some(Self::TapOvertravel),
            19 => Some(Self::SetpointsLost),
            20 => Some(Self::DeviceLost),
            21 => Some(Self::BusLost),
            22 => Some(Self::SpindleDrive),
            23 => Some(Self::SpindleGear),
            Self::FRAME.. => match FrameRefusal::from_code(code - Self::FRAME) {
                Some(refusal) => Some(Self::Frame(refusal)),
                None => None,
            },
            _ => None,
        }
    }

    /// The cause that a loss of a servo stack is; `None` if nothing was lost.
    #[must_use]
    pub const fn of_loss(loss: Loss) -> Option<Self> {
        match loss {
            Loss::None => None,
            Loss::Setpoints => Some(Self::SetpointsLost),
            Loss::Device => Some(Self::DeviceLost),
            Loss::Bus => Some(Self::BusLost),
            Loss::Spindle => Some(Self::SpindleDrive),
            Loss::Gear => Some(Self::SpindleGear),
        }
    }

    /// Whether it is the loss of a servo stack, by which spindle and coolant are at rest, whatever else stops
    /// them.
    #[must_use]
    pub const fn is_loss(self) -> bool {
        matches!(
            self,
            Self::SetpointsLost
                | Self::DeviceLost
                | Self::BusLost
                | Self::SpindleDrive
                | Self::SpindleGear
        )
    }

    /// Whether joints are not led any more by that: their power goes as soon as they rest.
    #[must_use]
    pub const fn is_loss_of_joints(self) -> bool {
        matches!(self, Self::SetpointsLost | Self::DeviceLost | Self::BusLost)
    }
}

impl super::code::Code for FaultCause {
    fn known(code: u32) -> Option<Self> {
        Self::from_code(code)
    }
}
