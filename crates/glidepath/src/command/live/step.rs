//! A step of a page under way, told by its own result: that the machine moves, or rests, may be another client's doing.
//!
//! ```text
//!  asked ──► followed? the status names the client and the number of the demand ──► at rest ──► result
//!            └─ another client moves, or nothing does for a while ──► let go ──► not done, and why
//! ```
//!
//! Steps that come while one moves add up, and have one end.

use super::super::ending;
use super::super::jog::{Arrival, Asked, PATIENCE as SETTLES_IN, Panel, at_end_already};
use super::steps::StepEnd;
use crate::config::MachineConfig;
use crate::exit::Exit;
use glidepath_geometry::{AXES, Axis};
use glidepath_link::{MachineState, Status, UnmetPrecondition};
use std::time::{Duration, Instant};

/// How long the machine may take to set out.
const SETS_OUT_IN: Duration = Duration::from_secs(1);
/// How long an interpolator may take to hear that a step is let go, and to show it.
const HEARD_IN: Duration = Duration::from_millis(100);

/// What a step is waiting for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stage {
    SettingOut,
    /// It was let go, because another client moves the machine or because nothing moves.
    GivenUp {
        is_anothers: bool,
    },
    Moving,
    Settling,
}

/// The state of a step after a look at the machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Seen {
    UnderWay,
    /// It is to be let go.
    LetGo,
    Over(StepEnd),
}

/// A step under way, or several that add up.
#[derive(Debug)]
pub(super) struct Step {
    pub(super) numbers: Vec<u64>,
    /// What was asked for first, and last.
    first: Asked,
    asked: Asked,
    by: [f64; AXES],
    start: Vec<(Axis, f64)>,
    stage: Stage,
    since: Instant,
}

/// Why a step cannot be begun now, if it cannot.
pub(super) fn why_not(
    status: &Status,
    (start, by): (&[(Axis, f64)], &[f64; AXES]),
    config: &MachineConfig,
) -> Option<String> {
    let precondition = status.state().ok().and_then(Panel::precondition);
    if let Some(precondition) = precondition {
        return Some(precondition.text().to_owned());
    }
    let is_homed = status.homed == status.joints;
    is_homed
        .then(|| at_end_already(start, by, config))
        .flatten()
}

impl Step {
    pub(super) fn new(
        number: u64,
        asked: Asked,
        (start, by): (Vec<(Axis, f64)>, [f64; AXES]),
        now: Instant,
    ) -> Self {
        Self {
            numbers: vec![number],
            first: asked,
            asked,
            by,
            start,
            stage: Stage::SettingOut,
            since: now,
        }
    }

    /// Whether it has set out, so that another one adds to it.
    pub(super) const fn takes_more(&self) -> bool {
        matches!(self.stage, Stage::Moving)
    }

    /// Another one that was asked for behind it.
    pub(super) fn add(&mut self, number: u64, asked: Asked, by: &[f64; AXES], now: Instant) {
        self.numbers.push(number);
        self.asked = asked;
        for (all, more) in self.by.iter_mut().zip(by) {
            *all += more;
        }
        self.begin(Stage::SettingOut, now);
    }

    fn begin(&mut self, stage: Stage, now: Instant) {
        (self.stage, self.since) = (stage, now);
    }

