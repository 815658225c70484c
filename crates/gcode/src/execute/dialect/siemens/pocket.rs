//! What both pockets have in common: tool, levels, directions, insertion.
//!
//! ```text
//! level by level:  the centre ── down (VARI: at rapid, at feed, on a helix) ── rings outwards, MIDA
//!                  apart at most ── back to the centre
//! ```
//!
//! | VARI | tens | ones |
//! |---|---|---|
//! | 0 | down at rapid, at feed to finish | as 1 |
//! | 1 | down at feed FFD | roughing, FAL and FALD are left |
//! | 2 | down on a helix, radius RAD1, DP1 a turn | finishing: the edge, then the bottom if FALD is left on it |
//!
//! The edge is finished in levels too; the tool comes to it and leaves it on quarter circles. CDIR:
//! 0 climb, 1 against it (as the spindle turns), 2 clockwise, 3 counterclockwise. Not covered: pockets
//! that were begun before (AP1, AP2, AD), swinging down (VARI 3x), a corner as the reference point.

use glidepath_geometry::Axis;

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::dialect::siemens::arguments::{Arguments, Levels};
use crate::execute::dialect::siemens::cycle::{coordinate, diameters, plane_axes};
use crate::execute::dialect::siemens::lines::Lines;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::spindle::SpindleDirection;

/// Rings farther apart than this part of the tool's diameter would leave islands in corners.
pub(super) const MAX_WIDTH: f64 = 0.8;

/// Where the arguments of a pocket are, behind DP: the two cycles have them in other places.
pub(super) struct Places {
    pub(super) center: usize,
    pub(super) depth: usize,
    pub(super) premachined: core::ops::Range<usize>,
    pub(super) helix: usize,
}

/// How the tool comes down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Insertion {
    Rapid,
    Feed,
    /// Radius, and depth of a turn.
    Helix(f64, f64),
}

/// A pocket with its tool, in the units in force.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pocket {
    pub(super) levels: Levels,
    pub(super) axes: [Axis; 3],
    pub(super) center: [f64; 2],
    /// How deep a level is at most; zero: all at once.
    pub(super) step: f64,
    /// What is left at the edge.
    pub(super) edge: f64,
    /// What is left on the bottom.
    pub(super) floor: f64,
    pub(super) feed: f64,
    pub(super) plunge: f64,
    pub(super) is_clockwise: bool,
    pub(super) insertion: Insertion,
    pub(super) finishes: bool,
    /// How far rings are apart at most.
    pub(super) width: f64,
    pub(super) tool_radius: f64,
}

/// `G2` or `G3`.
pub(super) const fn arc_code(is_clockwise: bool) -> &'static str {
    if is_clockwise { "G2" } else { "G3" }
}

