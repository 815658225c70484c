//! The nine axes of RS274/NGC and vectors over them.

use core::fmt;
use nalgebra::SVector;

/// Number of axes every vector and record carries.
pub const AXES: usize = 9;

/// One value per axis, in the order X Y Z A B C U V W: mm for the linear axes, degrees for the
/// rotary ones (and their time derivatives).
pub type AxisVector = SVector<f64, AXES>;

/// Indices of X, Y and Z.
pub const LINEAR_XYZ: core::ops::Range<usize> = 0..3;
/// Indices of A, B and C.
pub const ROTARY_ABC: core::ops::Range<usize> = 3..6;
/// Indices of U, V and W.
pub const UVW: core::ops::Range<usize> = 6..9;

/// A program axis. The discriminant is the index into [`AxisVector`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Axis {
    /// First linear axis.
    X = 0,
    /// Second linear axis.
    Y = 1,
    /// Third linear axis.
    Z = 2,
    /// Rotation about X.
    A = 3,
    /// Rotation about Y.
    B = 4,
    /// Rotation about Z.
    C = 5,
    /// Linear, parallel to X.
    U = 6,
    /// Linear, parallel to Y.
    V = 7,
    /// Linear, parallel to Z.
    W = 8,
}

impl Axis {
    /// All axes in index order.
    pub const ALL: [Self; AXES] = [
        Self::X,
        Self::Y,
        Self::Z,
        Self::A,
        Self::B,
        Self::C,
        Self::U,
        Self::V,
        Self::W,
    ];

    /// Position in [`AxisVector`].
    #[must_use]
    pub const fn index(self) -> usize {
        self as usize
    }

    /// The program letter, upper case.
    #[must_use]
    pub const fn letter(self) -> char {
        match self {
            Self::X => 'X',
            Self::Y => 'Y',
            Self::Z => 'Z',
            Self::A => 'A',
            Self::B => 'B',
            Self::C => 'C',
            Self::U => 'U',
            Self::V => 'V',
            Self::W => 'W',
        }
    }

    /// The axis of a program letter, either case.
    #[must_use]
    pub fn from_letter(letter: char) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|a| a.letter() == letter.to_ascii_uppercase())
    }

    /// True for A, B and C, whose unit is the degree.
    #[must_use]
    pub const fn is_rotary(self) -> bool {
        matches!(self, Self::A | Self::B | Self::C)
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.letter())
    }
}
