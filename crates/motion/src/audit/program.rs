//! The programmed path as chords, made when they are needed.
//!
//! A line is one chord, an arc many. Inner points of an arc lie slightly outside it, so that the
//! polygon is as far outside at its corners as it is inside between them: the distance from the arc
//! is half the sagitta.

use crate::{Event, Item, ItemKind, PathMode, Rate};
use glidepath_geometry::{Arc, AxisVector, Segment, feed_length};
use std::collections::VecDeque;

/// Distance between an arc and its chords, as a part of the tolerance.
pub(super) const FLATTENING: f64 = 1e-5;
/// A tolerance of zero would leave no room for rounding, mm.
pub(super) const SMALLEST_TOLERANCE_MM: f64 = 1e-6;
/// A tolerance counts as kept up to this factor; on arcs the chords come in addition.
const SLACK: f64 = 1.0 + 1e-6;
/// Turns sharper than this are corners to a path in exact-path mode, sine of half the angle.
const CORNER_SB: f64 = 1e-3;

/// A chord of the programmed path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    pub(super) start: AxisVector,
    pub(super) end: AxisVector,
    /// Tolerance along it, mm.
    pub(super) tolerance_mm: f64,
    /// Tolerance at its end, mm.
    pub(super) end_tolerance_mm: f64,
    /// Its end must be met.
    pub(super) is_end_exact: bool,
    /// Feedrate, mm/s; infinite for a rapid.
    pub(super) feed_v: f64,
    pub(super) line: u32,
}

#[derive(Debug, Clone, Copy)]
struct Move {
    segment: Segment,
    line: u32,
    feed_v: f64,
    /// Larger of the tolerances at its start and end.
    tolerance_mm: f64,
    end_tolerance_mm: f64,
    is_end_exact: bool,
    /// In exact-path mode: exact if the next move turns off.
    is_exact_at_turn: bool,
}

/// Whether a chord is there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Presence {
    /// It can be had with [`Rows::get`].
    Here,
    /// The program has not been fed that far.
    NotYet,
    /// The program ends before it.
    Never,
}

/// A window on the chords of the program.
#[derive(Debug)]
pub(super) struct Rows {
    window: VecDeque<Row>,
    /// Index of the first chord of the window.
    base: usize,
    ready: VecDeque<Move>,
    /// Chords already made of the first ready move.
    done: u32,
    /// The last move fed: what follows it decides about its end.
    pending: Option<Move>,
    is_ended: bool,
    end_position: Option<AxisVector>,
    default_tolerance_mm: f64,
    corner_tolerance_mm: f64,
    max_tolerance_mm: f64,
    moves: u64,
    path_length_mm: f64,
}

impl Rows {
    pub(super) fn new(tolerance_mm: f64) -> Self {
        let tolerance_mm = tolerance_mm.max(SMALLEST_TOLERANCE_MM);
        Self {
            window: VecDeque::new(),
            base: 0,
            ready: VecDeque::new(),
            done: 0,
            pending: None,
            is_ended: false,
            end_position: None,
            default_tolerance_mm: tolerance_mm,
            corner_tolerance_mm: 0.0,
            max_tolerance_mm: tolerance_mm,
            moves: 0,
            path_length_mm: 0.0,
        }
    }

    /// Largest tolerance so far, mm.
    pub(super) const fn max_tolerance_mm(&self) -> f64 {
        self.max_tolerance_mm
    }

    /// Moves fed.
    pub(super) const fn moves(&self) -> u64 {
        self.moves
    }

    /// Where the program fed so far ends, if it moves at all.
    pub(super) const fn end_position(&self) -> Option<AxisVector> {
        self.end_position
    }

    /// Feed length fed, mm.
    pub(super) const fn path_length_mm(&self) -> f64 {
        self.path_length_mm
    }

    pub(super) fn feed(&mut self, item: &Item) {
        match &item.kind {
            ItemKind::Move {
                segment,
                rate,
                mode,
            } => self.feed_move(item.line, segment, *rate, *mode),
            ItemKind::Dwell(_) => self.stop(),
            ItemKind::Event(event) => match event {
                Event::SpindleSpeed(_) | Event::SelectTool(_) => {}
                Event::MCode(_) | Event::ProgramStop(_) | Event::OptionalStop => self.stop(),
            },
        }
    }

    /// The machine rests here.
    fn stop(&mut self) {
        if let Some(pending) = &mut self.pending {
            pending.is_end_exact = true;
        }
    }

