//! A tilted plane of which not all blocks are read (P2 and P3 of FANUC's G68.2).

use nalgebra::Vector3;

/// The blocks so far; places in mm, program coordinates in front of the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum OpenPlane {
    /// P2: its points.
    Points {
        /// The zero, seen from the first point, in the plane.
        shift: Vector3<f64>,
        /// A turn about the normal.
        turn_deg: f64,
        first: Option<Vector3<f64>>,
        second: Option<Vector3<f64>>,
    },
    /// P3: the zero and the direction of X.
    Directions { zero: Vector3<f64>, x: Vector3<f64> },
}

impl OpenPlane {
    /// A plane by points of which there is none yet.
    pub(crate) fn of_points() -> Self {
        Self::Points {
            shift: Vector3::zeros(),
            turn_deg: 0.0,
            first: None,
            second: None,
        }
    }

    /// True where the point with the number comes next.
    pub(crate) const fn is_point(&self, number: u32) -> bool {
        match self {
            Self::Points { first: None, .. } => number == 1,
            Self::Points { second: None, .. } => number == 2,
            Self::Points { .. } => number == 3,
            Self::Directions { .. } => false,
        }
    }

    /// The plane with its first or second point.
    pub(crate) fn and_point(mut self, point: Vector3<f64>) -> Self {
        if let Self::Points { first, second, .. } = &mut self {
            let next = if first.is_none() { first } else { second };
            *next = Some(point);
        }
        self
    }
}
