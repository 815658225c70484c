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
}

impl ToolAxis {
    /// The turns from the work to the tool, three at most: the last one turns the tool first.
    #[must_use]
    pub fn new(turns: &[AxisTurn]) -> Self {
        let mut all = [None; TURNS];
        for (slot, turn) in all.iter_mut().zip(turns) {
            *slot = Some(*turn);
        }
        Self { turns: all }
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

    /// By how many degrees the tool turns at most while the axes go straight from one place to another.
    pub(crate) fn turn_deg(&self, along: &AxisVector) -> f64 {
        let turns = self.turns.iter().flatten();
        turns.map(|turn| along[turn.axis.index()].abs()).sum()
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

/// How many chords keep a turn by so many degrees in all within a share of a tolerance, degrees: φ²/8n² of a radian.
pub(crate) fn chords(turn_deg: f64, allowed_deg: f64) -> f64 {
    turn_deg * (1.0 / (8.0 * DEG * allowed_deg)).sqrt()
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
        assert!((tool.turn_deg(&at) - 120.0).abs() < 1e-12);
    }

    #[test]
    fn a_chord_dips_by_its_sagitta() {
        let at = |deg: f64| turned([0.0, 0.0, DEG], [1.0, 0.0, 0.0], deg.to_radians());
        let ends = [at(0.0), at(2.0)];
        let sagitta = DEG * (1.0 - 1.0_f64.to_radians().cos());
        assert!((dip_deg(&ends) - sagitta).abs() < 1e-9 * sagitta);
        // Two degrees in so many chords that each dips by a thousandth.
        let parts = chords(2.0, 1e-3);
        let part = DEG * (1.0 - (1.0 / parts).to_radians().cos());
        assert!((part - 1e-3).abs() < 1e-6, "{part}");
    }
}
