//! Fillets and chamfers between two elements of a profile.
//!
//! The centre of a fillet is as far from both elements as its radius: it is where their offsets
//! meet, on the inner side of the corner. A chamfer leads straight between the points where a
//! fillet of the same size would begin and end.

use crate::execute::compensation::element::{Element, Point, meet, turn};

/// Directions that differ by less are no corner, radians.
const SMOOTH_RAD: f64 = 1e-9;

/// What is made of the corner at the end of an element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum EdgeBreak {
    /// An arc of this radius, mm, > 0.
    Fillet(f64),
    /// A line between the ends of a fillet of this radius.
    Chamfer(f64),
    /// A line whose ends are this far from the corner of two lines.
    Leg(f64),
}

/// Puts a fillet or chamfer between two elements, which are shortened; `None` if it does not fit.
pub(crate) fn cut(
    before: &mut Element,
    after: &mut Element,
    corner: EdgeBreak,
) -> Option<Option<Element>> {
    let (u, v) = (before.end_tangent(), after.start_tangent());
    let left_turn = turn(u, v);
    if left_turn.abs() < SMOOTH_RAD {
        return Some(None);
    }
    let radius = match corner {
        EdgeBreak::Fillet(radius) | EdgeBreak::Chamfer(radius) => radius,
        EdgeBreak::Leg(_) if before.arc.is_some() || after.arc.is_some() => return None,
        EdgeBreak::Leg(leg) => leg / (0.5 * left_turn.abs()).tan(),
    };
    let left = radius.copysign(left_turn);
    let center = meet(&before.offset(left)?, &after.offset(left)?)?;
    let (from, to) = (foot(before, center), foot(after, center));
    before.end_at(from);
    after.start_at(to);
    let a = [from[0] - center[0], from[1] - center[1]];
    let b = [to[0] - center[0], to[1] - center[1]];
    let sweep = turn(a, b);
    Some(Some(Element {
        start: from,
        end: to,
        arc: matches!(corner, EdgeBreak::Fillet(_)).then_some((center, sweep)),
    }))
}

/// The point of the line or circle of an element that is nearest to another point.
fn foot(element: &Element, point: Point) -> Point {
    match element.arc {
        None => {
            let u = element.start_tangent();
            let from = element.start;
            let s = (point[0] - from[0]) * u[0] + (point[1] - from[1]) * u[1];
            [from[0] + s * u[0], from[1] + s * u[1]]
        }
        Some((center, _)) => {
            let by = [point[0] - center[0], point[1] - center[1]];
            let radius = (element.start[0] - center[0]).hypot(element.start[1] - center[1]);
            let share = radius / by[0].hypot(by[1]);
            [center[0] + share * by[0], center[1] + share * by[1]]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn line(start: Point, end: Point) -> Element {
        Element {
            start,
            end,
            arc: None,
        }
    }

    fn near(a: Point, b: Point) -> bool {
        (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12
    }

    #[test]
    fn a_square_corner_by_hand() {
        let corner = || {
            (
                line([0.0, 0.0], [-10.0, 0.0]),
                line([-10.0, 0.0], [-10.0, 5.0]),
            )
        };
        let (mut before, mut after) = corner();
        let fillet = cut(&mut before, &mut after, EdgeBreak::Fillet(2.0));
        let fillet = fillet.flatten().expect("it fits");
        assert!(near(before.end, [-8.0, 0.0]) && near(fillet.start, before.end));
        assert!(near(after.start, [-10.0, 2.0]) && near(fillet.end, after.start));
        let (center, sweep) = fillet.arc.expect("an arc");
        assert!(near(center, [-8.0, 2.0]));
        assert!((sweep + core::f64::consts::FRAC_PI_2).abs() < 1e-12);

        let (mut before, mut after) = corner();
        let chamfer = cut(&mut before, &mut after, EdgeBreak::Chamfer(2.0));
        let chamfer = chamfer.flatten().expect("it fits");
        assert_eq!(chamfer.arc, None);
        assert!(near(chamfer.start, [-8.0, 0.0]) && near(chamfer.end, [-10.0, 2.0]));
    }

    #[test]
    fn what_does_not_fit_is_refused_and_no_corner_is_left_alone() {
        let (mut before, mut after) = (
            line([0.0, 0.0], [-1.0, 0.0]),
            line([-1.0, 0.0], [-1.0, 5.0]),
        );
        assert_eq!(cut(&mut before, &mut after, EdgeBreak::Fillet(1.5)), None);
        let mut straight = line([-1.0, 0.0], [-3.0, 0.0]);
        assert_eq!(
            cut(&mut before, &mut straight, EdgeBreak::Fillet(0.5)),
            Some(None)
        );
    }

    #[test]
    fn a_fillet_touches_a_line_and_an_arc() {
        // A quarter about (-5, 5) from (-5, 0) to (0, 5)... entered along a slant.
        let mut before = line([-20.0, 3.0], [-5.0, 0.0]);
        let mut after = Element {
            start: [-5.0, 0.0],
            end: [0.0, 5.0],
            arc: Some(([-5.0, 5.0], core::f64::consts::FRAC_PI_2)),
        };
        let fillet = cut(&mut before, &mut after, EdgeBreak::Fillet(1.0));
        let fillet = fillet.flatten().expect("it fits");
        let (center, _) = fillet.arc.expect("an arc");
        let far = (center[0] + 5.0).hypot(center[1] - 5.0);
        assert!((far - 4.0).abs() < 1e-12, "inside the arc by its radius");
        let across = (center[0] + 20.0) * 3.0 / 234.0_f64.sqrt()
            + (center[1] - 3.0) * 15.0 / 234.0_f64.sqrt();
        assert!((across - 1.0).abs() < 1e-12, "above the line by its radius");
    }
}
