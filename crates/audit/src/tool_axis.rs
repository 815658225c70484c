//! The direction of the tool on the work, from the rotary axes: closed forms of the auditor's own.
//!
//! ```text
//!   d = R₁(α₁) … Rₙ(αₙ) ẑ        Rᵢ turns about a direction of the machine, αᵢ is the angle of a rotary axis
//! ```

use glidepath_geometry::{Axis, AxisVector};

/// Degrees of a radian.
const DEG: f64 = 180.0 / core::f64::consts::PI;

/// Most turns.
const TURNS: usize = 3;

/// A turn of the tool against the work.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisTurn {
    /// The axis whose angle it is.
    pub axis: Axis,
    /// What it turns about, right-handed with rising angles; of length 1.
    pub about: [f64; 3],
}

/// How the rotary axes turn the tool against the work.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToolAxis {
    turns: [Option<AxisTurn>; TURNS],
    /// The angles themselves are judged, too.
    pub(crate) are_axes_judged: bool,
}

impl ToolAxis {
    /// The turns from the work to the tool, three at most: the last one turns the tool first.
    #[must_use]
    pub fn new(turns: &[AxisTurn]) -> Self {
        let mut all = [None; TURNS];
        for (slot, turn) in all.iter_mut().zip(turns) {
            *slot = Some(*turn);
        }
        Self {
            turns: all,
            are_axes_judged: false,
        }
    }

    /// The same where all angles count, and not only the direction that comes of them: where the tool is turned about
    /// itself, too.
    #[must_use]
    pub const fn with_axes(self) -> Self {
        Self {
            are_axes_judged: true,
            ..self
        }
    }

    /// The direction from the tip to the spindle, of length 1.
    #[must_use]
    pub fn direction(&self, position: &AxisVector) -> [f64; 3] {
        self.turned(position, 1.0)
    }

    /// The same, degrees long: how far two of them are apart is, for small angles, the angle between them in degrees.
    pub(crate) fn way_deg(&self, position: &AxisVector) -> [f64; 3] {
        self.turned(position, DEG)
    }

    fn turned(&self, position: &AxisVector, length: f64) -> [f64; 3] {
        let mut way = [0.0, 0.0, length];
        for turn in self.turns.iter().rev().flatten() {
            way = turned(way, turn.about, position[turn.axis.index()].to_radians());
        }
        way
    }

    /// How the direction bends at most while the axes go straight from one place to another.
    ///
    /// With rates rᵢ of the angles and sᵢ the sine of the angle between what axis i turns about and what it turns, the
    /// second derivative is no more than Σ rᵢ² sᵢ + 2 Σ rᵢ rⱼ sⱼ over i < j. A turn about the tool itself is none.
    pub(crate) fn turn(&self, from: &AxisVector, to: &AxisVector) -> Turn {
        let mut ways = [[0.0, 0.0, 1.0]; 2];
        // Of the turns behind: the sum of their angles, and of their angles by their sines.
        let (mut behind, mut behind_s) = (0.0, 0.0);
        let mut bend = 0.0;
        let mut across = core::f64::consts::PI;
        for turn in self.turns.iter().rev().flatten() {
            let i = turn.axis.index();
            let by = (to[i] - from[i]).to_radians().abs();
            let leans = range(ways.map(|way| angle(way, turn.about)), behind);
            let sine = most_sine(leans);
            across = 2.0 * leans[1];
            bend += by * by * sine + 2.0 * by * behind_s;
            behind_s += by * sine;
            behind += by;
            for (way, at) in ways.iter_mut().zip([from, to]) {
                *way = turned(*way, turn.about, at[i].to_radians());
            }
        }
        let span = behind_s.min(across);
        Turn { bend, span }
    }
}

/// How the direction of the tool bends along a move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Turn {
    /// Most of its second derivative over the move, rad.
    pub(crate) bend: f64,
    /// How far two directions of the move are apart at most, rad.
    pub(crate) span: f64,
}

impl Turn {
    /// Of a tool that nobody knows.
    pub(crate) const NONE: Self = Self {
        bend: 0.0,
        span: 0.0,
    };

    pub(crate) fn span_deg(&self) -> f64 {
        self.span * DEG
    }

    /// How far so many chords are from it at most, degrees: b/8n² of a radian, and no more than all of it.
    pub(crate) fn flattened_deg(&self, chords: f64) -> f64 {
        DEG * (self.bend / (8.0 * chords * chords)).min(self.span)
    }

    /// How many chords are no further from it than that, degrees.
    pub(crate) fn chords(&self, allowed_deg: f64) -> f64 {
        (self.bend * DEG / (8.0 * allowed_deg)).sqrt()
    }
}

fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let dot: f64 = (0..3).map(|i| a[i] * b[i]).sum();
    let cross = [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ];
    cross[0].hypot(cross[1]).hypot(cross[2]).atan2(dot)
}

/// Where an angle may be on its way from one to another, no longer than `way`, rad.
fn range(ends: [f64; 2], way: f64) -> [f64; 2] {
    let (sum, way) = (ends[0] + ends[1], way.max((ends[1] - ends[0]).abs()));
    [0.5 * (sum - way), 0.5 * (sum + way)]
}

