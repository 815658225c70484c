//! The programmed path as chords, made when they are needed.

use crate::amount::Amount;
use crate::exact_end::ExactEnd;
use crate::flatten::{CURVE_FLATTENING, FLATTENING, chords, inner_point};
use crate::free_space::{Chord, Place};
use crate::piece::Piece;
use crate::settings::AuditSettings;
use crate::tool_axis::{ToolAxis, Turn};
use crate::turn_tolerance::{TurnTolerance, turn_chords};
use glidepath_geometry::{AxisVector, Prepared, Segment};
use glidepath_program::{DirectionTolerance, Item, ItemKind, PathMode, Rate};
use std::collections::VecDeque;

/// A tolerance of zero would leave no room for rounding, mm.
pub(crate) const SMALLEST_TOLERANCE_MM: f64 = 1e-6;
/// A tolerance counts as kept up to this factor; on arcs the chords come in addition.
const SLACK: f64 = 1.0 + 1e-6;

/// A chord of the programmed path.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DiagramRow {
    pub(crate) chord: Chord,
    /// Tolerance along it, mm.
    pub(crate) tolerance_mm: f64,
    /// Tolerance at its end, mm.
    pub(crate) end_tolerance_mm: f64,
    /// Tolerance of its move, whatever that of the move before is, mm.
    pub(crate) own_tolerance_mm: f64,
    /// Tolerance of the rotary axes.
    pub(crate) turn: TurnTolerance,
    /// Its end must be met.
    pub(crate) exact_end: Option<ExactEnd>,
    /// Time to rest at its end, s.
    pub(crate) dwell_t: f64,
    /// Feedrate, mm/s; infinite for a rapid.
    pub(crate) feed_v: f64,
    pub(crate) line: u32,
    /// The move that it is of.
    pub(crate) piece: Piece,
}

#[derive(Debug, Clone, Copy)]
struct Move {
    segment: Segment,
    length: f64,
    line: u32,
    feed_v: f64,
    /// Larger of the tolerances at its start and end.
    tolerance_mm: f64,
    end_tolerance_mm: f64,
    turn: TurnTolerance,
    exact_end: Option<ExactEnd>,
    dwell_t: f64,
    is_exact_path: bool,
    /// Chords it is made of.
    chords: u32,
    piece: Piece,
    /// The next move has not been fed yet.
    is_open: bool,
}

/// Whether a chord is there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Presence {
    /// It can be had with [`DiagramRows::get`].
    Here,
    /// The program has not been fed that far.
    NotYet,
    /// The program ends before it.
    Never,
}

/// A window on the chords of the program.
#[derive(Debug)]
pub(crate) struct DiagramRows {
    window: VecDeque<DiagramRow>,
    /// Index of the first chord of the window.
    base: usize,
    /// Moves fed whose chords have not all been made, and the last one as long as it is open.
    fed: VecDeque<Move>,
    /// Chords already made of the first of them.
    done: u32,
    /// Its segment, once it has an inner point.
    prepared: Option<Prepared>,
    is_ended: bool,
    end_position: Option<AxisVector>,
    default_tolerance_mm: f64,
    direction: DirectionTolerance,
    /// How the rotary axes turn the tool, where that is judged.
    pub(crate) tool: Option<ToolAxis>,
    corner_tolerance_mm: f64,
    corner_tolerance_deg: f64,
    /// Larger than any tolerance below which a place of the program may be near, mm.
    max_tolerance_mm: f64,
    amount: Amount,
}

impl DiagramRows {
    pub(crate) fn new(settings: &AuditSettings) -> Self {
        let tolerance_mm = settings.tolerance_mm.max(SMALLEST_TOLERANCE_MM);
        Self {
            window: VecDeque::new(),
            base: 0,
            fed: VecDeque::new(),
            done: 0,
            prepared: None,
            is_ended: false,
            end_position: None,
            default_tolerance_mm: tolerance_mm,
            direction: settings.direction,
            tool: None,
            corner_tolerance_mm: 0.0,
            corner_tolerance_deg: 0.0,
            max_tolerance_mm: tolerance_mm,
            amount: Amount::default(),
        }
    }

    /// Largest tolerance so far, mm.
    pub(crate) const fn max_tolerance_mm(&self) -> f64 {
        self.max_tolerance_mm
    }

