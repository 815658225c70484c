//! CYCLE81, 82, 83, 85 and 86: holes at the place where the tool stands.
//!
//! Each goes at rapid to SDIS above the surface, at feed to the bottom, and out to RTP:
//!
//! | cycle | down | at the bottom | out |
//! |---|---|---|---|
//! | 81, 82 | feed | dwell DTB | rapid |
//! | 83 | in strokes: the first to FDEP, each shorter than the one before by DAM, none shorter than DAM | dwell DTB | rapid |
//! | 85 | feed FFR | dwell DTB | feed RFF to SDIS, rapid from there |
//! | 86 | feed, with the spindle on (SDIR 3 or 4) | dwell DTB, the spindle stops at POSS, rapid by RPA, RPO, RPAP | rapid, and back in the plane |
//!
//! Behind each stroke CYCLE83 breaks the chip (VARI 0: VRT back, or 1 mm) or clears it (VARI 1: out to SDIS,
//! dwell DTS, and back to DIS1 above the depth reached; 0: 0.6 mm, or a fiftieth of the depth where that is
//! more, 7 mm at most). Of strokes as long as DAM the last two are alike. Of DAM below zero the
//! negative is the part of a stroke that the next one has; none is shorter than MDEP then.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::execute::dialect::siemens::arguments::{Arguments, Levels};
use crate::execute::dialect::siemens::cycle::{coordinate, plane_axes};
use crate::execute::dialect::siemens::lines::Lines;
use crate::execute::interpreter::Interpreter;
use crate::syntax::modes::FeedMode;

/// Most strokes of a hole.
const MAX_STROKES: usize = 10_000;
/// Newer arguments of CYCLE83: the least stroke, the way back that breaks a chip, the dwell at the last depth,
/// how far above the depth reached rapid ends.
const MDEP: usize = 13;
const VRT: usize = 14;
const DTD: usize = 15;
const DIS1: usize = 16;
/// How far the tool goes back to break a chip, mm.
const CHIP_BREAK_MM: f64 = 1.0;
/// Depths as near to the bottom as this are the bottom, in the units in force.
const BOTTOM: f64 = 1e-6;

#[cold]
fn least_beside_amount(arguments: Arguments<'_>, least: f64, less: f64) -> Box<BlockDiagnostic> {
    let message = format!("MDEP {least} beside DAM {less}, whose strokes become shorter");
    arguments
        .refused(
            message,
            "the least stroke counts where DAM is a factor, below zero",
        )
        .help("leave MDEP out, or write DAM as a factor")
}

impl Interpreter {
    /// The lines of a cycle that begins: above the hole, clear of the surface.
    pub(super) fn above(&self, arguments: Arguments<'_>, levels: Levels) -> Outcome<Lines> {
        let mut lines = Lines::new(plane_axes(self, arguments)?);
        lines.along("G0", levels.clear);
        Ok(lines)
    }

    /// CYCLE81 and CYCLE82.
    pub(super) fn drill(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        let levels = arguments.levels(arguments.get(4))?;
        let dwell =
            arguments.not_negative(5, "DTB", "seconds at the bottom; turns are not counted")?;
        let mut lines = self.above(arguments, levels)?;
        lines.along("G1", levels.bottom);
        lines.dwell(dwell);
        lines.along("G0", levels.retract);
        Ok(lines)
    }

    /// CYCLE83.
    pub(super) fn deep_drill(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        let levels = arguments.levels(arguments.get(4))?;
        let meaning = "seconds at the bottom; turns are not counted";
        let dwell = arguments.not_negative(8, "DTB", meaning)?;
        let dwell_out =
            arguments.not_negative(9, "DTS", "seconds outside; turns are not counted")?;
        let clears = arguments.choice(11, "VARI", &[0, 1])? == 1;
        let factor = arguments
            .get(10)
            .filter(|factor| *factor != 0.0)
            .unwrap_or(1.0);
        if !(0.001..=1.0).contains(&factor) {
            let message = format!("FRF is {factor}");
            return Err(arguments
                .refused(
                    message,
                    "the feed of the first stroke is a part of the feed in force",
                )
                .help("write a factor from 0.001 to 1"));
        }
        let unit = self.state.modal.units.mm();
        let depth = levels.surface - levels.bottom;
        let meaning = "how far above the depth reached rapid ends";
        let ahead = match arguments.not_negative(DIS1, "DIS1", meaning)? {
            0.0 if depth * unit <= 30.0 => 0.6 / unit,
            0.0 => (depth / 50.0).min(7.0 / unit),
            ahead => ahead,
        };
        let back = match arguments.not_negative(VRT, "VRT", "how far to go back to break a chip")? {
            0.0 => CHIP_BREAK_MM / unit,
            back => back,
        };
        let meaning = "seconds at the last depth; turns are not counted";
        let dwell_last = match arguments.not_negative(DTD, "DTD", meaning)? {
            0.0 => dwell,
            dwell => dwell,
        };
        let mut lines = self.above(arguments, levels)?;
        let seconds = match self.state.modal.feed_mode {
            FeedMode::PerRevolution => 1.0,
            FeedMode::PerMinute | FeedMode::InverseTime => 60.0,
        };
        let feed = self
            .state
            .modal
            .feed
            .map(|feed| feed.linear_v * seconds / self.feed_unit_mm());
        if let Some(feed) = feed.filter(|_| factor < 1.0) {
            lines.feed(feed * factor);
        }
        let strokes = self.strokes(arguments, levels)?;
        let last = strokes.len().saturating_sub(1);
        for (index, level) in strokes.into_iter().enumerate() {
            lines.along("G1", level);
            lines.dwell(if index == last { dwell_last } else { dwell });
            if let Some(feed) = feed.filter(|_| index == 0 && factor < 1.0) {
                lines.feed(feed);
            }
            if index == last {
                break;
            }
            if clears {
                lines.along("G0", levels.clear);
                lines.dwell(dwell_out);
                lines.along("G0", (level + ahead).min(levels.clear));
            } else {
                lines.along("G1", (level + back).min(levels.clear));
            }
        }
        lines.along("G0", levels.retract);
        Ok(lines)
    }

