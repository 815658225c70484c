//! The circle through the ends of an arc: its centre from R, the check of its radii, its sweep.

use core::f64::consts::{PI, TAU};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::motion::settled::MIN_MOVE;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;

/// Difference of the radii that is always accepted, mm.
const RADIUS_TOLERANCE_MM: f64 = 0.0127;
/// Relative difference of the radii that is accepted below [`RADIUS_TOLERANCE_MAX_MM`].
const RADIUS_TOLERANCE_RELATIVE: f64 = 0.001;
/// Difference of the radii that is never accepted, mm.
const RADIUS_TOLERANCE_MAX_MM: f64 = 100.0 * RADIUS_TOLERANCE_MM;
/// By how much an R may fall short of half the distance of the end points, mm.
const SHORT_RADIUS_MM: f64 = 0.00127;
/// Ends closer than this make a full turn, mm.
const SAME_POINT_MM: f64 = 1e-6;

/// What to check of an arc whose centre always counts from its start.
const CHECK_CENTER: &str =
    "check the end, and I, J and K, which are the way from the start to the centre";

/// The two in-plane coordinates of an arc's ends, mm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ends {
    pub(crate) start: [f64; 2],
    pub(crate) end: [f64; 2],
}

impl Ends {
    /// True where an arc ends where it begins.
    pub(crate) fn is_closed(self) -> bool {
        self.chord() <= SAME_POINT_MM
    }

