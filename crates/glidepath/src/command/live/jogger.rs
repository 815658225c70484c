//! The thread that jogs for the pages, with a port for demands, as `glidepath jog` has one.
//!
//! ```text
//!  page ── every 50 ms ──► gesture: does it count? ──► demand, stamped now ──► interpolator
//!                          └─ silent, late, up ──► let go        └─ silent for dead_man ──► stops by itself
//! ```
//!
//! A demand is stamped for a message that came, and for nothing else: whatever dies between the finger and
//! here, the interpolator hears no more and brings the axes to rest.

mod stepping;

use super::gesture::{Gesture, Heard};
use super::step::Step;
use super::steps::{StepEnd, Steps};
use crate::command::jog::Demands;
use crate::config::MachineConfig;
use glidepath_geometry::AXES;
use glidepath_link::{Ipc, JogMode, LinkConfig, LinkError, Status, Subscriber, Transport as _};
use glidepath_realtime::{Clock as _, Monotonic};
use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

/// Between two looks whether the gesture is over.
const LOOK: Duration = Duration::from_millis(10);
/// Between two times that a step is said again.
const STEP_EVERY: Duration = Duration::from_millis(30);
/// A status that is older tells nothing of the machine any more, ns.
const OLD_NS: u64 = 1_000_000_000;
/// Gestures that are over, and are remembered.
const REMEMBERED: usize = 64;

/// How axes are to be moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::command) enum Hand {
    /// A message of a finger that is down: mm/s or °/s by axis.
    Down {
        gesture: u64,
        number: u64,
        at_ms: f64,
        velocity: [f64; AXES],
    },
    /// The finger is up.
    Up { gesture: u64 },
    /// One step, mm or degrees by axis, at most so many mm/s. With the number by which its result is told.
    Step {
        number: Option<u64>,
        by: [f64; AXES],
        most_v: f64,
    },
    /// Whatever moves by a page is let go.
    LetGo,
}

/// The way to the thread that jogs.
#[derive(Debug)]
pub(in crate::command) struct Jogger {
    hands: Sender<(Hand, Instant)>,
    steps: Arc<Steps>,
}

impl Jogger {
    /// Starts the thread, which ends with this.
    pub(in crate::command) fn start(
        config: &MachineConfig,
        link: &LinkConfig,
    ) -> Result<Self, std::io::Error> {
        let (hands, receiver) = channel();
        let (link, config, steps) = (link.clone(), config.clone(), Arc::<Steps>::default());
        let thread = std::thread::Builder::new().name("live-jog".to_owned());
        let told = Arc::clone(&steps);
        thread.spawn(move || serve(&link, &receiver, &(config, told)))?;
        Ok(Self { hands, steps })
    }

    /// Has axes moved once, and the result told by a number. `None` if nobody is there to do it.
    pub(super) fn step(&self, by: [f64; AXES], most_v: f64) -> Option<u64> {
        let number = self.steps.begin();
        let wanted = Some(number);
        let step = Hand::Step {
            number: wanted,
            by,
            most_v,
        };
        self.hand(step).then_some(number)
    }

    /// The steps of the pages, each with its result.
    pub(super) fn steps(&self) -> Arc<Steps> {
        Arc::clone(&self.steps)
    }

    /// Has axes moved. Returns whether there is anybody to do it.
    pub(in crate::command) fn hand(&self, hand: Hand) -> bool {
        self.hand_asked(hand, Instant::now())
    }

    /// The same, of what was asked for at a time: where the machine was stopped since, nothing moves.
    pub(in crate::command) fn hand_asked(&self, hand: Hand, at: Instant) -> bool {
        self.hands.send((hand, at)).is_ok()
    }
}

/// Serves until nobody can ask any more. A port that fails is made anew for the next gesture.
fn serve(link: &LinkConfig, hands: &Receiver<(Hand, Instant)>, told: &(MachineConfig, Arc<Steps>)) {
    let mut next = None;
    loop {
        let served = Ipc::connect(link).and_then(|transport| {
            let demands = Demands::new(transport.jog_sink()?);
            let statuses = transport.status_source()?;
            Hands::new(demands, statuses, told).follow(hands, next.take())
        });
        match served {
            Ok(()) => return,
            Err(error) => {
                told.1.end_all(&StepEnd::Not(error.to_string()));
                match hands.recv() {
                    // What was asked of a port that failed is not done later.
                    Ok((Hand::Up { .. } | Hand::LetGo, _)) => {}
                    Ok(hand) => next = Some(hand),
                    Err(_) => return,
                }
            }
        }
    }
}