    /// The depths of a deep hole, down to the bottom.
    fn strokes(&self, arguments: Arguments<'_>, levels: Levels) -> Outcome<Vec<f64>> {
        let relative = arguments.get(6).filter(|depth| *depth != 0.0);
        let first = match (relative, arguments.get(5)) {
            (Some(depth), _) => levels.surface - depth.abs(),
            (None, Some(level)) => level,
            (None, None) => levels.bottom,
        };
        if first >= levels.surface {
            return Err(arguments
                .refused(
                    "the first depth is not below the surface",
                    "FDEP is a coordinate below RFP",
                )
                .help("check FDEP and FDPR"));
        }
        let less = arguments.or_zero(7);
        if less < -1.0 {
            let message = format!("DAM is {less}");
            return Err(arguments
                .refused(
                    message,
                    "below zero it is a factor, which makes strokes shorter",
                )
                .help("write a factor from -1 to 0, or by how much each stroke is shorter"));
        }
        let least = arguments.not_negative(MDEP, "MDEP", "the least stroke")?;
        let mut level = first.max(levels.bottom);
        let mut stroke = levels.surface - level;
        let mut strokes = vec![level];
        while level > levels.bottom + BOTTOM {
            let left = level - levels.bottom;
            if less > 0.0 {
                stroke = (stroke - less).max(less);
            } else if less < 0.0 {
                stroke = (stroke * -less).max(least);
            }
            // The last two are alike, so that none is too thin to cut.
            let are_alike =
                less > 0.0 && stroke <= less && left > stroke + BOTTOM && left < 2.0 * less;
            let next = if are_alike { 0.5 * left } else { stroke };
            if less > 0.0 && next < least - BOTTOM && left > next + BOTTOM {
                return Err(least_beside_amount(arguments, least, less));
            }
            if are_alike {
                strokes.extend([level - 0.5 * left, levels.bottom]);
                break;
            }
            level = if left <= stroke + BOTTOM {
                levels.bottom
            } else {
                level - stroke
            };
            if strokes.len() >= MAX_STROKES || stroke <= BOTTOM {
                return Err(arguments
                    .refused("too many strokes", "the strokes of a hole are bounded")
                    .help("use a greater first depth, or another DAM"));
            }
            strokes.push(level);
        }
        Ok(strokes)
    }

    /// CYCLE85.
    pub(super) fn ream(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        let levels = arguments.levels(arguments.get(4))?;
        let meaning = "seconds at the bottom; turns are not counted";
        let dwell = arguments.not_negative(5, "DTB", meaning)?;
        let inwards = arguments.not_negative(6, "FFR", "the feed down")?;
        let outwards = arguments.not_negative(7, "RFF", "the feed up")?;
        let mut lines = self.above(arguments, levels)?;
        lines.feed(inwards);
        lines.along("G1", levels.bottom);
        lines.dwell(dwell);
        lines.feed(outwards);
        lines.along("G1", levels.clear);
        lines.along("G0", levels.retract);
        Ok(lines)
    }

    /// CYCLE86.
    pub(super) fn bore(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        let levels = arguments.levels(arguments.get(4))?;
        let meaning = "seconds at the bottom; turns are not counted";
        let dwell = arguments.not_negative(5, "DTB", meaning)?;
        let direction = arguments.choice(6, "SDIR", &[3, 4])?;
        let by = [7, 8, 9].map(|index| arguments.or_zero(index));
        let angle = arguments.or_zero(10);
        if by[2] < 0.0 {
            return Err(arguments
                .refused("RPAP leads downwards", "the tool stands at the bottom")
                .help("write a way upwards"));
        }
        let axes = plane_axes(self, arguments)?;
        let at = axes.map(|axis| coordinate(self, axis));
        let mut lines = self.above(arguments, levels)?;
        lines.line(format!("M{direction}"));
        lines.along("G1", levels.bottom);
        lines.dwell(dwell);
        // Without an angle it is 0, or the spindle's own where it does not turn to any.
        lines.line(if angle == 0.0 {
            "M19".to_owned()
        } else {
            format!("M19 R[{}]", angle.rem_euclid(360.0))
        });
        if by.iter().any(|way| *way != 0.0) {
            let to = [at[0] + by[0], at[1] + by[1], levels.bottom + by[2]];
            lines.go("G0", to.map(Some));
        }
        lines.along("G0", levels.retract);
        lines.across("G0", [at[0], at[1]]);
        Ok(lines)
    }
}
