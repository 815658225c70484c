//! The kinds of diagnostics.

use core::fmt;

/// The kind of a diagnostic. The kebab-case name of each is stable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DiagnosticCode {
    /// The input could not be read.
    ReadFailed,
    /// A curve file says what it may not.
    CurveFile,
    /// A curve that cannot be followed.
    Curve,
    /// A motion the machine's joints cannot do.
    Joint,
    /// The input is not ASCII or UTF-8 text.
    WrongEncoding,
    /// A line is longer than the largest length accepted.
    LineTooLong,
    /// A line so long that its end is not looked for.
    EndlessLine,
    /// A NUL byte in the text.
    NulByte,
    /// A character outside ASCII, not in a comment.
    NonAsciiCharacter,
    /// A character no block may contain at that place.
    BadCharacter,
    /// A comment without its closing parenthesis.
    UnclosedComment,
    /// An opening parenthesis inside a comment.
    NestedComment,
    /// A percent sign with other text in its line.
    StrayPercent,
    /// Something that looks like a number but is none.
    MalformedNumber,
    /// A letter without its number.
    MissingNumber,
    /// A number too large for its word.
    NumberOutOfRange,
    /// A number that must be whole is not.
    NotAnInteger,
    /// An expression that is not well formed.
    Expression,
    /// An operation without a result.
    Arithmetic,
    /// A parameter that does not exist, has no value, or cannot be assigned.
    Parameter,
    /// O words that do not fit together.
    FlowStructure,
    /// A call of a subroutine that is not defined.
    UnknownSubroutine,
    /// Calls nested too deeply.
    CallDepth,
    /// A loop that neither ends nor does anything.
    EndlessLoop,
    /// A subroutine or loop too long to be kept.
    FlowTooLong,
    /// A word or code of the language that is not supported.
    NotSupported,
    /// A G number that does not exist.
    UnknownGCode,
    /// An M number that does not exist.
    UnknownMCode,
    /// A letter that is no word.
    UnknownWord,
    /// The same word twice in a block.
    DuplicateWord,
    /// Two codes of one modal group in a block.
    ModalGroupConflict,
    /// A block number that is not at the start of its line.
    MisplacedBlockNumber,
    /// A word that nothing in the block uses.
    UnusedWord,
    /// A word that two codes of the block want.
    AmbiguousWord,
    /// A word that a code of the block needs is missing.
    MissingWord,
    /// A value its word does not allow.
    InvalidValue,
    /// The machine has no such axis.
    AxisNotConfigured,
    /// Two codes of the block both want the axis words.
    AxisWordsConflict,
    /// Axis words while no motion mode is active.
    NoMotionMode,
    /// A feed move before any feedrate.
    MissingFeed,
    /// A feedrate that is zero or negative.
    BadFeed,
    /// Machine coordinates (G53) where they are not possible.
    MachineCoordinates,
    /// An arc with neither centre nor radius.
    ArcWithoutCenter,
    /// An arc with both centre and radius.
    ArcOverdetermined,
    /// A centre word of an axis outside the plane.
    ArcOffsetOutsidePlane,
    /// An arc whose centre is its start or end.
    ArcZeroRadius,
    /// A radius too small to reach the end point.
    ArcRadiusTooSmall,
    /// Start and end are not at the same distance from the centre.
    ArcRadiusMismatch,
    /// A radius with an end point that is the start point.
    ArcFullCircleWithRadius,
    /// An arc that cannot be made in the active plane or coordinate system.
    ArcPlane,
    /// A move beyond a soft limit.
    SoftLimit,
    /// A line of a tool table that is not well formed.
    ToolTable,
    /// A modal state that was not saved.
    SavedState,
    /// A tool that is not in the tool table.
    UnknownTool,
    /// There is no tool table to look a tool up in.
    NoToolTable,
    /// A canned cycle that cannot be made.
    CannedCycle,
    /// Cutter radius compensation where it is not possible.
    CutterRadius,
    /// A corner or an arc the compensated tool does not fit into.
    Gouge,
    /// Something of the machine that is not connected: inputs, outputs, a probe.
    NotConnected,
    /// A probe that did not find what it looked for.
    Probe,
    /// Polar words that cannot be used.
    Polar,
    /// The spindle does not do what the block needs.
    Spindle,
    /// The checksum of a line is wrong.
    Checksum,
    /// A spline that cannot be made, or is not complete.
    Spline,
    /// An alarm that the program raises by itself.
    Alarm,
    /// A text in the language of a control that is not read, or no program at all.
    ForeignLanguage,
    /// A program that two controls read differently, and nothing says for which it is.
    UndecidedDialect,
}

