//! How true the shape of a motion is, in figures: what a machinist measures on the part, beside the
//! distance from the programmed path.
//!
//! ```text
//!            ╭─ outside the figure                     programmed  ───────┐
//!    ────────╯──┐                                                         │   ╭── overshoot
//!               │      beside the line, in its middle half                └───┴──────────────
//!               │      ────────────────~~~~~~~~────────────────
//! ```
//!
//! * *Overshoot* of an axis: how far it goes beyond all that the program asks of it there, and comes
//!   back. Of Z downwards it is depth that nobody programmed.
//! * *Outside*: how far the motion is on the outer side of a corner between straight feed moves. A
//!   rounded corner is on the inner side.
//! * *Straightness*: the largest distance from the line in the middle half of a straight feed move.
//! * *Reversals* of each axis, in the motion and in the program: each is a passage through the
//!   backlash of its drive.
//!
//! They are told and judge nothing: all of it may be inside the tolerance. Work is linear in frames
//! and items, memory that of the moves at hand.

mod corner;
mod met;
mod overshoot;
mod reversals;

use crate::follow::Follow;
use corner::Corner;
use glidepath_geometry::{AXES, AxisVector, Segment};
use glidepath_program::{Item, ItemKind};
pub use met::Met;
use overshoot::Overshoots;
pub use reversals::HYSTERESIS_MM;
use reversals::{Reversals, waypoints};

/// A straight feed move has a middle half from this length on, mm.
pub const STRAIGHT_MM: f64 = 5.0;

/// What there is to tell of a motion's shape.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ShapeReport {
    /// How far each axis goes below what is asked of it and comes back, at most.
    pub below: [Met; AXES],
    /// How far each axis goes above it likewise.
    pub above: [Met; AXES],
    /// How far the motion is outside of a corner, at most.
    pub outside: Met,
    /// How far it is beside a straight feed move in its middle half, at most.
    pub beside: Met,
    /// Straight feed moves that are long enough to have a middle half, and were run.
    pub straight_moves: u64,
    /// Reversals of each axis in the motion.
    pub reversals: [u64; AXES],
    /// Reversals of each axis that the program asks for.
    pub programmed_reversals: [u64; AXES],
}

/// The figures of a motion as it goes by.
#[derive(Debug, Default)]
pub(crate) struct Shape {
    overshoots: Overshoots,
    program: Reversals,
    motion: Reversals,
    outside: Met,
    beside: Met,
    straight_moves: u64,
    /// The straight move whose middle half was met last.
    straight: Option<u64>,
}

impl Shape {
    /// The next item of the program.
    pub(crate) fn program(&mut self, item: &Item) {
        if let ItemKind::Move { segment, .. } = &item.kind {
            waypoints(segment, |point| self.program.next(point));
        }
    }

    /// The next position, with the moves that it may be on.
    pub(crate) fn next(&mut self, position: &AxisVector, line: u32, follow: &Follow) {
        self.motion.next(position);
        self.overshoots.next(position, line, follow);
        let Some(here) = follow.here() else {
            return;
        };
        let Segment::Line(chord) = here.programmed else {
            return;
        };
        if here.is_rapid() {
            return;
        }
        let length = here.length_s;
        let is_late = follow.here_s() > 0.5 * length;
        let corner = if is_late {
            follow.next().and_then(|next| Corner::between(here, next))
        } else {
            follow
                .previous()
                .and_then(|last| Corner::between(last, here))
        };
        if let Some(corner) = corner {
            let outside_mm = corner.outside_mm(position, is_late);
            self.outside.see(outside_mm, line);
        }
        let is_middle = (0.25 * length..=0.75 * length).contains(&follow.here_s());
        if length >= STRAIGHT_MM && is_middle {
            self.beside.see(corner::beside_mm(&chord, position), line);
            if self.straight.replace(here.number) != Some(here.number) {
                self.straight_moves += 1;
            }
        }
    }

    pub(crate) fn report(&self) -> ShapeReport {
        let [below, above] = self.overshoots.report();
        ShapeReport {
            below,
            above,
            outside: self.outside,
            beside: self.beside,
            straight_moves: self.straight_moves,
            reversals: self.motion.counts,
            programmed_reversals: self.program.counts,
        }
    }
}
