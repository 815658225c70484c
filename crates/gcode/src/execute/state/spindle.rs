//! The spindle as the program has commanded it: direction, speed, and what S means.

use serde::{Deserialize, Serialize};

/// Which way the spindle turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum SpindleDirection {
    /// M3.
    Clockwise,
    /// M4.
    Counterclockwise,
}

impl SpindleDirection {
    /// The M code that turns it this way.
    pub(crate) const fn code(self) -> u32 {
        match self {
            Self::Clockwise => 3,
            Self::Counterclockwise => 4,
        }
    }

    pub(crate) const fn reversed(self) -> Self {
        match self {
            Self::Clockwise => Self::Counterclockwise,
            Self::Counterclockwise => Self::Clockwise,
        }
    }
}

/// State of the spindle.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Spindle {
    /// Which way the program has it turn.
    pub(crate) turning: Option<SpindleDirection>,
    /// It was told to stand since it turned last, by the program or for a tap, and so is an axis
    /// where it can be one.
    pub(crate) is_axis: bool,
    /// Speed told last, rev/min; zero until there is an S word.
    pub(crate) speed: f64,
    pub(crate) surface: Option<Surface>,
    /// Most revolutions a minute of G96 from here on (G50 S, LIMS).
    pub(crate) most: Option<f64>,
    /// S of G97, rev/min, as it was written.
    #[serde(default)]
    pub(crate) asked: f64,
    /// The limit holds for the revolutions of G97, too (SINUMERIK).
    #[serde(default)]
    pub(crate) is_limited: bool,
    /// Most revolutions a minute at all times (G26 of SINUMERIK).
    #[serde(default)]
    pub(crate) upper: Option<f64>,
    /// Fewest revolutions a minute of a spindle that turns (G25 of SINUMERIK).
    #[serde(default)]
    pub(crate) lower: Option<f64>,
    /// The gear that was put in last, from 1; 0: nothing was said of it.
    #[serde(default)]
    pub(crate) gear: u32,
    /// S chooses the gear (M40 of SINUMERIK, or the machine's own choice).
    #[serde(default)]
    pub(crate) chooses_gear: bool,
    /// M5 stopped it, and nothing that may start it came behind.
    #[serde(default)]
    pub(crate) is_stopped: bool,
    /// The next tapping cycle is rigid (M29).
    pub(crate) is_rigid: bool,
}

/// G96.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Surface {
    /// Cutting speed, mm/min; zero until there is an S word.
    pub(crate) speed: f64,
    /// Most revolutions a minute.
    pub(crate) most: f64,
}

impl Spindle {
    /// G96 is in force: the speed depends on where the tool is.
    pub(crate) const fn follows_tool(&self) -> bool {
        self.surface.is_some()
    }

    /// The revolutions of G97, no more than its limit allows.
    pub(crate) fn allowed(&self) -> f64 {
        let most = self.most.filter(|_| self.is_limited);
        self.in_range(most.map_or(self.asked, |most| self.asked.min(most)))
    }

    /// A speed above zero within the range of G25 and G26.
    pub(crate) fn in_range(&self, speed: f64) -> f64 {
        if speed <= 0.0 {
            return speed;
        }
        let raised = self.lower.map_or(speed, |lower| speed.max(lower));
        self.upper.map_or(raised, |upper| raised.min(upper))
    }

    /// It stands for taps alone, and is to turn again behind them.
    pub(crate) const fn stands_for_tap(&self) -> bool {
        self.is_axis && self.turning.is_some()
    }
}
