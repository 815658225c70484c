//! Arcs in any plane of space, as rational curves: CIP, and arcs in a frame that tilts their plane.
//!
//! An arc of less than half a turn is a quadratic NURBS whose middle point is where the tangents of
//! its ends meet, with the cosine of half its angle as weight (L. Piegl, W. Tiller, *The NURBS Book*,
//! ch. 7). A frame is an affine map, so the curve through the mapped points is the mapped arc.

use core::f64::consts::{FRAC_PI_4, TAU};

use glidepath_geometry::{Axis, AxisVector, Nurbs, Plane};
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::curve::Circle;
use crate::execute::motion::settled::{MIN_MOVE, settled};
use crate::syntax::block::Block;
use crate::syntax::modes::Distance;
use crate::syntax::named_word::Named;
use crate::syntax::word_check::missing;

/// Largest angle of a piece of an arc that goes nowhere else, radians.
const FLAT_PIECE_RAD: f64 = FRAC_PI_4;
/// The same of a helix: along its axis a rational piece is even to (angle)² / 60 of its length.
const HELIX_PIECE_RAD: f64 = TAU / 90.0;
/// Sines of angles below this are of three points on a line.
const STRAIGHT: f64 = 1e-9;

/// An arc in space: what it adds to the coordinates of its centre.
#[derive(Debug, Clone, Copy)]
pub(super) struct SpaceArc {
    /// Where it begins and ends, all axes.
    pub(super) start: AxisVector,
    pub(super) end: AxisVector,
    /// Of X, Y and Z.
    pub(super) center: [f64; 3],
    /// From the centre to where it begins, and at a right angle to that in the sense of the sweep, both
    /// as long as the radius.
    pub(super) axes: [[f64; 3]; 2],
    /// The angle it goes through, > 0, radians.
    pub(super) sweep_rad: f64,
}

impl SpaceArc {
    /// An arc in a plane, about a centre in its two axes.
    pub(super) fn in_plane(
        plane: Plane,
        (start, end): (AxisVector, AxisVector),
        center: [f64; 2],
        sweep_rad: f64,
    ) -> Self {
        let (first, second) = plane.axes();
        let (i, j) = (first.index(), second.index());
        let mut middle = [start[0], start[1], start[2]];
        (middle[i], middle[j]) = (center[0], center[1]);
        let out_of = [start[i] - center[0], start[j] - center[1]];
        let mut axes = [[0.0; 3]; 2];
        (axes[0][i], axes[0][j]) = (out_of[0], out_of[1]);
        let sense = sweep_rad.signum();
        (axes[1][i], axes[1][j]) = (-sense * out_of[1], sense * out_of[0]);
        Self {
            start,
            end,
            center: middle,
            axes,
            sweep_rad: sweep_rad.abs(),
        }
    }

    /// The curve, in control points that `map` puts into their places.
    pub(super) fn curve(
        &self,
        map: impl Fn(AxisVector) -> AxisVector,
    ) -> Result<Nurbs, Box<BlockDiagnostic>> {
        let way = self.end - self.start;
        let flat = self.offset(self.sweep_rad, 1.0);
        let arc_way = [0, 1, 2].map(|i| flat[i] + self.center[i] - self.start[i]);
        let beside = Axis::ALL.into_iter().any(|axis| {
            let i = axis.index();
            (way[i] - arc_way.get(i).copied().unwrap_or(0.0)).abs() > MIN_MOVE
        });
        let piece = if beside {
            HELIX_PIECE_RAD
        } else {
            FLAT_PIECE_RAD
        };
        let count = (self.sweep_rad / piece).ceil().max(1.0);
        let half = 0.5 * self.sweep_rad / count;
        let weight = half.cos();
        // What the ends have besides the circle is gone evenly.
        let rest = |share: f64| {
            let mut rest = way * share;
            for i in 0..3 {
                rest[i] = (way[i] - arc_way[i]) * share;
            }
            rest
        };
        let at = |angle: f64, stretch: f64| {
            let offset = self.offset(angle, stretch);
            let mut point = self.start + rest(angle / self.sweep_rad);
            for i in 0..3 {
                point[i] += self.center[i] + offset[i] - self.start[i];
            }
            point
        };
        let (mut points, mut weights) = (vec![map(self.start)], vec![1.0]);
        let mut knots = vec![0.0; 3];
        let mut number = 0.0;
        while number < count {
            let middle = (2.0 * number + 1.0) * half;
            points.push(map(at(middle, 1.0 / weight)));
            number += 1.0;
            let is_last = number >= count;
            points.push(map(if is_last {
                self.end
            } else {
                at(2.0 * number * half, 1.0)
            }));
            weights.extend([weight, 1.0]);
            knots.extend([number; 2]);
        }
        knots.push(number);
        Nurbs::new(2, &points, &weights, &knots).map_err(|error| {
            let span = SourceSpan::default();
            BlockDiagnostic::new(DiagnosticCode::Spline, span, error.to_string())
                .because(
                    "an arc of a plane that is turned or tilted is a curve with control points",
                )
                .help("check the centre and the radius of the arc")
        })
    }

