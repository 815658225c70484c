//! Words whose names are longer than a letter: SINUMERIK's `AP=`, `RP=`, `AR=`, `ANG=`, `I1=` …, and
//! FANUC's `,A`.
//!
//! SINUMERIK's are rewritten to a letter behind a comma, which no program of that control has.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::duplicate_word::duplicate;

/// What such a word is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Named {
    /// LIMS: the highest speed of the spindle under G96 and G97.
    SpeedLimit,
    /// S of G26: the highest speed of the spindle at all times.
    UpperSpeed,
    /// S of G25: its lowest speed while it turns.
    LowerSpeed,
    /// RP: the distance from the pole.
    PolarRadius,
    /// AP: the angle about the pole, degrees.
    PolarAngle,
    /// AR: the angle that an arc goes through, degrees.
    ArcAngle,
    /// ANG, `,A`: the direction of a straight move in the plane, degrees.
    LineAngle,
    /// I1, J1, K1: the point that CIP goes through.
    Via(usize),
    /// A3, B3, C3: the direction of the tool.
    Vector(usize),
    /// SPOS: the angle at which the spindle stops, degrees.
    SpindleAngle,
    /// FB: the feed of this block alone.
    BlockFeed,
    /// FRC: the feed of the corner at the end of this block.
    CornerFeed,
    /// FRCM: the feed of all corners from here on; zero: that of the path.
    CornerFeeds,
}

/// How many there are.
const COUNT: usize = 17;

impl Named {
    /// The letter that stands for it behind a comma.
    pub(crate) const fn letter(self) -> u8 {
        match self {
            Self::SpeedLimit => b'S',
            Self::UpperSpeed => b'H',
            Self::LowerSpeed => b'E',
            Self::PolarRadius => b'P',
            Self::PolarAngle => b'Q',
            Self::ArcAngle => b'O',
            Self::LineAngle => b'A',
            Self::Via(0) => b'I',
            Self::Via(1) => b'J',
            Self::Via(_) => b'K',
            Self::Vector(0) => b'U',
            Self::Vector(1) => b'V',
            Self::Vector(_) => b'W',
            Self::SpindleAngle => b'N',
            Self::BlockFeed => b'B',
            Self::CornerFeed => b'F',
            Self::CornerFeeds => b'G',
        }
    }

    /// The word of a letter behind a comma.
    pub(crate) const fn of_letter(letter: u8) -> Option<Self> {
        Some(match letter {
            b'S' => Self::SpeedLimit,
            b'H' => Self::UpperSpeed,
            b'E' => Self::LowerSpeed,
            b'P' => Self::PolarRadius,
            b'Q' => Self::PolarAngle,
            b'O' => Self::ArcAngle,
            b'A' => Self::LineAngle,
            b'I' => Self::Via(0),
            b'J' => Self::Via(1),
            b'K' => Self::Via(2),
            b'U' => Self::Vector(0),
            b'V' => Self::Vector(1),
            b'W' => Self::Vector(2),
            b'N' => Self::SpindleAngle,
            b'B' => Self::BlockFeed,
            b'F' => Self::CornerFeed,
            b'G' => Self::CornerFeeds,
            _ => return None,
        })
    }

