//! The geometry of corners that are broken.
//!
//! ```text
//!        a ───────●P1
//!                  ╲        P1, P2: as far from the corner b, t
//!               b   ●P2     chamfer: t, or its own length / (2 sin(θ/2))
//!                   │       arc: t = r / tan(θ/2), θ the angle between the moves
//!                   c
//! ```
//!
//! Beside arcs an arc touches both moves; its centre is as far from both as its radius. The ends of a chamfer
//! are each as far from the corner, in a straight line, as its value says: FANUC's manual gives "the distance
//! from the virtual corner", that of NCT (2000M, 16.1), whose `,C` is the same, "the length of the chord drawn
//! from intersection".

use core::f64::consts::PI;

use crate::execute::compensation::element::{Element, Point, along, direction, distance, turn};
use crate::execute::lathe_cycle::edge_break::{EdgeBreak, cut};
use crate::execute::motion::settled::MIN_MOVE;
use crate::syntax::block::CornerKind;

/// The angle between the moves within which they go on straight, or back, radians.
const STRAIGHT_RAD: f64 = 1e-6;
/// The same where a FANUC goes straight: one degree.
const STRAIGHT_ON_FANUC_RAD: f64 = PI / 180.0;

/// What a control makes of a corner.
#[derive(Debug, Clone, Copy)]
pub(super) struct CornerRules {
    straight_rad: f64,
    /// A chamfer beside an arc has its ends so far from the corner.
    chamfers_arcs: bool,
}

impl CornerRules {
    /// Those of a FANUC: between moves whose directions differ by less than a degree it makes no corner R, and
    /// between two straight ones no chamfer either.
    pub(super) const FANUC: Self = Self {
        straight_rad: STRAIGHT_ON_FANUC_RAD,
        chamfers_arcs: true,
    };
    pub(super) const OTHERS: Self = Self {
        straight_rad: STRAIGHT_RAD,
        chamfers_arcs: false,
    };
}

/// Two moves, and what is between them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Broken {
    pub(super) before: Element,
    pub(super) between: Element,
    pub(super) behind: Element,
}

/// Why a corner cannot be broken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CornerFault {
    ChamferAtArc,
    ArcTooLarge,
    LegTooLong,
    NoMove,
    Back,
}

impl CornerFault {
    pub(super) const fn why(self) -> &'static str {
        match self {
            Self::ChamferAtArc => "where a chamfer begins on an arc is not known of this control",
            Self::ArcTooLarge => "the arc does not fit between the moves",
            Self::LegTooLong => "one of the moves is shorter than what it takes away",
            Self::NoMove => "one of the moves goes nowhere",
            Self::Back => "the second move goes back where the first one came from",
        }
    }

    /// A smaller one would fit.
    pub(super) const fn is_of_size(self) -> bool {
        matches!(self, Self::ArcTooLarge | Self::LegTooLong)
    }
}

/// How a corner is broken; `None`: the moves go on straight. Else why it cannot be.
pub(super) fn broken(
    mut before: Element,
    mut behind: Element,
    (kind, size_mm): (CornerKind, f64),
    rules: CornerRules,
) -> Result<Option<Broken>, CornerFault> {
    if before.arc.is_none() && behind.arc.is_none() {
        let points = [before.start, before.end, behind.end];
        return between_lines(points, kind, size_mm, rules.straight_rad);
    }
    let is_arc = matches!(kind, CornerKind::Round | CornerKind::RoundAll);
    if !is_arc && !rules.chamfers_arcs {
        return Err(CornerFault::ChamferAtArc);
    }
    if !is_arc {
        let from = on_way(&before, true, size_mm).ok_or(CornerFault::LegTooLong)?;
        let to = on_way(&behind, false, size_mm).ok_or(CornerFault::LegTooLong)?;
        before.end_at(from);
        behind.start_at(to);
        let between = Element {
            start: from,
            end: to,
            arc: None,
        };
        return Ok(Some(Broken {
            before,
            between,
            behind,
        }));
    }
    if turn(before.end_tangent(), behind.start_tangent()).abs() < rules.straight_rad {
        return Ok(None);
    }
    match cut(&mut before, &mut behind, EdgeBreak::Fillet(size_mm)) {
        None => Err(CornerFault::ArcTooLarge),
        Some(None) => Ok(None),
        Some(Some(between)) => Ok(Some(Broken {
            before,
            between,
            behind,
        })),
    }
}

