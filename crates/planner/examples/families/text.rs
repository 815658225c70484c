//! The text of a program as it grows.

use std::fmt::Write as _;

/// A program in G-code, in mm, whose first point is machine zero.
#[derive(Debug)]
pub(crate) struct Text {
    lines: String,
    /// The first point; coordinates are written from there.
    origin: [f64; 3],
    decimals: usize,
}

impl Text {
    /// A program that starts at a point and drives at a feedrate.
    pub(crate) fn new(start: [f64; 3], feed_mm_min: f64) -> Self {
        Self {
            lines: format!("G21 G90 G94 G17 F{feed_mm_min:.0}\n"),
            origin: start,
            decimals: 6,
        }
    }

    /// The same with another number of decimals.
    pub(crate) const fn rounded(mut self, decimals: usize) -> Self {
        self.decimals = decimals;
        self
    }

    fn word(&mut self, letter: char, value: f64) {
        // −0 is written as 0.
        let value = if value.abs() < 1e-9 { 0.0 } else { value };
        // Writing to a String does not fail.
        let _ = write!(self.lines, " {letter}{value:.*}", self.decimals);
    }

    fn end(&mut self, to: [f64; 3]) {
        for (axis, letter) in ['X', 'Y', 'Z'].into_iter().enumerate() {
            self.word(letter, to[axis] - self.origin[axis]);
        }
    }

    /// A straight move.
    pub(crate) fn line(&mut self, to: [f64; 3]) {
        self.lines.push_str("G1");
        self.end(to);
        self.lines.push('\n');
    }

    /// A straight move of X and Y; Z stays where it is.
    pub(crate) fn line_xy(&mut self, to: [f64; 2]) {
        self.lines.push_str("G1");
        self.word('X', to[0] - self.origin[0]);
        self.word('Y', to[1] - self.origin[1]);
        self.lines.push('\n');
    }

    /// An arc in X and Y about a centre, told from where it starts; Z ends at a height if it moves.
    pub(crate) fn arc(&mut self, arc: &ArcTo) {
        self.lines
            .push_str(if arc.is_clockwise { "G2" } else { "G3" });
        self.word('X', arc.to[0] - self.origin[0]);
        self.word('Y', arc.to[1] - self.origin[1]);
        if let Some(z) = arc.z {
            self.word('Z', z - self.origin[2]);
        }
        self.word('I', arc.center[0] - arc.from[0]);
        self.word('J', arc.center[1] - arc.from[1]);
        self.lines.push('\n');
    }

    /// Any other lines.
    pub(crate) fn raw(&mut self, lines: &str) {
        self.lines.push_str(lines);
        self.lines.push('\n');
    }

    /// The whole text.
    pub(crate) fn finish(mut self) -> String {
        self.lines.push_str("M2\n");
        self.lines
    }
}

/// An arc in X and Y.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ArcTo {
    pub(crate) from: [f64; 2],
    pub(crate) to: [f64; 2],
    pub(crate) center: [f64; 2],
    pub(crate) is_clockwise: bool,
    pub(crate) z: Option<f64>,
}
