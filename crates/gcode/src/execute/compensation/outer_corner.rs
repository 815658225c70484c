//! The way of the tool round outer corners of the contour.
//!
//! ```text
//!   on arcs (LinuxCNC, SINUMERIK)        in straight lines (FANUC, parameter 19607#2)
//!        ╭─●                              ●──●        up to a right angle: where both sides meet;
//!       ●  │ ← about the corner           │           sharper: on by the radius, and across
//!    ───┼──┼                           ───┼
//! ```

use glidepath_program::Item;

use crate::execute::compensation::element::{
    Element, Point, corner_points, distance, lines, minus, turn,
};
use crate::execute::compensation::path::{Compensation, ContourMove, Pending};
use crate::execute::motion::settled::MIN_MOVE;
use crate::execute::motion::speed::Speed;

/// Extensions of two lines stay this near to the arc about their corner, mm.
const MITRE_MM: f64 = 1e-3;

impl Pending {
    /// How fast the tool goes round the corner in front of it: as fast as in the move itself, which takes the
    /// time of its block.
    fn speed_at_corner(&self) -> Speed {
        match self.of.speed {
            Speed::Moves(per_minute) => Speed::Feed(self.path.length() * per_minute / 60.0),
            speed => speed,
        }
    }
}

impl Compensation {
    /// Where two lines with a flat convex corner meet if they are extended.
    pub(super) fn mitre(&self, last: &Pending, next: &Pending) -> Option<Point> {
        if last.path.arc.is_some() || next.path.arc.is_some() {
            return None;
        }
        let corner = lines(&last.path, &next.path)?;
        let over = distance(corner, next.of.contour.start) - self.radius();
        (over <= MITRE_MM).then_some(corner)
    }

    /// Goes round a convex corner in straight lines: both sides on, along their tangents, up to where these
    /// meet; round a sharp corner as far as the radius, and across. Lines are made longer, and what is beside
    /// an arc, and across, is of the block behind the corner.
    pub(super) fn go_round(&mut self, mut last: Pending, next: &mut Pending, out: &mut Vec<Item>) {
        let [leaves, comes] = corner_points(
            (last.path.end, last.of.contour.end_tangent()),
            (next.path.start, next.of.contour.start_tangent()),
            self.radius(),
        );
        let ends_straight = last.path.arc.is_none();
        if ends_straight {
            last.path.end = leaves;
        }
        self.give(&last, out);
        if !ends_straight {
            self.go_across(next, leaves, out);
        }
        if distance(leaves, comes) > MIN_MOVE {
            self.go_across(next, comes, out);
        }
        if next.path.arc.is_none() {
            next.path.start = comes;
        } else {
            self.go_across(next, next.path.start, out);
        }
    }

    /// A straight move round a corner, as fast as the move behind it.
    fn go_across(&mut self, next: &Pending, to: Point, out: &mut Vec<Item>) {
        let path = Element {
            start: self.place(),
            end: to,
            arc: None,
        };
        let of = ContourMove {
            speed: next.speed_at_corner(),
            ..next.of
        };
        self.emit(&of, &path, self.tool, out);
    }

    /// Goes round a convex corner to the start of the next element.
    pub(super) fn round(&mut self, next: &Pending, out: &mut Vec<Item>) {
        let center = next.of.contour.start;
        let from = self.place();
        let to = next.path.start;
        let (a, b) = (minus(from, center), minus(to, center));
        // Round the outside: clockwise for a tool on the left.
        let mut sweep = turn(a, b);
        let round = -self.left.signum();
        if sweep * round < 0.0 {
            sweep += round * core::f64::consts::TAU;
        }
        let arc = (next.of.speed != Speed::Rapid).then_some((center, sweep));
        let path = Element {
            start: from,
            end: to,
            arc,
        };
        let of = ContourMove {
            speed: next.speed_at_corner(),
            ..next.of
        };
        self.emit(&of, &path, self.tool, out);
    }
}
