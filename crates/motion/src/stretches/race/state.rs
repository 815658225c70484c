//! What is known of a race: both ways, which of them is driven, and how it can be left.

use crate::PlanError;
use crate::in_tube::SearchWeights;
use crate::stretches::joint::{Joint, SEAM};
use crate::stretches::program_path::ProgramPath;
use crate::stretches::runner::{ItemLog, Runner};
use crate::stretches::way::Manner;
use glidepath_geometry::AxisVector;
use glidepath_program::{Frame, Item, Override, Settings};
use std::collections::VecDeque;
use std::ops::Range;

/// Periods by which the motion may be later than along the path alone: a joint waits for the grid.
pub(super) const LATE: i64 = 1;
/// The ways.
pub(super) const TUBE: usize = 0;
pub(super) const PATH: usize = 1;

/// Both ways along a stretch.
#[derive(Debug, Clone)]
pub(in crate::stretches) struct Race {
    pub(super) settings: Settings,
    pub(super) log: ItemLog,
    pub(super) ways: [Runner; 2],
    pub(super) program: ProgramPath,
    /// The way that is driven.
    pub(super) on: usize,
    /// The other one does not count any more.
    pub(super) is_decided: bool,
    /// Periods by which its frames come later than by its own count, and what is added to its path
    /// positions.
    pub(super) shift: i64,
    pub(super) shift_s: f64,
    /// How the way driven can be left for the other one where the section at hand begins.
    pub(super) leave: Option<Joint>,
    pub(super) late: i64,
    /// The first frames of the section, and how many were looked at.
    pub(super) begins: [usize; 2],
    pub(super) looked: usize,
    /// A joint under way.
    pub(super) joint: VecDeque<Frame>,
    /// Frames of the way driven before this one are given out.
    pub(super) release: usize,
}

impl Race {
    pub(in crate::stretches) fn new(
        settings: Settings,
        start: AxisVector,
        wanted: Override,
    ) -> Self {
        let manners = [Manner::InTube(SearchWeights::USUAL), Manner::OnPath];
        // Both begin at the same place at the same time.
        let leave = Joint {
            from: 0,
            to: 1,
            frames: Vec::new(),
            shift_s: 0.0,
        };
        Self {
            settings,
            log: ItemLog::default(),
            ways: manners.map(|manner| Runner::new(manner, settings, start, wanted)),
            program: ProgramPath::new(settings, wanted),
            on: TUBE,
            is_decided: false,
            shift: 0,
            shift_s: 0.0,
            leave: Some(leave),
            late: LATE,
            begins: [1; 2],
            looked: 0,
            joint: VecDeque::new(),
            release: 1,
        }
    }

    /// Takes the next item, whose block is its number.
    pub(in crate::stretches) fn push(&mut self, item: &Item) -> Result<(), PlanError> {
        self.program.push(item);
        self.log.push(*item);
        let counts = self.counting();
        self.ways[counts]
            .iter_mut()
            .try_for_each(|way| way.push(item))
    }

    /// The ways that are planned.
    pub(super) const fn counting(&self) -> Range<usize> {
        if self.is_decided {
            self.on..self.on + 1
        } else {
            TUBE..PATH + 1
        }
    }

    /// The stretch ends with what has been pushed.
    pub(in crate::stretches) fn finish(&mut self) {
        self.log.finish();
        for way in &mut self.ways {
            way.finish();
        }
    }

    /// Drops what nothing more is asked of.
    pub(super) fn forget(&mut self) {
        let ways = &self.ways[self.counting()];
        let items = ways.iter().map(Runner::first_item).min();
        self.log.forget_before(items.unwrap_or(0));
        let number = |way: &Runner| way.frame(way.first()).map_or(0, |frame| frame.block);
        let number = ways.iter().map(number).min();
        self.program.forget_before(number.unwrap_or(0));
    }

    /// Periods in a time, rounded up.
    pub(super) fn periods(&self, t: f64) -> usize {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a float to integer cast saturates, and periods are positive"
        )]
        let periods = (t / self.settings.period_t).ceil() as usize;
        periods.max(2 * SEAM)
    }
}
