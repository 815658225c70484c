//! The dense runs of short lines in a program, and what is between them.

use glidepath_fit::Point;
use glidepath_geometry::{LINEAR_XYZ, Segment};
use glidepath_program::{Item, ItemKind, PathMode, Rate};

/// Fewer lines than this are no run.
const FEWEST: usize = 16;

/// A piece of a program.
#[allow(clippy::large_enum_variant, reason = "nearly every piece is an item")]
#[derive(Debug, Clone, PartialEq)]
pub enum ProgramPiece {
    /// Lines in X, Y and Z one after the other, at one feedrate in one path mode.
    Run(Run),
    /// Anything else.
    Item(Item),
}

/// A run of lines.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Its items, at least two.
    pub items: Vec<Item>,
    /// mm/s.
    pub feed_v: f64,
    /// How it goes through its corners.
    pub mode: PathMode,
}

impl Run {
    /// The start and the end of each line.
    #[must_use]
    pub fn points(&self) -> Vec<Point> {
        let segment = |item: &Item| match item.kind {
            ItemKind::Move { segment, .. } => Some(segment),
            _ => None,
        };
        let first = self.items.first().and_then(segment).map(|s| s.start());
        let ends = self.items.iter().filter_map(segment).map(|s| s.end());
        first
            .into_iter()
            .chain(ends)
            .map(|at| at.fixed_rows::<3>(LINEAR_XYZ.start).into_owned())
            .collect()
    }

    /// First and last source line.
    #[must_use]
    pub fn lines(&self) -> (u32, u32) {
        let line = |item: Option<&Item>| item.map_or(0, |item| item.line);
        (line(self.items.first()), line(self.items.last()))
    }
}

/// Sorts the items of a program.
#[derive(Debug, Default)]
pub struct Runs {
    pieces: Vec<ProgramPiece>,
    run: Option<Run>,
}

impl Runs {
    /// Takes the next item.
    pub fn push(&mut self, item: Item) {
        let Some((feed_v, mode)) = short_line(&item) else {
            self.end_run();
            self.pieces.push(ProgramPiece::Item(item));
            return;
        };
        let same = |run: &&mut Run| run.feed_v.to_bits() == feed_v.to_bits() && run.mode == mode;
        if let Some(run) = self.run.as_mut().filter(same) {
            run.items.push(item);
            return;
        }
        self.end_run();
        self.run = Some(Run {
            items: vec![item],
            feed_v,
            mode,
        });
    }

    /// The whole program.
    #[must_use]
    pub fn finish(mut self) -> Vec<ProgramPiece> {
        self.end_run();
        self.pieces
    }

    fn end_run(&mut self) {
        let Some(run) = self.run.take() else { return };
        if run.items.len() >= FEWEST {
            self.pieces.push(ProgramPiece::Run(run));
        } else {
            self.pieces
                .extend(run.items.into_iter().map(ProgramPiece::Item));
        }
    }
}

/// Feedrate and path mode of a line in X, Y and Z that may be left by a tolerance.
fn short_line(item: &Item) -> Option<(f64, PathMode)> {
    let ItemKind::Move {
        segment: Segment::Line(line),
        rate: Rate::Feed(feed_v),
        mode: mode @ PathMode::Continuous { .. },
    } = item.kind
    else {
        return None;
    };
    let displacement = line.displacement();
    let others = displacement.iter().skip(LINEAR_XYZ.end);
    others
        .into_iter()
        .all(|d| *d == 0.0)
        .then_some((feed_v, mode))
}