impl Pocket {
    /// `G2` or `G3` along the edge.
    pub(super) const fn arc(&self) -> &'static str {
        arc_code(self.is_clockwise)
    }

    /// The levels from the surface down to `bottom`, alike.
    fn depths(&self, bottom: f64) -> f64 {
        let depth = self.levels.surface - bottom;
        if self.step > 0.0 {
            (depth / self.step - 1e-9).ceil().max(1.0)
        } else {
            1.0
        }
    }

    /// How many rings lie between the innermost path and the outermost one, which is `reach` away.
    pub(super) fn rings(&self, reach: f64) -> f64 {
        (reach / self.width - 1e-9).ceil().max(1.0)
    }

    /// The way from level to level, with `clear` at each: it is given the number of the level.
    pub(super) fn machined(
        &self,
        arguments: Arguments<'_>,
        lines_of_level: f64,
        clear: impl Fn(&mut Lines),
        finish: impl Fn(&mut Lines),
    ) -> Outcome<Lines> {
        let rough_bottom = self.levels.bottom + self.floor;
        let bottom = if self.finishes {
            self.levels.bottom
        } else {
            rough_bottom
        };
        let depths = self.depths(bottom);
        Lines::check_count((depths + 1.0) * (lines_of_level + 8.0), arguments)?;
        let mut lines = Lines::new(self.axes);
        lines.along("G0", self.levels.retract);
        lines.across("G0", self.center);
        lines.along("G0", self.levels.clear);
        let (mut from, mut count) = (self.levels.surface, 0.0);
        while count < depths {
            count += 1.0;
            let level = self.levels.surface - (self.levels.surface - bottom) * count / depths;
            self.insert(&mut lines, from, level);
            lines.feed(self.feed);
            if self.finishes {
                finish(&mut lines);
            } else {
                clear(&mut lines);
            }
            lines.across("G1", self.center);
            from = level;
        }
        if self.finishes && self.floor > 0.0 {
            // The tool stands at the bottom, where the edge was finished last.
            clear(&mut lines);
            lines.across("G1", self.center);
        }
        lines.along("G0", self.levels.retract);
        Ok(lines)
    }

    /// Down at the centre, from one level to the next.
    fn insert(&self, lines: &mut Lines, from: f64, level: f64) {
        match self.insertion {
            Insertion::Rapid => lines.along("G0", level),
            Insertion::Feed => {
                lines.feed(self.plunge);
                lines.along("G1", level);
            }
            Insertion::Helix(radius, pitch) => {
                let start = [self.center[0] + radius, self.center[1]];
                let turns = ((from - level) / pitch - 1e-9).ceil().max(1.0);
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "turns are checked to be few"
                )]
                let turns = turns as u32;
                lines.feed(self.plunge);
                lines.across("G1", start);
                lines.along("G1", from);
                lines.arc(self.arc(), start, Some(level), [-radius, 0.0], turns);
                // What the helix leaves as a ramp.
                lines.arc(self.arc(), start, None, [-radius, 0.0], 1);
            }
        }
    }
}

impl Interpreter {
    /// What the arguments of a pocket say but for its shape.
    pub(super) fn pocket(&self, arguments: Arguments<'_>, places: &Places) -> Outcome<Pocket> {
        let levels = arguments.levels(None)?;
        let axes = plane_axes(self, arguments)?;
        let at = |offset: usize| places.depth + offset;
        for index in places.premachined.clone() {
            if arguments.or_zero(index) != 0.0 {
                return Err(arguments
                    .refused(
                        "a pocket that was begun before (AP1, AP2, AD)",
                        "its first rings would cut air, or too much",
                    )
                    .help("leave these arguments out: the whole pocket is cleared"));
            }
        }
        let step = arguments.not_negative(at(0), "MID", "how deep a level is at most")?;
        let edge = arguments.not_negative(at(1), "FAL", "what is left at the edge")?;
        let floor = arguments.not_negative(at(2), "FALD", "what is left on the bottom")?;
        let feed = arguments.not_negative(at(3), "FFP1", "the feed in the plane")?;
        let plunge = arguments.not_negative(at(4), "FFD", "the feed down")?;
        if floor >= levels.surface - levels.bottom {
            return Err(arguments
                .refused(
                    "FALD is as much as the depth",
                    "nothing would be left to clear",
                )
                .help("check FALD"));
        }
        let tool_radius = self.mill_radius(arguments)?;
        let variant = arguments.choice(at(6), "VARI", &[0, 1, 2, 10, 11, 12, 20, 21, 22])?;
        let finishes = variant % 10 == 2;
        let insertion = match variant / 10 {
            0 if !finishes => Insertion::Rapid,
            // What roughing left on the bottom is no place to go to at rapid.
            0 | 1 => Insertion::Feed,
            _ => {
                let meaning = "the radius of the helix";
                let radius = arguments.positive(places.helix, "RAD1", meaning)?;
                let meaning = "how deep a turn of the helix is";
                let pitch = arguments.positive(places.helix + 1, "DP1", meaning)?;
                if (levels.surface - levels.bottom) / pitch > 1000.0 {
                    return Err(arguments
                        .refused(
                            "a helix of more than 1000 turns",
                            "the length of a cycle is bounded",
                        )
                        .help("use a greater DP1"));
                }
                Insertion::Helix(radius, pitch)
            }
        };
        let most = MAX_WIDTH * 2.0 * tool_radius;
        let width = match arguments.not_negative(at(7), "MIDA", "how far rings are apart")? {
            0.0 => most,
            width if width <= most * (1.0 + 1e-9) => width,
            width => {
                let message = format!("MIDA is {width}, more than 80 % of the tool's diameter");
                return Err(arguments
                    .refused(message, "it would leave islands in corners")
                    .help(format!("write {most} or less, or leave it out")));
            }
        };
        Ok(Pocket {
            levels,
            axes,
            center: self.pocket_center(arguments, places.center, axes)?,
            step,
            edge,
            floor,
            feed,
            plunge,
            is_clockwise: self.pocket_direction(arguments, at(5))?,
            insertion,
            finishes,
            width,
            tool_radius,
        })
    }

