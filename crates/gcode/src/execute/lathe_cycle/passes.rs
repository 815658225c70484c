//! The passes: layer by layer into the stock, then along the contour.
//!
//! A level is passed from the way down to it up to the first wall of the contour. Then the tool
//! retreats at 45°, goes back above the level, and down to the next one:
//!
//! ```text
//!            ◄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄   ╲  back, at rapid speed
//!           ╱                          ▼
//!     wall ║◄──────────────────────────●   pass, at the feedrate
//!          ║                            ╲
//!          ╰─────────── contour ─────────╲  way down
//! ```
//!
//! The first way down is the straight one from the start to the first point of the contour, at
//! rapid speed, or at the feedrate where the profile of a FANUC begins with G1. Below that the tool follows the contour. Where the contour falls, a pocket begins:
//! it is the way down, at the feedrate, and the pocket's levels are passed on it, before the tool
//! goes on along its bottom.

use crate::execute::compensation::element::Point;
use crate::execute::lathe_cycle::pass_axes::{ContourPiece, PieceShape, ROUNDING_MM};
use crate::execute::motion::speed::Pace;
use crate::syntax::modes::Pockets;

/// Levels and ways that differ by no more are the same, mm.
const SAME_MM: f64 = 1e-6;
/// Most passes of one cycle.
pub(super) const MAX_PASSES: f64 = 10_000.0;
/// Most moves of one cycle: they are in memory together.
pub(crate) const MAX_PASS_MOVES: usize = 50_000;

/// A move of the tool, in *a* and *b*.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PassMove {
    Rapid(Point),
    Feed(Point),
    /// End, centre, and whether it turns left.
    Arc(Point, Point, bool),
}

/// Why there are no passes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NoPasses {
    /// The start is on the side of the workpiece.
    WrongSide,
    /// More than can be.
    TooMany,
}

/// The words of G71 and G72, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Roughing {
    pub(super) pockets: Pockets,
    /// Depth of a pass, > 0.
    pub(super) increment_mm: f64,
    /// How far the tool retreats behind a pass, along *a* and *b*, ≥ 0.
    pub(super) retract_mm: f64,
    /// How many increments below the start the first pass is.
    pub(super) first_level: f64,
    /// At which speed the tool goes down the first way.
    pub(super) infeed: Pace,
}

/// The moves of a roughing cycle along a contour, for a tool at `start`.
pub(crate) fn rough(
    contour: &[ContourPiece],
    start: Point,
    words: Roughing,
) -> Result<Vec<PassMove>, NoPasses> {
    let Some((first, last)) = contour.first().zip(contour.last()) else {
        return Err(NoPasses::TooMany);
    };
    let begin = first.start;
    if start[1] < begin[1] - ROUNDING_MM {
        return Err(NoPasses::WrongSide);
    }
    let mut pieces = vec![ContourPiece::line(
        [start[0].max(begin[0]), start[1]],
        begin,
    )];
    pieces.extend(contour.iter().flat_map(monotone).flatten());
    if last.end[1] < start[1] {
        pieces.push(ContourPiece::line(last.end, [last.end[0], start[1]]));
    }
    let lowest = pieces
        .iter()
        .map(|piece| piece.end[1])
        .fold(start[1], f64::min);
    if (start[1] - lowest) / words.increment_mm > MAX_PASSES {
        return Err(NoPasses::TooMany);
    }
    let mut passes = Passes {
        pieces: &pieces,
        words,
        moves: Vec::new(),
    };
    let from = pieces.first().map_or(start, |way| way.start);
    passes.moves.push(PassMove::Rapid(from));
    passes.all(start[1])?;
    Ok(passes.moves)
}

/// The moves of one finishing pass along a contour, for a tool at `start`, that comes to its first point
/// as `infeed` says. A tool above the contour first goes beside it.
pub(crate) fn finish(contour: &[ContourPiece], start: Point, infeed: Pace) -> Vec<PassMove> {
    let begin = contour.first().map(|piece| piece.start);
    let aside = begin
        .filter(|begin| start[0] < begin[0] - SAME_MM)
        .map(|begin| PassMove::Rapid([begin[0], start[1]]));
    let along = contour.iter().map(|piece| along(piece, piece.end));
    aside
        .into_iter()
        .chain(begin.map(|begin| down(infeed, begin)))
        .chain(along)
        .collect()
}

/// The way from the end of a contour to where the straight one to `start` is free of it: none if it
/// is already, else up beside the contour and back above it.
pub(crate) fn lift(contour: &[ContourPiece], start: Point) -> Vec<PassMove> {
    let (Some(begin), Some(last)) = (contour.first(), contour.last()) else {
        return Vec::new();
    };
    let (begin, end) = (begin.start, last.end);
    let top = |piece: &ContourPiece| {
        let ends = piece.start[1].max(piece.end[1]);
        monotone(piece)[0].map_or(ends, |first| ends.max(first.end[1]))
    };
    let way = |a: f64| end[1] + (a - end[0]) / (start[0] - end[0]) * (start[1] - end[1]);
    let is_below = |piece: &ContourPiece| {
        let low = way(piece.start[0]).min(way(piece.end[0]));
        top(piece) <= low + SAME_MM
    };
    let beside = start[0].max(begin[0]);
    if start[0] >= begin[0] && contour.iter().all(is_below) {
        return Vec::new();
    }
    let level = contour.iter().map(top).fold(start[1], f64::max);
    vec![
        PassMove::Feed([end[0], level]),
        PassMove::Rapid([beside, level]),
    ]
}

/// The move down the first way.
const fn down(infeed: Pace, end: Point) -> PassMove {
    match infeed {
        Pace::Rapid => PassMove::Rapid(end),
        Pace::Feed => PassMove::Feed(end),
    }
}

