//! The findings on the shape of a motion: how far it is beyond the figure of the program, and
//! where.

use core::fmt;
use glidepath_geometry::Axis;

/// Further than this on the side of a stop or of a corner where the program is not is a finding, mm or
/// degrees.
pub const BEYOND_MM: f64 = 1e-3;
/// Findings that are kept.
pub const KEPT: usize = 8;

/// A place where the motion is beyond the figure of the program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShapeFinding {
    /// The axis that goes beyond the place where it comes to a rest, sets out from one or turns round;
    /// none where it is a corner that the motion is outside of.
    pub axis: Option<Axis>,
    /// How far at most, mm, or degrees of a rotary axis.
    pub distance_mm: f64,
    /// Source line of the motion there.
    pub line: u32,
}

impl fmt::Display for ShapeFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            axis,
            distance_mm,
            line,
        } = self;
        match axis {
            Some(axis) => {
                let unit = if axis.is_rotary() { "°" } else { "mm" };
                write!(
                    f,
                    "line {line}: {axis} goes {distance_mm:.4} {unit} beyond its stop"
                )
            }
            None => write!(f, "line {line}: {distance_mm:.4} mm outside of the corner"),
        }
    }
}

/// The findings of a motion: one for a vertex at most, the worst.
#[derive(Debug, Default)]
pub(super) struct Findings {
    pub(super) count: u64,
    pub(super) kept: [Option<ShapeFinding>; KEPT],
    /// The vertex at hand, by the number of the move behind it, and the worst there.
    vertex: u64,
    worst: Option<ShapeFinding>,
}

impl Findings {
    /// At a vertex the motion is so far beyond.
    pub(super) fn see(&mut self, vertex: u64, finding: ShapeFinding) {
        if vertex != self.vertex {
            self.settle();
            self.vertex = vertex;
        }
        let worst_mm = self.worst.map_or(BEYOND_MM, |worst| worst.distance_mm);
        if finding.distance_mm > worst_mm {
            self.worst = Some(finding);
        }
    }

    /// Nothing more is seen of the vertex at hand.
    pub(super) fn settle(&mut self) {
        if let Some(worst) = self.worst.take() {
            let free = self.kept.iter_mut().find(|kept| kept.is_none());
            if let Some(free) = free {
                *free = Some(worst);
            }
            self.count += 1;
        }
    }
}
