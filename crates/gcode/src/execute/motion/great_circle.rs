//! Orientation on a great circle (ORIVECT and ORIPLANE of SINUMERIK): between two blocks the direction of the
//! tool turns in one plane, by the same angle on the same way.
//!
//! ```text
//!   direction(s) = from · cos(s · angle) + side · sin(s · angle)         s = 0 … 1 along the path
//! ```
//!
//! The rotary axes follow it, each by another law. Along the axis of C, at the pole, C has no value: where a
//! move begins or ends within [`POLE_DEG`] of it, the angles change evenly, as this control has it unless its
//! machine data say otherwise (MD 21108, MD 24540).

use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::FiveAxis;
use nalgebra::Vector3;

/// How near to the pole C is not asked to follow a direction, degrees.
const POLE_DEG: f64 = 2.0;
/// Directions and angles nearer than this are the same, radians and degrees.
const SAME: f64 = 1e-9;

/// The turn of a move.
#[derive(Debug, Clone, Copy)]
pub(super) struct GreatCircle {
    machine: FiveAxis,
    from: Vector3<f64>,
    /// At right angles to it, in the plane of the turn.
    side: Vector3<f64>,
    angle_rad: f64,
    /// Which of the two ways to stand along a direction the machine takes.
    branch: usize,
    /// C at both ends.
    rotary_deg: [f64; 2],
}

/// Why a move has no great circle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NoCircle {
    /// It would pass the pole.
    ByPole,
    /// C would turn farther than the direction needs it.
    Farther,
    /// It would leave what the tilt axis can lean the tool to.
    OutOfReach,
}

impl GreatCircle {
    /// The turn between two places; `None` where the angles change evenly.
    pub(super) fn between(
        machine: FiveAxis,
        start: &AxisVector,
        end: &AxisVector,
    ) -> Result<Option<Self>, NoCircle> {
        let (tilt, rotary) = (machine.tilt_axis().index(), Axis::C.index());
        let (tilts, rotary_deg) = ([start[tilt], end[tilt]], [start[rotary], end[rotary]]);
        let turn = rotary_deg[1] - rotary_deg[0];
        let directions = [0, 1].map(|end| machine.tool_axis(tilts[end], rotary_deg[end]));
        let [from, to] = directions.map(|way| way.normalize());
        let is_at_pole = |way: &Vector3<f64>| way.x.hypot(way.y) < POLE_DEG.to_radians().sin();
        // A tilt alone is a great circle.
        if turn.abs() < SAME || is_at_pole(&from) || is_at_pole(&to) {
            return Ok(None);
        }
        let normal = from.cross(&to);
        let angle_rad = normal.norm().atan2(from.dot(&to));
        if turn.abs() > 180.0 || angle_rad < SAME {
            return Err(NoCircle::Farther);
        }
        let branch_of = |way: &Vector3<f64>, end: usize| {
            let both = machine.branches_deg(way, rotary_deg[end])?;
            let far = both.map(|(tilt, rotary)| {
                (tilt - tilts[end])
                    .abs()
                    .max((rotary - rotary_deg[end]).abs())
            });
            Some(usize::from(far[1] < far[0]))
        };
        let side = (to - from * from.dot(&to)).normalize();
        let lowest = lowest(&from, &side, angle_rad);
        if machine.branches_deg(&lowest, 0.0).is_none() {
            return Err(NoCircle::OutOfReach);
        }
        let branch = branch_of(&from, 0).ok_or(NoCircle::OutOfReach)?;
        if Some(branch) != branch_of(&to, 1) || passes_pole(&from, &side, angle_rad) {
            return Err(NoCircle::ByPole);
        }
        Ok(Some(Self {
            machine,
            from,
            side,
            angle_rad,
            branch,
            rotary_deg,
        }))
    }

    /// Turns the tool to where it is on that share of the way.
    pub(super) fn turn(&self, share: f64, place: &mut AxisVector) {
        let (sin, cos) = (share * self.angle_rad).sin_cos();
        let way = self.from * cos + self.side * sin;
        let [first, last] = self.rotary_deg;
        let near = first + share * (last - first);
        // The lowest direction of the turn is in reach, and so are all.
        let Some(branches) = self.machine.branches_deg(&way, near) else {
            return;
        };
        let (tilt, rotary) = branches[self.branch];
        place[self.machine.tilt_axis().index()] = tilt;
        place[Axis::C.index()] = rotary;
    }
}