    /// From the centre to the point at an angle, that much farther away.
    fn offset(&self, angle: f64, stretch: f64) -> [f64; 3] {
        let (sin, cos) = angle.sin_cos();
        [0, 1, 2].map(|i| stretch * (self.axes[0][i] * cos + self.axes[1][i] * sin))
    }
}

impl Interpreter {
    /// Gives out an arc, whose control points `map` puts into machine coordinates.
    pub(super) fn push_space_arc(
        &mut self,
        block: &Block,
        arc: &SpaceArc,
        map: impl Fn(AxisVector) -> AxisVector,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let mut center = arc.start;
        for (i, coordinate) in arc.center.into_iter().enumerate() {
            center[i] = coordinate;
        }
        let radius = map(arc.start) - map(center);
        let radius_mm = radius[0].hypot(radius[1]).hypot(radius[2]);
        let flat_mm = radius_mm * arc.sweep_rad;
        let circle = Some(Circle { radius_mm, flat_mm }).filter(|_| flat_mm > 0.0);
        let curve = arc.curve(map).map_err(|mut fault| {
            fault.span = block.motion_span();
            fault
        })?;
        self.push_curve(block, curve, circle, out)
    }

    /// CIP: an arc through a point, I1 J1 K1, to its end.
    pub(crate) fn arc_through(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let span = block.motion_span();
        self.check_no_compensation(block)?;
        let via = [0, 1, 2].map(|axis| block.named.get(Named::Via(axis)));
        if via.iter().all(Option::is_none) {
            let meaning = "the point that the arc goes through";
            return Err(missing(span, "CIP", "I1, J1 or K1", meaning));
        }
        let start = self.state.path_end;
        let target = self.target(block)?;
        let mut end = settled(start, target, [None, None]);
        for i in 0..3 {
            end[i] = target[i];
        }
        let scale = self.state.modal.units.mm();
        let mut place = self.state.offsets.to_program(self.state.position);
        let incremental = self.state.modal.distance == Distance::Incremental;
        for (i, value) in via.into_iter().enumerate() {
            if let Some(value) = value {
                let is_diameter = i == 0 && self.state.modal.diameter && !incremental;
                let share = if is_diameter { 0.5 } else { 1.0 };
                place[i] = value * share * scale + if incremental { place[i] } else { 0.0 };
            }
        }
        let via = self.state.offsets.to_machine(place);
        let xyz = |point: &AxisVector| [point[0], point[1], point[2]];
        let Some(arc) = through(xyz(&start), xyz(&via), xyz(&end)) else {
            let message = "the three points of CIP are on a line";
            return Err(BlockDiagnostic::new(DiagnosticCode::ArcWithoutCenter, span, message)
                .because("an arc goes from the start through I1 J1 K1 to the end, which are three places of a circle")
                .help("correct I1, J1 and K1, or write G1"));
        };
        let arc = SpaceArc { start, end, ..arc };
        self.push_space_arc(block, &arc, |point| point, out)?;
        self.state.position = target;
        Ok(())
    }

    fn check_no_compensation(&self, block: &Block) -> Outcome<()> {
        if self.state.open.compensation.is_none() && !self.state.leaving_contour {
            return Ok(());
        }
        let message = "an arc in space with cutter radius compensation";
        Err(
            BlockDiagnostic::new(DiagnosticCode::CutterRadius, block.motion_span(), message)
                .because("the radius is taken beside lines and arcs of the plane")
                .help("write G40 and a straight move before it"),
        )
    }

