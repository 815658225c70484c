//! The M-code waits of a machine: which M codes are waited for, and what ends the wait.

use core::time::Duration;
use glidepath_link::{Auxiliary, Setpoint, SetpointFrame, SpindleFlags};
use glidepath_program::{CodeWord, Event};

/// Most rules of a machine.
pub const MAX_M_CODE_WAITS: usize = 32;

/// Most events that are told and not yet awaited. Of more the oldest is answered at its wait alone.
pub(crate) const MOST_TOLD: usize = 4;

/// The source of the answer that what an M code asked for is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AnswerSource {
    /// Nobody: it is not waited for.
    Nobody,
    /// Somebody does, by [`glidepath_link::Command::Acknowledge`].
    Acknowledgement,
    /// The spindle turns as fast as it was told to, by feedback.
    SpindleAtSpeed,
    /// The spindle stands, by feedback.
    SpindleStopped,
    /// The spindle stands at its angle, by feedback.
    SpindleOriented,
    /// The gear that the spindle was told is in, by feedback.
    SpindleInGear,
    /// A digital input, 0 to 63, by feedback.
    Input {
        /// Its number.
        number: u8,
        /// What it is to be.
        high: bool,
    },
    /// The planner, by going on: it asked an input what the program is to do (M66).
    Planner,
    /// The interpolator itself: the spindle is at its speed, and at the angle at which a pass of a
    /// thread begins.
    SpindleAngle,
}

impl AnswerSource {
    /// Whether it takes the feedback of drives.
    #[must_use]
    pub const fn needs_feedback(self) -> bool {
        !matches!(
            self,
            Self::Nobody | Self::Acknowledgement | Self::Planner | Self::SpindleAngle
        )
    }

    /// Whether inputs and the spindle say that it is done.
    pub(crate) const fn is_given(self, digital_in: u64, spindle: SpindleFlags) -> bool {
        match self {
            Self::Nobody => true,
            Self::Acknowledgement | Self::Planner | Self::SpindleAngle => false,
            Self::SpindleAtSpeed => spindle.contains(SpindleFlags::AT_SPEED),
            Self::SpindleStopped => spindle.contains(SpindleFlags::STOPPED),
            Self::SpindleOriented => spindle.contains(SpindleFlags::ORIENTED),
            Self::SpindleInGear => spindle.contains(SpindleFlags::IN_GEAR),
            Self::Input { number, high } => (digital_in >> (number & 63) & 1 == 1) == high,
        }
    }
}

/// How long a pass of a thread waits for its spindle.
const SPINDLE_PATIENCE: Duration = Duration::from_secs(60);
/// What a pass of a thread begins with.
const PASS: MCodeWait = MCodeWait {
    first: 0,
    last: 0,
    answer: AnswerSource::SpindleAngle,
    within: Some(SPINDLE_PATIENCE),
    is_late: false,
};

/// The motion does not pass some M codes before they are answered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MCodeWait {
    /// The first M code that this is about.
    pub first: u32,
    /// The last one.
    pub last: u32,
    /// What ends the wait.
    pub answer: AnswerSource,
    /// How long it may take; longer is a fault. `None`: for ever.
    pub within: Option<Duration>,
    /// The motion goes on at the code, and waits where the program says so later
    /// ([`Event::Await`]).
    pub is_late: bool,
}

/// The M code at which the spindle is to stand at an angle; its Q word is how long that may take, s.
pub(crate) const ORIENTED: u32 = 19;

impl MCodeWait {
    /// The same wait for a code, as long as the code's own Q word says where that is a time.
    #[must_use]
    pub(crate) fn or_within(self, code: u32, q: Option<f64>) -> Self {
        let of_word = q.filter(|_| code == ORIENTED);
        let own = of_word.and_then(|q| Duration::try_from_secs_f64(q).ok());
        Self {
            within: own.or(self.within),
            ..self
        }
    }
}

/// All M codes that are waited for. A code that several rules are about obeys the first of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct MCodeWaits {
    rules: [Option<MCodeWait>; MAX_M_CODE_WAITS],
}

impl MCodeWaits {
    /// Nothing waits.
    pub const NONE: Self = Self {
        rules: [None; MAX_M_CODE_WAITS],
    };

    /// The waits of these rules; `None` if there are more than [`MAX_M_CODE_WAITS`].
    #[must_use]
    pub fn new(rules: &[MCodeWait]) -> Option<Self> {
        let mut m_code_waits = Self::NONE;
        if rules.len() > MAX_M_CODE_WAITS {
            return None;
        }
        for (to, rule) in m_code_waits.rules.iter_mut().zip(rules) {
            *to = Some(*rule);
        }
        Some(m_code_waits)
    }

