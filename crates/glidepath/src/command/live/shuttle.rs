//! The shuttle: the thread that moves the machine back along the path and onward again, for as long as a finger is down.
//!
//! ```text
//!  page ── every 50 ms ──► gesture: does it count? ──► feed override of either sign; resume, the first time
//!                          └─ silent, late, up ──► hold; at rest, the override that was
//! ```
//!
//! It goes back as far as the machine does, and onward to where the path was held, at 100 % at most. As with a jog,
//! a gesture that has fallen silent is over, and a hold or an abort ends it for good.

use super::gesture::{Gesture, Heard};
use crate::command::operator::PATIENCE;
use glidepath_link::{
    Command, CommandRequest, Ipc, LinkConfig, LinkError, MachineState, Operator, Record as _,
    Status, Subscriber, Transport as _, refused,
};
use glidepath_realtime::{Clock as _, Monotonic};
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Between two looks whether the gesture is over.
const LOOK: Duration = Duration::from_millis(10);
/// Gestures that are over, and are remembered.
const REMEMBERED: usize = 64;
/// Nearer to where the path was held it goes no further, mm.
const THERE_MM: f64 = 1e-6;
/// A change of the override that is worth a command.
const WORTH: f64 = 0.01;

/// What a finger does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Drag {
    /// A message of a finger that is down: which way, and what part of the speed of the plan.
    Down {
        gesture: u64,
        number: u64,
        at_ms: f64,
        speed: f64,
    },
    /// The finger is up.
    Up { gesture: u64 },
    /// A hold, or an abort: the gesture is over.
    LetGo,
}

/// What pages are told of it.
#[derive(Debug, Default)]
struct Told {
    /// The gesture under way.
    gesture: Option<u64>,
    /// Counts what went wrong, and what it was last.
    troubles: u64,
    trouble: String,
}

/// The way to the thread that moves the machine along the path.
#[derive(Debug)]
pub(super) struct Shuttle {
    drags: Sender<(Drag, Instant)>,
    told: Arc<Mutex<Told>>,
}

impl Shuttle {
    /// Starts the thread, which ends with this.
    pub(super) fn start(link: &LinkConfig) -> Result<Self, std::io::Error> {
        let (drags, receiver) = channel();
        let (link, told) = (link.clone(), Arc::<Mutex<Told>>::default());
        let thread = std::thread::Builder::new().name("live-shuttle".to_owned());
        let own = Arc::clone(&told);
        thread.spawn(move || serve(&link, &receiver, &own))?;
        Ok(Self { drags, told })
    }

    /// Has the machine moved. Returns whether there is anybody to do it.
    pub(super) fn drag(&self, drag: Drag) -> bool {
        self.drags.send((drag, Instant::now())).is_ok()
    }

    pub(super) fn object(&self) -> Value {
        let told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        json!({ "gesture": told.gesture, "troubles": told.troubles, "trouble": told.trouble })
    }
}

/// Serves until nobody can ask any more.
fn serve(link: &LinkConfig, drags: &Receiver<(Drag, Instant)>, told: &Mutex<Told>) {
    loop {
        let served = Ipc::connect(link).and_then(|transport| {
            let statuses = transport.status_source()?;
            Hands::new(link, statuses, told).follow(drags)
        });
        match served {
            Ok(()) => return,
            Err(error) => {
                say(told, &error.to_string());
                // What was asked of a port that failed is not done later.
                if drags.recv().is_err() {
                    return;
                }
            }
        }
    }
}

fn say(told: &Mutex<Told>, trouble: &str) {
    let mut told = told.lock().unwrap_or_else(PoisonError::into_inner);
    told.gesture = None;
    told.troubles += 1;
    trouble.clone_into(&mut told.trouble);
}

