//! Answers to "what if": how long a program would take with another tolerance, jerk or feed. Nothing of it runs.
//!
//! One is planned at a time for the operator's seat, and one for all other pages, so that nobody who only looks takes
//! anything from who operates. What is known is remembered, as long as the file and what is kept of the machine are
//! the same.

use super::preview::Looker;
use super::shown::File;
use crate::command::changed::Change;
use crate::command::forecast::{Forecast, Spectator};
use crate::config::MachineConfig;
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;

/// Answers that are remembered.
const REMEMBERED: usize = 64;

/// What is asked: of a file as it is, with what is kept of the machine, and with something changed.
#[derive(Debug, Clone, PartialEq)]
struct Question {
    file: File,
    bytes: u64,
    changed: Option<SystemTime>,
    set_up: u64,
    change: Change,
}

/// The answer: seconds, or why there are none.
type Answer = Result<f64, String>;

struct UnderWay {
    question: Question,
    forecast: Forecast,
    trouble: Arc<Mutex<Option<String>>>,
}

#[derive(Default)]
struct Known {
    answers: VecDeque<(Question, Answer)>,
    of_seat: Option<UnderWay>,
    of_others: Option<UnderWay>,
}

/// What would be.
pub(super) struct WhatIf {
    config: MachineConfig,
    known: Mutex<Known>,
}

/// Keeps why a plan ended early.
struct Trouble(Arc<Mutex<Option<String>>>);

impl Spectator for Trouble {
    fn end(&mut self, trouble: Option<&str>) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = trouble.map(str::to_owned);
    }
}

impl WhatIf {
    pub(super) fn new(config: &MachineConfig) -> Self {
        Self {
            config: config.clone(),
            known: Mutex::default(),
        }
    }

    /// How long it takes, as far as that is known: planning begins with the first question, and ends with another one.
    pub(super) fn object(&self, looker: Looker, file: &File, change: Change, set_up: u64) -> Value {
        let about = file.path.metadata().ok();
        let question = Question {
            file: file.clone(),
            bytes: about.as_ref().map_or(0, std::fs::Metadata::len),
            changed: about.and_then(|about| about.modified().ok()),
            set_up,
            change,
        };
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let answered = known.answers.iter().find(|(of, _)| *of == question);
        if let Some((_, answer)) = answered {
            return told(answer);
        }
        let place = known.place(looker);
        if place.as_ref().is_none_or(|it| it.question != question) {
            let (before, now) = (place.take(), self.begin(&question));
            // It ends in its own time: at the next line that it reads.
            std::thread::spawn(move || drop(before));
            match now {
                Ok(now) => *place = Some(now),
                Err(why) => return known.answer(question, Err(why)),
            }
        }
        let Some(under_way) = place else {
            return Value::Null;
        };
        if let Some(answer) = under_way.answer() {
            let over = place.take();
            std::thread::spawn(move || drop(over));
            return known.answer(question, answer);
        }
        json!({ "seconds": Value::Null, "so_far_s": under_way.forecast.so_far_t(), "failed": Value::Null })
    }

    fn begin(&self, question: &Question) -> Result<UnderWay, String> {
        let trouble = Arc::<Mutex<Option<String>>>::default();
        let File { path, planned_for } = &question.file;
        let change = question.change;
        let watched = Trouble(Arc::clone(&trouble));
        let forecast = Forecast::changed(path, &self.config, *planned_for, change, watched);
        Ok(UnderWay {
            question: question.clone(),
            forecast: forecast.map_err(|failure| failure.to_string())?,
            trouble,
        })
    }
}

impl Known {
    const fn place(&mut self, looker: Looker) -> &mut Option<UnderWay> {
        match looker {
            Looker::Seat => &mut self.of_seat,
            Looker::Other => &mut self.of_others,
        }
    }

    fn answer(&mut self, question: Question, answer: Answer) -> Value {
        let object = told(&answer);
        self.answers.push_front((question, answer));
        self.answers.truncate(REMEMBERED);
        object
    }
}

