//! Corners that are broken: `,C` and `,R` of FANUC, CHR, CHF, RND and RNDM of SINUMERIK.
//!
//! The move to the corner is held until the next one is known. Between two straight moves at feed, in
//! the plane:
//!
//! ```text
//!        a ───────●P1
//!                  ╲        P1, P2: as far from the corner b, t
//!               b   ●P2     chamfer: t, or its own length / (2 sin(θ/2))
//!                   │       arc: t = r / tan(θ/2), θ the angle between the moves
//!                   c
//! ```

use core::f64::consts::PI;

use glidepath_geometry::{Arc, AxisVector, Segment};
use glidepath_program::Item;

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::settled::MIN_MOVE;
use crate::execute::motion::speed::Pace;
use crate::execute::state::open_corner::OpenCorner;
use crate::syntax::block::{Block, CornerKind, CornerWord};
use crate::syntax::modes::Motion;

/// The angle between the moves within which they go on straight, or back, radians.
const STRAIGHT_RAD: f64 = 1e-6;

/// Where a corner is left and where the next move begins, in the two axes of the plane.
struct Broken {
    first: [f64; 2],
    second: [f64; 2],
    /// Centre and sweep of an arc.
    arc: Option<([f64; 2], f64)>,
}

impl Interpreter {
    /// Before a block: without a straight move of its own a corner cannot be broken.
    pub(crate) fn settle_corner(
        &mut self,
        block: &Block,
        motion: Option<Motion>,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        if let Some(word) = block.corner
            && word.kind == CornerKind::RoundAll
        {
            self.state.rounds_mm = word.value * self.state.modal.units.mm();
        }
        let Some(corner) = &self.corner else {
            return Ok(());
        };
        let goes_on = motion == Some(Motion::Linear) && block.codes.non_modal.is_none();
        if goes_on {
            return Ok(());
        }
        if !corner.may_stay {
            return Err(no_second_move(block.first_span()));
        }
        self.leave_corner(block, out)
    }

    /// Makes the move to a corner that stays as it is.
    fn leave_corner(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let Some(corner) = self.corner.take() else {
            return Ok(());
        };
        self.make_held(block, &corner, corner.at, out)
    }

    /// The end of the program: a corner has to have its second move.
    pub(crate) fn end_corner(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        match &self.corner {
            Some(corner) if !corner.may_stay => Err(no_second_move(SourceSpan::default())),
            _ => self.leave_corner(block, out),
        }
    }

    /// A straight move of G1: breaks the corner it begins at, and holds the move if its end is
    /// one.
    pub(crate) fn straight_between_corners(
        &mut self,
        block: &Block,
        target: AxisVector,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        if let Some(corner) = self.corner.take() {
            self.break_corner(block, &corner, target, out)?;
        }
        let word = self.corner_word(block);
        let Some((kind, size_mm, may_stay)) = word else {
            return self.straight(block, target, Pace::Feed, out);
        };
        let from = if self.compensation.is_some() {
            self.state.position
        } else {
            self.state.path_end
        };
        self.corner = Some(Box::new(OpenCorner {
            from,
            at: target,
            kind,
            size_mm,
            feed: self.state.modal.feed,
            line: self.line,
            may_stay,
        }));
        self.state.position = target;
        Ok(())
    }

    /// How the corner at the end of a block is to be broken.
    fn corner_word(&self, block: &Block) -> Option<(CornerKind, f64, bool)> {
        let mm = self.state.modal.units.mm();
        match block.corner {
            Some(CornerWord { kind, value, .. }) if kind != CornerKind::RoundAll => {
                Some((kind, value * mm, false)).filter(|_| value > 0.0)
            }
            _ => Some((CornerKind::Round, self.state.rounds_mm, true))
                .filter(|_| self.state.rounds_mm > 0.0),
        }
    }

