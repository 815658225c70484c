//! The steps that pages ask for: begun in their order, and each told by its own end.

use super::super::gesture::SILENCE;
use super::super::step::{Seen, Step, why_not};
use super::super::steps::StepEnd;
use super::{Hands, OLD_NS, ns_of};
use crate::command::jog::positions;
use glidepath_geometry::AXES;
use glidepath_link::{JogMode, LinkError, Record as _, Status};
use glidepath_realtime::{Clock as _, Monotonic};
use std::time::{Duration, Instant};

/// How long a step is said again: the interpolator may just have learnt of this client.
const STEP_SAID: Duration = Duration::from_millis(200);
/// How long a step waits for the one before to set out: on a busy host some statuses.
const WAITS: Duration = Duration::from_millis(500);
/// Steps that wait for the one before to set out.
const MOST_WAITING: usize = 8;

impl Hands<'_> {
    pub(super) fn step(
        &mut self,
        number: Option<u64>,
        (by, most_v): ([f64; AXES], f64),
        at: Instant,
    ) -> Result<(), LinkError> {
        let is_late = at.elapsed() > SILENCE;
        let Some(number) = number else {
            if self.gesture.is_some() || is_late {
                return Ok(());
            }
            return self.say(by, most_v, at);
        };
        let why = if self.gesture.is_some() {
            "a finger moves the axes"
        } else if is_late {
            "it came late, and does not count"
        } else if self.waiting.len() >= MOST_WAITING {
            "too many steps are asked for at once"
        } else {
            self.waiting.push_back((number, by, most_v, at));
            return self.begin_waiting();
        };
        self.steps.end(number, StepEnd::Not(why.to_owned()));
        Ok(())
    }

    /// Begins the steps that can be begun now. One that comes before the last was seen to set out waits for that: else
    /// the last might be missed, and would be told by this one's result.
    pub(super) fn begin_waiting(&mut self) -> Result<(), LinkError> {
        self.hear()?;
        let Some(status) = self.status else {
            return Ok(());
        };
        while self.told.as_ref().is_none_or(Step::takes_more) {
            let Some((number, by, most_v, at)) = self.waiting.pop_front() else {
                break;
            };
            let now = Instant::now();
            if let Some(mut step) = self.told.take() {
                self.say(by, most_v, at)?;
                step.add(number, self.demands.asked(), &by, now);
                self.told = Some(step);
                continue;
            }
            let start = positions(&status, self.config);
            if let Some(why) = why_not(&status, (&start, &by), self.config) {
                self.steps.end(number, StepEnd::Not(why));
                continue;
            }
            self.say(by, most_v, at)?;
            let asked = self.demands.asked();
            self.told = Some(Step::new(number, asked, (start, by), now));
        }
        Ok(())
    }

    fn say(&mut self, by: [f64; AXES], most_v: f64, at: Instant) -> Result<(), LinkError> {
        self.step = Some((at + STEP_SAID, Instant::now()));
        let demands = &mut self.demands;
        demands.ask(ns_of(at), JogMode::Incremental, by, most_v, false)
    }

    /// Hears what the machine says, and what that is to the step whose result is to be told.
    pub(super) fn hear(&mut self) -> Result<(), LinkError> {
        while let Some(status) = self.statuses.take()? {
            status.check()?;
            self.status = Some(status);
            let now = Instant::now();
            let seen = self
                .told
                .as_mut()
                .map(|step| step.see(&status, self.config, now));
            match seen {
                Some(Seen::Over(end)) => self.end_step(&end),
                Some(Seen::LetGo) => {
                    self.step = None;
                    self.demands.let_go()?;
                }
                Some(Seen::UnderWay) | None => {}
            }
        }
        let age_ns = |status: Status| Monotonic.now_ns().saturating_sub(status.updated_ns);
        if self.status.is_some_and(|status| age_ns(status) > OLD_NS) {
            self.status = None;
            self.end_steps("nothing is heard of the machine any more");
        }
        Ok(())
    }

    fn end_step(&mut self, end: &StepEnd) {
        let step = self.told.take();
        for number in step.into_iter().flat_map(|step| step.numbers) {
            self.steps.end(number, end.clone());
        }
    }

    /// Ends the one under way, and those that wait.
    pub(super) fn end_steps(&mut self, why: &str) {
        self.end_step(&StepEnd::Not(why.to_owned()));
        self.drop_waiting(why);
    }

    /// A step that waited for too long does not count any more.
    pub(super) fn waiting_is_over(&mut self, now: Instant) {
        let is_late = |(.., at): &(u64, [f64; AXES], f64, Instant)| {
            now.saturating_duration_since(*at) > WAITS
        };
        if self.waiting.front().is_some_and(is_late) {
            self.drop_waiting("it came too soon behind another one, and does not count");
        }
    }

    pub(super) fn drop_waiting(&mut self, why: &str) {
        for (number, ..) in self.waiting.drain(..) {
            self.steps.end(number, StepEnd::Not(why.to_owned()));
        }
    }
}
