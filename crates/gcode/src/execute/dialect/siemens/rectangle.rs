//! A rectangle with round corners that the tool goes round, inside of a pocket or outside of a spigot.

use crate::execute::dialect::siemens::lines::Lines;
use crate::execute::dialect::siemens::pocket::arc_code;

/// The rectangle, turned by STA about its centre.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rectangle {
    pub(super) center: [f64; 2],
    /// The sense in which it is gone round.
    pub(super) is_clockwise: bool,
    /// Cosine and sine of STA.
    pub(super) turn: [f64; 2],
}

/// A ring: half its length and width, and the radius of its corners.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ring {
    pub(super) half: [f64; 2],
    pub(super) corner: f64,
}

impl Ring {
    /// The same ring, farther inside.
    pub(super) fn inside(self, by: f64) -> Self {
        Self {
            half: self.half.map(|half| (half - by).max(0.0)),
            corner: (self.corner - by).max(0.0),
        }
    }
}

impl Rectangle {
    /// A way along length and width, in the plane; against the sense of counting it is mirrored.
    pub(super) fn turned(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let v = if self.is_clockwise { -v } else { v };
        let [cos, sin] = self.turn;
        [u * cos - v * sin, u * sin + v * cos]
    }

    pub(super) fn point(&self, place: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.turned(place);
        [self.center[0] + x, self.center[1] + y]
    }

    pub(super) fn line_to(&self, lines: &mut Lines, place: [f64; 2]) {
        lines.across("G1", self.point(place));
    }

    pub(super) fn arc_to(&self, lines: &mut Lines, place: [f64; 2], center: [f64; 2]) {
        let code = arc_code(self.is_clockwise);
        lines.arc(code, self.point(place), None, self.turned(center), 1);
    }

    /// Once around, from the middle of the side at the end of the length, where the tool stands.
    pub(super) fn around(&self, lines: &mut Lines, ring: Ring) {
        let ([a, b], c) = (ring.half, ring.corner);
        // Corner by corner: where it begins, where it ends, and its centre from its beginning.
        for (from, to, center) in [
            ([a, b - c], [a - c, b], [-c, 0.0]),
            ([c - a, b], [-a, b - c], [0.0, -c]),
            ([-a, c - b], [c - a, -b], [c, 0.0]),
            ([a - c, -b], [a, c - b], [0.0, c]),
        ] {
            self.line_to(lines, from);
            if c > 0.0 {
                self.arc_to(lines, to, center);
            }
        }
        self.line_to(lines, [a, 0.0]);
    }
}
