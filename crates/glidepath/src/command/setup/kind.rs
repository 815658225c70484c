//! The kinds of machines that a set-up knows, and what is usual for each.

/// A kind of machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Mill,
    Router,
    Lathe,
    Plasma,
    Delta,
}

pub(super) const KINDS: [(&str, Kind); 5] = [
    ("mill", Kind::Mill),
    ("router", Kind::Router),
    ("lathe", Kind::Lathe),
    ("plasma", Kind::Plasma),
    ("delta", Kind::Delta),
];

/// What is usual for an axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct UsualAxis {
    pub(super) letter: char,
    pub(super) travel_mm: f64,
    /// Zero is at the upper end of the travel.
    pub(super) zero_is_high: bool,
    /// mm/min.
    pub(super) feed: f64,
    /// mm/s².
    pub(super) acceleration: f64,
}

const fn axis(
    letter: char,
    travel_mm: f64,
    zero_is_high: bool,
    feed: f64,
    acceleration: f64,
) -> UsualAxis {
    UsualAxis {
        letter,
        travel_mm,
        zero_is_high,
        feed,
        acceleration,
    }
}

const MILL: [UsualAxis; 3] = [
    axis('X', 500.0, false, 6000.0, 800.0),
    axis('Y', 300.0, false, 6000.0, 800.0),
    axis('Z', 300.0, true, 4000.0, 600.0),
];
const ROUTER: [UsualAxis; 3] = [
    axis('X', 800.0, false, 8000.0, 600.0),
    axis('Y', 600.0, false, 8000.0, 600.0),
    axis('Z', 120.0, true, 3000.0, 400.0),
];
const LATHE: [UsualAxis; 2] = [
    axis('X', 120.0, false, 4000.0, 1000.0),
    axis('Z', 350.0, true, 6000.0, 1000.0),
];
const PLASMA: [UsualAxis; 3] = [
    axis('X', 1250.0, false, 20_000.0, 1500.0),
    axis('Y', 1250.0, false, 20_000.0, 1500.0),
    axis('Z', 120.0, true, 6000.0, 1500.0),
];

impl Kind {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Mill => "mill",
            Self::Router => "router",
            Self::Lathe => "lathe",
            Self::Plasma => "plasma table",
            Self::Delta => "delta with three towers",
        }
    }

    /// The axes that are asked for, in their order.
    pub(super) const fn axes(self) -> &'static [UsualAxis] {
        match self {
            Self::Mill => &MILL,
            Self::Router => &ROUTER,
            Self::Lathe => &LATHE,
            Self::Plasma => &PLASMA,
            Self::Delta => &[],
        }
    }

    /// How far the motion may be from the program, mm.
    pub(super) const fn tolerance_mm(self) -> f64 {
        match self {
            Self::Mill => 0.01,
            Self::Router | Self::Delta => 0.03,
            Self::Lathe => 0.005,
            Self::Plasma => 0.1,
        }
    }
}
