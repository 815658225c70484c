//! The words that shift, turn, mirror and scale the coordinates of a program.

/// What a frame does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FrameKind {
    Shift,
    Turn,
    Mirror,
    Scale,
}

/// TRANS, ATRANS and the like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct FrameWord {
    pub(crate) kind: FrameKind,
    /// It is added to what is in force, in whose place the others come.
    pub(crate) adds: bool,
}

impl FrameWord {
    /// The word of that name, in capitals.
    pub(super) fn named(name: &[u8]) -> Option<Self> {
        let (kind, adds) = match name {
            b"TRANS" => (FrameKind::Shift, false),
            b"ATRANS" => (FrameKind::Shift, true),
            b"ROT" => (FrameKind::Turn, false),
            b"AROT" => (FrameKind::Turn, true),
            b"MIRROR" => (FrameKind::Mirror, false),
            b"AMIRROR" => (FrameKind::Mirror, true),
            b"SCALE" => (FrameKind::Scale, false),
            b"ASCALE" => (FrameKind::Scale, true),
            _ => return None,
        };
        Some(Self { kind, adds })
    }
}
