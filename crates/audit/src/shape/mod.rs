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
//! * *Outside*: how far the motion is on the outer side of a corner between feed moves. A rounded
//!   corner is on the inner side.
//! * *Straightness*: the largest distance from the line in the middle half of a straight feed move.
//! * *Reversals* of each axis, in the motion and in the program: each is a passage through the
//!   backlash of its drive.
//!
//! They are told; all of it may be inside the tolerance. Three of them are judged, with [`BEYOND_MM`]
//! ([`ShapeFinding`]): straightness; and where the motion is to be on the inner side ([`Corners::Inner`]), a
//! motion outside of a corner, and an axis beyond the place where it comes to a rest, sets out from one or
//! turns round.
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
pub use finding::{BEYOND_MM, Border, KEPT, ShapeFinding};
use glidepath_geometry::{AXES, Axis, AxisVector, LINEAR_XYZ, Line, Segment};
use glidepath_program::{Corners, Item, ItemKind};
pub use met::Met;
use overshoot::Overshoots;
pub use reversals::HYSTERESIS_MM;
use reversals::{Reversals, waypoints};
use stop::Stops;

/// A straight feed move has a middle half from this length on, mm.
pub const STRAIGHT_MM: f64 = 5.0;

/// Share of a move on both sides of its middle in which neither end is the nearer one.
const MIDDLE: f64 = 0.1;

/// True about the middle of the move at hand: what is on the inner side of either of its ends is inside
/// there. Between corners that turn to different sides the motion has to go over somewhere.
fn is_middle(follow: &Follow) -> bool {
    follow.here().is_some_and(|here| {
        let share = follow.here_s() / here.length_s;
        (share - 0.5).abs() < MIDDLE
    })
}

/// True if no other axis moves along a line than X, Y and Z: of those it is a line that one can see.
fn is_in_space(line: &Line) -> bool {
    let displacement = line.end - line.start;
    let others = displacement.iter().skip(LINEAR_XYZ.end);
    others.fold(0.0, |sum: f64, value| sum + value.abs()) <= 0.0
}

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
    /// Vertices of the program at which the motion is on the outer side, and straight moves that it is beside.
    pub finding_count: u64,
    /// How many of them are straight moves that the motion is beside.
    pub beside_count: u64,
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
        if here.is_rapid() {
            return;
        }
        self.judge_corners(position, line, follow);
        let Segment::Line(chord) = here.programmed else {
            return;
        };
        let length = here.length_s;
        let is_middle_half = (0.25 * length..=0.75 * length).contains(&follow.here_s());
        if length >= STRAIGHT_MM && is_middle_half {
            let distance_mm = corner::beside_mm(&chord, position);
            self.beside.see(distance_mm, line);
            if is_in_space(&chord) {
                let finding = ShapeFinding {
                    border: Border::Straight,
                    distance_mm,
                    line,
                };
                self.findings.see_beside(here.number, finding);
            }
            if self.straight.replace(here.number) != Some(here.number) {
                self.straight_moves += 1;
            }
        }
    }

    /// Whether the motion is outside of the corner at the nearer end of the move at hand.
    fn judge_corners(&mut self, position: &AxisVector, line: u32, follow: &Follow) {
        let Some(here) = follow.here() else {
            return;
        };
        let ends = [follow.previous(), follow.next()];
        let corners = [
            ends[0].and_then(|last| Corner::between(last, here)),
            ends[1].and_then(|next| Corner::between(here, next)),
        ];
        let is_late = follow.here_s() > 0.5 * here.length_s;
        let at = (here, follow.here_s());
        if let Some(corner) = corners[usize::from(is_late)] {
            let mut outside_mm = corner.outside_mm(position, at, is_late);
            if is_middle(follow) {
                let of_other = corners[usize::from(!is_late)]
                    .map_or(0.0, |other| other.outside_mm(position, at, !is_late));
                outside_mm = outside_mm.min(of_other);
            }
            self.outside.see(outside_mm, line);
            if self.corners == Corners::Inner {
                let finding = ShapeFinding {
                    border: Border::Corner,
                    distance_mm: outside_mm,
                    line,
                };
                self.findings.see(here.number + u64::from(is_late), finding);
            }
        }
    }

    /// Whether axes are beyond the stops of the nearer end of the move at hand.
    fn judge_stops(&mut self, position: &AxisVector, line: u32, follow: &Follow) {
        let Some(here) = follow.here() else {
            return;
        };
        let is_late = follow.here_s() > 0.5 * here.length_s;
        let (last, next) = (follow.previous(), follow.next());
        let stops = [
            last.and_then(|last| Stops::between(last, here)),
            next.and_then(|next| Stops::between(here, next)),
        ];
        let Some(nearer) = stops[usize::from(is_late)] else {
            return;
        };
        let other = stops[usize::from(!is_late)];
        for axis in Axis::ALL {
            let mut distance_mm = nearer.beyond_mm(position, axis.index());
            if is_middle(follow) {
                let of_other = other.map_or(0.0, |stops| stops.beyond_mm(position, axis.index()));
                distance_mm = distance_mm.min(of_other);
            }
            let finding = ShapeFinding {
                border: Border::Stop(axis),
                distance_mm,
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
            beside_count: self.findings.beside_count,
            findings: self.findings.kept,
        }
    }
}