/// When a message came, by the clock that demands are stamped with.
fn ns_of(at: Instant) -> u64 {
    let age_ns = u64::try_from(at.elapsed().as_nanos()).unwrap_or(u64::MAX);
    Monotonic.now_ns().saturating_sub(age_ns)
}

/// What moves, and by whom.
struct Hands<'a> {
    demands: Demands,
    statuses: Box<dyn Subscriber<Status>>,
    status: Option<Status>,
    config: &'a MachineConfig,
    steps: &'a Steps,
    /// The step whose result is to be told, and those that wait until it has set out.
    told: Option<Step>,
    waiting: VecDeque<(u64, [f64; AXES], f64, Instant)>,
    gesture: Option<Gesture>,
    /// What the gesture asks for.
    velocity: [f64; AXES],
    over: VecDeque<u64>,
    /// A step: until when it is said again, and when it was said last.
    step: Option<(Instant, Instant)>,
}

impl<'a> Hands<'a> {
    fn new(
        demands: Demands,
        statuses: Box<dyn Subscriber<Status>>,
        (config, steps): &'a (MachineConfig, Arc<Steps>),
    ) -> Self {
        Self {
            demands,
            statuses,
            status: None,
            config,
            steps,
            told: None,
            waiting: VecDeque::new(),
            gesture: None,
            velocity: [0.0; AXES],
            over: VecDeque::new(),
            step: None,
        }
    }

    fn follow(
        &mut self,
        hands: &Receiver<(Hand, Instant)>,
        first: Option<(Hand, Instant)>,
    ) -> Result<(), LinkError> {
        if let Some((hand, at)) = first {
            self.take(hand, at)?;
        }
        loop {
            match hands.recv_timeout(LOOK) {
                Ok((hand, at)) => self.take(hand, at)?,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return self.release(),
            }
            self.look()?;
        }
    }

    fn take(&mut self, hand: Hand, at: Instant) -> Result<(), LinkError> {
        match hand {
            Hand::Down {
                gesture,
                number,
                at_ms,
                velocity,
            } => self.down((gesture, number, at_ms), velocity, at),
            Hand::Up { gesture } => {
                self.forget(gesture);
                if self.gesture.as_ref().map(Gesture::id) == Some(gesture) {
                    return self.release();
                }
                Ok(())
            }
            Hand::LetGo => self.release(),
            Hand::Step { number, by, most_v } => self.step(number, (by, most_v), at),
        }
    }

    fn down(
        &mut self,
        (id, number, at_ms): (u64, u64, f64),
        velocity: [f64; AXES],
        at: Instant,
    ) -> Result<(), LinkError> {
        if self.over.contains(&id) || at.elapsed() > super::gesture::SILENCE {
            return Ok(());
        }
        let is_new = match &mut self.gesture {
            Some(gesture) if gesture.id() == id => match gesture.hear(number, at_ms, at) {
                Heard::Fresh => false,
                Heard::Late => return Ok(()),
                Heard::Over => return self.release(),
            },
            // One hand at a time: another finger waits until the first is up.
            Some(_) => return Ok(()),
            None => {
                self.gesture = Some(Gesture::begin(id, number, at_ms, at));
                true
            }
        };
        self.step = None;
        if is_new {
            self.end_steps("a finger moves the axes since");
        }
        if is_new || velocity.map(f64::to_bits) != self.velocity.map(f64::to_bits) {
            self.velocity = velocity;
            let demands = &mut self.demands;
            return demands.ask(ns_of(at), JogMode::Continuous, velocity, 0.0, false);
        }
        self.demands.again()
    }

    /// Lets go where the gesture is over, and says a step again.
    fn look(&mut self) -> Result<(), LinkError> {
        self.begin_waiting()?;
        let now = Instant::now();
        self.waiting_is_over(now);
        let is_over = self.gesture.as_mut().is_some_and(|it| it.is_over(now));
        if is_over {
            return self.release();
        }
        match &mut self.step {
            Some((until, _)) if now >= *until => self.step = None,
            Some((_, said)) if now.saturating_duration_since(*said) >= STEP_EVERY => {
                *said = now;
                return self.demands.again();
            }
            _ => {}
        }
        Ok(())
    }

    fn release(&mut self) -> Result<(), LinkError> {
        if let Some(gesture) = self.gesture.take() {
            self.forget(gesture.id());
        }
        self.step = None;
        self.drop_waiting("it was let go");
        self.demands.let_go()
    }

    /// A gesture that is over does not begin again.
    fn forget(&mut self, gesture: u64) {
        if self.over.len() == REMEMBERED {
            self.over.pop_front();
        }
        self.over.push_back(gesture);
    }
}