    /// Looks at a status. All of them are looked at, in their order.
    pub(super) fn see(&mut self, status: &Status, config: &MachineConfig, now: Instant) -> Seen {
        let is_ours = self.asked.is_one_since(&self.first, status);
        let state = status.state();
        let moves = matches!(
            state,
            Ok(MachineState::Jogging | MachineState::Holding | MachineState::Stopping)
        );
        let has_set_out = self.asked.is_followed(status);
        if matches!(self.stage, Stage::SettingOut | Stage::GivenUp { .. }) && has_set_out {
            self.begin(Stage::Moving, now);
        }
        if matches!(self.stage, Stage::Moving | Stage::Settling) && !is_ours {
            let text = "another client has moved the axes since; look where they are";
            return Seen::Over(StepEnd::Not(text.to_owned()));
        }
        match self.stage {
            Stage::SettingOut => {
                let is_anothers = state == Ok(MachineState::Jogging) && !is_ours;
                if !is_anothers && now.saturating_duration_since(self.since) <= SETS_OUT_IN {
                    return Seen::UnderWay;
                }
                self.begin(Stage::GivenUp { is_anothers }, now);
                Seen::LetGo
            }
            Stage::GivenUp { is_anothers } => {
                if now.saturating_duration_since(self.since) <= HEARD_IN {
                    return Seen::UnderWay;
                }
                Seen::Over(StepEnd::Not(why_nothing_moved(status, is_anothers)))
            }
            Stage::Moving if moves => Seen::UnderWay,
            Stage::Moving => {
                self.begin(Stage::Settling, now);
                self.settle(status, config, now)
            }
            Stage::Settling => self.settle(status, config, now),
        }
    }

    fn settle(&self, status: &Status, config: &MachineConfig, now: Instant) -> Seen {
        let is_late = now.saturating_duration_since(self.since) > SETTLES_IN;
        if !Arrival::is_settled(status, config) && !is_late {
            return Seen::UnderWay;
        }
        let arrival = Arrival::at(status, config, (&self.start, Some(&self.by)));
        Seen::Over(match arrival.exit() {
            Exit::Done => StepEnd::Done,
            _ => StepEnd::Not(arrival.text().trim().replace("\n  ", "; ")),
        })
    }
}

fn why_nothing_moved(status: &Status, is_anothers: bool) -> String {
    if is_anothers {
        return UnmetPrecondition::ByHand.text().to_owned();
    }
    let state = status.state().ok();
    ending::failure(status)
        .or_else(|| state.and_then(|state| Some(Panel::precondition(state)?.text().to_owned())))
        .or_else(|| ending::why(status))
        .unwrap_or_else(|| "nothing moved: somebody else jogs, or the travel ends there".to_owned())
}

#[cfg(test)]
mod tests {
    use super::super::super::jog::positions;
    use super::*;

    struct Desk {
        config: MachineConfig,
        status: Status,
        start: Instant,
    }

    impl Desk {
        fn new() -> Self {
            let mut status: Status = bytemuck::Zeroable::zeroed();
            status.state = MachineState::Idle.code();
            Self {
                config: crate::config::load(None).unwrap(),
                status,
                start: Instant::now(),
            }
        }

        fn step(&self) -> Step {
            let mut by = [0.0; AXES];
            by[0] = 1.0;
            let start = positions(&self.status, &self.config);
            Step::new(7, Asked::of(5, 3), (start, by), self.start)
        }

        /// The machine does something for the demand of a client, and X is somewhere.
        fn is(&mut self, state: MachineState, (client, number): (u64, u64), x: f64) {
            self.status.state = state.code();
            (self.status.jog_client, self.status.jog_number) = (client, number);
            self.status.position[0] = x;
        }

        fn see(&self, step: &mut Step, ms: u64) -> Seen {
            step.see(
                &self.status,
                &self.config,
                self.start + Duration::from_millis(ms),
            )
        }
    }

    #[test]
    fn a_step_is_done_when_its_own_demand_was_followed_and_rests_at_its_end() {
        let mut desk = Desk::new();
        let mut step = desk.step();
        assert_eq!(desk.see(&mut step, 0), Seen::UnderWay);
        desk.is(MachineState::Jogging, (5, 3), 0.4);
        assert_eq!(desk.see(&mut step, 40), Seen::UnderWay);
        desk.is(MachineState::Idle, (5, 3), 1.0);
        assert_eq!(desk.see(&mut step, 90), Seen::Over(StepEnd::Done));
        // It did not go all the way.
        let mut desk = Desk::new();
        let mut step = desk.step();
        desk.is(MachineState::Jogging, (5, 3), 0.2);
        assert_eq!(desk.see(&mut step, 20), Seen::UnderWay);
        desk.is(MachineState::Idle, (5, 3), 0.3);
        let Seen::Over(StepEnd::Not(why)) = desk.see(&mut step, 60) else {
            panic!("it is short");
        };
        assert!(
            why.contains("X stopped before the end of its step: 0.7000 mm"),
            "{why}"
        );
    }

