//! The real-time characters, which have their effect at once, wherever they stand.

/// A real-time character.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RealTime {
    /// Where the machine is, and what it does.
    Report,
    /// The same with every field.
    FullReport,
    /// Come to rest on the path.
    Hold,
    /// Go on.
    Resume,
    /// End all, and begin anew.
    Reset,
    /// End all; modes and connection stay.
    Stop,
    /// The door was opened.
    Door,
    /// Move by hand no longer.
    JogCancel,
    /// The feed override, by percent or to 100 %.
    Feed(Change),
    /// The rapid override, percent.
    Rapid(u8),
    /// The spindle override.
    Spindle(Change),
    /// The spindle is to stand, or coolant to be switched.
    NotByHand,
    /// The modes in force.
    Modes,
    /// Rest at the end of every block, or do so no longer.
    SingleBlock,
    /// The tool was changed.
    ToolChanged,
}

/// How an override changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Change {
    Whole,
    By(i32),
}

impl RealTime {
    /// What a byte is; `None` if it belongs to a line, or to nothing.
    pub(crate) const fn of(byte: u8) -> Option<Self> {
        Some(match byte {
            b'?' | 0x80 => Self::Report,
            0x87 => Self::FullReport,
            b'!' | 0x82 => Self::Hold,
            b'~' | 0x81 => Self::Resume,
            0x18 => Self::Reset,
            0x19 => Self::Stop,
            0x83 => Self::Modes,
            0x84 => Self::Door,
            0x85 => Self::JogCancel,
            0x89 => Self::SingleBlock,
            0x90 => Self::Feed(Change::Whole),
            0x91 => Self::Feed(Change::By(10)),
            0x92 => Self::Feed(Change::By(-10)),
            0x93 => Self::Feed(Change::By(1)),
            0x94 => Self::Feed(Change::By(-1)),
            0x95 => Self::Rapid(100),
            0x96 => Self::Rapid(50),
            0x97 => Self::Rapid(25),
            0x99 => Self::Spindle(Change::Whole),
            0x9a => Self::Spindle(Change::By(10)),
            0x9b => Self::Spindle(Change::By(-10)),
            0x9c => Self::Spindle(Change::By(1)),
            0x9d => Self::Spindle(Change::By(-1)),
            0x9e | 0xa0 | 0xa1 => Self::NotByHand,
            0xa3 => Self::ToolChanged,
            _ => return None,
        })
    }
}
