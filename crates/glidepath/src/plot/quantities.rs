//! The curves of velocity, acceleration and jerk of several positions, against their limits.

use super::colour::CURVES;
use super::envelope::Envelope;
use super::strip::Strip;
use glidepath_kinematics::JointVector;
use glidepath_program::Limits;

/// One position, of an axis or a joint, and what is drawn of it.
#[derive(Debug)]
pub(super) struct PositionCurves {
    name: String,
    index: usize,
    limits: [f64; 3],
    units: [&'static str; 3],
    curves: [Envelope; 3],
}

impl PositionCurves {
    /// The position with an index, and limits and units of its three derivatives.
    pub(super) fn new(
        name: String,
        index: usize,
        limits: [f64; 3],
        units: [&'static str; 3],
    ) -> Self {
        Self {
            name,
            index,
            limits,
            units,
            curves: [const { Envelope::new() }; 3],
        }
    }
}

/// Positions of one kind.
#[derive(Debug)]
pub(super) struct Quantities {
    drawn: Vec<PositionCurves>,
    recent: Recent,
}

impl Quantities {
    pub(super) fn new(drawn: Vec<PositionCurves>) -> Self {
        Self {
            drawn,
            recent: Recent::default(),
        }
    }

    pub(super) fn push(&mut self, tick: u64, period_t: f64, positions: &JointVector) {
        let differences = self.recent.differences(tick, positions);
        for position in &mut self.drawn {
            let mut scale = 1.0;
            for (curve, difference) in position.curves.iter_mut().zip(&differences) {
                scale /= period_t;
                if let Some(difference) = difference {
                    curve.push(tick, difference[position.index] * scale);
                }
            }
        }
    }

    /// What is drawn of those that move.
    pub(super) fn strips(&self) -> impl Iterator<Item = Strip<'_>> {
        let moving =
            |position: &&PositionCurves| position.curves.iter().any(|curve| curve.peak() > 0.0);
        self.drawn.iter().filter(moving).flat_map(|position| {
            let names = ["velocity", "acceleration", "jerk"];
            position
                .curves
                .iter()
                .enumerate()
                .map(move |(k, curve)| Strip {
                    title: format!("{} {}", position.name, names[k]),
                    unit: position.units[k],
                    colour: CURVES[k],
                    curve,
                    limit: Some(position.limits[k]).filter(|limit| *limit < Limits::UNLIMITED),
                    band: None,
                    signed: true,
                })
        })
    }
}

/// The samples finite differences are made of. Before the first the machine is at rest.
#[derive(Debug, Default)]
struct Recent {
    last_tick: u64,
    /// The last three positions, newest first; fewer after a gap.
    positions: Vec<JointVector>,
}

impl Recent {
    /// First, second and third difference of the positions, as far as there are enough of them.
    fn differences(&mut self, tick: u64, position: &JointVector) -> [Option<JointVector>; 3] {
        if self.positions.is_empty() {
            self.positions = vec![*position; 3];
        } else if tick != self.last_tick + 1 {
            self.positions.clear();
        }
        self.last_tick = tick;
        let known = &self.positions;
        let first = known.first().map(|a| position - a);
        let second = known.get(1).map(|b| position - 2.0 * known[0] + b);
        let third = known
            .get(2)
            .map(|c| position - 3.0 * known[0] + 3.0 * known[1] - c);
        self.positions.insert(0, *position);
        self.positions.truncate(3);
        [first, second, third]
    }
}
