//! What is known of the index pulse of a joint.

/// What is known of it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct IndexSeen {
    /// How often its input was latched, and where the joint was the last time; `None` if nobody latches it.
    pub(crate) latched: Option<(u64, f64)>,
    /// What its drive keeps of it, if it was asked to.
    pub(crate) kept: Kept,
}

/// What a drive keeps of an index pulse.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) enum Kept {
    /// It is not ready for one.
    #[default]
    No,
    /// It is ready, and there was none since.
    Armed,
    /// Where the joint was, as the drive counts.
    At(f64),
}

impl Kept {
    pub(super) const fn place(self) -> Option<f64> {
        match self {
            Self::At(place) => Some(place),
            Self::No | Self::Armed => None,
        }
    }
}
