//! Moves to the straight pieces that the window planner follows.
//!
//! ```text
//!  arc     ──flattened──▶ chords within a small share of the tolerance of it
//!  chords  ──merged─────▶ pieces within a small share of the tolerance of them
//! ```
//!
//! Both steps keep what they give within a known distance of what they take, both ways and in
//! order, so the tolerance of a piece is what is left after the two distances: a motion within that
//! of the pieces is within the tolerance of the program. Pieces cost the window planner work, and
//! tolerance gains it time; the shares below leave nearly all of it to the motion.

use super::chords::{CutMove, FlatChord};
use super::ledger::LedgerEntry;
use super::merging::Dropped;
use super::path::{Reference, Straightness};
use super::work_queue::{WorkItem, WorkQueue};
use crate::due_event::Beside;
use crate::intake::SHORTEST_MOVE_MM;
use crate::programmed_rate::{ProgrammedRate, axes_speed};
use crate::rest::Rest;
use crate::ruled::{self, BESIDE_MM, RULED_MM};
use glidepath_geometry::{Segment, feed_length};
use glidepath_program::{Item, Override, ProgramLine, Settings, tolerance_norm};
use std::collections::VecDeque;

/// Share of the tolerance that a merged piece may be away from the chords it replaces.
const MERGING_R: f64 = 0.1;
/// How far before and behind an event's place, in tolerances, the motion may be nearest to that.
const REACH_R: f64 = 2.0;
/// Distance up to which a vertex counts as being on a line.
const STRAIGHT_MM: f64 = 1e-9;
/// From so many tolerances of length on a line is seen to be straight: it is turned by no more than a
/// vertex makes of it that is off by such a share of the tolerance.
const LONG_R: f64 = 200.0;
const TURNED_R: f64 = 0.0125;
/// How far the motion may be beyond a border, mm or degrees: a hundredth of the usual tolerance of .02 mm. Samples
/// settle on pieces of a curve to some hundredths of a tolerance, and windows at one of 1 µm found no motion that is
/// within a hundredth of it.
const BEYOND_MM: f64 = 2e-4;
/// What the program comes down to.
#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "short-lived, one at a time")]
pub(crate) enum Product {
    /// A straight piece. Its tag and its speed are for the taker to fill in.
    Piece(LedgerEntry, Reference),
    Exact(Item),
    ExactEnd,
    Rest(Rest),
}

/// Makes pieces of moves, as they are asked for.
#[derive(Debug, Clone)]
pub(crate) struct Flattener {
    settings: Settings,
    flattening: Option<CutMove>,
    /// The chord that may still be merged with what follows.
    open: Option<OpenChord>,
    ready: VecDeque<Product>,
}

#[derive(Debug, Clone)]
struct OpenChord {
    chord: FlatChord,
    dropped: Dropped,
    /// The longest of the chords drawn together, mm.
    longest_mm: f64,
    /// From the middle half of the first to that of the last of them that one can lay a ruler to, mm after its
    /// start.
    ruled_mm: Option<[f64; 2]>,
    /// Where further lines begin, mm after its start.
    lines: Vec<(f64, ProgramLine)>,
}

impl Flattener {
    pub(crate) const fn new(settings: Settings) -> Self {
        Self {
            settings,
            flattening: None,
            open: None,
            ready: VecDeque::new(),
        }
    }

    /// The next product, as far as the program is known.
    pub(crate) fn next(&mut self, work_queue: &mut WorkQueue) -> Option<Product> {
        loop {
            if let Some(product) = self.ready.pop_front() {
                return Some(product);
            }
            if let Some(chord) = self.flattening.as_mut().and_then(CutMove::next) {
                self.take(chord);
                continue;
            }
            self.flattening = None;
            match work_queue.next()? {
                WorkItem::Move(of) => self.flattening = Some(CutMove::new(of, &self.settings)),
                WorkItem::Exact(item) => self.put(Product::Exact(item)),
                WorkItem::ExactEnd => self.put(Product::ExactEnd),
                WorkItem::Rest(rest) => self.put(Product::Rest(rest)),
            }
        }
    }

    /// Puts out something that ends a piece.
    fn put(&mut self, product: Product) {
        self.close();
        self.ready.push_back(product);
    }

    fn take(&mut self, chord: FlatChord) {
        if let Some(open) = &mut self.open
            && (open.absorb(&chord) || open.merge(&chord))
        {
            return;
        }
        self.close();
        self.open = Some(OpenChord {
            longest_mm: chord.length_mm(),
            ruled_mm: middle_half_mm(&chord, 0.0),
            chord,
            dropped: Dropped::default(),
            lines: Vec::new(),
        });
    }