    /// How far the ends are from each other.
    pub(crate) fn chord(self) -> f64 {
        distance(self.start, self.end)
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

pub(crate) fn check_radii(block: &Block, ends: Ends, center: [f64; 2]) -> Outcome<()> {
    let (start, end) = (distance(ends.start, center), distance(ends.end, center));
    let span = center_span(block);
    if start <= MIN_MOVE || end <= MIN_MOVE {
        let which = if start <= MIN_MOVE { "start" } else { "end" };
        let message = format!("the centre of the arc is its {which} point");
        return Err(
            BlockDiagnostic::new(DiagnosticCode::ArcZeroRadius, span, message)
                .because("a circle of radius zero has no direction")
                .help(match block.dialect {
                    Dialect::LinuxCnc => {
                        "write the centre relative to the start (G91.1), or use G90.1"
                    }
                    _ => CHECK_CENTER,
                }),
        );
    }
    let difference = (start - end).abs();
    let relative = difference / start.max(end);
    if difference > RADIUS_TOLERANCE_MAX_MM
        || (difference > RADIUS_TOLERANCE_MM && relative > RADIUS_TOLERANCE_RELATIVE)
    {
        let message = format!(
            "the arc does not close: its radius is {start:.4} mm at the start, {end:.4} mm at the end"
        );
        return Err(
            BlockDiagnostic::new(DiagnosticCode::ArcRadiusMismatch, span, message)
                .because("both ends must lie on one circle about the centre")
                .help(match block.dialect {
                    Dialect::LinuxCnc => {
                        "check that the centre is meant as G91.1 (relative) or G90.1 (absolute)"
                    }
                    _ => CHECK_CENTER,
                }),
        );
    }
    Ok(())
}

/// Where a diagnostic about the centre points.
fn center_span(block: &Block) -> SourceSpan {
    let words = [b'I', b'J', b'K'].map(|letter| block.span(letter));
    let present = words.into_iter().filter(|span| span.length > 0);
    present
        .min_by_key(|span| span.start)
        .unwrap_or_else(|| block.motion_span())
}

/// Centre of the arc with the given radius in mm; negative: the longer one.
pub(crate) fn center_from_radius(
    block: &Block,
    ends: Ends,
    radius: f64,
    counterclockwise: bool,
) -> Outcome<[f64; 2]> {
    let span = block.span(b'R');
    let chord = distance(ends.start, ends.end);
    let half = 0.5 * chord;
    if radius.abs() <= MIN_MOVE {
        return Err(BlockDiagnostic::new(
            DiagnosticCode::ArcZeroRadius,
            span,
            "the radius of the arc is zero",
        )
        .because("a circle of radius zero has no direction"));
    }
    if chord <= SAME_POINT_MM {
        let message = "a radius, and an end point that is the start point";
        return Err(
            BlockDiagnostic::new(DiagnosticCode::ArcFullCircleWithRadius, span, message)
                .because("every circle of that radius through the point would do")
                .help("give the centre by I, J or K"),
        );
    }
    if half - radius.abs() > SHORT_RADIUS_MM {
        let message = format!(
            "the radius {:.4} mm is too small: the ends are {chord:.4} mm apart",
            radius.abs()
        );
        return Err(
            BlockDiagnostic::new(DiagnosticCode::ArcRadiusTooSmall, span, message)
                .because("the radius must be at least half the distance of the ends")
                .help("correct R or the end point"),
        );
    }
    let rise = (radius * radius - half * half).max(0.0).sqrt();
    // The centre is left of the chord for a short counterclockwise arc.
    let side = if counterclockwise == (radius > 0.0) {
        rise
    } else {
        -rise
    };
    let along = [
        (ends.end[0] - ends.start[0]) / chord,
        (ends.end[1] - ends.start[1]) / chord,
    ];
    Ok([
        0.5 * (ends.start[0] + ends.end[0]) - side * along[1],
        0.5 * (ends.start[1] + ends.end[1]) + side * along[0],
    ])
}

/// Signed sweep in radians: up to one turn, and the further turns.
pub(crate) fn sweep(ends: Ends, center: [f64; 2], counterclockwise: bool, turns: f64) -> f64 {
    let angle = |p: [f64; 2]| (p[1] - center[1]).atan2(p[0] - center[0]);
    let turn = if counterclockwise { TAU } else { -TAU };
    let mut swept = angle(ends.end) - angle(ends.start);
    if distance(ends.start, ends.end) <= SAME_POINT_MM {
        // A full turn: what differs is rounding, on either side.
        if swept.abs() > PI {
            swept -= TAU.copysign(swept);
        }
        swept += turn;
    } else if (swept > 0.0) != counterclockwise || swept == 0.0 {
        swept += turn;
    }
    swept + (turns - 1.0) * turn
}

#[cfg(test)]
mod tests {
    use super::*;

    const DOT: [f64; 2] = [0.0, 0.0];

    fn swept(start: [f64; 2], end: [f64; 2], counterclockwise: bool) -> f64 {
        sweep(Ends { start, end }, DOT, counterclockwise, 1.0)
    }

    #[test]
    fn sweeps_go_the_asked_way() {
        let (east, north, west) = ([1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]);
        assert!((swept(east, north, true) - PI / 2.0).abs() < 1e-15);
        assert!((swept(east, north, false) + 1.5 * PI).abs() < 1e-15);
        assert!((swept(north, east, false) + PI / 2.0).abs() < 1e-15);
        assert!((swept(west, north, true) - 1.5 * PI).abs() < 1e-15);
        assert!((swept(east, east, true) - TAU).abs() < 1e-15);
        assert!((swept(west, west, false) + TAU).abs() < 1e-15);
    }

    #[test]
    fn a_full_turn_survives_rounding_on_both_sides_of_the_cut() {
        for offset in [1e-13, -1e-13] {
            assert!((swept([-1.0, 0.0], [-1.0, offset], true) - TAU).abs() < 1e-12);
            assert!((swept([-1.0, offset], [-1.0, -offset], false) + TAU).abs() < 1e-12);
        }
    }

    #[test]
    fn more_turns_add_whole_turns() {
        let ends = Ends {
            start: [1.0, 0.0],
            end: [0.0, 1.0],
        };
        assert!((sweep(ends, DOT, true, 3.0) - (PI / 2.0 + 2.0 * TAU)).abs() < 1e-14);
        assert!((sweep(ends, DOT, false, 2.0) + (1.5 * PI + TAU)).abs() < 1e-14);
    }

    #[test]
    fn the_radius_is_met_at_both_ends() {
        let ends = Ends {
            start: [1.0, 2.0],
            end: [4.0, -3.0],
        };
        for radius in [3.0, -3.0, 100.0, -2.92] {
            for counterclockwise in [true, false] {
                let c = center_from_radius(&Block::default(), ends, radius, counterclockwise)
                    .expect("reachable");
                assert!((distance(ends.start, c) - radius.abs()).abs() < 1e-9);
                assert!((distance(ends.end, c) - radius.abs()).abs() < 1e-9);
                let swept = sweep(ends, c, counterclockwise, 1.0);
                assert_eq!(swept > 0.0, counterclockwise);
                assert_eq!(
                    swept.abs() > PI,
                    radius < 0.0,
                    "{radius} {counterclockwise}"
                );
            }
        }
    }
}
