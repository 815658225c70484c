//! A pass of a thread: when it begins, where it is to be, and whether the spindle still makes sense.

use super::lead::Lead;
use super::seen::SpindleSeen;
use crate::shared::message::observation::Turn;
use glidepath_link::FaultCause;
use glidepath_program::PHASE_STEPS;

/// The slowest and the fastest that the spindle may turn in a pass, in parts of the speed at which
/// program time passes at rate 1. That is 1.1 times the programmed speed, so this is 50 % and 109 %
/// of it.
const SLOWEST: f64 = 0.5 / 1.1;
const FASTEST: f64 = 1.09 / 1.1;
/// How far the axes may be from where the spindle is, in revolutions.
const FARTHEST: f64 = 0.02;
/// How many index pulses may be missing or too many.
const INDEX_SLACK: f64 = 1.1;

/// A pass under way.
#[derive(Debug, Clone, Copy)]
struct Following {
    lead: Lead,
    /// 1 if the spindle turns forwards, −1 if backwards.
    direction: f64,
    /// The angle, in that direction, at which program time is at the start.
    origin: f64,
    /// Index pulses when it began, and the angle then.
    index: Option<(u64, f64)>,
}

#[derive(Debug, Clone, Copy, Default)]
#[allow(clippy::large_enum_variant, reason = "there is one of them")]
enum State {
    #[default]
    None,
    /// The motion stands at the event.
    Waiting(Option<Lead>),
    Following(Following),
}

/// Where program time is to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Follow {
    /// Periods after the start.
    pub(crate) elapsed: f64,
    /// How many of them pass in a tick.
    pub(crate) step: f64,
    /// The frame that the pass sets out from.
    pub(crate) start: u64,
    /// Revolutions of the spindle in a period at rate 1.
    pub(crate) turns: f64,
}

/// A pass of a thread, if there is one.
#[derive(Debug, Default)]
pub(crate) struct Pass {
    state: State,
}

impl Pass {
    /// Whether the motion follows the spindle, or is about to.
    pub(crate) const fn is_in_use(&self) -> bool {
        !matches!(self.state, State::None)
    }

    pub(crate) const fn is_following(&self) -> bool {
        matches!(self.state, State::Following(_))
    }

    /// The motion stands at the beginning of a pass.
    pub(crate) fn wait(&mut self) {
        self.state = State::Waiting(None);
    }

    /// There is no pass any more.
    pub(crate) const fn end(&mut self) {
        self.state = State::None;
    }

    /// What the frames say of the pass that is waited for, once that was found.
    pub(crate) const fn lead(&self) -> Option<Lead> {
        match self.state {
            State::Waiting(lead) => lead,
            State::None | State::Following(_) => None,
        }
    }

    pub(crate) const fn keep_lead(&mut self, lead: Lead) {
        self.state = State::Waiting(Some(lead));
    }

    /// Where program time is to be at `at_ns` if the pass begins by then, in the period of so many
    /// ns that ends there. `phase` is as in [`glidepath_program::Event::Synchronise`].
    pub(crate) fn begins(
        &self,
        seen: &SpindleSeen,
        phase: u32,
        at_ns: u64,
        period_ns: u64,
    ) -> Option<(Follow, Begun)> {
        let lead = self.lead()?;
        if !seen.is_ready(at_ns, period_ns) {
            return None;
        }
        let turn = &seen.turn;
        let (angle, speed) = turn.at(at_ns);
        if !(SLOWEST..=FASTEST).contains(&(speed.abs() / lead.rate_v)) {
            return None;
        }
        let direction = 1.0_f64.copysign(speed);
        let first = f64::from(phase) / f64::from(PHASE_STEPS) - lead.lag;
        let passed = (direction * angle - first).rem_euclid(1.0);
        let period_t = seconds(period_ns);
        if passed >= speed.abs() * period_t {
            return None;
        }
        let turns = lead.rate_v * period_t;
        let follow = Follow {
            elapsed: passed / turns,
            step: speed.abs() / lead.rate_v,
            start: lead.start,
            turns,
        };
        let index = turn.index_count.map(|count| (count, turn.angle));
        let begun = Following {
            lead,
            direction,
            origin: direction * angle - passed,
            index,
        };
        Some((follow, Begun(begun)))
    }

    /// The pass begins.
    pub(crate) const fn begin(&mut self, begun: Begun) {
        self.state = State::Following(begun.0);
    }

    /// Where program time is to be at `at_ns`, from `now_ns` on.
    ///
    /// # Errors
    /// The spindle cannot be followed any more.
    pub(crate) fn follow(
        &self,
        seen: &SpindleSeen,
        now_ns: u64,
        at_ns: u64,
    ) -> Result<Follow, FaultCause> {
        let State::Following(following) = &self.state else {
            return Err(FaultCause::ThreadLost);
        };
        let Following {
            lead,
            direction,
            origin,
            index,
        } = following;
        let period_ns = at_ns.saturating_sub(now_ns);
        let turn = &seen.turn;
        if !seen.is_known(now_ns, period_ns) || !counts_fit(*index, turn) {
            return Err(FaultCause::SpindleAngle);
        }
        let (angle, speed) = turn.at(at_ns);
        let rate = direction * speed / lead.rate_v;
        if !(SLOWEST..=FASTEST).contains(&rate) {
            return Err(FaultCause::SpindleSpeed);
        }
        let turns = lead.rate_v * seconds(period_ns);
        Ok(Follow {
            elapsed: (direction * angle - origin) / turns,
            step: rate,
            start: lead.start,
            turns,
        })
    }
}

impl Follow {
    /// Whether the axes are so far behind or ahead of the spindle that it is no thread any more,
    /// so many periods after the start.
    pub(crate) fn is_lost(&self, elapsed: f64) -> bool {
        (self.elapsed - elapsed).abs() * self.turns > FARTHEST
    }
}

/// A pass that may begin.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Begun(Following);

/// Whether as many index pulses came as there were revolutions.
fn counts_fit(begun: Option<(u64, f64)>, turn: &Turn) -> bool {
    match (begun, turn.index_count) {
        (Some((count, angle)), Some(now)) => {
            #[allow(clippy::cast_precision_loss, reason = "pulses of a pass")]
            let pulses = now.saturating_sub(count) as f64;
            ((turn.angle - angle).abs() - pulses).abs() <= INDEX_SLACK
        }
        (Some(_), None) => false,
        (None, _) => true,
    }
}

#[allow(clippy::cast_precision_loss, reason = "a period")]
fn seconds(ns: u64) -> f64 {
    ns as f64 * 1e-9
}
