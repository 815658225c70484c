//! The settings of the gears between the motor of a spindle and the spindle.

/// Gears of a spindle, as many as programs have words for.
pub const MOST_GEARS: usize = 5;

/// A gear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gear {
    /// Turns of the motor in a turn of the spindle, > 0.
    pub ratio: f64,
    /// The spindle turns the other way in it.
    pub is_inverted: bool,
    /// The highest speed of the spindle, rev/min, > 0.
    pub max_rpm: f64,
    /// How fast the speed of the spindle changes, rev/min in a second, > 0.
    pub ramp_rpm_per_s: f64,
    /// The digital input that says that it is in, 0 to 63.
    pub input: usize,
}

/// The motor turns to and fro while gears are changed, so that teeth find their gaps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing {
    /// Its speed, rev/min of the motor, > 0.
    pub rpm: f64,
    /// How long it turns one way, ns, > 0.
    pub way_ns: u64,
}

/// The gears of a spindle, and how they are changed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearSettings {
    /// Those that there are, the first one M41.
    pub gears: [Option<Gear>; MOST_GEARS],
    /// How the motor turns meanwhile; `None`: it stands without power.
    pub swing: Option<Swing>,
    /// How long a gear may take to be in, ns.
    pub within_ns: u64,
}

impl GearSettings {
    /// A gear by its number, from 1.
    #[must_use]
    pub fn of(&self, number: u32) -> Option<&Gear> {
        let index = usize::try_from(number).ok()?.checked_sub(1)?;
        self.gears.get(index)?.as_ref()
    }

    /// All of them, with their numbers.
    pub fn all(&self) -> impl Iterator<Item = (u32, &Gear)> {
        let numbered = (1..).zip(&self.gears);
        numbered.filter_map(|(number, gear)| Some((number, gear.as_ref()?)))
    }

    /// The one in which the spindle turns fastest.
    pub(super) fn fastest(&self) -> Option<&Gear> {
        let gears = self.gears.iter().flatten();
        gears.min_by(|a, b| a.ratio.total_cmp(&b.ratio))
    }
}
