//! A pending segment: its end is not decided before the next segment is known.

use crate::on_path::junction::JunctionSide;
use crate::programmed_rate::ProgrammedRate;
use glidepath_geometry::Segment;
use glidepath_program::{Event, PathMode, ProgramLine};

/// A segment whose end is not decided yet.
#[derive(Debug, Clone)]
pub(crate) struct Pending {
    pub segment: Segment,
    pub length_s: f64,
    pub rate: ProgrammedRate,
    /// The rate under the override at hand, where the segment can be driven at it.
    pub rate_v: f64,
    pub line: ProgramLine,
    /// The lines of further blocks on it, and where on it they start.
    pub lines: Vec<(f64, ProgramLine)>,
    pub mode: PathMode,
    /// Length at the start that the junction before has replaced.
    pub trimmed_s: f64,
    pub events: Vec<Event>,
    /// How far it is from the program, mm.
    pub error_mm: f64,
    /// Whether it continues a curve at its start, and is continued by one at its end: then the
    /// junction at the other end may take all of it.
    pub continues: [bool; 2],
}

impl Pending {
    /// The segment as one that a junction ends.
    pub(crate) const fn ending(&self) -> JunctionSide<'_> {
        self.side(self.continues[0])
    }

    /// The segment as one that a junction starts.
    pub(crate) const fn starting(&self) -> JunctionSide<'_> {
        self.side(self.continues[1])
    }

    const fn side(&self, is_whole: bool) -> JunctionSide<'_> {
        JunctionSide {
            segment: &self.segment,
            mode: self.mode,
            length_s: self.length_s,
            share_s: if is_whole {
                self.length_s
            } else {
                0.5 * self.length_s
            },
            rate_v: self.rate_v,
            synchronised: self.rate.rate.is_synchronised(),
            error_mm: self.error_mm,
        }
    }

    /// The line of the last block on it.
    pub(crate) fn last_line(&self) -> ProgramLine {
        self.lines.last().map_or(self.line, |(_, line)| *line)
    }
}
