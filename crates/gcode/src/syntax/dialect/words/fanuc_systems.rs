//! The systems B and C of FANUC's lathes: the code of system A that a code of theirs is.
//!
//! | system A | B | C |
//! |---|---|---|
//! | G90, G92, G94 | G77, G78, G79 | G20, G21, G24 |
//! | G98, G99 | G94, G95 | G94, G95 |
//! | G20, G21 | the same | G70, G71 |
//! | G70 to G76 | the same | G72 to G78 |
//! | G32 | G33 | G33 |
//! | G50 | G92 | G92 |
//! | U, W | G91 with X, Z | G91 with X, Z |
//!
//! G90, G91, G98 and G99 are those of mills.

use crate::setup::fanuc::FanucControl;

/// A system of codes beside A.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum OtherSystem {
    B,
    C,
}

/// What a code of such a system is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SystemCode {
    /// The code of system A, times ten.
    OfA(u32),
    /// A code that means what it means to LinuxCNC, times ten.
    Shared(u32),
    /// The system does not have it.
    Absent,
}

impl OtherSystem {
    pub(crate) const fn of(control: FanucControl) -> Option<Self> {
        match control {
            FanucControl::LatheB => Some(Self::B),
            FanucControl::LatheC => Some(Self::C),
            FanucControl::Mill | FanucControl::LatheA => None,
        }
    }

    /// What a code is, whose number comes times ten.
    pub(crate) const fn code(self, tenths: u32) -> SystemCode {
        use SystemCode::{Absent, OfA, Shared};
        match (self, tenths) {
            (_, 900 | 910 | 980 | 990) => Shared(tenths),
            (_, 320 | 500 | 930) | (Self::C, 790) => Absent,
            (_, 330) => OfA(320),
            (_, 920) => OfA(500),
            (_, 940) => OfA(980),
            (_, 950) => OfA(990),
            (Self::B, 770) | (Self::C, 200) => OfA(900),
            (Self::B, 780) | (Self::C, 210) => OfA(920),
            (Self::B, 790) | (Self::C, 240) => OfA(940),
            (Self::C, 700) => Shared(200),
            (Self::C, 710) => Shared(210),
            (Self::C, 720 | 730 | 740 | 750 | 760 | 770 | 780) => OfA(tenths - 20),
            _ => OfA(tenths),
        }
    }
}
