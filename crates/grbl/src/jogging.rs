//! The queue of a sender's jogs: those that wait, and the one that moves.
//!
//! A jog begins where the one before it ends. One that goes on in the same direction is handed over at once, so
//! that the axes do not stop between the two; another one waits until the axes rest.

use std::collections::VecDeque;
use std::time::Duration;

use crate::{AXES, Act, Doing};

/// Jogs that wait at most.
const MOST: usize = 16;
/// How long the axes may take to set out.
const PATIENCE: Duration = Duration::from_secs(1);
/// How near a place is to another that is the same, mm or degrees.
const SAME_MM: f64 = 1e-6;
/// How parallel two directions are that are the same.
const SAME_DIRECTION: f64 = 1e-9;

/// A way that is to be gone.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Way {
    by: [f64; AXES],
    most_v: f64,
}

impl Way {
    fn length(&self) -> f64 {
        self.by.iter().map(|by| by * by).sum::<f64>().sqrt()
    }

    fn goes_on_from(&self, before: &Self) -> bool {
        let along: f64 = self.by.iter().zip(&before.by).map(|(a, b)| a * b).sum();
        let both = self.length() * before.length();
        along > both * (1.0 - SAME_DIRECTION) && same(self.most_v, before.most_v)
    }
}

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME_DIRECTION * a.abs().max(b.abs())
}

/// What moves by hand.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Moving {
    way: Way,
    /// Where all that was handed over ends.
    target: [f64; AXES],
    since: Duration,
    has_set_out: bool,
}

/// The outcome of a look.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Jogged {
    Nothing,
    /// The machine did not do what it was to do.
    NotDone,
}

/// The jogs of a sender.
#[derive(Debug, Default)]
pub(crate) struct Jogging {
    waiting: VecDeque<Way>,
    moving: Option<Moving>,
    /// Where the last of them ends.
    end: Option<[f64; AXES]>,
    /// They were ended, and the axes may not be at rest yet.
    is_ending: bool,
}

impl Jogging {
    /// Whether anything moves, or waits to.
    pub(crate) fn is_active(&self) -> bool {
        self.moving.is_some() || self.is_ending || !self.waiting.is_empty()
    }

    pub(crate) fn has_room(&self) -> bool {
        self.waiting.len() < MOST && !self.is_ending
    }

    /// Where the next jog begins, of a machine at this place.
    pub(crate) fn end(&self, position: &[f64; AXES]) -> [f64; AXES] {
        self.end.unwrap_or(*position)
    }

    /// One more, from where the last one ends.
    pub(crate) fn add(&mut self, from: &[f64; AXES], to: &[f64; AXES], most_v: f64) {
        let mut by = [0.0; AXES];
        for ((by, from), to) in by.iter_mut().zip(from).zip(to) {
            *by = to - from;
        }
        self.end = Some(*to);
        let way = Way { by, most_v };
        if way.length() > 0.0 {
            self.waiting.push_back(way);
        }
    }

    /// Ends all of them. Returns whether there was anything to end.
    pub(crate) fn cancel(&mut self) -> bool {
        let was_active = self.is_active();
        self.waiting.clear();
        self.is_ending |= self.moving.take().is_some();
        was_active
    }

    /// The machine does not move by hand any more, whoever had it do so.
    pub(crate) fn forget(&mut self) {
        *self = Self::default();
    }

    /// Looks at how far the machine has come; hands over what is to be gone now.
    pub(crate) fn look(
        &mut self,
        (doing, position): (Doing, &[f64; AXES]),
        now: Duration,
        acts: &mut Vec<Act>,
    ) -> Jogged {
        let mut jogged = Jogged::Nothing;
        let moves = doing == Doing::Jogging;
        if self.is_ending && !moves && !matches!(doing, Doing::Holding | Doing::Stopping) {
            self.is_ending = false;
        }
        if let Some(moving) = &mut self.moving {
            moving.has_set_out |= moves;
            let is_there = near(position, &moving.target);
            let is_late = now.saturating_sub(moving.since) > PATIENCE;
            if !moves && (is_there || moving.has_set_out || is_late) {
                self.moving = None;
                if !is_there {
                    self.waiting.clear();
                    jogged = Jogged::NotDone;
                }
            }
        }
        // What is demanded while something else has the machine is not done.
        let may_begin = matches!(doing, Doing::Idle | Doing::NotHomed);
        if may_begin || self.moving.is_some() {
            self.hand_over(position, now, acts);
        }
        if !self.is_active() {
            self.end = None;
        }
        jogged
    }