    /// The held move up to a place on its way.
    fn make_held(
        &mut self,
        block: &Block,
        corner: &OpenCorner,
        place: AxisVector,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let (line, feed) = (self.line, self.state.modal.feed);
        self.line = corner.line;
        self.state.modal.feed = corner.feed;
        self.state.position = corner.from;
        let made = self.straight(block, place, Pace::Feed, out);
        self.state.modal.feed = feed;
        self.line = line;
        made
    }

    fn break_corner(
        &mut self,
        block: &Block,
        corner: &OpenCorner,
        target: AxisVector,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let span = block.motion_span();
        let image = self.offsets.plane(self.state.modal.plane);
        let image = image.ok_or_else(|| not_in_plane(span))?;
        let (first, second) = image.plane.axes();
        let (i, j) = (first.index(), second.index());
        let leaves_plane = |from: &AxisVector, to: &AxisVector| {
            let mut other = to - from;
            (other[i], other[j]) = (0.0, 0.0);
            other.amax() > MIN_MOVE
        };
        let is_out = leaves_plane(&corner.from, &corner.at) || leaves_plane(&corner.at, &target);
        if is_out && corner.may_stay {
            return self.make_held(block, corner, corner.at, out);
        } else if is_out {
            return Err(not_in_plane(span));
        }
        let flat = |place: &AxisVector| [place[i], place[j]];
        let points = [flat(&corner.from), flat(&corner.at), flat(&target)];
        let broken = broken(points, corner.kind, corner.size_mm * image.scale);
        let broken = match broken {
            Ok(Some(broken)) => broken,
            Ok(None) => return self.make_held(block, corner, corner.at, out),
            Err(_) if corner.may_stay => return self.make_held(block, corner, corner.at, out),
            Err(why) => return Err(cannot_break(span, why)),
        };
        let place = |flat: [f64; 2]| {
            let mut place = corner.at;
            (place[i], place[j]) = (flat[0], flat[1]);
            place
        };
        self.make_held(block, corner, place(broken.first), out)?;
        match broken.arc {
            None => self.straight(block, place(broken.second), Pace::Feed, out),
            Some((center, sweep_rad)) => {
                let end = place(broken.second);
                let arc = Arc {
                    start: end,
                    end,
                    plane: image.plane,
                    center,
                    sweep_rad,
                };
                self.round(block, arc, out)
            }
        }
    }

    /// The arc of a rounded corner; it begins where the tool is.
    fn round(&mut self, block: &Block, arc: Arc, out: &mut Vec<Item>) -> Outcome<()> {
        let is_compensated = self.compensation.is_some();
        let start = if is_compensated {
            self.state.position
        } else {
            self.state.path_end
        };
        let (arc, end) = (Arc { start, ..arc }, arc.end);
        let segment = Segment::Arc(arc);
        let speed = self.speed(block, &segment, Pace::Feed)?;
        if is_compensated {
            self.state.position = end;
            return self.contour_move(block, segment, speed, out);
        }
        let (low, high) = arc.bounding_box();
        self.check_limits(block, &low, &high, "a point")?;
        self.state.position = end;
        self.push_move(segment, speed, out);
        Ok(())
    }
}

