//! The settings of a superposition: which axis it moves, how far and how fast, and by what.

use glidepath_geometry::Axis;

/// What moves the axis, and the meaning of what it says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SuperpositionControl {
    /// A velocity of the offset: the input is controlled to its target (the voltage of an arc).
    Velocity,
    /// The offset itself (a follower that touches).
    Offset,
    /// No input, but a handwheel, or a program that demands as one does: the offset goes on by what it turns.
    Wheel,
}

/// The superposition: an input moves an axis in addition to the program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Superposition {
    /// The axis.
    pub axis: Axis,
    /// The velocity of the offset at most, mm/s or °/s, > 0.
    pub velocity: f64,
    /// Its acceleration at most, > 0.
    pub acceleration: f64,
    /// Its jerk at most, > 0.
    pub jerk: f64,
    /// The offset at least and at most, mm or degrees; 0 is between the two.
    pub range: [f64; 2],
    /// The analog input of feedback, 0 to 7.
    pub input: u8,
    /// What it says.
    pub control: SuperpositionControl,
    /// The value of the input at which nothing is to move, or at which the offset is 0.
    pub target: f64,
    /// Velocity or offset for each unit that the input is above the target.
    pub gain: f64,
    /// How far the input may be from the target without effect, ≥ 0.
    pub dead_band: f64,
    /// The digital output of the program that switches it on; `None`: it is on.
    pub switch: Option<u32>,
    /// The digital input that has to be on, and its level then.
    pub enable: Option<(u8, bool)>,
    /// The part of the programmed feed below which the offset stands still, 0 to 1.
    pub freeze_below: f64,
    /// How long it stands still behind that, s.
    pub freeze_for_t: f64,
    /// Switched off, the axis goes back to the program; if not, it keeps its offset until the program ends.
    pub returns: bool,
}

impl Superposition {
    /// What the input asks for: a velocity or an offset.
    pub(crate) fn wanted(&self, value: f64) -> f64 {
        let beside = value - self.target;
        let beyond = (beside.abs() - self.dead_band).max(0.0).copysign(beside);
        self.gain * beyond
    }
}