    /// A place, with the direction of the tool there.
    pub(crate) fn place<'a>(&self, axes: &'a AxisVector) -> Place<'a> {
        let way = self.tool.map_or([0.0; 3], |tool| tool.way_deg(axes));
        Place { axes, way }
    }

    /// A chord, with the directions of the tool at its ends.
    pub(crate) fn chord(&self, from: AxisVector, to: AxisVector) -> Chord {
        let ways = [&from, &to].map(|end| self.place(end).way);
        Chord::with_ways(from, to, ways)
    }

    /// What has been fed amounts to.
    pub(crate) const fn amount(&self) -> &Amount {
        &self.amount
    }

    /// Where the program fed so far ends, if it moves at all.
    pub(crate) const fn end_position(&self) -> Option<AxisVector> {
        self.end_position
    }

    pub(crate) fn feed(&mut self, item: &Item) {
        self.amount.add(item, self.default_tolerance_mm);
        match &item.kind {
            ItemKind::Move {
                segment,
                rate,
                mode,
            } => self.feed_move(item.line, segment, *rate, *mode),
            ItemKind::Dwell(dwell_t) => {
                self.stop();
                self.dwell(*dwell_t);
            }
            ItemKind::Event(event) if event.is_at_rest() => self.stop(),
            ItemKind::Event(_) => {}
        }
    }

    /// The machine rests here.
    fn stop(&mut self) {
        if let Some(last) = self.fed.back_mut().filter(|last| last.is_open) {
            last.exact_end = Some(ExactEnd::STOP);
        }
    }

    /// The machine rests here for a time; before the first move there is nothing to attach that to.
    fn dwell(&mut self, dwell_t: f64) {
        if let Some(last) = self.fed.back_mut().filter(|last| last.is_open) {
            last.dwell_t += dwell_t;
        }
    }

    /// What follows the last move is known.
    fn close(&mut self) {
        let is_only = self.fed.len() == 1;
        let Some(last) = self.fed.back_mut() else {
            return;
        };
        last.is_open = false;
        if is_only && self.done >= last.chords {
            // Its chords have been made already; none was passed, as the next one was not there.
            if let Some(row) = self.window.back_mut() {
                row.exact_end = last.exact_end;
                row.dwell_t = last.dwell_t;
            }
            self.fed.pop_back();
            self.done = 0;
        }
    }

    /// The motion has to bridge a gap in the program (there should be none).
    fn bridge(&mut self, from: &Move, to: &Segment) {
        let (start, end) = (from.segment.end(), to.start());
        if start != end {
            let segment = Segment::line(start, end);
            self.fed.push_back(Move {
                segment,
                length: segment.length(),
                chords: 1,
                piece: Piece::new(self.amount.moves, &segment),
                exact_end: None,
                dwell_t: 0.0,
                is_open: false,
                ..*from
            });
        }
    }

    /// What a degree of the rotary axes counts for where a tolerance is in force, mm. A direction is judged as it is,
    /// whatever rotary axes make of it.
    fn mm_per_deg(&self, tolerance_mm: f64) -> f64 {
        if self.tool.is_some() {
            tolerance_mm / self.direction.in_force_deg(tolerance_mm)
        } else {
            self.direction.mm_per_deg(tolerance_mm)
        }
    }

    fn feed_move(&mut self, line: u32, segment: &Segment, rate: Rate, mode: PathMode) {
        let length = segment.length();
        let is_stop = mode == PathMode::ExactStop;
        let end_tolerance_mm = match mode {
            PathMode::Continuous {
                tolerance_mm: Some(tolerance),
            } => tolerance,
            _ => self.default_tolerance_mm,
        };
        let mm_per_deg = self.mm_per_deg(end_tolerance_mm);
        let end_tolerance_mm = (end_tolerance_mm - segment.error_mm()).max(SMALLEST_TOLERANCE_MM);
        let end_tolerance_deg = end_tolerance_mm / mm_per_deg;
        self.max_tolerance_mm = self.max_tolerance_mm.max(end_tolerance_mm);
        let slack = match segment {
            Segment::Line(_) => SLACK,
            Segment::Arc(_) => SLACK + 3.0 * FLATTENING,
            Segment::Curve(_) => SLACK + CURVE_FLATTENING,
        };
        if length <= 0.0 {
            if is_stop {
                self.stop();
            }
            return;
        }
        if let Some(previous) = self.fed.back_mut() {
            if previous.is_exact_path && previous.exact_end.is_none() {
                previous.exact_end = Some(ExactEnd::passing(&previous.segment, segment));
            }
            let previous = *previous;
            self.close();
            self.bridge(&previous, segment);
        }
        self.end_position = Some(segment.end());
        let tolerance_mm = end_tolerance_mm.max(self.corner_tolerance_mm) * slack;
        let bends = self.tool.map_or(Turn::NONE, |tool| {
            tool.turn(&segment.start(), &segment.end())
        });
        let chords = chords(segment, tolerance_mm).max(turn_chords(bends, end_tolerance_deg));
        let turn = TurnTolerance {
            is_way: self.tool.is_some(),
            axes_r: (self.tool.is_some_and(|tool| tool.are_axes_judged))
                .then_some(1.0 / self.direction.turn_r),
            mm_per_deg,
            ..TurnTolerance::of_move(
                [self.corner_tolerance_deg, end_tolerance_deg],
                (bends, chords),
                slack,
            )
        };
        self.fed.push_back(Move {
            segment: *segment,
            length,
            line,
            feed_v: rate.feed_v().unwrap_or(f64::INFINITY).min(rate.most_v()),
            tolerance_mm,
            end_tolerance_mm: end_tolerance_mm * slack,
            turn,
            exact_end: is_stop.then_some(ExactEnd::STOP),
            dwell_t: 0.0,
            is_exact_path: mode == PathMode::ExactPath,
            chords,
            piece: Piece::new(self.amount.moves, segment),
            is_open: true,
        });
        self.corner_tolerance_mm = end_tolerance_mm;
        self.corner_tolerance_deg = end_tolerance_deg;
    }

    /// Nothing more will be fed: the end of the program is an exact stop.
    pub(crate) fn end(&mut self) {
        self.stop();
        self.close();
        self.is_ended = true;
    }

    /// Drops what has been fed: nothing will be matched any more.
    pub(crate) fn discard(&mut self) {
        self.fed.clear();
        self.done = 0;
        self.prepared = None;
        self.window.clear();
    }

    /// Makes chord `index` if the program has been fed that far.
    pub(crate) fn reach(&mut self, index: usize) -> Presence {
        while self.base + self.window.len() <= index {
            let next = match self.fed.front() {
                Some(next) if self.done < next.chords => next,
                _ if self.is_ended => return Presence::Never,
                _ => return Presence::NotYet,
            };
            let start = match self.window.back() {
                Some(row) if self.done > 0 => row.chord.to,
                _ => next.segment.start(),
            };
            self.done += 1;
            let is_last = self.done >= next.chords;
            let end = if is_last {
                next.segment.end()
            } else {
                let prepared = self.prepared.get_or_insert_with(|| next.segment.prepared());
                let along_mm = next.length * f64::from(self.done) / f64::from(next.chords);
                inner_point(&next.segment, prepared, along_mm, next.chords)
            };
            self.window.push_back(DiagramRow {
                chord: self.chord(start, end),
                tolerance_mm: next.tolerance_mm,
                end_tolerance_mm: if is_last {
                    next.end_tolerance_mm
                } else {
                    next.tolerance_mm
                },
                own_tolerance_mm: next.end_tolerance_mm,
                turn: next.turn.of_chord(is_last),
                exact_end: next.exact_end.filter(|_| is_last),
                dwell_t: if is_last { next.dwell_t } else { 0.0 },
                feed_v: next.feed_v,
                line: next.line,
                piece: next.piece,
            });
            if is_last {
                self.prepared = None;
            }
            if is_last && !next.is_open {
                self.fed.pop_front();
                self.done = 0;
            }
        }
        Presence::Here
    }

    /// Chords and moves kept.
    #[cfg(test)]
    pub(crate) fn kept(&self) -> usize {
        self.window.len() + self.fed.len()
    }

    /// Chord `index`, if it is in the window.
    pub(crate) fn get(&self, index: usize) -> Option<&DiagramRow> {
        self.window.get(index.checked_sub(self.base)?)
    }

    /// Forgets the chords before `index`, except the last one made.
    pub(crate) fn forget_before(&mut self, index: usize) {
        while self.base < index && self.window.len() > 1 {
            self.window.pop_front();
            self.base += 1;
        }
    }
}
