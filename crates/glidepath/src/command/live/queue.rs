//! The queue of programs that a person starts one after the other: between two of them somebody changes the part.
//!
//! Nothing here begins anything. The first one is what the page that operates offers to start; it leaves the queue when
//! it ended well, and stays, with what became of it, when it did not.

use super::job_submitter::{Handed, JobSubmitter};
use serde_json::{Value, json};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Programs that wait at most.
const MOST: usize = 50;

/// Why the queue stays as it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub(super) enum QueueError {
    #[error("the queue has {MOST} programs, and takes no more: remove some")]
    Full,
    #[error("it is not in the queue any more")]
    NotThere,
    #[error("it runs: it leaves the queue when it has ended")]
    Runs,
    #[error("another one is the first of the queue: move it up, or start that")]
    NotFirst,
    #[error("it is in the queue with another tolerance")]
    OtherTolerance,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum State {
    Waits,
    /// It runs, or is about to, as a job of the pages.
    Runs(u64),
    /// It ended, and not well.
    Ended(String),
}

#[derive(Debug)]
struct Entry {
    id: u64,
    name: String,
    /// How many times its tolerance it may use.
    tolerance_ratio: f64,
    state: State,
}

#[derive(Debug, Default)]
struct Known {
    count: u64,
    entries: Vec<Entry>,
}

impl Known {
    fn at(&self, id: u64) -> Result<usize, QueueError> {
        let at = self.entries.iter().position(|entry| entry.id == id);
        at.ok_or(QueueError::NotThere)
    }

    /// Where one is that does not run.
    fn waiting(&self, id: u64) -> Result<usize, QueueError> {
        let at = self.at(id)?;
        let runs = self.entries.get(at).is_some_and(Entry::runs);
        if runs { Err(QueueError::Runs) } else { Ok(at) }
    }
}

impl Entry {
    const fn runs(&self) -> bool {
        matches!(self.state, State::Runs(_))
    }
}

/// The queue of all pages.
#[derive(Debug, Default)]
pub(super) struct Queue(Mutex<Known>);

impl Queue {
    fn known(&self) -> MutexGuard<'_, Known> {
        // The list is whole, whoever panicked.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Puts a program at its end.
    pub(super) fn add(&self, name: String, tolerance_ratio: f64) -> Result<u64, QueueError> {
        let mut known = self.known();
        if known.entries.len() >= MOST {
            return Err(QueueError::Full);
        }
        known.count += 1;
        let id = known.count;
        known.entries.push(Entry {
            id,
            name,
            tolerance_ratio,
            state: State::Waits,
        });
        Ok(id)
    }

    /// Puts a program before or behind others. The one that runs stays the first.
    pub(super) fn put(&self, id: u64, to: usize) -> Result<(), QueueError> {
        let mut known = self.known();
        let at = known.waiting(id)?;
        let first = usize::from(known.entries.first().is_some_and(Entry::runs));
        let entry = known.entries.remove(at);
        let to = to.clamp(first, known.entries.len());
        known.entries.insert(to, entry);
        Ok(())
    }

    pub(super) fn remove(&self, id: u64) -> Result<(), QueueError> {
        let mut known = self.known();
        let at = known.waiting(id)?;
        known.entries.remove(at);
        Ok(())
    }

    /// Whether this program, the first of the queue, may be started from it.
    pub(super) fn may_start(
        &self,
        id: u64,
        name: &str,
        tolerance_ratio: f64,
    ) -> Result<(), QueueError> {
        let known = self.known();
        let at = known.waiting(id)?;
        let entry = known.entries.get(at).filter(|entry| entry.name == name);
        match (at, entry) {
            (0, Some(entry)) if entry.tolerance_ratio.to_bits() == tolerance_ratio.to_bits() => {
                Ok(())
            }
            (0, Some(_)) => Err(QueueError::OtherTolerance),
            (0, None) => Err(QueueError::NotThere),
            _ => Err(QueueError::NotFirst),
        }
    }

    /// It runs as a job of the pages.
    pub(super) fn started(&self, id: u64, job: u64) {
        let mut known = self.known();
        if let Some(entry) = known.entries.iter_mut().find(|entry| entry.id == id) {
            entry.state = State::Runs(job);
        }
    }

    /// Looks what has become of the one that runs.
    pub(super) fn look(&self, jobs: &JobSubmitter) {
        let mut known = self.known();
        known.entries.retain_mut(|entry| {
            let State::Runs(job) = entry.state else {
                return true;
            };
            let words = match jobs.end(job) {
                Some(None | Some(Handed::Running)) => return true,
                Some(Some(Handed::Done(_))) => return false,
                Some(Some(Handed::Not(text) | Handed::Changed(text) | Handed::ToConfirm(text))) => {
                    text
                }
                None => "nobody knows how it ended".to_owned(),
            };
            entry.state = State::Ended(words);
            true
        });
    }

    pub(super) fn object(&self) -> Value {
        let known = self.known();
        let object = |entry: &Entry| {
            let (state, text) = match &entry.state {
                State::Waits => ("waits", ""),
                State::Runs(_) => ("runs", ""),
                State::Ended(text) => ("ended", text.as_str()),
            };
            json!({
                "id": entry.id,
                "name": entry.name,
                "tolerance_ratio": entry.tolerance_ratio,
                "state": state,
                "text": text,
            })
        };
        known.entries.iter().map(object).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(queue: &Queue) -> Vec<String> {
        let told = queue.object();
        let name = |entry: &Value| entry["name"].as_str().unwrap().to_owned();
        told.as_array().unwrap().iter().map(name).collect()
    }

    #[test]
    fn a_queue_is_put_in_order_and_only_its_first_is_started() {
        let queue = Queue::default();
        let ids = ["a", "b", "c"].map(|name| queue.add(name.to_owned(), 1.0).unwrap());
        queue.put(ids[2], 0).unwrap();
        assert_eq!(names(&queue), ["c", "a", "b"]);
        queue.put(ids[2], 99).unwrap();
        assert_eq!(names(&queue), ["a", "b", "c"]);
        assert_eq!(queue.may_start(ids[1], "b", 1.0), Err(QueueError::NotFirst));
        assert_eq!(queue.may_start(ids[0], "b", 1.0), Err(QueueError::NotThere));
        let other = Err(QueueError::OtherTolerance);
        assert_eq!(queue.may_start(ids[0], "a", 2.0), other);
        assert_eq!(queue.may_start(ids[0], "a", 1.0), Ok(()));
        // What runs stays where it is, and is not started again.
        queue.started(ids[0], 7);
        assert_eq!(queue.may_start(ids[0], "a", 1.0), Err(QueueError::Runs));
        assert_eq!(queue.remove(ids[0]), Err(QueueError::Runs));
        assert_eq!(queue.put(ids[0], 2), Err(QueueError::Runs));
        queue.put(ids[2], 0).unwrap();
        assert_eq!(names(&queue), ["a", "c", "b"]);
        queue.remove(ids[2]).unwrap();
        assert_eq!(queue.remove(ids[2]), Err(QueueError::NotThere));
        assert_eq!(names(&queue), ["a", "b"]);
    }

    #[test]
    fn a_queue_is_bounded() {
        let queue = Queue::default();
        for number in 0..MOST {
            assert!(queue.add(number.to_string(), 1.0).is_ok());
        }
        assert_eq!(queue.add("more".to_owned(), 1.0), Err(QueueError::Full));
    }
}
