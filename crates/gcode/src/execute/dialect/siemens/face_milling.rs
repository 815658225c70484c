//! CYCLE71: a rectangle is milled flat, stroke by stroke and level by level.
//!
//! ```text
//!            ●────────────────────────────────●  strokes end R + FDP outside; the last one is FDP1
//!      FDP   │    ┌──────────────────────┐    │  farther than the edge, less R
//!     ◄──►   │    │         LENG         │    │
//!            ●────┼──────────────────────┼────●  at most MIDA from stroke to stroke
//!                 │                      │
//!            ●────┼──────────────────────┼────●
//!                 └──────────────────────┘
//!              PA, PO, turned by STA about this corner
//! ```
//!
//! | VARI | tens | ones |
//! |---|---|---|
//! | 1 | strokes along the first axis, in one direction | roughing in levels of MID, FALD is left |
//! | 2 | along the second axis, in one direction | finishing in one level |
//! | 3, 4 | as 1 and 2, to and fro | |
//!
//! Down is outside of the rectangle, at feed from SDIS above what the level before has left. Between
//! strokes to and fro the tool goes at feed outside of it; of those in one direction it comes back at
//! rapid, above it.

use glidepath_geometry::Axis;

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::dialect::siemens::arguments::Arguments;
use crate::execute::dialect::siemens::cycle::{diameters, plane_axes};
use crate::execute::dialect::siemens::lines::Lines;
use crate::execute::interpreter::Interpreter;

/// Strokes are this part of the tool's diameter apart where MIDA does not say so.
const USUAL_WIDTH: f64 = 0.8;
/// Most lines of a stroke.
const LINES: f64 = 5.0;

/// The face in its own directions: along the strokes, and from stroke to stroke.
struct Face {
    corner: [f64; 2],
    /// Lengths with their signs.
    along: f64,
    across: f64,
    /// The strokes go along the second axis.
    is_upright: bool,
    /// Sine and cosine of the angle by which it is turned.
    turn: (f64, f64),
    tool_radius: f64,
    /// How far beyond the edges a stroke begins and ends.
    beyond: f64,
    /// How wide all strokes together cut, from the first edge on.
    width: f64,
    strokes: f64,
    to_and_fro: bool,
}

impl Face {
    /// A place in the two axes of the plane.
    fn place(&self, along: f64, across: f64) -> [f64; 2] {
        let along = along * self.along.signum();
        let across = across * self.across.signum();
        let (u, v) = if self.is_upright {
            (across, along)
        } else {
            (along, across)
        };
        let (sin, cos) = self.turn;
        [
            self.corner[0] + u * cos - v * sin,
            self.corner[1] + u * sin + v * cos,
        ]
    }

    /// One level; the tool is above it, and comes back there.
    fn mill(&self, lines: &mut Lines, level: f64, clear: f64, feed: f64) {
        let (near, far) = (-self.beyond, self.along.abs() + self.beyond);
        let (mut stroke, mut is_back) = (1.0, false);
        while stroke <= self.strokes {
            let across = self.width * stroke / self.strokes - self.tool_radius;
            let (from, to) = if is_back { (far, near) } else { (near, far) };
            let begin = self.place(from, across);
            if stroke > 1.0 && self.to_and_fro {
                lines.across("G1", begin);
            } else {
                lines.across("G0", begin);
                lines.along("G0", clear);
                lines.feed(feed);
                lines.along("G1", level);
            }
            lines.across("G1", self.place(to, across));
            if !self.to_and_fro || stroke >= self.strokes {
                lines.along("G0", clear);
            }
            is_back = self.to_and_fro && !is_back;
            stroke += 1.0;
        }
    }
}

/// Into how many parts, all alike and none greater than a step, a way is divided; 0: one.
pub(super) fn parts(way: f64, step: f64) -> f64 {
    if step > 0.0 {
        (way / step - 1e-9).ceil().max(1.0)
    } else {
        1.0
    }
}

impl Interpreter {
    /// CYCLE71.
    pub(super) fn mill_face(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        let levels = arguments.levels(None)?;
        let step = arguments.not_negative(9, "MID", "how deep a level is at most")?;
        let left = arguments.not_negative(12, "FALD", "what is left on the face")?;
        let feed = arguments.not_negative(13, "FFP1", "the feed in the plane")?;
        let variant = arguments.choice(14, "VARI", &[11, 12, 21, 22, 31, 32, 41, 42])?;
        let rough_bottom = levels.bottom + left;
        if rough_bottom >= levels.surface {
            return Err(arguments
                .refused("FALD is as much as the depth", "nothing would be milled")
                .help("check FALD"));
        }
        let axes = plane_axes(self, arguments)?;
        if self.counts_diameters() && axes.iter().take(2).any(|axis| *axis == Axis::X) {
            return Err(diameters(arguments, "with its corner"));
        }
        let face = self.face(arguments, variant / 10)?;
        let (mut above, bottom, count) = if variant % 10 == 2 {
            (rough_bottom, levels.bottom, 1.0)
        } else {
            let depth = levels.surface - rough_bottom;
            (levels.surface, rough_bottom, parts(depth, step))
        };
        Lines::check_count(count * face.strokes * LINES + 4.0, arguments)?;
        let mut lines = Lines::new(axes);
        lines.along("G0", levels.retract);
        let clearance = levels.clear - levels.surface;
        let (top, mut index) = (above, 1.0);
        while index <= count {
            let level = if index < count {
                top - (top - bottom) * index / count
            } else {
                bottom
            };
            face.mill(&mut lines, level, above + clearance, feed);
            above = level;
            index += 1.0;
        }
        lines.along("G0", levels.retract);
        Ok(lines)
    }

    /// The face and its strokes, of which the tens of VARI say how they go.
    fn face(&self, arguments: Arguments<'_>, way: i32) -> Outcome<Face> {
        let corner = [
            arguments.need(4, "PA", "the corner of the face, first axis")?,
            arguments.need(5, "PO", "the corner of the face, second axis")?,
        ];
        let length = arguments.need(6, "LENG", "the length along the first axis")?;
        let side = arguments.need(7, "WID", "the width along the second axis")?;
        if length == 0.0 || side == 0.0 {
            return Err(arguments
                .refused("LENG or WID is zero", "a face has a length and a width")
                .help("write both, with the signs of their directions"));
        }
        let tool_radius = self.mill_radius(arguments)?;
        let overrun = arguments.not_negative(11, "FDP", "how far strokes go beyond the edge")?;
        let meaning = "how far the last stroke is beyond the edge";
        let last = arguments.not_negative(15, "FDP1", meaning)?;
        let apart = match arguments.not_negative(10, "MIDA", "how far strokes are apart")? {
            0.0 => USUAL_WIDTH * 2.0 * tool_radius,
            apart if apart <= 2.0 * tool_radius * (1.0 + 1e-9) => apart,
            apart => {
                let message = format!("MIDA is {apart}, more than the tool's diameter");
                return Err(arguments
                    .refused(message, "something would be left between the strokes")
                    .help("write the diameter or less, or leave it out"));
            }
        };
        let is_upright = way % 2 == 0;
        let (along, across) = if is_upright {
            (side, length)
        } else {
            (length, side)
        };
        let width = across.abs() + last;
        Ok(Face {
            corner,
            along,
            across,
            is_upright,
            turn: arguments.or_zero(8).to_radians().sin_cos(),
            tool_radius,
            beyond: tool_radius + overrun,
            width,
            strokes: parts(width, apart),
            to_and_fro: way >= 3,
        })
    }
}