/// The largest sine in a range of angles: below 0 and beyond half a round it comes back.
fn most_sine([low, high]: [f64; 2]) -> f64 {
    let right = core::f64::consts::FRAC_PI_2;
    if low <= right && right <= high {
        1.0
    } else {
        low.sin().abs().max(high.sin().abs())
    }
}

/// A vector turned about a direction (Rodrigues): v cos α + k × v sin α + k (k·v)(1 − cos α).
fn turned(v: [f64; 3], k: [f64; 3], angle_rad: f64) -> [f64; 3] {
    let (sin, cos) = angle_rad.sin_cos();
    let dot = k[0] * v[0] + k[1] * v[1] + k[2] * v[2];
    let cross = [
        k[1] * v[2] - k[2] * v[1],
        k[2] * v[0] - k[0] * v[2],
        k[0] * v[1] - k[1] * v[0],
    ];
    core::array::from_fn(|i| v[i] * cos + cross[i] * sin + k[i] * dot * (1.0 - cos))
}

/// How far a chord between two directions dips below the sphere, degrees: r − √(r² − c²/4). It is no change of
/// direction.
pub(crate) fn dip_deg(ends: &[[f64; 3]; 2]) -> f64 {
    let half_2: f64 = (0..3)
        .map(|i| (0.5 * (ends[1][i] - ends[0][i])).powi(2))
        .sum();
    // Written so that small ones keep their digits.
    half_2 / (DEG + (DEG * DEG - half_2).max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tool_that_leans_and_turns() {
        // C turns what A has leaned: z leans by A to -y, and C takes it round.
        let turn = |axis, about| AxisTurn { axis, about };
        let tool = ToolAxis::new(&[
            turn(Axis::C, [0.0, 0.0, 1.0]),
            turn(Axis::A, [1.0, 0.0, 0.0]),
        ]);
        let mut at = AxisVector::zeros();
        (at[Axis::A.index()], at[Axis::C.index()]) = (30.0, 90.0);
        let way = tool.way_deg(&at).map(|x| x / DEG);
        let wanted = [0.5, 0.0, 0.75_f64.sqrt()];
        for (is, wanted) in way.into_iter().zip(wanted) {
            assert!((is - wanted).abs() < 1e-12, "{way:?}");
        }
    }

    /// Against differences of the directions themselves.
    #[test]
    fn no_move_bends_more() {
        let turn = |axis, about| AxisTurn { axis, about };
        let skewed = [0.0, 0.5_f64.sqrt(), 0.5_f64.sqrt()];
        let tools = [
            ToolAxis::new(&[
                turn(Axis::C, [0.0, 0.0, 1.0]),
                turn(Axis::A, [1.0, 0.0, 0.0]),
            ]),
            ToolAxis::new(&[turn(Axis::C, [0.0, 0.0, 1.0]), turn(Axis::B, skewed)]),
            ToolAxis::new(&[
                turn(Axis::C, [0.0, 0.0, 1.0]),
                turn(Axis::B, [0.0, 1.0, 0.0]),
                turn(Axis::A, [1.0, 0.0, 0.0]),
            ]),
        ];
        let place = |a, b, c| {
            let mut at = AxisVector::zeros();
            for (axis, angle) in [(Axis::A, a), (Axis::B, b), (Axis::C, c)] {
                at[axis.index()] = angle;
            }
            at
        };
        let places = [
            place(0.0, 0.0, 0.0),
            place(0.0, 0.0, 3000.0),
            place(0.01, 0.02, 90.0),
            place(30.0, -20.0, 10.0),
            place(-80.0, 120.0, 200.0),
        ];
        for tool in tools {
            for (from, to) in places
                .iter()
                .flat_map(|a| places.iter().map(move |b| (a, b)))
            {
                let Turn { bend, span } = tool.turn(from, to);
                let at = |t: f64| tool.direction(&(from + (to - from) * t));
                let h = 1e-4;
                for k in 1..1000 {
                    let t = f64::from(k) / 1000.0;
                    let [a, b, c] = [at(t - h), at(t), at(t + h)];
                    assert!(angle(at(0.0), b) <= span + 1e-9, "{from} {to}");
                    let second = [0, 1, 2].map(|i| (a[i] - 2.0 * b[i] + c[i]) / (h * h));
                    let most = second[0].hypot(second[1]).hypot(second[2]);
                    assert!(
                        most <= bend * (1.0 + 1e-6) + 1e-5,
                        "{from} {to} {most} {bend}"
                    );
                }
            }
        }
        // A turn about the tool is none.
        assert!(tools[0].turn(&places[0], &places[1]).bend < 1e-12);
    }

    #[test]
    fn a_chord_dips_by_its_sagitta() {
        let at = |deg: f64| turned([0.0, 0.0, DEG], [1.0, 0.0, 0.0], deg.to_radians());
        let ends = [at(0.0), at(2.0)];
        let sagitta = DEG * (1.0 - 1.0_f64.to_radians().cos());
        assert!((dip_deg(&ends) - sagitta).abs() < 1e-9 * sagitta);
        // Two degrees in so many chords that each dips by a thousandth.
        let bend = 2.0_f64.to_radians().powi(2);
        let span = 2.0_f64.to_radians();
        let parts = Turn { bend, span }.chords(1e-3);
        let part = DEG * (1.0 - (1.0 / parts).to_radians().cos());
        assert!((part - 1e-3).abs() < 1e-6, "{part}");
    }
}
