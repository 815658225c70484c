//! The marks of blocks: to which of the program a place on the path belongs.
//!
//! Places are lengths along the merged chords of a run of blocks. Line numbers are kept for every
//! block; rates and events only where they change, for blocks are merged only where they do not.

use crate::programmed_rate::ProgrammedRate;
use glidepath_program::{Event, ProgramLine};
use std::collections::VecDeque;

/// A foot this near an end of a part is there: rounding must make no block of its own out of what is left.
const AT_END_U: f64 = 1e-9;

/// What a block changes when it is entered.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Change {
    /// The rate from here on.
    pub rate: ProgrammedRate,
    /// What happens here, without stopping the motion.
    pub events: Vec<Event>,
}

/// From some place of a part of the path on, another block is driven.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cut {
    /// Where: 0 at the start of the part, 1 at its end, in its own parameter.
    pub from_u: f64,
    /// Source line of the block.
    pub line: ProgramLine,
    /// Its rate and events, if they are others than before.
    pub change: Option<Change>,
}

#[derive(Debug, Clone)]
struct Mark {
    from_t: f64,
    line: ProgramLine,
    change: Option<Change>,
}

/// The blocks of a run that have not been put out.
#[derive(Debug, Clone, Default)]
pub(super) struct Marks {
    waiting: VecDeque<Mark>,
    /// The line of the block at hand.
    line: ProgramLine,
}

impl Marks {
    /// A block begins at a length.
    pub(super) fn push(&mut self, from_t: f64, line: ProgramLine, change: Option<Change>) {
        self.waiting.push_back(Mark {
            from_t,
            line,
            change,
        });
    }

    pub(super) fn len(&self) -> usize {
        self.waiting.len()
    }

    /// The blocks driven on a part that ends where the next one's foot is at 1. The foot of a
    /// length is its place on the part: below 0 before it.
    pub(super) fn take(&mut self, mut foot: impl FnMut(f64) -> f64) -> Vec<Cut> {
        let mut cuts = Vec::with_capacity(1);
        while let Some(mark) = self.waiting.front() {
            let from_u = foot(mark.from_t).max(0.0);
            if from_u > 1.0 - AT_END_U {
                break;
            }
            if from_u > AT_END_U && cuts.is_empty() {
                cuts.push(Cut {
                    from_u: 0.0,
                    line: self.line,
                    change: None,
                });
            }
            let Some(Mark { line, change, .. }) = self.waiting.pop_front() else {
                break;
            };
            self.line = line;
            cuts.push(Cut {
                from_u,
                line,
                change,
            });
        }
        if cuts.is_empty() {
            cuts.push(Cut {
                from_u: 0.0,
                line: self.line,
                change: None,
            });
        }
        cuts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_told_by_the_part_they_begin_on() {
        let mut marks = Marks::default();
        for line in 1..=4 {
            let number = ProgramLine {
                number: line,
                block: 0,
            };
            marks.push(f64::from(line - 1), number, None);
        }
        let lines = |cuts: Vec<Cut>| -> Vec<(f64, u32)> {
            cuts.into_iter()
                .map(|cut| (cut.from_u, cut.line.number))
                .collect()
        };
        // A part from 0 to 2.5, then one to 2.75, then the rest.
        let first = lines(marks.take(|t| t / 2.5));
        assert_eq!(first, [(0.0, 1), (0.4, 2), (0.8, 3)]);
        assert_eq!(lines(marks.take(|t| (t - 2.5) / 0.25)), [(0.0, 3)]);
        let last = lines(marks.take(|t| (t - 2.75) / 0.5));
        assert_eq!(last, [(0.0, 3), (0.5, 4)]);
        assert_eq!(marks.len(), 0);
    }
}