/// How a corner is broken; `None`: the moves go on straight. Else why it cannot be.
fn broken(
    [a, b, c]: [[f64; 2]; 3],
    kind: CornerKind,
    size_mm: f64,
) -> Result<Option<Broken>, &'static str> {
    let way = |to: [f64; 2]| [to[0] - b[0], to[1] - b[1]];
    let length = |v: [f64; 2]| v[0].hypot(v[1]);
    let (to_a, to_c) = (way(a), way(c));
    let (before, behind) = (length(to_a), length(to_c));
    if before <= MIN_MOVE || behind <= MIN_MOVE {
        return Err("one of the moves goes nowhere");
    }
    let u = to_a.map(|part| part / before);
    let v = to_c.map(|part| part / behind);
    let cross = u[0] * v[1] - u[1] * v[0];
    let angle = cross.abs().atan2(u[0] * v[0] + u[1] * v[1]);
    if PI - angle < STRAIGHT_RAD {
        return Ok(None);
    }
    if angle < STRAIGHT_RAD {
        return Err("the second move goes back where the first one came from");
    }
    let leg = match kind {
        CornerKind::Chamfer => size_mm,
        CornerKind::ChamferLength => 0.5 * size_mm / (0.5 * angle).sin(),
        CornerKind::Round | CornerKind::RoundAll => size_mm / (0.5 * angle).tan(),
    };
    if leg > before + MIN_MOVE || leg > behind + MIN_MOVE {
        return Err("one of the moves is shorter than what it takes away");
    }
    let along = |way: [f64; 2]| [b[0] + leg * way[0], b[1] + leg * way[1]];
    let arc = matches!(kind, CornerKind::Round | CornerKind::RoundAll).then(|| {
        let middle = [u[0] + v[0], u[1] + v[1]];
        let out = size_mm / (0.5 * angle).sin() / length(middle);
        let center = [b[0] + out * middle[0], b[1] + out * middle[1]];
        // The moves go along −u, then v: to the left where that turns left.
        let sweep = (PI - angle).copysign(-cross);
        (center, sweep)
    });
    Ok(Some(Broken {
        first: along(u),
        second: along(v),
        arc,
    }))
}

#[cold]
fn no_second_move(span: SourceSpan) -> Box<Fault> {
    let message = "a corner that is broken has no straight move behind it";
    Fault::new(DiagnosticCode::NotSupported, span, message)
        .because("the word in the block before counts between two straight moves at feed (G1)")
        .help("write the moves one behind the other, or write the chamfer or arc out")
}

#[cold]
fn not_in_plane(span: SourceSpan) -> Box<Fault> {
    let message = "a corner that is broken outside the plane";
    Fault::new(DiagnosticCode::NotSupported, span, message)
        .because("both moves have to be in the plane of arcs")
        .help("write G17, G18 or G19, or write the chamfer or arc out")
}

#[cold]
fn cannot_break(span: SourceSpan, why: &str) -> Box<Fault> {
    let message = "the corner before this move cannot be broken";
    Fault::new(DiagnosticCode::InvalidValue, span, message)
        .because(why)
        .help("write a smaller value")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_right_angle_by_hand() {
        let points = [[0.0, 0.0], [20.0, 0.0], [20.0, 20.0]];
        let round = broken(points, CornerKind::Round, 5.0).expect("it can be");
        let round = round.expect("a corner");
        let (center, sweep) = round.arc.expect("an arc");
        let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12;
        assert!(near(round.first, [15.0, 0.0]) && near(round.second, [20.0, 5.0]));
        assert!(near(center, [15.0, 5.0]) && (sweep - PI / 2.0).abs() < 1e-12);
        let own = broken(points, CornerKind::ChamferLength, 2.0_f64.sqrt()).expect("it can be");
        assert!(near(own.expect("a corner").first, [19.0, 0.0]));
        let back = [[0.0, 0.0], [20.0, 0.0], [5.0, 0.0]];
        assert!(broken(back, CornerKind::Chamfer, 1.0).is_err());
        assert!(broken(points, CornerKind::Chamfer, 20.1).is_err());
        let on = [[0.0, 0.0], [20.0, 0.0], [25.0, 0.0]];
        assert!(matches!(broken(on, CornerKind::Round, 1.0), Ok(None)));
    }

    #[test]
    fn a_turn_to_the_right_sweeps_clockwise() {
        let points = [[0.0, 0.0], [20.0, 0.0], [20.0, -20.0]];
        let round = broken(points, CornerKind::Round, 5.0).expect("it can be");
        let (_, sweep) = round.and_then(|round| round.arc).expect("an arc");
        assert!((sweep + PI / 2.0).abs() < 1e-12);
    }
}