    /// The word of a name in SINUMERIK's language, in capitals.
    pub(crate) fn of_name(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"LIMS" => Self::SpeedLimit,
            b"RP" => Self::PolarRadius,
            b"AP" => Self::PolarAngle,
            b"AR" => Self::ArcAngle,
            b"ANG" | b"ANG1" | b"ANG2" => Self::LineAngle,
            b"I1" => Self::Via(0),
            b"J1" => Self::Via(1),
            b"K1" => Self::Via(2),
            b"A3" => Self::Vector(0),
            b"B3" => Self::Vector(1),
            b"C3" => Self::Vector(2),
            b"SPOS" => Self::SpindleAngle,
            b"FB" => Self::BlockFeed,
            b"FRC" => Self::CornerFeed,
            b"FRCM" => Self::CornerFeeds,
            _ => return None,
        })
    }

    /// Its name in a diagnostic.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::SpeedLimit => "LIMS",
            Self::UpperSpeed => "S of G26",
            Self::LowerSpeed => "S of G25",
            Self::PolarRadius => "RP",
            Self::PolarAngle => "AP",
            Self::ArcAngle => "AR",
            Self::LineAngle => "the angle of a line (ANG, ,A)",
            Self::Via(0) => "I1",
            Self::Via(1) => "J1",
            Self::Via(_) => "K1",
            Self::Vector(0) => "A3",
            Self::Vector(1) => "B3",
            Self::Vector(_) => "C3",
            Self::SpindleAngle => "SPOS",
            Self::BlockFeed => "FB",
            Self::CornerFeed => "FRC",
            Self::CornerFeeds => "FRCM",
        }
    }

    /// True for words that say where to go, as those of axes do.
    const fn is_place(self) -> bool {
        matches!(
            self,
            Self::PolarRadius | Self::PolarAngle | Self::LineAngle | Self::Vector(_)
        )
    }

    const fn index(self) -> usize {
        match self {
            Self::SpeedLimit => 0,
            Self::PolarRadius => 1,
            Self::PolarAngle => 2,
            Self::ArcAngle => 3,
            Self::LineAngle => 4,
            Self::Via(axis) => 5 + axis,
            Self::Vector(axis) => 8 + axis,
            Self::SpindleAngle => 11,
            Self::BlockFeed => 12,
            Self::CornerFeed => 13,
            Self::CornerFeeds => 14,
            Self::UpperSpeed => 15,
            Self::LowerSpeed => 16,
        }
    }
}

/// The value of such a word, and where it stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NamedValue {
    pub(crate) word: Named,
    pub(crate) value: f64,
    pub(crate) span: SourceSpan,
}

/// The words of a block that have such names.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct NamedWords {
    values: [Option<NamedValue>; COUNT],
    /// One of them says where to go.
    are_places: bool,
}

impl NamedWords {
    pub(crate) fn add(&mut self, word: Named, value: f64, span: SourceSpan) -> Outcome<()> {
        let Some(slot) = self.values.get_mut(word.index()) else {
            return Ok(());
        };
        if slot.is_some() {
            return Err(duplicate(word.name().trim_start_matches("the "), span));
        }
        *slot = Some(NamedValue { word, value, span });
        self.are_places |= word.is_place();
        Ok(())
    }

    /// A word with its place.
    pub(crate) fn find(&self, word: Named) -> Option<NamedValue> {
        self.values.get(word.index()).copied().flatten()
    }

    pub(crate) fn get(&self, word: Named) -> Option<f64> {
        self.find(word).map(|found| found.value)
    }

    /// True if one of them says where to go.
    pub(crate) const fn are_places(&self) -> bool {
        self.are_places
    }

    /// The first word that `takes` does not take.
    pub(crate) fn untaken(&self, takes: impl Fn(Named) -> bool) -> Option<NamedValue> {
        let untaken = |found: &NamedValue| !takes(found.word);
        self.values.iter().flatten().copied().find(untaken)
    }
}

/// A word that nothing in its block takes.
#[cold]
pub(crate) fn no_use(word: NamedValue) -> Box<BlockDiagnostic> {
    let (why, help) = match word.word {
        Named::PolarRadius | Named::PolarAngle => (
            "polar coordinates are the end of G0, G1, G2 and G3, or a pole",
            "write the motion code into the block",
        ),
        Named::ArcAngle => (
            "it is the angle that an arc goes through",
            "write G2 or G3 into the block",
        ),
        Named::LineAngle => (
            "it is the direction of a straight move at feed",
            "write G1 into the block",
        ),
        Named::BlockFeed => (
            "it is the feed of the move in its block",
            "write G1, G2 or G3 into the block",
        ),
        Named::CornerFeed => (
            "it is the feed of a corner that is broken",
            "write RND=, CHR= or CHF= beside it",
        ),
        Named::Via(_) => (
            "it is of the point that CIP goes through",
            "write CIP into the block",
        ),
        _ => (
            "the direction of the tool is that of a straight move",
            "write G1 into the block",
        ),
    };
    let message = format!("nothing in the block uses {}", word.word.name());
    BlockDiagnostic::new(DiagnosticCode::UnusedWord, word.span, message)
        .because(why)
        .help(help)
}