    #[test]
    fn steps_add_up_and_have_one_end() {
        let mut desk = Desk::new();
        let mut step = desk.step();
        assert!(!step.takes_more(), "it may not be heard yet");
        desk.is(MachineState::Jogging, (5, 3), 0.4);
        assert_eq!(desk.see(&mut step, 20), Seen::UnderWay);
        assert!(step.takes_more());
        let mut by = [0.0; AXES];
        by[0] = 1.0;
        step.add(
            8,
            Asked::of(5, 4),
            &by,
            desk.start + Duration::from_millis(20),
        );
        // What was asked for first is still followed, or rests by now: that is the end of neither.
        for (state, ms) in [(MachineState::Jogging, 30), (MachineState::Idle, 40)] {
            desk.is(state, (5, 3), 1.0);
            assert_eq!(desk.see(&mut step, ms), Seen::UnderWay);
        }
        desk.is(MachineState::Jogging, (5, 4), 1.5);
        assert_eq!(desk.see(&mut step, 60), Seen::UnderWay);
        desk.is(MachineState::Idle, (5, 4), 2.0);
        assert_eq!(desk.see(&mut step, 90), Seen::Over(StepEnd::Done));
        assert_eq!(step.numbers, [7, 8]);
    }

    #[test]
    fn what_another_client_moves_is_never_the_result_of_a_step() {
        // Another client was first: its way is as long as the step, and no more than that is seen.
        let mut desk = Desk::new();
        let mut step = desk.step();
        desk.is(MachineState::Jogging, (9, 1), 0.5);
        assert_eq!(desk.see(&mut step, 20), Seen::LetGo);
        desk.is(MachineState::Idle, (9, 1), 1.0);
        assert_eq!(desk.see(&mut step, 60), Seen::UnderWay);
        let anothers = Seen::Over(StepEnd::Not(UnmetPrecondition::ByHand.text().to_owned()));
        assert_eq!(desk.see(&mut step, 140), anothers);
        // Another one follows before the end of this one was seen.
        let mut desk = Desk::new();
        let mut step = desk.step();
        desk.is(MachineState::Jogging, (5, 3), 0.9);
        assert_eq!(desk.see(&mut step, 20), Seen::UnderWay);
        desk.is(MachineState::Idle, (9, 2), 1.0);
        assert!(matches!(
            desk.see(&mut step, 40),
            Seen::Over(StepEnd::Not(_))
        ));
        // It was let go, and had been begun all the same.
        let mut desk = Desk::new();
        let mut step = desk.step();
        assert_eq!(desk.see(&mut step, 1001), Seen::LetGo);
        desk.is(MachineState::Idle, (5, 3), 0.0);
        assert!(
            matches!(desk.see(&mut step, 1040), Seen::Over(StepEnd::Not(why)) if why.contains("1.0000 mm"))
        );
    }

    #[test]
    fn a_step_that_cannot_be_says_why() {
        let mut desk = Desk::new();
        let start = positions(&desk.status, &desk.config);
        let mut by = [0.0; AXES];
        by[0] = 1.0;
        let why = |status: &Status| why_not(status, (&start, &by), &desk.config);
        assert_eq!(why(&desk.status), None);
        let mut running = desk.status;
        running.state = MachineState::Running.code();
        let now = why(&running).unwrap();
        assert_eq!(now, UnmetPrecondition::NoJogNow.text());
        // Nothing sets out, and nobody says why.
        let mut step = desk.step();
        assert_eq!(desk.see(&mut step, 1001), Seen::LetGo);
        desk.is(MachineState::Idle, (0, 0), 0.0);
        assert!(
            matches!(desk.see(&mut step, 1102), Seen::Over(StepEnd::Not(why)) if why.starts_with("nothing moved"))
        );
    }
}
