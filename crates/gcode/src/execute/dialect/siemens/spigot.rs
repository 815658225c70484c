//! CYCLE76 and CYCLE77: rectangular and circular spigots, gone round once in each level.
//!
//! ```text
//!        ┌───────────────────┐ blank, AP1 (and AP2)
//!        │   ╭───────────╮   │
//!        │   │  spigot   │◄──┼─╮ half a circle to it, and another one off it
//!        │   │           │   │ ● down at FFD, outside of the blank, towards +X, turned by STA
//!        │   ╰───────────╯   │
//!        └───────────────────┘
//! ```
//!
//! VARI 1 leaves FAL at the side and FALD on the bottom, VARI 2 nothing. Both go down in equal levels of MID
//! at most. CDIR: 0 climb, 1 against it (as the spindle turns), 2 clockwise, 3 counterclockwise. LENG, WID, PRAD
//! and AP are dimensions of the whole spigot, PA and PO its centre. Only one way round is made: what the blank has
//! beyond the tool's diameter stays.

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::dialect::siemens::arguments::{Arguments, Levels};
use crate::execute::dialect::siemens::cycle::{diameters, plane_axes};
use crate::execute::dialect::siemens::face_milling::parts;
use crate::execute::dialect::siemens::lines::Lines;
use crate::execute::dialect::siemens::pocket::arc_code;
use crate::execute::dialect::siemens::rectangle::{Rectangle, Ring};
use crate::execute::interpreter::Interpreter;
use glidepath_geometry::Axis;

/// Lines of a level, but for those of its way round.
const LINES: f64 = 6.0;

/// A spigot with its tool, in the units in force.
struct Spigot {
    levels: Levels,
    axes: [Axis; 3],
    /// Where the tool goes: its half length along the first direction is [`Self::reach`].
    rectangle: Rectangle,
    /// From the centre to the path of the tool's centre, in the first direction.
    reach: f64,
    /// From there to where it goes down.
    aside: f64,
    bottom: f64,
    step: f64,
    feed: f64,
    plunge: f64,
}

impl Spigot {
    /// All levels, each gone round by `around` from the place in the first direction and back to it.
    fn milled(&self, arguments: Arguments<'_>, around: impl Fn(&mut Lines)) -> Outcome<Lines> {
        let depth = self.levels.surface - self.bottom;
        let count = parts(depth, self.step);
        Lines::check_count(count * (LINES + 9.0), arguments)?;
        let (near, far) = ([self.reach, 0.0], [self.reach + self.aside, 0.0]);
        let code = arc_code(!self.rectangle.is_clockwise);
        let half = 0.5 * self.aside;
        let mut lines = Lines::new(self.axes);
        lines.along("G0", self.levels.retract);
        lines.across("G0", self.rectangle.point(far));
        lines.along("G0", self.levels.clear);
        let mut index = 1.0;
        while index <= count {
            lines.feed(self.plunge);
            lines.along("G1", self.levels.surface - depth * index / count);
            lines.feed(self.feed);
            let to = self.rectangle.point(near);
            lines.arc(code, to, None, self.rectangle.turned([-half, 0.0]), 1);
            around(&mut lines);
            let to = self.rectangle.point(far);
            lines.arc(code, to, None, self.rectangle.turned([half, 0.0]), 1);
            index += 1.0;
        }
        lines.along("G0", self.levels.retract);
        Ok(lines)
    }
}

/// Where the arguments behind the shape of a spigot are.
struct Places {
    center: usize,
    depth: usize,
    blank: usize,
}

impl Interpreter {
    /// What both have in common: half of the spigot in its first direction is `half`, without allowance.
    fn spigot(
        &self,
        arguments: Arguments<'_>,
        places: &Places,
        (half, angle): (f64, f64),
    ) -> Outcome<(Spigot, f64)> {
        let levels = arguments.levels(arguments.get(4))?;
        let axes = plane_axes(self, arguments)?;
        if self.counts_diameters() && axes.iter().take(2).any(|axis| *axis == Axis::X) {
            return Err(diameters(arguments, "with its centre"));
        }
        let at = |offset: usize| places.depth + offset;
        let step = arguments.not_negative(at(0), "MID", "how deep a level is at most")?;
        let edge = arguments.not_negative(at(1), "FAL", "what is left at the side")?;
        let floor = arguments.not_negative(at(2), "FALD", "what is left on the bottom")?;
        let feed = arguments.not_negative(at(3), "FFP1", "the feed in the plane")?;
        let plunge = arguments.not_negative(at(4), "FFD", "the feed down")?;
        let direction = arguments.choice(at(5), "CDIR", &[0, 1, 2, 3])?;
        let finishes = arguments.choice(at(6), "VARI", &[1, 2])? == 2;
        let [edge, floor] = if finishes { [0.0; 2] } else { [edge, floor] };
        if floor >= levels.surface - levels.bottom {
            return Err(arguments
                .refused("FALD is as much as the depth", "nothing would be milled")
                .help("check FALD"));
        }
        let blank = arguments.not_negative(places.blank, "AP1", "the size of the blank")?;
        let tool = self.mill_radius(arguments)?;
        // Outside of an edge the tool climbs the other way round.
        let is_clockwise = self.pocket_direction(arguments, at(5))? != (direction < 2);
        let center = [
            arguments.need(places.center, "PA", "the centre, first axis")?,
            arguments.need(places.center + 1, "PO", "the centre, second axis")?,
        ];
        let reach = half + edge + tool;
        let clearance = levels.clear - levels.surface;
        let outside = (0.5 * blank + tool + clearance).max(reach + tool);
        let (sin, cos) = angle.to_radians().sin_cos();
        let spigot = Spigot {
            bottom: levels.bottom + floor,
            levels,
            axes,
            rectangle: Rectangle {
                center,
                is_clockwise,
                turn: [cos, sin],
            },
            reach,
            aside: outside - reach,
            step,
            feed,
            plunge,
        };
        Ok((spigot, edge + tool))
    }

    /// CYCLE76.
    pub(super) fn rectangular_spigot(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        let length = arguments.positive(5, "LENG", "the length of the spigot")?;
        let width = arguments.positive(6, "WID", "the width of the spigot")?;
        let corner = arguments.not_negative(7, "CRAD", "the radius of the corners")?;
        if 2.0 * corner > length.min(width) * (1.0 + 1e-9) {
            return Err(arguments
                .refused(
                    format!("corners with a radius of {corner}"),
                    "they are at most half as wide as the spigot",
                )
                .help("check CRAD"));
        }
        let places = Places {
            center: 8,
            depth: 11,
            blank: 18,
        };
        let turn = arguments.or_zero(10);
        let (spigot, away) = self.spigot(arguments, &places, (0.5 * length, turn))?;
        let ring = Ring {
            half: [0.5 * length + away, 0.5 * width + away],
            corner: corner + away,
        };
        spigot.milled(arguments, |lines| spigot.rectangle.around(lines, ring))
    }

    /// CYCLE77.
    pub(super) fn circular_spigot(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        let diameter = arguments.positive(5, "PRAD", "the diameter of the spigot")?;
        let places = Places {
            center: 6,
            depth: 8,
            blank: 15,
        };
        let (spigot, _) = self.spigot(arguments, &places, (0.5 * diameter, 0.0))?;
        let code = arc_code(spigot.rectangle.is_clockwise);
        let start = spigot.rectangle.point([spigot.reach, 0.0]);
        spigot.milled(arguments, |lines| {
            lines.arc(code, start, None, [-spigot.reach, 0.0], 1);
        })
    }
}