/// The point of a move that is so far, straight, from its end or start; `None`: it is shorter.
fn on_way(of: &Element, from_end: bool, chord_mm: f64) -> Option<Point> {
    let (corner, other) = if from_end {
        (of.end, of.start)
    } else {
        (of.start, of.end)
    };
    let Some((center, sweep)) = of.arc else {
        let fits = chord_mm <= distance(corner, other) + MIN_MOVE;
        return fits.then(|| along(corner, direction(corner, other), chord_mm));
    };
    let half = 0.5 * chord_mm / distance(corner, center);
    let angle = 2.0 * half.min(1.0).asin();
    if half > 1.0 || angle > sweep.abs() {
        return None;
    }
    let back = if from_end { -1.0 } else { 1.0 };
    let (sin, cos) = (back * angle.copysign(sweep)).sin_cos();
    let (u, v) = (corner[0] - center[0], corner[1] - center[1]);
    Some([center[0] + u * cos - v * sin, center[1] + u * sin + v * cos])
}

/// A corner of the straight moves from a to b and on to c.
fn between_lines(
    [a, b, c]: [Point; 3],
    kind: CornerKind,
    size_mm: f64,
    straight_rad: f64,
) -> Result<Option<Broken>, CornerFault> {
    let way = |to: [f64; 2]| [to[0] - b[0], to[1] - b[1]];
    let length = |v: [f64; 2]| v[0].hypot(v[1]);
    let (to_a, to_c) = (way(a), way(c));
    let (before, behind) = (length(to_a), length(to_c));
    if before <= MIN_MOVE || behind <= MIN_MOVE {
        return Err(CornerFault::NoMove);
    }
    let u = to_a.map(|part| part / before);
    let v = to_c.map(|part| part / behind);
    let cross = u[0] * v[1] - u[1] * v[0];
    let angle = cross.abs().atan2(u[0] * v[0] + u[1] * v[1]);
    if PI - angle < straight_rad {
        return Ok(None);
    }
    if angle < STRAIGHT_RAD {
        return Err(CornerFault::Back);
    }
    let leg = match kind {
        CornerKind::Chamfer => size_mm,
        CornerKind::ChamferLength => 0.5 * size_mm / (0.5 * angle).sin(),
        CornerKind::Round | CornerKind::RoundAll => size_mm / (0.5 * angle).tan(),
    };
    if leg > before + MIN_MOVE || leg > behind + MIN_MOVE {
        return Err(CornerFault::LegTooLong);
    }
    let along = |way: Point| [b[0] + leg * way[0], b[1] + leg * way[1]];
    let arc = matches!(kind, CornerKind::Round | CornerKind::RoundAll).then(|| {
        let middle = [u[0] + v[0], u[1] + v[1]];
        let out = size_mm / (0.5 * angle).sin() / length(middle);
        let center = [b[0] + out * middle[0], b[1] + out * middle[1]];
        // The moves go along −u, then v: to the left where that turns left.
        let sweep = (PI - angle).copysign(-cross);
        (center, sweep)
    });
    let line = |start: Point, end: Point| Element {
        start,
        end,
        arc: None,
    };
    let (first, second) = (along(u), along(v));
    Ok(Some(Broken {
        before: line(a, first),
        between: Element {
            arc,
            ..line(first, second)
        },
        behind: line(second, c),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(start: Point, end: Point) -> Element {
        Element {
            start,
            end,
            arc: None,
        }
    }

    fn near(a: Point, b: Point) -> bool {
        (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-9
    }

    fn corner(points: [Point; 3], kind: CornerKind, size: f64) -> Option<Broken> {
        let [a, b, c] = points;
        broken(line(a, b), line(b, c), (kind, size), CornerRules::OTHERS).expect("it can be")
    }

    #[test]
    fn a_right_angle_by_hand() {
        let points = [[0.0, 0.0], [20.0, 0.0], [20.0, 20.0]];
        let round = corner(points, CornerKind::Round, 5.0).expect("a corner");
        let (center, sweep) = round.between.arc.expect("an arc");
        assert!(near(round.before.end, [15.0, 0.0]) && near(round.behind.start, [20.0, 5.0]));
        assert!(near(center, [15.0, 5.0]) && (sweep - PI / 2.0).abs() < 1e-12);
        let own = corner(points, CornerKind::ChamferLength, 2.0_f64.sqrt()).expect("a corner");
        assert!(near(own.before.end, [19.0, 0.0]));
        let back = broken(
            line([0.0, 0.0], [20.0, 0.0]),
            line([20.0, 0.0], [5.0, 0.0]),
            (CornerKind::Chamfer, 1.0),
            CornerRules::OTHERS,
        );
        assert!(back.is_err());
        let [a, b, c] = points;
        let too_long = (CornerKind::Chamfer, 20.1);
        assert!(broken(line(a, b), line(b, c), too_long, CornerRules::OTHERS).is_err());
        let on = [[0.0, 0.0], [20.0, 0.0], [25.0, 0.0]];
        assert!(corner(on, CornerKind::Round, 1.0).is_none());
    }

    #[test]
    fn a_turn_to_the_right_sweeps_clockwise() {
        let points = [[0.0, 0.0], [20.0, 0.0], [20.0, -20.0]];
        let round = corner(points, CornerKind::Round, 5.0).expect("a corner");
        let (_, sweep) = round.between.arc.expect("an arc");
        assert!((sweep + PI / 2.0).abs() < 1e-12);
    }

    #[test]
    fn a_line_and_a_quarter_circle_by_hand() {
        // Along X to (10, 0), then clockwise about (20, 0), upwards at first. An arc of radius 2 inside
        // the corner, above the line and left of the circle: its centre is 2 above the line, and 12
        // from (20, 0).
        let before = line([0.0, 0.0], [10.0, 0.0]);
        let behind = Element {
            start: [10.0, 0.0],
            end: [20.0, 10.0],
            arc: Some(([20.0, 0.0], -PI / 2.0)),
        };
        let made = broken(before, behind, (CornerKind::Round, 2.0), CornerRules::FANUC)
            .expect("it can be");
        let made = made.expect("a corner");
        let x = 20.0 - 140.0_f64.sqrt();
        let (center, _) = made.between.arc.expect("an arc");
        assert!(near(center, [x, 2.0]), "{center:?}");
        assert!(near(made.before.end, [x, 0.0]));
        let touch = [20.0 - (20.0 - x) * 10.0 / 12.0, 2.0 * 10.0 / 12.0];
        assert!(near(made.behind.start, touch), "{:?}", made.behind.start);
        let (_, sweep) = made.behind.arc.expect("an arc");
        let from = (touch[1]).atan2(touch[0] - 20.0);
        assert!((sweep - (PI / 2.0 - from)).abs() < 1e-9, "{sweep}");
    }

    #[test]
    fn a_chamfer_at_an_arc_by_hand() {
        // Along X to (10, 0), then a quarter clockwise about (20, 0), upwards at first. A chord of 10 is a
        // sixth of a turn of a circle of radius 10.
        let before = line([0.0, 0.0], [10.0, 0.0]);
        let behind = Element {
            start: [10.0, 0.0],
            end: [20.0, 10.0],
            arc: Some(([20.0, 0.0], -PI / 2.0)),
        };
        let chamfer = |size| (CornerKind::Chamfer, size);
        let made = broken(before, behind, chamfer(10.0), CornerRules::FANUC).expect("it can be");
        let made = made.expect("a corner");
        let touch = [15.0, 75.0_f64.sqrt()];
        assert!(near(made.between.start, [0.0, 0.0]) && near(made.between.end, touch));
        let (_, sweep) = made.behind.arc.expect("an arc");
        assert!((sweep + PI / 6.0).abs() < 1e-12 && made.between.arc.is_none());
        let fault = |size, rules| broken(before, behind, chamfer(size), rules).err();
        let fanuc = CornerRules::FANUC;
        assert_eq!(fault(10.1, fanuc), Some(CornerFault::LegTooLong));
        assert_eq!(
            fault(1.0, CornerRules::OTHERS),
            Some(CornerFault::ChamferAtArc)
        );
        // The other way round: the arc comes first, and its end is cut.
        let back = |of: Element| Element {
            start: of.end,
            end: of.start,
            arc: of.arc.map(|(center, sweep)| (center, -sweep)),
        };
        let made = broken(back(behind), back(before), chamfer(10.0), fanuc).expect("it can be");
        let made = made.expect("a corner");
        assert!(near(made.between.start, touch) && near(made.between.end, [0.0, 0.0]));
    }

    #[test]
    fn a_fanuc_goes_straight_within_a_degree() {
        let on = |degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let behind = line([20.0, 0.0], [20.0 + 20.0 * cos, 20.0 * sin]);
            let before = line([0.0, 0.0], [20.0, 0.0]);
            let size = (CornerKind::Chamfer, 5.0);
            broken(before, behind, size, CornerRules::FANUC).expect("it can be")
        };
        assert!(on(0.99).is_none() && on(-0.99).is_none() && on(1.01).is_some());
    }
}