    /// Hands over what may be gone now: all that goes on in one direction is one way.
    fn hand_over(&mut self, position: &[f64; AXES], now: Duration, acts: &mut Vec<Act>) {
        if self.is_ending {
            return;
        }
        let mut over: Option<Way> = None;
        while let Some(next) = self.waiting.front().copied() {
            let before = over.or(self.moving.map(|moving| moving.way));
            if before.is_some_and(|before| !next.goes_on_from(&before)) {
                break;
            }
            self.waiting.pop_front();
            over = Some(match over {
                Some(way) => Way {
                    by: sum(&way.by, &next.by),
                    ..way
                },
                None => next,
            });
        }
        let Some(way) = over else {
            return;
        };
        let from = self.moving.map_or(*position, |moving| moving.target);
        self.moving = Some(Moving {
            way,
            target: sum(&from, &way.by),
            since: now,
            has_set_out: false,
        });
        acts.push(Act::Jog {
            by: way.by,
            most_v: way.most_v,
        });
    }
}

fn sum(a: &[f64; AXES], b: &[f64; AXES]) -> [f64; AXES] {
    let mut sum = *a;
    for (sum, b) in sum.iter_mut().zip(b) {
        *sum += b;
    }
    sum
}

fn near(a: &[f64; AXES], b: &[f64; AXES]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= SAME_MM)
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOW: Duration = Duration::ZERO;

    fn at(x: f64, y: f64) -> [f64; AXES] {
        let mut at = [0.0; AXES];
        (at[0], at[1]) = (x, y);
        at
    }

    fn handed_over(jogging: &mut Jogging, doing: Doing, position: &[f64; AXES]) -> Vec<f64> {
        let mut acts = Vec::new();
        jogging.look((doing, position), NOW, &mut acts);
        let by = |act| match act {
            Act::Jog { by, .. } => by[0] + by[1],
            _ => f64::NAN,
        };
        acts.into_iter().map(by).collect()
    }

    #[test]
    fn what_goes_on_is_handed_over_at_once_and_what_turns_waits() {
        let mut jogging = Jogging::default();
        jogging.add(&at(0.0, 0.0), &at(5.0, 0.0), 10.0);
        jogging.add(&at(5.0, 0.0), &at(9.0, 0.0), 10.0);
        let here = at(0.0, 0.0);
        assert_eq!(handed_over(&mut jogging, Doing::Idle, &here), [9.0]);
        jogging.add(&at(9.0, 0.0), &at(9.0, 3.0), 10.0);
        let on_the_way = at(4.0, 0.0);
        let none: [f64; 0] = [];
        assert_eq!(handed_over(&mut jogging, Doing::Jogging, &on_the_way), none);
        let there = at(9.0, 0.0);
        assert_eq!(handed_over(&mut jogging, Doing::Idle, &there), [3.0]);
        assert!(jogging.is_active());
        assert_eq!(handed_over(&mut jogging, Doing::Idle, &at(9.0, 3.0)), none);
        assert!(!jogging.is_active());
    }

    #[test]
    fn one_that_ends_short_ends_those_behind_it() {
        let mut jogging = Jogging::default();
        jogging.add(&at(0.0, 0.0), &at(5.0, 0.0), 10.0);
        jogging.add(&at(5.0, 0.0), &at(0.0, 0.0), 10.0);
        let mut acts = Vec::new();
        jogging.look((Doing::Idle, &at(0.0, 0.0)), NOW, &mut acts);
        jogging.look((Doing::Jogging, &at(1.0, 0.0)), NOW, &mut acts);
        let jogged = jogging.look((Doing::Idle, &at(2.0, 0.0)), NOW, &mut acts);
        assert_eq!((jogged, acts.len()), (Jogged::NotDone, 1));
        assert!(!jogging.is_active());
    }

    #[test]
    fn an_end_is_over_when_the_axes_rest() {
        let mut jogging = Jogging::default();
        jogging.add(&at(0.0, 0.0), &at(5.0, 0.0), 10.0);
        let mut acts = Vec::new();
        jogging.look((Doing::Idle, &at(0.0, 0.0)), NOW, &mut acts);
        assert!(jogging.cancel());
        assert!(!jogging.has_room());
        jogging.look((Doing::Jogging, &at(1.0, 0.0)), NOW, &mut acts);
        assert!(jogging.is_active());
        jogging.look((Doing::Idle, &at(1.2, 0.0)), NOW, &mut acts);
        assert!(!jogging.is_active());
        assert!(near(&jogging.end(&at(1.2, 0.0)), &at(1.2, 0.0)));
    }
}
