//! Previews of programs of the folder before they run: their texts, their paths, how long they take,
//! and what is wrong with them.
//!
//! A program is planned once, for all pages that look at it. A few are remembered for the operator's seat, and a
//! few for all others, so that nobody who only looks has given up what is about to run; of either, the one that
//! was asked for least recently is given up for another one. A page that looks at it is told so, and does not have
//! it planned again: else pages that look at different programs would have each other's planned for ever.

use super::planned::{self, Planned, Reading};
use super::shown::Shown;
use crate::command::begins_with::begins_now;
use crate::command::forecast::{Forecast, PlannedFor};
use crate::config::MachineConfig;
use serde_json::Value;
use std::collections::VecDeque;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;

/// Programs that are remembered for the operator's seat.
const MOST_OF_SEAT: usize = 4;
/// Programs that are remembered for all others.
const MOST_OF_OTHERS: usize = 2;
/// Text of all of either, bytes. The one that was asked for last is remembered whatever its length.
const MOST_TEXT: usize = 64 << 20;

/// The program is not looked at any more.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("other programs have been looked at since, and this one was given up: choose it again")]
pub(super) struct GivenUp;

/// The programs that are looked at.
pub(super) struct Preview {
    config: MachineConfig,
    known: Mutex<Known>,
}

#[derive(Default)]
struct Known {
    /// How many programs were looked at.
    count: u64,
    /// Those that the operator's seat has looked at, and those of all others. The one asked for last is the first.
    of_seat: VecDeque<LookedAt>,
    of_others: VecDeque<LookedAt>,
}

/// Who looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Looker {
    /// The page that operates.
    Seat,
    /// A page that only looks, or waits for the seat.
    Other,
}

/// A file as it was when it was looked at.
#[derive(Debug, Clone, PartialEq)]
struct Stamp {
    name: String,
    bytes: u64,
    changed: Option<SystemTime>,
    /// What is kept of the machine: a plan is of the offsets and tools that it was made with.
    set_up: u64,
}

struct LookedAt {
    stamp: Stamp,
    shown: Arc<Shown>,
    forecast: Option<Forecast>,
    _reading: Option<Reading>,
}

/// A page's look at a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Look {
    /// It was chosen.
    First,
    /// It is looked at already, and asked how far it is.
    Again,
    /// What is known of it is not true any more. Of others than the seat it is not believed.
    Anew,
}

impl Preview {
    pub(super) fn new(config: &MachineConfig) -> Self {
        Self {
            config: config.clone(),
            known: Mutex::default(),
        }
    }

    fn known(&self) -> MutexGuard<'_, Known> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Where numbers and lines of a program are, by its generation; `None` if it was given up.
    pub(super) fn shown(&self, generation: u64) -> Option<Arc<Shown>> {
        let known = self.known();
        let mut all = known.of_seat.iter().chain(&known.of_others);
        let found = all.find(|it| it.shown.generation() == generation);
        found.map(|it| Arc::clone(&it.shown))
    }

    /// What is known of a program so far. `set_up` counts the changes of what is kept.
    ///
    /// # Errors
    /// It is asked for again, and was given up.
    pub(super) fn object(
        &self,
        (file, name): (&Path, &str),
        set_up: u64,
        (looker, look): (Looker, Look),
    ) -> Result<Value, GivenUp> {
        let about = file.metadata().ok();
        let stamp = Stamp {
            name: name.to_owned(),
            bytes: about.as_ref().map_or(0, std::fs::Metadata::len),
            changed: about.and_then(|about| about.modified().ok()),
            set_up,
        };
        let mut known = self.known();
        let (before, place) = known.take(name, looker);
        if before.is_none() && look == Look::Again {
            return Err(GivenUp);
        }
        let is_doubted = (looker, look) == (Looker::Seat, Look::Anew);
        // Whoever chooses it wants it from where the machine stands now.
        let chosen = (look == Look::First).then(|| begins_now(&self.config));
        let is_from_there = |it: &LookedAt| {
            let begins = it.forecast.as_ref().map(Forecast::begins);
            chosen.flatten().is_none_or(|now| begins == Some(now))
        };
        let is_known = |it: &LookedAt| it.stamp == stamp && !is_doubted && is_from_there(it);
        let (looked_at, given_up) = match before {
            Some(it) if is_known(&it) => (it, None),
            before => {
                known.count += 1;
                (self.look_at(file, stamp, known.count), before)
            }
        };
        let object = looked_at.object();
        known.put(looked_at, place);
        let given_up: Vec<LookedAt> = given_up.into_iter().chain(known.beyond()).collect();
        drop(known);
        if !given_up.is_empty() {
            // They end in their own time: at the next line that they read.
            std::thread::spawn(move || drop(given_up));
        }
        Ok(object)
    }

