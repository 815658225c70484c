//! What the parameters of a FANUC control decide about its programs.

use crate::syntax::modes::Units;

/// What a FANUC or Haas control is made for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FanucControl {
    /// A mill, or a machining centre.
    Mill,
    /// A lathe whose codes are those of system A: G90, G92 and G94 are cycles, U and W increments.
    LatheA,
    /// System B: G77, G78 and G79 are the cycles, G90 and G91 say how coordinates count.
    LatheB,
    /// System C: G20, G21 and G24 are the cycles, G70 and G71 inches and millimetres.
    LatheC,
}

/// What F is on a lathe before G98 or G99 (parameter 3402#4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FeedAtStart {
    /// Not said: an F before either is refused.
    #[default]
    Unsaid,
    /// Per minute.
    PerMinute,
    /// Per revolution.
    PerRevolution,
}

/// What a coordinate without a decimal point means (parameter 3401#0).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PointInput {
    /// Not said: such coordinates are read as millimetres or inches up to 999, and refused above.
    #[default]
    Unsaid,
    /// Millimetres, inches or degrees: X1000 is 1000 mm.
    Calculator,
    /// Least increments: X1000 is 1 mm, or 0.1 inch.
    Increment,
}

/// How the memory of tool offsets is divided (parameters 6000#3, 8136#6).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum OffsetMemory {
    /// Not said: the variables of tool offsets are refused.
    #[default]
    Unsaid,
    /// Memory A: one value for each offset.
    A,
    /// Memory C: `#2001` and on are the wear, `#2201` and on the geometry.
    C,
    /// Haas, and memory C with the bit V15: `#2001` and on are the length, `#2201` its wear.
    /// `#2401` and on, the radius or diameter by setting 40 and its wear, are refused.
    Haas,
}

/// In which range `ATAN[a]/[b]` and `ASIN[a]` are (parameter 6004#0).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Arctangent {
    /// From 0 to 360 degrees; ASIN from 270 over 0 to 90.
    #[default]
    Full,
    /// From −180 to 180 degrees; ASIN from −90 to 90.
    Signed,
}

/// Where the coordinate is that the first move behind G68 does not name (parameter 11600#5, AX1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RotationStart {
    /// Not said: a move to one coordinate alone is refused where that matters.
    #[default]
    Unsaid,
    /// As it was before the rotation, and rotated with the one that is named (AX1 = 0).
    AsBefore,
    /// Where the tool is in the rotated coordinates (AX1 = 1, as a series 0i-C).
    AsRotated,
}

/// Which way the tool goes aside at the bottom of a bored hole (parameter 5101#4, #5; setting 27 of Haas).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BoreShift {
    /// Not said: Q of G76 is refused.
    #[default]
    Unsaid,
    /// Towards +X.
    PlusX,
    /// Towards −X.
    MinusX,
    /// Towards +Y.
    PlusY,
    /// Towards −Y.
    MinusY,
}

impl BoreShift {
    /// The direction along X and Y.
    pub(crate) const fn direction(self) -> Option<[f64; 2]> {
        Some(match self {
            Self::Unsaid => return None,
            Self::PlusX => [1.0, 0.0],
            Self::MinusX => [-1.0, 0.0],
            Self::PlusY => [0.0, 1.0],
            Self::MinusY => [0.0, -1.0],
        })
    }
}

/// How the tool goes round outer corners with G41 and G42 (parameter 19607#2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum OuterCorners {
    /// Not said: in straight lines, but on arcs where the memory of offsets is that of a Haas.
    #[default]
    Unsaid,
    /// In straight lines: both sides go on to where they meet, or as far as the radius, and across.
    Lines,
    /// On arcs about the corner.
    Arcs,
}

/// What the parameters of a FANUC control say.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FanucParameters {
    /// `None`: a lathe of system A on a machine with X and Z and without Y, else a mill.
    pub control: Option<FanucControl>,
    /// The units before the first G20 or G21; `None`: not said, and taken to be millimetres.
    pub units_at_start: Option<Units>,
    /// Coordinates without a point.
    pub point: PointInput,
    /// The memory of tool offsets.
    pub offset_memory: OffsetMemory,
    /// The range of `ATAN[a]/[b]` and `ASIN[a]`.
    pub arctangent: Arctangent,
    /// The feed of a lathe.
    pub feed_at_start: FeedAtStart,
    /// The way aside of G76.
    pub bore_shift: BoreShift,
    /// The way round outer corners.
    pub outer_corners: OuterCorners,
    /// Whether A, B and C roll over (parameter 1008: ROAx 1, RABx 0): to an angle in G90 they turn the shorter way.
    pub rolls_over: bool,
    /// Whether R of G68 is the angle itself in G91, too, and not added to the one in force (parameter 5400#0, RIN).
    pub rotations_are_absolute: bool,
    /// Where a coordinate is that the first move behind G68 does not name.
    pub rotation_start: RotationStart,
}

impl FanucParameters {
    /// True where the control is a Haas.
    pub(crate) const fn is_haas(&self) -> bool {
        matches!(self.offset_memory, OffsetMemory::Haas)
    }

    /// True where the tool goes round outer corners in straight lines.
    pub(crate) const fn has_corners_of_lines(&self) -> bool {
        match self.outer_corners {
            OuterCorners::Lines => true,
            OuterCorners::Arcs => false,
            OuterCorners::Unsaid => !self.is_haas(),
        }
    }
}
