//! The state of a motion that is out of tolerance, and the goal of the search for where it is.

/// What must hold after the last column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Goal {
    /// Something can be reached.
    Anything,
    /// Something within tolerance can be reached.
    WithinTolerance,
    /// The end of the program can be reached.
    End,
}

/// A motion that is out of tolerance.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OutOfTolerance {
    /// Width at which it is followed, mm.
    pub(crate) floor_mm: f64,
    /// Where it began.
    pub(crate) tick: u64,
    pub(crate) line: u32,
}
