//! The codes by which a FANUC changes the coordinates of a program.

/// What FANUC makes of the coordinates of a program; true where it begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FrameCode {
    /// G51, G50.
    Scale(bool),
    /// G51.1, G50.1.
    Mirror(bool),
    /// G101 of Haas, G100.
    Switch(bool),
    /// G68, G69.
    Turn(bool),
}

impl FrameCode {
    /// The codes that end what needs no words.
    pub(crate) const ENDS: [Self; 2] = [Self::Scale(false), Self::Turn(false)];

    /// The place of a code in [`Self::ENDS`].
    pub(crate) const fn ends(self) -> Option<usize> {
        match self {
            Self::Scale(false) => Some(0),
            Self::Turn(false) => Some(1),
            _ => None,
        }
    }
}

/// What FANUC makes of a tilted plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TiltCode {
    /// G68.2.
    Plane,
    /// G53.1.
    Align,
}
