//! The state of the machine, as far as the protocol needs it.

use crate::{AXES, Alarm};

/// The activity of the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Doing {
    /// Nobody tells: the interpolator is gone.
    #[default]
    Unknown,
    /// At rest, ready.
    Idle,
    /// At rest, and a job is read, checked and planned.
    Preparing,
    /// On its path, in motion.
    Running,
    /// On its path, coming to rest by a hold.
    Holding,
    /// At rest by a hold.
    Held,
    /// At rest where the motion known so far ends.
    Waiting,
    /// At rest at M0, M1 or the end of a block, until somebody has it go on.
    ProgramStop,
    /// At rest until a tool was changed.
    AwaitingTool,
    /// At rest until something else was done.
    Awaiting,
    /// Coming to rest: what it did is over.
    Stopping,
    /// Moved by hand.
    Jogging,
    /// Looking for its home.
    Homing,
    /// At rest with power, and does not know where it is.
    NotHomed,
    /// Without power.
    Off,
    /// At rest by a fault.
    Faulted,
}

impl Doing {
    /// Whether it may move without being told to.
    #[must_use]
    pub const fn is_moving(self) -> bool {
        matches!(
            self,
            Self::Running | Self::Holding | Self::Stopping | Self::Jogging | Self::Homing
        )
    }

    /// Whether it rests, and nobody has it.
    #[must_use]
    pub const fn is_free(self) -> bool {
        matches!(
            self,
            Self::Unknown | Self::Idle | Self::NotHomed | Self::Off | Self::Faulted
        )
    }
}

/// How the spindle turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Spindle {
    /// It stands.
    #[default]
    Off,
    /// As M3 has it.
    Clockwise,
    /// As M4 has it.
    Counterclockwise,
}

/// The state of the machine.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineView {
    /// What it does.
    pub doing: Doing,
    /// Where the axes were commanded to be last, mm or degrees.
    pub position: [f64; AXES],
    /// Where the zero of programs is for what is executed now, with all offsets, that of the tool, too.
    pub zero: [f64; AXES],
    /// Speed along the path, mm/s.
    pub feed_v: f64,
    /// Revolutions a minute.
    pub spindle_rpm: f64,
    /// How the spindle turns.
    pub spindle: Spindle,
    /// Coolant.
    pub flood: bool,
    /// Coolant.
    pub mist: bool,
    /// The feed override, a ratio.
    pub feed_r: f64,
    /// The rapid override, a ratio.
    pub rapid_r: f64,
    /// The spindle override, a ratio.
    pub spindle_r: f64,
    /// The axes that stand at a limit switch, and `P` for a probe that touches something.
    pub pins: String,
    /// Line of the job that is executed; 0 if none is.
    pub line: u32,
    /// It was jogged away from the path that it is held on.
    pub is_away: bool,
    /// What it waits for, or says, for people.
    pub message: String,
    /// Why it is at rest by a fault, or without power.
    pub fault: Option<(Alarm, String)>,
}

impl Default for MachineView {
    fn default() -> Self {
        Self {
            doing: Doing::Unknown,
            position: [0.0; AXES],
            zero: [0.0; AXES],
            feed_v: 0.0,
            spindle_rpm: 0.0,
            spindle: Spindle::Off,
            flood: false,
            mist: false,
            feed_r: 1.0,
            rapid_r: 1.0,
            spindle_r: 1.0,
            pins: String::new(),
            line: 0,
            is_away: false,
            message: String::new(),
            fault: None,
        }
    }
}