    /// An arc of a plane of the program that is in no plane of the machine; `ends` and `center` are in
    /// the two axes of the plane, program coordinates.
    pub(super) fn arc_in_tilted_frame(
        &mut self,
        block: &Block,
        plane: Plane,
        ends: (AxisVector, AxisVector),
        (center, sweep_rad): ([f64; 2], f64),
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        self.check_no_compensation(block)?;
        let arc = SpaceArc::in_plane(plane, ends, center, sweep_rad);
        let offsets = self.state.offsets.clone();
        // Its start is where the last move ended, to the last bit.
        let here = self.state.path_end;
        let map = |point: AxisVector| {
            if point == ends.0 {
                here
            } else {
                offsets.to_machine(point)
            }
        };
        self.push_space_arc(block, &arc, map, out)
    }
}

/// The arc from one point through another to a third; `None` if they are on a line.
fn through(start: [f64; 3], via: [f64; 3], end: [f64; 3]) -> Option<SpaceArc> {
    let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let (u, v) = (minus(via, start), minus(end, start));
    let normal = cross(u, v);
    let (uu, vv, nn) = (dot(u, u), dot(v, v), dot(normal, normal));
    if nn <= STRAIGHT * STRAIGHT * uu * vv || uu <= 0.0 || vv <= 0.0 {
        return None;
    }
    // The centre from the start: (|u|² v − |v|² u) × n / 2|n|², turned as n is.
    let mix = [0, 1, 2].map(|i| uu * v[i] - vv * u[i]);
    let to_center = cross(mix, normal).map(|part| 0.5 * part / nn);
    let center = [0, 1, 2].map(|i| start[i] + to_center[i]);
    let out = minus(start, center);
    let length = nn.sqrt();
    let left = cross(normal, out).map(|part| part / length);
    let to_end = minus(end, center);
    let angle = dot(to_end, left).atan2(dot(to_end, out));
    let sweep_rad = if angle <= 0.0 { angle + TAU } else { angle };
    Some(SpaceArc {
        start: AxisVector::zeros(),
        end: AxisVector::zeros(),
        center,
        axes: [out, left],
        sweep_rad,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    #[test]
    fn three_points_by_hand() {
        let arc = through([0.0; 3], [10.0, 0.0, 10.0], [20.0, 0.0, 0.0]).expect("an arc");
        let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|i| (a[i] - b[i]).abs() < 1e-12);
        assert!(near(arc.center, [10.0, 0.0, 0.0]));
        assert!((arc.sweep_rad - PI).abs() < 1e-12);
        assert!(near(arc.offset(PI / 2.0, 1.0), [0.0, 0.0, 10.0]));
        // The long way round.
        let long = through([10.0, 0.0, 0.0], [-10.0, 0.0, 0.0], [0.0, -10.0, 0.0]);
        let long = long.expect("an arc");
        assert!(near(long.center, [0.0; 3]) && (long.sweep_rad - 1.5 * PI).abs() < 1e-12);
        assert!(through([0.0; 3], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0]).is_none());
    }

    #[test]
    fn every_point_of_the_curve_is_as_far_from_the_centre() {
        let mut arc = through([3.0, 1.0, 0.0], [0.0, 4.0, 2.0], [-1.0, -3.0, 5.0]).expect("an arc");
        (arc.start[0], arc.start[1]) = (3.0, 1.0);
        (arc.end[0], arc.end[1], arc.end[2]) = (-1.0, -3.0, 5.0);
        let radius = (0..3).map(|i| arc.axes[0][i].powi(2)).sum::<f64>().sqrt();
        let curve = arc.curve(|point| point).expect("a curve");
        let path = glidepath_geometry::NurbsPath::new(curve);
        assert!((path.length() - radius * arc.sweep_rad).abs() < 1e-6 * radius);
        for segment in path.segments(1e-7) {
            for share in [0.0, 0.3, 0.7, 1.0] {
                let at = segment.jet(share * segment.length()).position;
                let far = (0..3).map(|i| (at[i] - arc.center[i]).powi(2)).sum::<f64>();
                assert!((far.sqrt() - radius).abs() < 1e-6);
            }
        }
    }
}