    /// The centre, in the axes of the plane: where the tool stands, if it is left out.
    pub(super) fn pocket_center(
        &self,
        arguments: Arguments<'_>,
        first: usize,
        axes: [Axis; 3],
    ) -> Outcome<[f64; 2]> {
        let given = [0, 1].map(|index| arguments.get(first + index));
        let is_written = |index: usize| axes[index] == Axis::X && given[index].is_some();
        if self.counts_diameters() && (0..2).any(is_written) {
            return Err(diameters(arguments, "with its centre"));
        }
        Ok([0, 1].map(|index| given[index].unwrap_or_else(|| coordinate(self, axes[index]))))
    }

    /// The radius of the edge in force.
    pub(super) fn mill_radius(&self, arguments: Arguments<'_>) -> Outcome<f64> {
        self.check_edge(arguments)?;
        let diameter = self.edge_in_force().map_or(0.0, |edge| edge.diameter_mm);
        if diameter > 0.0 {
            return Ok(0.5 * diameter / self.state.modal.units.mm());
        }
        let tool = self.state.tool;
        let which = match self.state.edge {
            Some(edge) if edge > 1 => format!("D{edge} of tool {tool}"),
            _ => format!("tool {tool}"),
        };
        Err(arguments
            .refused(
                format!("{which} has no diameter"),
                "the way of the tool in the cycle depends on it",
            )
            .help("change to a tool before the cycle, and give its diameter in the tool table"))
    }

    /// Refuses D0, with which the tool has no radius.
    pub(super) fn check_edge(&self, arguments: Arguments<'_>) -> Outcome<()> {
        if self.state.edge != Some(0) {
            return Ok(());
        }
        Err(arguments
            .refused(
                "no edge of the tool is in force (D0)",
                "the way of the tool in the cycle depends on the radius of one, and the control refuses it, too \
                 (alarm 61000)",
            )
            .help("write the D of the edge that cuts before the cycle"))
    }

    /// True for clockwise.
    pub(super) fn pocket_direction(&self, arguments: Arguments<'_>, index: usize) -> Outcome<bool> {
        let direction = arguments.choice(index, "CDIR", &[0, 1, 2, 3])?;
        if direction >= 2 {
            return Ok(direction == 2);
        }
        // Inside of an edge, a tool that turns clockwise climbs counterclockwise.
        let climbs_clockwise = match self.state.spindle.turning {
            Some(SpindleDirection::Clockwise) => false,
            Some(SpindleDirection::Counterclockwise) => true,
            None => {
                return Err(arguments
                    .refused(
                        "the spindle does not turn",
                        "which way is climbing depends on it",
                    )
                    .help("write M3 before it, or CDIR 2 (G2) or 3 (G3)"));
            }
        };
        Ok(climbs_clockwise == (direction == 0))
    }
}