impl DiagnosticCode {
    /// The stable name, for example `arc-radius-mismatch`.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::ReadFailed => "read-failed",
            Self::CurveFile => "curve-file",
            Self::Curve => "curve",
            Self::Joint => "joint",
            Self::WrongEncoding => "wrong-encoding",
            Self::LineTooLong => "line-too-long",
            Self::EndlessLine => "endless-line",
            Self::NulByte => "nul-byte",
            Self::NonAsciiCharacter => "non-ascii-character",
            Self::BadCharacter => "bad-character",
            Self::UnclosedComment => "unclosed-comment",
            Self::NestedComment => "nested-comment",
            Self::StrayPercent => "stray-percent",
            Self::MalformedNumber => "malformed-number",
            Self::MissingNumber => "missing-number",
            Self::NumberOutOfRange => "number-out-of-range",
            Self::NotAnInteger => "not-an-integer",
            Self::Expression => "expression",
            Self::Arithmetic => "arithmetic",
            Self::Parameter => "parameter",
            Self::FlowStructure => "flow-structure",
            Self::UnknownSubroutine => "unknown-subroutine",
            Self::CallDepth => "call-depth",
            Self::EndlessLoop => "endless-loop",
            Self::FlowTooLong => "flow-too-long",
            Self::NotSupported => "not-supported",
            Self::UnknownGCode => "unknown-g-code",
            Self::UnknownMCode => "unknown-m-code",
            Self::UnknownWord => "unknown-word",
            Self::DuplicateWord => "duplicate-word",
            Self::ModalGroupConflict => "modal-group-conflict",
            Self::MisplacedBlockNumber => "misplaced-block-number",
            Self::UnusedWord => "unused-word",
            Self::AmbiguousWord => "ambiguous-word",
            Self::MissingWord => "missing-word",
            Self::InvalidValue => "invalid-value",
            Self::AxisNotConfigured => "axis-not-configured",
            Self::AxisWordsConflict => "axis-words-conflict",
            Self::NoMotionMode => "no-motion-mode",
            Self::MissingFeed => "missing-feed",
            Self::BadFeed => "bad-feed",
            Self::MachineCoordinates => "machine-coordinates",
            Self::ArcWithoutCenter => "arc-without-center",
            Self::ArcOverdetermined => "arc-overdetermined",
            Self::ArcOffsetOutsidePlane => "arc-offset-outside-plane",
            Self::ArcZeroRadius => "arc-zero-radius",
            Self::ArcRadiusTooSmall => "arc-radius-too-small",
            Self::ArcRadiusMismatch => "arc-radius-mismatch",
            Self::ArcFullCircleWithRadius => "arc-full-circle-with-radius",
            Self::ArcPlane => "arc-plane",
            Self::SoftLimit => "soft-limit",
            Self::ToolTable => "tool-table",
            Self::SavedState => "saved-state",
            // The same to whoever reads reports: the tool is not known.
            Self::UnknownTool | Self::NoToolTable => "unknown-tool",
            Self::CannedCycle => "canned-cycle",
            Self::CutterRadius => "cutter-radius",
            Self::Gouge => "gouge",
            Self::NotConnected => "not-connected",
            Self::Probe => "probe",
            Self::Polar => "polar",
            Self::Spindle => "spindle",
            Self::Checksum => "checksum",
            Self::Spline => "spline",
            Self::Alarm => "alarm",
            Self::ForeignLanguage => "foreign-language",
            Self::UndecidedDialect => "undecided-dialect",
        }
    }

    /// True if it is about a word or a code, and not about what a block does.
    pub(crate) const fn is_of_reading(self) -> bool {
        matches!(
            self,
            Self::LineTooLong
                | Self::NulByte
                | Self::NonAsciiCharacter
                | Self::BadCharacter
                | Self::UnclosedComment
                | Self::NestedComment
                | Self::MalformedNumber
                | Self::MissingNumber
                | Self::NumberOutOfRange
                | Self::Expression
                | Self::Arithmetic
                | Self::Parameter
                | Self::NotSupported
                | Self::UnknownGCode
                | Self::UnknownMCode
                | Self::UnknownWord
                | Self::DuplicateWord
                | Self::ModalGroupConflict
                | Self::AmbiguousWord
        )
    }

    /// True if nothing after the diagnostic can be understood, so that reading ends there.
    #[must_use]
    pub const fn is_fatal(self) -> bool {
        matches!(
            self,
            Self::ReadFailed
                | Self::WrongEncoding
                | Self::EndlessLine
                | Self::ForeignLanguage
                | Self::UndecidedDialect
        )
    }
}

impl fmt::Display for DiagnosticCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}
