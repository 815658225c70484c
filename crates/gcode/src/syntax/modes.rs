//! The modes and codes of each modal group.

use serde::{Deserialize, Serialize};

/// Motion modes (group 1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Motion {
    /// G0.
    Rapid,
    /// G1.
    Linear,
    /// G2.
    ArcClockwise,
    /// G3.
    ArcCounterclockwise,
    /// G73, G74, G81 to G89.
    Cycle(CannedCycle),
    /// G70 to G72.2.
    Lathe(LatheCycle),
    /// G38.2 to G38.5.
    Probe(Probe),
    /// G5, G5.1, G5.2, G5.3, G6.2.
    Spline(Spline),
    /// G33.
    Thread,
    /// G33.1.
    RigidTap,
    /// CIP of SINUMERIK: an arc through a point.
    ArcThrough,
    /// CT of SINUMERIK: an arc that goes on in the direction of the move before.
    ArcTangent,
    /// G331 of SINUMERIK: a tap into its hole.
    TapIn,
    /// G332 of SINUMERIK: the tap out of it.
    TapOut,
    /// G76.
    ThreadCycle,
    /// G90, G92 and G94 of FANUC's lathes.
    Turning(Turning),
    /// G74 and G75 of FANUC's lathes: grooves by depths; true along X.
    Groove(bool),
    /// G12 and G13 of Haas: a round pocket; true clockwise.
    CirclePocket(bool),
    /// G70 and G71 of Haas' mills: holes of the cycle in force on a circle; true on an arc.
    HolePattern(bool),
}

impl CannedCycle {
    /// True where the spindle stops at an angle, and the tool goes aside.
    #[must_use]
    pub const fn goes_aside(self) -> bool {
        matches!(self, Self::FineBore | Self::BackBore)
    }
}

impl Motion {
    /// True if a block of this mode may do without axis words: arcs, splines, lathe cycles.
    #[must_use]
    pub const fn may_lack_axes(self) -> bool {
        self.is_arc()
            || matches!(
                self,
                Self::Spline(_) | Self::Lathe(_) | Self::CirclePocket(_) | Self::HolePattern(_)
            )
    }

    /// True for G2 and G3.
    #[must_use]
    pub const fn is_arc(self) -> bool {
        matches!(self, Self::ArcClockwise | Self::ArcCounterclockwise)
    }
}

/// Cycles of FANUC's lathes of one pass: to depth, along, out and back.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Turning {
    /// G90: along Z.
    Turn,
    /// G94: along X.
    Face,
    /// G92: a thread.
    Thread,
}

/// Splines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Spline {
    /// G5.
    Cubic,
    /// G5.1.
    Quadratic,
    /// G5.2: a control point with its weight.
    Weighted,
    /// G5.3: the control points of G5.2 are complete.
    EndWeighted,
    /// G6.2: a control point with its weight and a knot, or a knot alone.
    Knotted,
}

/// Canned cycles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum CannedCycle {
    /// G73: drilling that breaks the chip.
    ChipBreak,
    /// G74: tapping, left-hand.
    TapLeft,
    /// G76 of FANUC's and Haas' mills: boring, the tip off the wall on the way out.
    FineBore,
    /// G81: drilling.
    Drill,
    /// G82: drilling with a dwell.
    DrillDwell,
    /// G83: drilling that clears the chips.
    Peck,
    /// G84: tapping, right-hand.
    TapRight,
    /// G85: boring, feed out.
    Bore,
    /// G86: boring, spindle stop, rapid out.
    BoreStop,
    /// G87 of FANUC's mills: boring upwards, from below a bore that the tip passes beside its wall.
    BackBore,
    /// G89: boring with a dwell, feed out.
    BoreDwell,
}

/// Lathe cycles along a profile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum LatheCycle {
    /// G70: finishing.
    Finish,
    /// G71, G71.1, G71.2: roughing by passes along Z.
    Turn(Pockets),
    /// G72, G72.1, G72.2: roughing by passes along X.
    Face(Pockets),
    /// G73 of FANUC: passes along a profile that the part has already, nearer and nearer.
    Repeat,
}

/// The treatment by a roughing cycle of the pockets of a profile, which are places where it leads
/// back inwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Pockets {
    /// G71, G72: cut like the rest.
    Cut,
    /// G71.1, G72.1: left out.
    LeftOut,
    /// G71.2, G72.2: nothing else is cut.
    Only,
}

/// Probing moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Probe {
    /// True for G38.2 and G38.3: until contact. False: until contact is lost.
    pub toward: bool,
    /// True for G38.2 and G38.4: an error if the end is reached without it.
    pub must: bool,
}