    fn feed_move(&mut self, line: u32, segment: &Segment, rate: Rate, mode: PathMode) {
        self.moves += 1;
        let length = segment.length();
        self.path_length_mm += length;
        let is_stop = mode == PathMode::ExactStop;
        let end_tolerance_mm = match mode {
            PathMode::Continuous {
                tolerance_mm: Some(tolerance),
            } => tolerance,
            _ => self.default_tolerance_mm,
        }
        .max(SMALLEST_TOLERANCE_MM);
        self.max_tolerance_mm = self.max_tolerance_mm.max(end_tolerance_mm);
        let slack = match segment {
            Segment::Line(_) => SLACK,
            Segment::Arc(_) => SLACK + 3.0 * FLATTENING,
        };
        if length <= 0.0 {
            if is_stop {
                self.stop();
            }
            return;
        }
        if let Some(mut previous) = self.pending.take() {
            previous.is_end_exact |= previous.is_exact_at_turn && turns(&previous.segment, segment);
            let gap = segment.start() - previous.segment.end();
            let (from, to) = (previous.segment.end(), segment.start());
            self.ready.push_back(previous);
            if gap.amax() > 0.0 {
                // Programs are continuous; should one not be, the motion has to bridge the gap.
                let bridge = Segment::line(from, to);
                self.ready.push_back(Move {
                    segment: bridge,
                    is_end_exact: false,
                    ..previous
                });
            }
        }
        self.end_position = Some(segment.end());
        self.pending = Some(Move {
            segment: *segment,
            line,
            feed_v: match rate {
                Rate::Rapid => f64::INFINITY,
                Rate::Feed(feed_v) => feed_v,
            },
            tolerance_mm: end_tolerance_mm.max(self.corner_tolerance_mm) * slack,
            end_tolerance_mm: end_tolerance_mm * slack,
            is_end_exact: is_stop,
            is_exact_at_turn: mode == PathMode::ExactPath,
        });
        self.corner_tolerance_mm = end_tolerance_mm;
    }

    /// Nothing more will be fed: the end of the program is an exact stop.
    pub(super) fn end(&mut self) {
        self.stop();
        self.ready.extend(self.pending.take());
        self.is_ended = true;
    }

    /// Drops what has been fed: nothing will be matched any more.
    pub(super) fn discard(&mut self) {
        self.ready.clear();
        self.window.clear();
    }

    /// Makes chord `index` if the program has been fed that far.
    pub(super) fn reach(&mut self, index: usize) -> Presence {
        while self.base + self.window.len() <= index {
            let Some(&next) = self.ready.front() else {
                return if self.is_ended {
                    Presence::Never
                } else {
                    Presence::NotYet
                };
            };
            let count = chords(&next);
            let start = match self.window.back() {
                Some(row) if self.done > 0 => row.end,
                _ => next.segment.start(),
            };
            self.done += 1;
            let is_last = self.done >= count;
            let end = if is_last {
                next.segment.end()
            } else {
                inner_point(&next, self.done, count)
            };
            self.window.push_back(Row {
                start,
                end,
                tolerance_mm: next.tolerance_mm,
                end_tolerance_mm: if is_last {
                    next.end_tolerance_mm
                } else {
                    next.tolerance_mm
                },
                is_end_exact: is_last && next.is_end_exact,
                feed_v: next.feed_v,
                line: next.line,
            });
            if is_last {
                self.ready.pop_front();
                self.done = 0;
            }
        }
        Presence::Here
    }

    /// Chord `index`, if it is in the window.
    pub(super) fn get(&self, index: usize) -> Option<&Row> {
        self.window.get(index.checked_sub(self.base)?)
    }

    /// Forgets the chords before `index`, except the last one made.
    pub(super) fn forget_before(&mut self, index: usize) {
        while self.base < index && self.window.len() > 1 {
            self.window.pop_front();
            self.base += 1;
        }
    }
}

/// Number of chords of a move.
fn chords(of: &Move) -> u32 {
    let Segment::Arc(arc) = &of.segment else {
        return 1;
    };
    let radius = arc.start_radius().max(arc.end_radius());
    // A chord over the angle α has sagitta R·α²/8, twice the distance that is allowed.
    let angle = (16.0 * FLATTENING * of.tolerance_mm / radius)
        .sqrt()
        .min(0.5);
    let count = (arc.sweep_rad.abs() / angle).ceil().clamp(1.0, 1e9);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped"
    )]
    let count = count as u32;
    count
}

/// Point `k` of `count` on an arc, moved outwards by half the sagitta.
fn inner_point(of: &Move, k: u32, count: u32) -> AxisVector {
    let fraction = f64::from(k) / f64::from(count);
    let length = of.segment.length();
    let mut point = of.segment.jet(length * fraction).position;
    if let Segment::Arc(arc) = &of.segment {
        push_outwards(arc, &mut point, f64::from(count));
    }
    point
}

fn push_outwards(arc: &Arc, point: &mut AxisVector, count: f64) {
    let (first, second) = arc.plane.axes();
    let angle = arc.sweep_rad / count;
    let factor = 1.0 + angle * angle / 16.0;
    for (axis, center) in [first, second].into_iter().zip(arc.center) {
        let i = axis.index();
        point[i] = center + (point[i] - center) * factor;
    }
}

/// Whether the path turns between two segments.
fn turns(from: &Segment, to: &Segment) -> bool {
    let (t1, t2) = (from.jet(from.length()).d1, to.jet(0.0).d1);
    feed_length(&(t2 - t1)) > 2.0 * CORNER_SB
}