impl UnderWay {
    /// `None` as long as it is planned.
    fn answer(&self) -> Option<Answer> {
        let trouble = self.trouble.lock().unwrap_or_else(PoisonError::into_inner);
        let failed = trouble.clone().map(Err);
        failed.or_else(|| self.forecast.planned_t().map(Ok))
    }
}

fn told(answer: &Answer) -> Value {
    json!({ "seconds": answer.as_ref().ok(), "so_far_s": answer.as_ref().ok(), "failed": answer.as_ref().err() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::command::forecast::PlannedFor;
    use std::time::{Duration, Instant};

    struct Desk {
        what_if: WhatIf,
        place: tempfile::TempDir,
    }

    impl Desk {
        fn new() -> Self {
            let place = tempfile::tempdir().unwrap();
            let corners = "G1 X20\nY20\nX0\nY0\n".repeat(3);
            let text = format!("G21 G90 G64 F6000\n{corners}M2\n");
            std::fs::write(place.path().join("a"), text).unwrap();
            std::fs::write(place.path().join("wrong"), "G21 G90\nG1 X5 Q\n").unwrap();
            Self {
                what_if: WhatIf::new(&crate::config::load(None).unwrap()),
                place,
            }
        }

        fn file(&self, name: &str) -> File {
            let path = self.place.path().join(name);
            let planned_for = PlannedFor::Preview;
            File { path, planned_for }
        }

        fn answer(&self, looker: Looker, name: &str, change: Change) -> Value {
            let (file, begun) = (self.file(name), Instant::now());
            loop {
                let told = self.what_if.object(looker, &file, change, 1);
                if told["seconds"].is_number() || told["failed"].is_string() {
                    return told;
                }
                assert!(begun.elapsed() < Duration::from_secs(60), "{told}");
                std::thread::sleep(Duration::from_millis(5));
            }
        }

        fn seconds(&self, change: Change) -> f64 {
            self.answer(Looker::Seat, "a", change)["seconds"]
                .as_f64()
                .unwrap()
        }
    }

    #[test]
    fn more_tolerance_jerk_and_feed_take_less_time() {
        let desk = Desk::new();
        let none = desk.seconds(Change::NONE);
        // Twelve sides of 20 mm at 100 mm/s take no less than that.
        assert!(none > 2.4, "{none}");
        for change in [
            Change {
                tolerance: 4.0,
                ..Change::NONE
            },
            Change {
                jerk: 2.0,
                ..Change::NONE
            },
            Change {
                feed: 1.5,
                ..Change::NONE
            },
        ] {
            let changed = desk.seconds(change);
            assert!(changed < none - 0.01, "{change:?}: {changed} of {none}");
        }
        let less = desk.seconds(Change {
            tolerance: 0.25,
            ..Change::NONE
        });
        assert!(less > none + 0.01, "{less} of {none}");
        // What is known is known at once.
        let known = desk
            .what_if
            .object(Looker::Other, &desk.file("a"), Change::NONE, 1);
        assert_eq!(
            known["seconds"].as_f64().map(f64::to_bits),
            Some(none.to_bits())
        );
    }

    #[test]
    fn others_take_nothing_from_the_seat_and_what_is_wrong_is_said() {
        let desk = Desk::new();
        let feed = |feed| Change {
            feed,
            ..Change::NONE
        };
        let ask = |looker, change| desk.what_if.object(looker, &desk.file("a"), change, 1);
        let _begun = ask(Looker::Seat, feed(1.1));
        let _begun = ask(Looker::Other, feed(1.2));
        let known = desk.what_if.known.lock().unwrap();
        let is_planned = |place: &Option<UnderWay>, change| {
            let is_answered = known.answers.iter().any(|(of, _)| of.change == change);
            is_answered
                || place
                    .as_ref()
                    .is_some_and(|it| it.question.change == change)
        };
        assert!(is_planned(&known.of_seat, feed(1.1)));
        assert!(is_planned(&known.of_others, feed(1.2)));
        drop(known);
        let wrong = desk.answer(Looker::Seat, "wrong", Change::NONE);
        assert!(
            wrong["failed"].as_str().unwrap().contains("line 2"),
            "{wrong}"
        );
    }
}
