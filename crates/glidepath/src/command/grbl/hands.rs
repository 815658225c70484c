//! The threads that carry out what a sender has the machine do at once: commands of the
//! interpolator, and jogs.
//!
//! A thread gives commands, because their answers are waited for, and a report waits for nothing. What stops the
//! motion is given first.

use super::super::live::jogger::{Hand, Jogger};
use crate::config::MachineConfig;
use glidepath_geometry::AXES;
use glidepath_grbl::Act;
use glidepath_link::{Command, CommandRequest, EventId, LinkConfig, LinkError, Operator, Status};
use glidepath_realtime::{Clock as _, Monotonic};
use std::io;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

/// Why a command was not given.
const STOPPED: &str = "a stop was asked for behind it";
/// How long the interpolator may take for an answer.
const PATIENCE: Duration = Duration::from_secs(2);

/// What was to be done, and whether it was; if not, why.
type Answer = (Act, Result<(), String>);
/// What is to be done, by which command, and when it was asked for, ns of the host's steady clock.
type Order = (Act, Command, u64);

/// The ways to the machine.
pub(super) struct Hands {
    commands: Sender<Order>,
    answers: Receiver<Answer>,
    jogger: Jogger,
    /// The joints of each axis, and of all, one bit each.
    joints: [u32; AXES],
    all: u32,
    untold: Vec<Answer>,
}

impl Hands {
    /// Starts the threads, which end with this.
    pub(super) fn start(config: &MachineConfig, link: &LinkConfig) -> io::Result<Self> {
        let (commands, receiver) = channel();
        let (sender, answers) = channel();
        let own = link.clone();
        let thread = std::thread::Builder::new().name("grbl-commands".to_owned());
        thread.spawn(move || give(&own, &receiver, &sender))?;
        let mut joints = [0; AXES];
        for (joint, axis) in config.axis_of_joints().iter().enumerate() {
            if let Some(mask) = joints.get_mut(axis.index()) {
                *mask |= 1 << joint;
            }
        }
        Ok(Self {
            commands,
            answers,
            jogger: Jogger::start(config, link)?,
            joints,
            all: (1 << config.drives()) - 1,
            untold: Vec::new(),
        })
    }

    /// Has something done that was asked for at a time, ns of the host's steady clock.
    pub(super) fn act(&mut self, act: Act, status: Option<&Status>, asked_ns: u64) {
        let command = match &act {
            Act::Hold => Command::Hold,
            Act::Resume => Command::Resume,
            Act::Return => Command::Return,
            Act::Abort => Command::Abort,
            Act::Reset => Command::Reset,
            Act::Enable => Command::Enable,
            Act::Disable => Command::Disable,
            Act::FeedOverride(ratio) => Command::FeedOverride(*ratio),
            Act::RapidOverride(ratio) => Command::RapidOverride(*ratio),
            Act::SpindleOverride(ratio) => Command::SpindleOverride(*ratio),
            Act::Home(None) => Command::Home(self.all),
            Act::Home(Some(axis)) => {
                Command::Home(self.joints.get(*axis).copied().unwrap_or_default())
            }
            Act::ToggleSingleBlock => {
                Command::SingleBlock(status.is_none_or(|status| status.single_block == 0))
            }
            Act::Acknowledge => Command::Acknowledge {
                event: status.map_or_else(EventId::default, |status| EventId {
                    boot_id: status.boot_id,
                    epoch: status.epoch,
                    sequence: status.awaited_sequence,
                }),
                done: true,
            },
            Act::Jog { by, most_v } => {
                let (by, most_v) = (*by, *most_v);
                self.hand(
                    Hand::Step {
                        number: None,
                        by,
                        most_v,
                    },
                    (act, asked_ns),
                );
                return;
            }
            Act::LetGo => {
                self.hand(Hand::LetGo, (act, asked_ns));
                return;
            }
            Act::Judge(_) => return,
        };
        if let Err(unsent) = self.commands.send((act, command, asked_ns)) {
            let (act, ..) = unsent.0;
            let why = "nobody gives commands any more".to_owned();
            self.untold.push((act, Err(why)));
        }
    }

