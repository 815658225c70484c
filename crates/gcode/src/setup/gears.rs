//! The gears of a spindle, as programs choose them: M41 for the first to M45 for the fifth.

use crate::setup::m_codes::MCodes;
use crate::syntax::dialect::Dialect;

/// The word of the first gear.
const FIRST: u32 = 41;
/// The word of the last one that a spindle can have.
const LAST: u32 = 45;
/// The gear is chosen by S from here on (SINUMERIK).
pub(crate) const BY_SPEED: u32 = 40;

/// The speeds of a gear, rev/min of the spindle, 0 ≤ `least` < `most`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearSpeeds {
    /// The lowest one.
    pub least: f64,
    /// The highest one.
    pub most: f64,
}

impl GearSpeeds {
    fn has(self, rpm: f64) -> bool {
        (self.least..=self.most).contains(&rpm)
    }
}

/// The gears of a spindle, the first one M41; none where M40 to M45 are what they are at other machines.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Gears {
    speeds: Vec<GearSpeeds>,
    is_by_speed: bool,
}

impl Gears {
    /// Most gears of a spindle.
    pub const MOST: usize = (LAST - FIRST) as usize + 1;

    /// These gears, of which S chooses one where no program says otherwise (`is_by_speed`); `None` if there are
    /// more than [`Self::MOST`].
    #[must_use]
    pub fn new(speeds: Vec<GearSpeeds>, is_by_speed: bool) -> Option<Self> {
        (speeds.len() <= Self::MOST).then_some(Self {
            speeds,
            is_by_speed,
        })
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.speeds.len()
    }

    /// The highest speed of a gear, from 1, rev/min; `None` if there is no such gear.
    #[must_use]
    pub fn most_rpm(&self, gear: u32) -> Option<f64> {
        self.speeds_of(gear).map(|speeds| speeds.most)
    }

    /// Whether S chooses the gear until a program says otherwise.
    pub(crate) fn are_by_speed(&self) -> bool {
        self.is_by_speed && !self.speeds.is_empty()
    }

    /// Has their words be codes of the machine in a language; M42 of a printer is another one.
    pub fn declare(&self, dialect: Dialect, m_codes: &mut MCodes) {
        if self.speeds.is_empty() || dialect == Dialect::Marlin {
            return;
        }
        let first = if dialect == Dialect::Siemens {
            BY_SPEED
        } else {
            FIRST
        };
        m_codes.declare(first, LAST);
    }

    /// Whether a code of the machine is one of their words in a language.
    pub(crate) fn has_word(&self, code: u32, dialect: Dialect) -> bool {
        !self.speeds.is_empty()
            && match dialect {
                Dialect::Marlin => false,
                Dialect::Siemens => (BY_SPEED..=LAST).contains(&code),
                Dialect::LinuxCnc | Dialect::Fanuc => (FIRST..=LAST).contains(&code),
            }
    }

    /// The gear of a word, from 1; `None` if the spindle does not have it.
    pub(crate) fn of_word(&self, code: u32) -> Option<u32> {
        let gear = code.checked_sub(FIRST - 1)?;
        self.speeds_of(gear).map(|_| gear)
    }

    /// The word of a gear.
    pub(crate) const fn word(gear: u32) -> u32 {
        FIRST - 1 + gear
    }

    /// The speeds of a gear, from 1.
    pub(crate) fn speeds_of(&self, gear: u32) -> Option<GearSpeeds> {
        let index = usize::try_from(gear).ok()?.checked_sub(1)?;
        self.speeds.get(index).copied()
    }

    /// The gear for a speed, rev/min: the present one if it has it, else the first that does; `None` if none
    /// does.
    pub(crate) fn for_speed(&self, rpm: f64, present: u32) -> Option<u32> {
        let stays = self
            .speeds_of(present)
            .is_some_and(|speeds| speeds.has(rpm));
        if stays {
            return Some(present);
        }
        let gears = (1..).zip(&self.speeds);
        gears
            .into_iter()
            .find_map(|(gear, speeds)| speeds.has(rpm).then_some(gear))
    }

    /// What there is, for a message: `gear 1 (M41): 20 to 800 rev/min, gear 2 (M42): ...`.
    pub(crate) fn listed(&self) -> String {
        let gears = (1..).zip(&self.speeds).map(|(gear, speeds)| {
            let GearSpeeds { least, most } = speeds;
            format!(
                "gear {gear} (M{}) {least} to {most} rev/min",
                Self::word(gear)
            )
        });
        gears.collect::<Vec<_>>().join(", ")
    }
}
