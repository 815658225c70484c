//! The findings on the shape of a motion: how far it is beyond the figure of the program, and
//! where.

use core::fmt;
use glidepath_geometry::Axis;

/// Further than this on the side of a stop or of a corner where the program is not, or beside a straight move
/// in its middle half, is a finding, mm or degrees.
pub const BEYOND_MM: f64 = 1e-3;
/// Findings that are kept.
pub const KEPT: usize = 8;

/// What a motion is beyond.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Border {
    /// The place where an axis comes to a rest, sets out from one or turns round.
    Stop(Axis),
    /// The sides of a corner, which it is outside of.
    Corner,
    /// The line of a straight feed move, which it is beside in its middle half.
    Straight,
}

/// A place where the motion is beyond the figure of the program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShapeFinding {
    /// What it is beyond.
    pub border: Border,
    /// How far at most, mm, or degrees of a rotary axis.
    pub distance_mm: f64,
    /// Source line of the motion there.
    pub line: u32,
}

impl fmt::Display for ShapeFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            border,
            distance_mm,
            line,
        } = self;
        match border {
            Border::Stop(axis) => {
                let unit = if axis.is_rotary() { "°" } else { "mm" };
                write!(
                    f,
                    "line {line}: {axis} goes {distance_mm:.4} {unit} beyond its stop"
                )
            }
            Border::Corner => write!(f, "line {line}: {distance_mm:.4} mm outside of the corner"),
            Border::Straight => write!(
                f,
                "line {line}: {distance_mm:.4} mm beside the middle half of the straight move"
            ),
        }
    }
}

/// The findings of a motion: one for a vertex, and for a straight move, at most, the worst.
#[derive(Debug, Default)]
pub(super) struct Findings {
    pub(super) count: u64,
    /// Those of straight moves.
    pub(super) beside_count: u64,
    pub(super) kept: [Option<ShapeFinding>; KEPT],
    /// The vertex at hand, by the number of the move behind it, and the worst there.
    vertex: Worst,
    /// The straight move at hand, by its number, likewise.
    straight: Worst,
}

/// The worst at one place of the program.
#[derive(Debug, Default)]
struct Worst {
    number: u64,
    worst: Option<ShapeFinding>,
}

impl Worst {
    /// The worst of the place before, if this is another one.
    fn see(&mut self, number: u64, finding: ShapeFinding) -> Option<ShapeFinding> {
        let before = self.worst.take_if(|_| number != self.number);
        self.number = number;
        let worst_mm = self.worst.map_or(BEYOND_MM, |worst| worst.distance_mm);
        if finding.distance_mm > worst_mm {
            self.worst = Some(finding);
        }
        before
    }
}

impl Findings {
    /// At a vertex, by the number of the move behind it, the motion is so far beyond.
    pub(super) fn see(&mut self, vertex: u64, finding: ShapeFinding) {
        let before = self.vertex.see(vertex, finding);
        self.keep(before);
    }

    /// On a straight move, by its number, it is so far beside.
    pub(super) fn see_beside(&mut self, number: u64, finding: ShapeFinding) {
        let before = self.straight.see(number, finding);
        self.keep(before);
    }

    /// Nothing more is seen of the places at hand.
    pub(super) fn settle(&mut self) {
        for worst in [self.vertex.worst.take(), self.straight.worst.take()] {
            self.keep(worst);
        }
    }

    fn keep(&mut self, worst: Option<ShapeFinding>) {
        if let Some(worst) = worst {
            let free = self.kept.iter_mut().find(|kept| kept.is_none());
            if let Some(free) = free {
                *free = Some(worst);
            }
            self.count += 1;
            self.beside_count += u64::from(worst.border == Border::Straight);
        }
    }
}
