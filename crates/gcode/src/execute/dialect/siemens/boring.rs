//! CYCLE87, 88 and 89: holes that are bored, at the place where the tool stands.
//!
//! | cycle | down | at the bottom | out |
//! |---|---|---|---|
//! | 87, 88 | feed, with the spindle on (SDIR 3 or 4) | –, dwell DTB; the spindle stops, and the program (M0) | rapid |
//! | 89 | feed | dwell DTB | feed to SDIS, rapid from there |

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::dialect::siemens::arguments::Arguments;
use crate::execute::dialect::siemens::lines::Lines;
use crate::execute::interpreter::Interpreter;

/// What a dwell means.
const DWELL: &str = "seconds at the bottom; turns are not counted";

impl Interpreter {
    /// CYCLE87, and CYCLE88, which dwells: where SDIR and DTB are among the arguments.
    pub(super) fn bore_to_stop(
        &self,
        arguments: Arguments<'_>,
        direction: usize,
        dwell: Option<usize>,
    ) -> Outcome<Lines> {
        let levels = arguments.levels(arguments.get(4))?;
        let direction = arguments.choice(direction, "SDIR", &[3, 4])?;
        let mut lines = self.above(arguments, levels)?;
        lines.line(format!("M{direction}"));
        lines.along("G1", levels.bottom);
        if let Some(dwell) = dwell {
            lines.dwell(arguments.not_negative(dwell, "DTB", DWELL)?);
        }
        lines.line("M5");
        lines.line("M0");
        lines.along("G0", levels.retract);
        Ok(lines)
    }

    /// CYCLE89.
    pub(super) fn bore_both_ways(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        let levels = arguments.levels(arguments.get(4))?;
        let mut lines = self.above(arguments, levels)?;
        lines.along("G1", levels.bottom);
        lines.dwell(arguments.not_negative(5, "DTB", DWELL)?);
        lines.along("G1", levels.clear);
        lines.along("G0", levels.retract);
        Ok(lines)
    }
}
