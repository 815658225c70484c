//! The steps of pages, each with the number and the end by which it is told.

use serde_json::{Value, json};
use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Steps that are remembered.
const REMEMBERED: usize = 32;

/// The end of a step.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum StepEnd {
    Done,
    /// It was not done, or not to its end, and why.
    Not(String),
}

/// The steps of the pages, the last one first.
#[derive(Debug, Default)]
pub(super) struct Steps(Mutex<Known>);

#[derive(Debug, Default)]
struct Known {
    count: u64,
    steps: VecDeque<(u64, Option<StepEnd>)>,
}

impl Steps {
    fn known(&self) -> MutexGuard<'_, Known> {
        // The list is whole, whoever panicked.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The number of a new step.
    pub(super) fn begin(&self) -> u64 {
        let mut known = self.known();
        known.count += 1;
        let number = known.count;
        known.steps.push_front((number, None));
        known.steps.truncate(REMEMBERED);
        number
    }

    pub(super) fn end(&self, number: u64, end: StepEnd) {
        let mut known = self.known();
        let mut steps = known.steps.iter_mut();
        if let Some((_, slot)) = steps.find(|(of, _)| *of == number) {
            *slot = Some(end);
        }
    }

    /// Ends all that are under way.
    pub(super) fn end_all(&self, end: &StepEnd) {
        for (_, slot) in &mut self.known().steps {
            slot.get_or_insert_with(|| end.clone());
        }
    }

    pub(super) fn object(&self) -> Value {
        let known = self.known();
        let object = |(number, end): &(u64, Option<StepEnd>)| {
            let (state, text) = match end {
                None => ("under-way", ""),
                Some(StepEnd::Done) => ("done", ""),
                Some(StepEnd::Not(why)) => ("not", why.as_str()),
            };
            json!({ "number": number, "state": state, "text": text })
        };
        known.steps.iter().map(object).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_step_has_a_number_and_an_end_of_its_own() {
        let steps = Steps::default();
        let (first, second) = (steps.begin(), steps.begin());
        steps.end(second, StepEnd::Done);
        steps.end(first, StepEnd::Not("why".to_owned()));
        let told = steps.object();
        assert_eq!(
            told[0],
            json!({ "number": second, "state": "done", "text": "" })
        );
        assert_eq!(
            told[1],
            json!({ "number": first, "state": "not", "text": "why" })
        );
        for _ in 0..100 {
            let _number = steps.begin();
        }
        assert_eq!(steps.object().as_array().unwrap().len(), REMEMBERED);
    }
}