    /// Nothing more is merged with the open chord.
    fn close(&mut self) {
        let Some(open) = self.open.take() else {
            return;
        };
        let OpenChord {
            chord,
            lines,
            ruled_mm,
            dropped,
            ..
        } = open;
        // How far what it was drawn together from is beside it; of a chord of a curve, the curve.
        let drawn_mm = if dropped.is_empty() {
            tolerance_norm(&chord.sagitta_vector, chord.mm_per_deg)
        } else {
            dropped.error_mm
        };
        let segment = Segment::line(chord.start, chord.end);
        let length_s = segment.length();
        let rate = ProgrammedRate {
            rate: chord.rate,
            axes_v: axes_speed(&segment, &self.settings.limits).min(chord.most_v),
        };
        let left_mm = chord.tolerance_mm - chord.error_mm;
        let reference = Reference {
            end: chord.end,
            rate: rate.of_piece(Override::NONE),
            tolerance_mm: left_mm,
            tolerance_deg: left_mm / chord.mm_per_deg,
            sagitta_vector: chord.sagitta_vector,
            straight: straightness(&chord, drawn_mm, ruled_mm),
            beyond_mm: BEYOND_MM,
            is_rapid: chord.rate.is_rapid(),
            tag: 0,
        };
        let entry = LedgerEntry {
            line: chord.line,
            lines,
            rate,
            length_s,
            events: chord.events,
            beside: Beside {
                place: chord.start,
                reach_s: REACH_R * chord.tolerance_mm,
            },
        };
        self.ready.push_back(Product::Piece(entry, reference));
    }
}

/// Where a motion is to be straight along a chord, if the chord is a straight feed move, or several in a row:
/// from the middle half of the first long one to that of the last, these by their place on the chord.
fn straightness(
    chord: &FlatChord,
    drawn_mm: f64,
    ruled_mm: Option<[f64; 2]>,
) -> Option<Straightness> {
    let displacement = chord.end - chord.start;
    let is_cut = !chord.rate.is_rapid() && drawn_mm <= ruled::TURNED_MM;
    let length_mm = displacement.norm();
    if !is_cut || length_mm < RULED_MM {
        return None;
    }
    let whole = Straightness::of_move(BESIDE_MM - drawn_mm);
    Some(ruled_mm.map_or(whole, |ruled_mm| Straightness {
        between_u: ruled_mm.map(|at_mm| at_mm / length_mm),
        ..whole
    }))
}

/// The middle half of a chord that begins so many mm along a line, if one can lay a ruler to it.
fn middle_half_mm(chord: &FlatChord, from_mm: f64) -> Option<[f64; 2]> {
    let length_mm = chord.length_mm();
    (length_mm >= RULED_MM).then(|| [0.25, 0.75].map(|share| from_mm + share * length_mm))
}

impl OpenChord {
    /// Takes in a chord too short for a piece: what moves too short to be made by themselves have
    /// left at the end of a stretch.
    fn absorb(&mut self, next: &FlatChord) -> bool {
        let left = next.end - next.start;
        let error_mm = self.chord.error_mm + tolerance_norm(&left, self.chord.mm_per_deg);
        let is_short = left.amax() < SHORTEST_MOVE_MM && next.events.is_empty();
        if !is_short || error_mm > 2.0 * MERGING_R * self.chord.tolerance_mm {
            return false;
        }
        self.tell_line(next);
        self.chord.end = next.end;
        self.chord.error_mm = error_mm;
        true
    }

    /// Takes note of the line of a chord that is drawn together with this one.
    fn tell_line(&mut self, next: &FlatChord) {
        let chord = &self.chord;
        let last_line = self.lines.last().map_or(chord.line, |&(_, line)| line);
        if next.line != last_line {
            let passed_s = feed_length(&(chord.end - chord.start));
            self.lines.push((passed_s, next.line));
        }
    }

    /// Draws the next chord together with this one, if both are driven alike and the tolerance
    /// allows it.
    fn merge(&mut self, next: &FlatChord) -> bool {
        let chord = &self.chord;
        let alike = chord.rate == next.rate
            && chord.tolerance_mm.total_cmp(&next.tolerance_mm).is_eq()
            && next.events.is_empty();
        // The speed of a rapid depends on its direction, so only what goes straight on is one.
        let longest_mm = self.longest_mm.max(next.length_mm());
        let allowed_mm = if chord.rate.is_rapid() {
            STRAIGHT_MM
        } else if longest_mm >= RULED_MM {
            (TURNED_R * chord.tolerance_mm).min(ruled::TURNED_MM)
        } else if longest_mm >= LONG_R * chord.tolerance_mm {
            TURNED_R * chord.tolerance_mm
        } else {
            MERGING_R * chord.tolerance_mm
        };
        let base_mm = (chord.error_mm - self.dropped.error_mm).max(next.error_mm);
        if !alike
            || !self.dropped.extend(
                [&chord.start, &chord.end, &next.end],
                allowed_mm,
                chord.mm_per_deg,
            )
        {
            return false;
        }
        self.tell_line(next);
        let next_mm = middle_half_mm(next, self.chord.length_mm());
        self.ruled_mm = match (self.ruled_mm, next_mm) {
            (Some([from_mm, _]), Some([_, to_mm])) => Some([from_mm, to_mm]),
            (ruled_mm, next_mm) => ruled_mm.or(next_mm),
        };
        let chord = &mut self.chord;
        chord.end = next.end;
        chord.error_mm = base_mm + self.dropped.error_mm;
        chord.sagitta_vector = self.dropped.sagitta_vector;
        // How sharply a run of lines bends its chords do not tell.
        chord.most_v = f64::INFINITY;
        self.longest_mm = longest_mm;
        true
    }
}

#[cfg(test)]
mod tests;