/// Codes that act once (group 0).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NonModal {
    /// G4.
    Dwell,
    /// G10.
    SetData,
    /// G28, G30: go by way of the given point to the reference position of that index.
    GoToReference(usize),
    /// G28.1, G30.1.
    SetReference(usize),
    /// G52.
    LocalOffset,
    /// G50 of FANUC's lathes: the highest speed of the spindle, or what the present place is called.
    LatheSetting,
    /// G53.
    MachineCoordinates,
    /// G110, G111 and G112 of SINUMERIK.
    SetPole(PoleFrom),
    /// G92.
    SetOffset,
    /// G92.1.
    ClearOffset,
    /// G92.1 of FANUC: the axes that it names lose what G92 and G52 have shifted.
    PresetSystem,
    /// G92.2.
    SuspendOffset,
    /// G92.3.
    RestoreOffset,
}

impl NonModal {
    /// True if the code takes the axis words of its block for itself.
    pub(crate) const fn takes_axes(self) -> bool {
        matches!(
            self,
            Self::SetData
                | Self::GoToReference(_)
                | Self::LocalOffset
                | Self::LatheSetting
                | Self::SetOffset
                | Self::PresetSystem
                | Self::SetPole(_)
        )
    }
}

/// From where the place of a pole counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PoleFrom {
    /// G110: where the program went last.
    Place,
    /// G111: the program's zero.
    Zero,
    /// G112: the last pole.
    Pole,
}

/// Meaning of axis words (group 3) or of I, J, K (group 4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Distance {
    /// G90, G90.1.
    Absolute,
    /// G91, G91.1.
    Incremental,
}

/// Meaning of F (group 5).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum FeedMode {
    /// G93: one over the minutes the move takes.
    InverseTime,
    /// G94: per minute.
    PerMinute,
    /// G95: per revolution of the spindle.
    PerRevolution,
}

/// Cutter radius compensation (group 7).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CutterRadius {
    /// G40.
    Off,
    /// G41, G42: the radius comes from the tool table.
    FromTable(Side),
    /// G41.1, G42.1: the diameter is the D word.
    FromWord(Side),
}

/// Which side of the path the tool is on, seen in the direction of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Side {
    Left,
    Right,
}

/// Tool length offset (group 8).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ToolLength {
    /// G43.
    FromTable,
    /// G43.1: the offset is given by the axis words.
    FromWords,
    /// G43.2: one more tool of the table on top.
    Add,
    /// G44 of FANUC: the length is taken away.
    Subtract,
    /// G49.
    Cancel,
}

/// The place that a canned cycle retracts to (group 10).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Retract {
    /// G98: where the axis was before the cycles began.
    Initial,
    /// G99: the R plane.
    RPlane,
}

/// What F counts on arcs while G41 or G42 is in force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(crate) enum ArcFeed {
    /// The path of the tool's centre (CFTCP of SINUMERIK).
    #[default]
    Center,
    /// The contour on the inner side of arcs, on the outer one the path of the centre (CFIN, and FANUC's mills).
    Inside,
    /// The contour (CFC).
    Contour,
}

impl ArcFeed {
    /// The least share of F that is left where the tool is nearly as large as the arc.
    const LEAST: f64 = 0.01;

    /// The share of F that the centre goes at, whose path has a radius, on a contour with another one.
    pub(crate) fn share(self, center_mm: f64, contour_mm: f64) -> f64 {
        let share = center_mm / contour_mm;
        match self {
            Self::Contour if share.is_finite() => share.max(Self::LEAST),
            Self::Inside if share < 1.0 => share.max(Self::LEAST),
            Self::Center | Self::Inside | Self::Contour => 1.0,
        }
    }
}

/// Meaning of S (group 14).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SpindleMode {
    /// G96: cutting speed.
    SurfaceSpeed,
    /// G97: revolutions.
    Revolutions,
    /// G971 to G973 of SINUMERIK: revolutions, which LIMS does not limit.
    UnlimitedRevolutions,
}

/// Length units (group 6).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Units {
    /// G20.
    Inch,
    /// G21.
    Millimetre,
}

impl Units {
    /// Millimetres in one unit.
    #[must_use]
    pub const fn mm(self) -> f64 {
        match self {
            Self::Inch => 25.4,
            Self::Millimetre => 1.0,
        }
    }
}

/// How M codes stop (group 4 of the M codes).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stop {
    /// M0 or M60.
    Program(u32),
    /// M1.
    Optional,
    /// M2 or M30.
    End,
}