    /// The rule for an M code.
    #[must_use]
    pub fn of(&self, code: u32) -> Option<MCodeWait> {
        let rules = self.rules.iter().map_while(|rule| *rule);
        rules
            .into_iter()
            .find(|rule| (rule.first..=rule.last).contains(&code))
            .filter(|rule| rule.answer != AnswerSource::Nobody)
    }

    /// The rule for the event at rest of a frame, if the motion does not pass it.
    #[must_use]
    pub fn of_frame(&self, frame: &SetpointFrame) -> Option<MCodeWait> {
        if frame.event_count == 0 {
            return None;
        }
        match frame.event() {
            Ok(Some(Event::MCode(code))) => {
                self.of(code).filter(|m_code_wait| !m_code_wait.is_late)
            }
            Ok(Some(Event::Await(code))) => self.of(code).filter(|m_code_wait| m_code_wait.is_late),
            Ok(Some(Event::Synchronise { .. } | Event::Tap { .. })) => Some(PASS),
            _ => None,
        }
    }

    /// The rule for the event of a setpoint, if that is an M code that is waited for later.
    pub(crate) fn late(&self, setpoint: &Setpoint) -> Option<MCodeWait> {
        if setpoint.event_count == 0 {
            return None;
        }
        match setpoint.event() {
            Ok(Some(Event::MCode(code))) => self.of(code).filter(|m_code_wait| m_code_wait.is_late),
            _ => None,
        }
    }

    /// The longest that is waited for an event, as a record has it: ns of `CLOCK_MONOTONIC`.
    pub(crate) fn deadline_ns(&self, auxiliary: &Auxiliary, since_ns: u64) -> u64 {
        let within = match auxiliary.awaited_event() {
            Ok(Some(Event::MCode(code) | Event::Await(code))) => {
                let q = auxiliary.awaited_words.get(CodeWord::Q);
                let m_code_wait = self.of(code);
                m_code_wait.and_then(|m_code_wait| m_code_wait.or_within(code, q).within)
            }
            _ => None,
        };
        within.map_or(0, |within| {
            since_ns.saturating_add(u64::try_from(within.as_nanos()).unwrap_or(u64::MAX))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_rule_of_a_code_counts() {
        let m_code_wait = |first, last, answer| MCodeWait {
            first,
            last,
            answer,
            within: None,
            is_late: false,
        };
        let spindle = m_code_wait(3, 4, AnswerSource::SpindleAtSpeed);
        let exception = m_code_wait(120, 120, AnswerSource::SpindleStopped);
        let told = m_code_wait(122, 122, AnswerSource::Nobody);
        let users = m_code_wait(100, 199, AnswerSource::Acknowledgement);
        let m_code_waits = MCodeWaits::new(&[spindle, exception, told, users]).unwrap();
        assert_eq!(m_code_waits.of(4), Some(spindle));
        assert_eq!(m_code_waits.of(120), Some(exception));
        assert_eq!(m_code_waits.of(121), Some(users));
        assert_eq!(
            (
                m_code_waits.of(5),
                m_code_waits.of(200),
                m_code_waits.of(122)
            ),
            (None, None, None)
        );
        assert!(MCodeWaits::new(&[users; MAX_M_CODE_WAITS + 1]).is_none());
    }

    #[test]
    fn feedback_answers() {
        let high = AnswerSource::Input {
            number: 3,
            high: true,
        };
        let low = AnswerSource::Input {
            number: 3,
            high: false,
        };
        let quiet = SpindleFlags::default();
        assert!(high.is_given(0b1000, quiet) && !low.is_given(0b1000, quiet));
        assert!(!high.is_given(0b0111, quiet) && low.is_given(0b0111, quiet));
        assert!(AnswerSource::SpindleAtSpeed.is_given(0, SpindleFlags::AT_SPEED));
        assert!(!AnswerSource::SpindleAtSpeed.is_given(u64::MAX, SpindleFlags::STOPPED));
        assert!(AnswerSource::SpindleInGear.is_given(0, SpindleFlags::IN_GEAR));
        assert!(!AnswerSource::SpindleInGear.is_given(u64::MAX, SpindleFlags::STOPPED));
        assert!(!AnswerSource::Acknowledgement.is_given(u64::MAX, SpindleFlags::STOPPED));
    }
}
