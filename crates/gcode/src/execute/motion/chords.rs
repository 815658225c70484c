//! Chords of a move whose axes are mapped while its rotary axes turn.

use core::f64::consts::TAU;

use glidepath_geometry::{AxisVector, Segment};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::motion::great_circle::GreatCircle;
use crate::execute::motion::tip_map::TipMap;

/// How far a chord may be from the curve it stands for, mm.
const CHORD_MM: f64 = 1e-4;
/// How far a rotary axis may be from where it should be within a chord, degrees.
const CHORD_DEG: f64 = 1e-3;
/// Most that a rotary axis turns in a chord, degrees.
const MOST_TURN_DEG: f64 = 30.0;
/// Most times a move is halved.
const MOST_HALVES: u32 = 16;
/// Most chords of a move.
const MOST_CHORDS: usize = 200_000;

/// A piece of a mapped move: where it ends, and which part of the move's path it is of.
pub(super) type Chord = (AxisVector, f64);

/// A move, and the map that makes it one of the axes.
#[derive(Clone, Copy)]
pub(super) struct MappedMove<'a> {
    pub(super) map: &'a TipMap,
    pub(super) segment: &'a Segment,
    pub(super) circle: Option<GreatCircle>,
}

impl MappedMove<'_> {
    /// The chords of a path of that length between two places of the axes.
    ///
    /// # Errors
    /// There are too many to be kept.
    pub(super) fn chords(
        &self,
        length: f64,
        (start, end): (AxisVector, AxisVector),
    ) -> Outcome<Vec<Chord>> {
        let mut chords = Vec::new();
        let mut begins = (start, 0.0);
        for ends in self.parts(length, end) {
            halve(self, length, begins, ends, 0, &mut chords);
            begins = ends;
        }
        if chords.len() > MOST_CHORDS {
            return Err(too_many_chords());
        }
        Ok(chords)
    }

    /// The axes at a place of the path, whose length is given.
    fn axes(&self, s: f64, length: f64) -> AxisVector {
        let mut place = self.segment.jet(s).position;
        if let Some(circle) = &self.circle {
            circle.turn(s / length, &mut place);
        }
        self.map.axes(&place)
    }

    /// The ends of the parts that chords are made of. A chord is compared with its curve at three
    /// places, which in several turns of an arc may all be where it began: so no part is of more than one.
    fn parts(&self, length: f64, end: AxisVector) -> impl Iterator<Item = Chord> {
        let count = match self.segment {
            Segment::Arc(arc) => (arc.sweep_rad.abs() / TAU).ceil().max(1.0),
            Segment::Line(_) | Segment::Curve(_) => 1.0,
        };
        let numbers = std::iter::successors(Some(1.0), move |number| {
            (*number < count).then_some(number + 1.0)
        });
        numbers.map(move |number| {
            if number < count {
                let s = length * (number / count);
                (self.axes(s, length), s)
            } else {
                (end, length)
            }
        })
    }
}

#[cold]
fn too_many_chords() -> Box<BlockDiagnostic> {
    let message = format!("a move of more than {MOST_CHORDS} chords");
    BlockDiagnostic::new(DiagnosticCode::NotSupported, SourceSpan::default(), message)
        .because("the rotary axes turn along its path, so it is made of chords, which are all kept")
        .help("write the move in several blocks")
}

/// Halves a part of a move until its chords are as near to the curve as they have to be.
fn halve(
    way: &MappedMove<'_>,
    length: f64,
    (from, from_s): Chord,
    (to, to_s): Chord,
    depth: u32,
    chords: &mut Vec<Chord>,
) {
    let at = |share: f64| way.axes(from_s + share * (to_s - from_s), length);
    let is_off = |share: f64| {
        let place = at(share) - (from + (to - from) * share);
        place.fixed_rows::<3>(0).norm() > CHORD_MM || place.fixed_rows::<3>(3).amax() > CHORD_DEG
    };
    // A turn by whole rounds is back where it began.
    let turn = (0..3)
        .map(|i| (to[3 + i] - from[3 + i]).abs())
        .fold(0.0, f64::max);
    let is_near = turn <= MOST_TURN_DEG && ![0.25, 0.5, 0.75].into_iter().any(is_off);
    if is_near || depth >= MOST_HALVES || chords.len() > MOST_CHORDS {
        chords.push((to, to_s));
        return;
    }
    let middle = (at(0.5), 0.5 * (from_s + to_s));
    halve(way, length, (from, from_s), middle, depth + 1, chords);
    halve(way, length, middle, (to, to_s), depth + 1, chords);
}