    fn look_at(&self, file: &Path, stamp: Stamp, number: u64) -> LookedAt {
        let shown = Arc::new(Shown::new(Value::Null));
        let board = shown.begin_with(number, &stamp.name);
        board.file(file, PlannedFor::Preview);
        let planned = Planned::new(&self.config, board.clone());
        let (forecast, reading) =
            match Forecast::start(file, &self.config, PlannedFor::Preview, planned) {
                Ok(forecast) => {
                    board.text(forecast.lines());
                    let reading = planned::read(file, &self.config, forecast.begins(), board);
                    (Some(forecast), Some(reading))
                }
                Err(failure) => {
                    board.trouble(&failure.to_string());
                    (None, None)
                }
            };
        LookedAt {
            stamp,
            shown,
            forecast,
            _reading: reading,
        }
    }
}

/// Where a program that is looked at is remembered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    OfSeat(usize),
    OfOthers,
}

impl Known {
    /// Takes out what is known of a program, and says where it is put again. What others look at leaves those of the
    /// seat in their order.
    fn take(&mut self, name: &str, looker: Looker) -> (Option<LookedAt>, Place) {
        let at = |all: &VecDeque<LookedAt>| all.iter().position(|it| it.stamp.name == name);
        let of_others = at(&self.of_others);
        if let Some(at) = at(&self.of_seat) {
            let place = Place::OfSeat(if looker == Looker::Seat { 0 } else { at });
            return (self.of_seat.remove(at), place);
        }
        let place = match looker {
            Looker::Seat => Place::OfSeat(0),
            Looker::Other => Place::OfOthers,
        };
        (of_others.and_then(|at| self.of_others.remove(at)), place)
    }

    fn put(&mut self, looked_at: LookedAt, place: Place) {
        match place {
            Place::OfSeat(at) => self.of_seat.insert(at, looked_at),
            Place::OfOthers => self.of_others.push_front(looked_at),
        }
    }

    /// Takes out what is not remembered any more.
    fn beyond(&mut self) -> impl Iterator<Item = LookedAt> + use<> {
        let of_seat = beyond(&mut self.of_seat, MOST_OF_SEAT);
        let of_others = beyond(&mut self.of_others, MOST_OF_OTHERS);
        of_seat.into_iter().chain(of_others)
    }
}

fn beyond(all: &mut VecDeque<LookedAt>, most: usize) -> VecDeque<LookedAt> {
    let mut bytes = 0;
    let too_long = all.iter().position(|it| {
        let before = bytes;
        bytes += it.bytes();
        before > 0 && bytes > MOST_TEXT
    });
    let keep = too_long.unwrap_or(most).min(most);
    all.split_off(keep.min(all.len()))
}

impl LookedAt {
    fn bytes(&self) -> usize {
        let forecast = self.forecast.as_ref();
        forecast.map_or(0, |forecast| forecast.lines().bytes())
    }

    fn object(&self) -> Value {
        let forecast = self.forecast.as_ref();
        let mut object = self.shown.object();
        object["seconds"] = forecast.and_then(Forecast::planned_t).into();
        object["planned_so_far_s"] = forecast.map_or(0.0, Forecast::so_far_t).into();
        // In a text: numbers of pages are exact up to 2⁵³ only.
        let fingerprint = forecast.and_then(Forecast::fingerprint);
        object["fingerprint"] = fingerprint.map(|it| format!("{it:016x}")).into();
        object
    }
}

#[cfg(test)]
mod tests;