/// Where the tool leans most on a turn.
fn lowest(from: &Vector3<f64>, side: &Vector3<f64>, angle_rad: f64) -> Vector3<f64> {
    let at = |angle: f64| from * angle.cos() + side * angle.sin();
    // The plane of the turn is lowest half a turn from where it is highest.
    let bottom_rad = (-side.z).atan2(-from.z).rem_euclid(core::f64::consts::TAU);
    let inside = (bottom_rad < angle_rad).then_some(bottom_rad);
    let places = [Some(0.0), Some(angle_rad), inside];
    let lower = |a: Vector3<f64>, b: Vector3<f64>| if b.z < a.z { b } else { a };
    places.into_iter().flatten().map(at).fold(*from, lower)
}

/// True where a turn comes nearer to the pole than C can follow.
fn passes_pole(from: &Vector3<f64>, side: &Vector3<f64>, angle_rad: f64) -> bool {
    // Where the plane of the turn is nearest to the pole, and how near.
    let (along, across) = (from.z, side.z);
    let nearest_rad = along.hypot(across).min(1.0).acos();
    let at_rad = across.atan2(along);
    let is_between = [0.0, core::f64::consts::PI, -core::f64::consts::PI]
        .into_iter()
        .any(|half| (0.0..=angle_rad).contains(&(at_rad + half)));
    is_between && nearest_rad < POLE_DEG.to_radians()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_kinematics::{Rotaries, Tilt};

    fn machine() -> FiveAxis {
        FiveAxis {
            rotaries: Rotaries::TableTable {
                tilt_point: Vector3::zeros(),
                rotary_point: Vector3::zeros(),
            },
            tilt: Tilt::A,
            tilt_reversed: false,
            rotary_reversed: false,
            tool_mm: 50.0,
        }
    }

    fn at(a: f64, c: f64) -> AxisVector {
        let mut place = AxisVector::zeros();
        (place[Axis::A.index()], place[Axis::C.index()]) = (a, c);
        place
    }

    /// A and C half way.
    fn middle(start: (f64, f64), end: (f64, f64)) -> Result<Option<[f64; 2]>, NoCircle> {
        let circle = GreatCircle::between(machine(), &at(start.0, start.1), &at(end.0, end.1))?;
        Ok(circle.map(|circle| {
            let mut place = AxisVector::zeros();
            circle.turn(0.5, &mut place);
            [place[Axis::A.index()], place[Axis::C.index()]]
        }))
    }

    #[test]
    fn half_way_by_hand() {
        // Directions at 45 degrees from z, a quarter turn apart: the middle is (1, 1, 2) / √6 from the axis
        // by atan(√2 / 2) = 35.2644 degrees.
        let [a, c] = middle((45.0, 0.0), (45.0, 90.0))
            .unwrap()
            .expect("a circle");
        assert!((a - 35.264_389_682_754_654).abs() < 1e-9, "{a}");
        assert!((c - 45.0).abs() < 1e-9, "{c}");
        // The other way round for the other branch.
        let [a, c] = middle((-45.0, 10.0), (-45.0, 100.0))
            .unwrap()
            .expect("a circle");
        assert!((a + 35.264_389_682_754_654).abs() < 1e-9, "{a}");
        assert!((c - 55.0).abs() < 1e-9, "{c}");
    }

    #[test]
    fn even_angles_and_refusals() {
        for (start, end) in [
            ((10.0, 30.0), (50.0, 30.0)),
            ((0.0, 0.0), (30.0, 90.0)),
            ((30.0, 90.0), (1.0, 0.0)),
            ((-20.0, 5.0), (20.0, 5.0)),
        ] {
            assert_eq!(middle(start, end), Ok(None), "{start:?} {end:?}");
        }
        for (start, end) in [((30.0, 0.0), (30.0, 179.0)), ((30.0, 0.0), (-30.0, 10.0))] {
            assert_eq!(
                middle(start, end),
                Err(NoCircle::ByPole),
                "{start:?} {end:?}"
            );
        }
        for (start, end) in [((30.0, 0.0), (30.0, 200.0)), ((30.0, 0.0), (30.0, 360.0))] {
            assert_eq!(
                middle(start, end),
                Err(NoCircle::Farther),
                "{start:?} {end:?}"
            );
        }
        // By the pole behind the end, and on the other side of the circle.
        assert!(middle((40.0, 0.0), (60.0, 0.5)).unwrap().is_some());
    }
}