    fn hand(&mut self, hand: Hand, (act, asked_ns): (Act, u64)) {
        let age = Duration::from_nanos(Monotonic.now_ns().saturating_sub(asked_ns));
        let now = Instant::now();
        let at = now.checked_sub(age).unwrap_or(now);
        if !self.jogger.hand_asked(hand, at) {
            let why = "nobody jogs any more".to_owned();
            self.untold.push((act, Err(why)));
        }
    }

    /// What was answered since the last call. Of jogs only refusals are told.
    pub(super) fn answers(&mut self) -> Vec<Answer> {
        let untold = core::mem::take(&mut self.untold);
        untold.into_iter().chain(self.answers.try_iter()).collect()
    }
}

/// Gives commands until nobody has any more.
fn give(link: &LinkConfig, commands: &Receiver<Order>, answers: &Sender<Answer>) {
    while let Ok(first) = commands.recv() {
        let waiting = core::iter::once(first).chain(commands.try_iter()).collect();
        let (given, dropped) = in_order(waiting);
        let dropped = dropped
            .into_iter()
            .map(|act| (act, Err(STOPPED.to_owned())));
        let given = given
            .into_iter()
            .map(|(act, command, asked_ns)| (act, give_one(link, command, asked_ns)));
        for answer in dropped.chain(given) {
            if answers.send(answer).is_err() {
                return;
            }
        }
    }
}

/// The order in which commands that wait are given: a stop waits for no override, and what was to set out
/// before it does not set out behind it. The second part is what is not given.
fn in_order(mut waiting: Vec<Order>) -> (Vec<Order>, Vec<Act>) {
    let last_stop = waiting
        .iter()
        .rposition(|(_, command, _)| command.stops())
        .unwrap_or(0);
    let behind = waiting.split_off(last_stop);
    let (dropped, before): (Vec<Order>, Vec<Order>) = waiting
        .into_iter()
        .partition(|(_, command, _)| command.sets_out());
    let mut given: Vec<Order> = before.into_iter().chain(behind).collect();
    given.sort_by_key(|(_, command, _)| !command.stops());
    (given, dropped.into_iter().map(|(act, ..)| act).collect())
}

fn give_one(link: &LinkConfig, command: Command, asked_ns: u64) -> Result<(), String> {
    let told = |error: LinkError| error.to_string();
    let request = CommandRequest::new(u64::from(std::process::id()), 1, command);
    let request = request.asked_at(asked_ns);
    let operator = Operator::find(link).map_err(told)?;
    let reply = operator.call(&request, PATIENCE).map_err(told)?;
    let Some(reply) = reply else {
        return Err("the interpolator does not answer".to_owned());
    };
    match reply.outcome() {
        Ok(Ok(())) => Ok(()),
        Ok(Err(refusal)) => Err(reply.why(refusal)),
        Err(error) => Err(error.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stop_overtakes_what_waits_and_nothing_sets_out_behind_it_that_was_asked_before() {
        let orders = |commands: &[Command]| -> Vec<Order> {
            commands
                .iter()
                .map(|command| (Act::Hold, *command, 0))
                .collect()
        };
        let given = |commands: &[Command]| -> (Vec<Command>, usize) {
            let (given, dropped) = in_order(orders(commands));
            let given = given.into_iter().map(|(_, command, _)| command);
            (given.collect(), dropped.len())
        };
        let (slow, home) = (Command::FeedOverride(0.5), Command::Home(7));
        use Command::{Abort, Hold, Resume};
        assert_eq!(given(&[slow, home, Abort]), (vec![Abort, slow], 1));
        assert_eq!(given(&[Resume, Hold]), (vec![Hold], 1));
        assert_eq!(given(&[Hold, Resume]), (vec![Hold, Resume], 0));
        assert_eq!(given(&[Resume, Hold, Resume]), (vec![Hold, Resume], 1));
        assert_eq!(given(&[home, slow]), (vec![home, slow], 0));
    }
}