/// The finger that is down, and what it has the machine do.
struct Hands<'a> {
    link: &'a LinkConfig,
    statuses: Box<dyn Subscriber<Status>>,
    status: Option<Status>,
    told: &'a Mutex<Told>,
    gesture: Option<Gesture>,
    over: VecDeque<u64>,
    /// The override asked for last, of the gesture that is under way; 0 before the first.
    asked: f64,
    /// The override before the gesture, until it is in force again.
    before: Option<f64>,
    /// How far the path had come when it was held first, and in which epoch.
    farthest: Option<(u64, f64)>,
    number: u64,
    /// The gesture has the machine moving, or resting by an override of 0: only a hold ends that.
    has_resumed: bool,
    /// When the last gesture ended: what is older tells nothing of the rest behind it.
    ended_ns: u64,
}

impl<'a> Hands<'a> {
    fn new(
        link: &'a LinkConfig,
        statuses: Box<dyn Subscriber<Status>>,
        told: &'a Mutex<Told>,
    ) -> Self {
        Self {
            link,
            statuses,
            status: None,
            told,
            gesture: None,
            over: VecDeque::new(),
            asked: 0.0,
            before: None,
            farthest: None,
            number: 0,
            has_resumed: false,
            ended_ns: 0,
        }
    }

    fn follow(&mut self, drags: &Receiver<(Drag, Instant)>) -> Result<(), LinkError> {
        loop {
            let drag = drags.recv_timeout(LOOK);
            while let Some(status) = self.statuses.take()? {
                status.check()?;
                self.status = Some(status);
            }
            match drag {
                Ok((drag, at)) => self.take(drag, at),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    self.let_go();
                    return Ok(());
                }
            }
            self.look(Instant::now());
        }
    }

    fn take(&mut self, drag: Drag, at: Instant) {
        match drag {
            Drag::Down {
                gesture,
                number,
                at_ms,
                speed,
            } => self.down((gesture, number, at_ms), speed, at),
            Drag::Up { gesture } => {
                self.forget(gesture);
                if self.gesture.as_ref().map(Gesture::id) == Some(gesture) {
                    self.let_go();
                }
            }
            Drag::LetGo => self.let_go(),
        }
    }

    fn down(&mut self, (id, number, at_ms): (u64, u64, f64), speed: f64, at: Instant) {
        if self.over.contains(&id) || at.elapsed() > super::gesture::SILENCE {
            return;
        }
        match &mut self.gesture {
            Some(gesture) if gesture.id() == id => match gesture.hear(number, at_ms, at) {
                Heard::Fresh => {}
                Heard::Late => return,
                Heard::Over => return self.let_go(),
            },
            // One hand at a time: another finger waits until the first is up.
            Some(_) => return,
            None => {
                if self
                    .status
                    .is_none_or(|status| status.updated_ns <= self.ended_ns)
                {
                    // What is known is of before the last gesture's end: the next message may know more.
                    return;
                }
                let Some(status) = self.held() else {
                    self.forget(id);
                    return say(self.told, "the path is not held");
                };
                self.gesture = Some(Gesture::begin(id, number, at_ms, at));
                self.tell(Some(id));
                self.asked = 0.0;
                // What is asked for since the last gesture is that of somebody else.
                self.before.get_or_insert(status.feed_override.abs());
                let of_epoch = self.farthest.filter(|(epoch, _)| *epoch == status.epoch);
                let farthest = of_epoch.map_or(status.path_s, |(_, s)| s.max(status.path_s));
                self.farthest = Some((status.epoch, farthest));
            }
        }
        self.drive(speed, at);
    }

    /// The status of a machine that is held on its path.
    fn held(&self) -> Option<Status> {
        let is_held = |status: &Status| status.state() == Ok(MachineState::Held);
        self.status.filter(is_held)
    }

    /// Moves at a part of the speed of the plan: back where it is negative.
    fn drive(&mut self, speed: f64, at: Instant) {
        let is_there = self
            .status
            .is_some_and(|status| self.is_at_the_end(&status));
        let speed = if speed > 0.0 && is_there { 0.0 } else { speed };
        if (speed - self.asked).abs() < WORTH && (speed == 0.0) == (self.asked == 0.0) {
            return;
        }
        let is_first = !self.has_resumed;
        if is_first && speed == 0.0 {
            return;
        }
        self.asked = speed;
        let sent = self.send(Command::FeedOverride(speed), at);
        self.has_resumed = true;
        let sent = sent.and_then(|()| {
            if is_first {
                self.send(Command::Resume, at)
            } else {
                Ok(())
            }
        });
        if let Err(why) = sent {
            self.let_go();
            say(self.told, &why);
        }
    }

    fn tell(&self, gesture: Option<u64>) {
        let mut told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        told.gesture = gesture;
    }

    /// Whether the path has come to where it was held first.
    fn is_at_the_end(&self, status: &Status) -> bool {
        let of_epoch = self.farthest.filter(|(epoch, _)| *epoch == status.epoch);
        of_epoch.is_some_and(|(_, farthest)| status.path_s >= farthest - THERE_MM)
    }

    /// Ends what is over, and gives back the override once the machine rests.
    fn look(&mut self, now: Instant) {
        let is_over = self.gesture.as_mut().is_some_and(|it| it.is_over(now));
        if is_over {
            self.let_go();
        }
        let Some(status) = self.status else {
            return;
        };
        if self.gesture.is_some() {
            if self.asked > 0.0 && self.is_at_the_end(&status) {
                self.drive(0.0, now);
            }
            return;
        }
        if self.has_resumed {
            // It was not held yet, and is not over either.
            self.has_resumed = status.state() != Ok(MachineState::Idle);
            self.hold();
            return;
        }
        let rests = matches!(
            status.state(),
            Ok(MachineState::Held | MachineState::Idle | MachineState::ProgramStop)
        );
        let rests = rests && status.updated_ns > self.ended_ns;
        if rests && let Some(before) = self.before.take() {
            // Where it is refused, the machine is not what it was, and has an override of its own.
            let _given_back = self.send(Command::FeedOverride(before), now);
            self.ended_ns = Monotonic.now_ns();
        }
    }

    fn let_go(&mut self) {
        let Some(gesture) = self.gesture.take() else {
            return;
        };
        self.forget(gesture.id());
        self.tell(None);
        self.asked = 0.0;
        self.hold();
    }

    /// Holds what this has set in motion. At an override of 0 the machine says that it is held, and would go on with
    /// another override.
    fn hold(&mut self) {
        if self.has_resumed {
            let held = self.send(Command::Hold, Instant::now());
            self.has_resumed = held.is_err();
            held.unwrap_or_else(|why| say(self.told, &why));
        }
        self.ended_ns = Monotonic.now_ns();
    }

    fn send(&mut self, command: Command, at: Instant) -> Result<(), String> {
        self.number += 1;
        let client = u64::from(std::process::id()) ^ 1 << 63;
        let age_ns = u64::try_from(at.elapsed().as_nanos()).unwrap_or(u64::MAX);
        let asked_ns = Monotonic.now_ns().saturating_sub(age_ns);
        let request = CommandRequest::new(client, self.number, command).asked_at(asked_ns);
        let operator = Operator::find(self.link).map_err(|error| error.to_string())?;
        let reply = operator.call(&request, PATIENCE);
        let reply = reply.map_err(|error| error.to_string())?;
        let reply = reply.ok_or("the interpolator lives and does not answer")?;
        let outcome = reply.outcome().map_err(|error| error.to_string())?;
        outcome.map_err(|refusal| refused(command.kind().name(), &reply.why(refusal)))
    }

    /// A gesture that is over does not begin again.
    fn forget(&mut self, gesture: u64) {
        if self.over.len() == REMEMBERED {
            self.over.pop_front();
        }
        self.over.push_back(gesture);
    }
}