/// A piece in parts that rise or fall all along.
fn monotone(piece: &ContourPiece) -> [Option<ContourPiece>; 2] {
    let top = match piece.shape {
        PieceShape::Line(..) => return [Some(*piece), None],
        PieceShape::Hill(center, radius) => [center[0], center[1] + radius],
        PieceShape::Valley(center, radius) => [center[0], center[1] - radius],
    };
    let inside = top[0] < piece.start[0] - SAME_MM && top[0] > piece.end[0] + SAME_MM;
    if !inside {
        return [Some(*piece), None];
    }
    let (mut before, mut after) = (*piece, *piece);
    before.end = top;
    after.start = top;
    [Some(before), Some(after)]
}

/// The move along a piece to a point of it.
const fn along(piece: &ContourPiece, end: Point) -> PassMove {
    match piece.shape.turn() {
        None => PassMove::Feed(end),
        Some((center, left)) => PassMove::Arc(end, center, left),
    }
}

struct Passes<'a> {
    /// The way to the first point, the contour in rising and falling parts, the wall that closes
    /// it.
    pieces: &'a [ContourPiece],
    words: Roughing,
    moves: Vec<PassMove>,
}

impl Passes<'_> {
    fn all(&mut self, top: f64) -> Result<(), NoPasses> {
        let falling = self.pieces.iter().take_while(|piece| piece.falls()).count();
        for index in 0..falling.max(1) {
            if self.words.pockets == Pockets::Only {
                self.go_along(index);
            } else {
                self.descend(index, top)?;
            }
        }
        if self.words.pockets == Pockets::LeftOut {
            self.climb(falling.max(1));
            return Ok(());
        }
        // The levels count from the start, or from the first point of the pockets.
        let mut origin = (self.words.pockets == Pockets::Cut).then_some(top);
        for (index, piece) in self.pieces.iter().enumerate().skip(falling.max(1)) {
            if !piece.falls() {
                self.go_along(index);
                continue;
            }
            // A pocket inside another one shares its levels.
            if self.words.pockets == Pockets::Only {
                origin = Some(origin.map_or(piece.start[1], |level| level.max(piece.start[1])));
            }
            self.descend(index, origin.unwrap_or(top))?;
        }
        Ok(())
    }

    /// Along a piece to its end; down the first way before the contour begins.
    fn go_along(&mut self, index: usize) {
        let Some(piece) = self.pieces.get(index) else {
            return;
        };
        self.moves.push(if index == 0 {
            down(self.words.infeed, piece.end)
        } else {
            along(piece, piece.end)
        });
    }

    /// Down a falling piece, with a pass at every level of it. The levels count from `origin`.
    fn descend(&mut self, index: usize, origin: f64) -> Result<(), NoPasses> {
        let Some(piece) = self.pieces.get(index).copied() else {
            return Ok(());
        };
        let increment = self.words.increment_mm;
        let mut count = ((origin - piece.start[1] - SAME_MM) / increment)
            .ceil()
            .max(if index == 0 {
                self.words.first_level
            } else {
                0.0
            });
        loop {
            let level = origin - count * increment;
            if !piece.falls() || level < piece.end[1] + if index == 0 { SAME_MM } else { -SAME_MM }
            {
                break;
            }
            let level = level.clamp(piece.end[1], piece.start[1]);
            let at = [piece.at_level(level), level];
            self.pass(index, &piece, at);
            if self.moves.len() > MAX_PASS_MOVES {
                return Err(NoPasses::TooMany);
            }
            count += 1.0;
        }
        self.go_along(index);
        Ok(())
    }

    /// To a place on the way down, from there to the next wall, and back.
    fn pass(&mut self, index: usize, piece: &ContourPiece, at: Point) {
        let [a, level] = at;
        self.moves.push(if index == 0 {
            down(self.words.infeed, at)
        } else {
            along(piece, at)
        });
        let wall = self.wall(index + 1, level);
        let length = a - wall;
        if length <= SAME_MM {
            return;
        }
        let retract = self.words.retract_mm.min(0.5 * length);
        self.moves.extend([
            PassMove::Feed([wall, level]),
            PassMove::Rapid([wall + retract, level + retract]),
            PassMove::Rapid([a - retract, level + retract]),
            if index == 0 {
                down(self.words.infeed, at)
            } else {
                PassMove::Feed(at)
            },
        ]);
    }

    /// Where a level meets the contour, from a piece on.
    fn wall(&self, from: usize, level: f64) -> f64 {
        let mut after = self.pieces.iter().skip(from);
        let wall = after.find(|piece| !piece.falls() && piece.end[1] >= level - SAME_MM);
        match wall {
            Some(piece) if piece.start[1] >= level => piece.start[0],
            Some(piece) => piece.at_level(level),
            None => self.pieces.last().map_or(0.0, |piece| piece.end[0]),
        }
    }

    /// Along the contour from a piece on, across its pockets.
    fn climb(&mut self, from: usize) {
        let mut level = self
            .pieces
            .get(from.saturating_sub(1))
            .map_or(f64::NEG_INFINITY, |piece| piece.end[1]);
        for piece in self.pieces.iter().skip(from) {
            if piece.falls() || piece.end[1] < level - SAME_MM {
                continue;
            }
            if piece.start[1] < level - SAME_MM {
                self.moves
                    .push(PassMove::Feed([piece.at_level(level), level]));
            } else {
                self.moves.push(PassMove::Feed(piece.start));
            }
            self.moves.push(along(piece, piece.end));
            level = piece.end[1];
        }
    }
}
