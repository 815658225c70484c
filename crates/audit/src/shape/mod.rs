//! The shape figures of a motion: what a machinist measures on the part, beside the distance from
//! the programmed path.
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
//! They are told; all of it may be inside the tolerance. Two of them are judged, with [`BEYOND_MM`],
//! where the motion is to be on the inner side ([`Corners::Inner`]): a motion outside of a corner, and an
//! axis beyond the place where it comes to a rest, sets out from one or turns round ([`ShapeFinding`]).
//! Work is linear in frames and items, memory that of the moves at hand.

mod corner;
mod finding;
mod met;
mod overshoot;
mod reversals;
mod stop;

use crate::AuditSettings;
use crate::follow::Follow;
use corner::Corner;
use finding::Findings;
pub use finding::{BEYOND_MM, KEPT, ShapeFinding};
use glidepath_geometry::{AXES, Axis, AxisVector, Segment};
use glidepath_program::{Corners, Item, ItemKind};
pub use met::Met;
use overshoot::Overshoots;
pub use reversals::HYSTERESIS_MM;
use reversals::{Reversals, waypoints};
use stop::Stops;

/// A straight feed move has a middle half from this length on, mm.
pub const STRAIGHT_MM: f64 = 5.0;

/// The shape figures of a motion.
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
    /// Vertices of the program at which the motion is on the outer side.
    pub finding_count: u64,
    /// The first of them.
    pub findings: [Option<ShapeFinding>; KEPT],
}

/// The figures of a motion as it goes by.
#[derive(Debug, Default)]
pub(crate) struct Shape {
    overshoots: Overshoots,
    program: Reversals,
    motion: Reversals,
    outside: Met,
    beside: Met,
    corners: Corners,
    findings: Findings,
    straight_moves: u64,
    /// The straight move whose middle half was met last.
    straight: Option<u64>,
}

/// The shape of a motion by itself, without all else that is told of it.
#[derive(Debug)]
pub struct ShapeAudit {
    follow: Follow,
    shape: Shape,
}

impl ShapeAudit {
    /// With nothing seen yet.
    #[must_use]
    pub fn new(settings: &AuditSettings) -> Self {
        Self {
            follow: Follow::new(settings),
            shape: Shape::new(settings.corners),
        }
    }

    /// The next item of the program.
    pub fn program(&mut self, item: &Item) {
        self.follow.program(item);
        self.shape.program(item);
    }

    /// The next position, and the source line of the motion there. The program must have been fed as far.
    pub fn next(&mut self, position: &AxisVector, line: u32) {
        self.follow.go(position);
        self.shape.next(position, line, &self.follow);
    }

    /// The shape figures, after the last position.
    #[must_use]
    pub fn finish(mut self) -> ShapeReport {
        self.shape.report()
    }
}

impl Shape {
    /// Nothing seen yet; corners are to be passed on these sides.
    pub(crate) fn new(corners: Corners) -> Self {
        Self {
            corners,
            ..Self::default()
        }
    }

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
        if self.corners == Corners::Inner {
            self.judge_stops(position, line, follow);
        }
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
            if self.corners == Corners::Inner {
                let finding = ShapeFinding {
                    axis: None,
                    distance_mm: outside_mm,
                    line,
                };
                self.findings.see(here.number + u64::from(is_late), finding);
            }
        }
        let is_middle = (0.25 * length..=0.75 * length).contains(&follow.here_s());
        if length >= STRAIGHT_MM && is_middle {
            self.beside.see(corner::beside_mm(&chord, position), line);
            if self.straight.replace(here.number) != Some(here.number) {
                self.straight_moves += 1;
            }
        }
    }

    /// Whether axes are beyond the stops of the nearer end of the move at hand.
    fn judge_stops(&mut self, position: &AxisVector, line: u32, follow: &Follow) {
        let Some(here) = follow.here() else {
            return;
        };
        let is_late = follow.here_s() > 0.5 * here.length_s;
        let stops = if is_late {
            follow.next().and_then(|next| Stops::between(here, next))
        } else {
            let last = follow.previous();
            last.and_then(|last| Stops::between(last, here))
        };
        let Some(stops) = stops else {
            return;
        };
        for axis in Axis::ALL {
            let finding = ShapeFinding {
                axis: Some(axis),
                distance_mm: stops.beyond_mm(position, axis.index()),
                line,
            };
            self.findings.see(here.number + u64::from(is_late), finding);
        }
    }

    pub(crate) fn report(&mut self) -> ShapeReport {
        self.findings.settle();
        let [below, above] = self.overshoots.report();
        ShapeReport {
            below,
            above,
            outside: self.outside,
            beside: self.beside,
            straight_moves: self.straight_moves,
            reversals: self.motion.counts,
            programmed_reversals: self.program.counts,
            finding_count: self.findings.count,
            findings: self.findings.kept,
        }
    }
}
