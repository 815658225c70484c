//! The jobs that the machine has had since the page is served, whoever wanted them.

use glidepath_link::{EndOfEpoch, JobStage, Status};
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::time::{SystemTime, UNIX_EPOCH};

/// Jobs that are remembered.
const KEPT: usize = 100;

#[derive(Debug)]
struct Entry {
    number: u64,
    epoch: u64,
    name: String,
    begun_ms: u64,
    /// How it ended, when, and at which line; `None` while it goes on.
    end: Option<(&'static str, u64, u32)>,
}

/// The jobs, the last one first.
#[derive(Debug, Default)]
pub(super) struct Day {
    entries: VecDeque<Entry>,
}

impl Day {
    /// Looks what is new. `name` is that of the program, where it is known.
    pub(super) fn take(&mut self, status: &Status, name: Option<&str>, now_ms: u64) {
        let stage = status.job_stage();
        let is_new = self
            .entries
            .front()
            .is_none_or(|last| last.number != status.job_number);
        if is_new && status.job_number != 0 && stage == Ok(JobStage::Begun) {
            if let Some(last) = self.entries.front_mut() {
                // Its end was not seen.
                last.end.get_or_insert(("over", now_ms, 0));
            }
            self.entries.push_front(Entry {
                number: status.job_number,
                epoch: status.epoch,
                name: status
                    .job
                    .as_str()
                    .split(": ")
                    .next()
                    .unwrap_or_default()
                    .to_owned(),
                begun_ms: now_ms,
                end: None,
            });
            self.entries.truncate(KEPT);
        }
        let Some(last) = self.entries.front_mut().filter(|last| last.end.is_none()) else {
            return;
        };
        if last.number == status.job_number && stage == Ok(JobStage::Begun) {
            last.epoch = status.epoch;
            if let Some(name) = name {
                name.clone_into(&mut last.name);
            }
            return;
        }
        // Of a job whose end was not seen nothing is told.
        let end = if last.epoch == status.epoch {
            status.end_of_epoch().map_or("over", end_word)
        } else {
            "over"
        };
        last.end = Some((end, now_ms, status.line));
    }

    pub(super) fn object(&self) -> Value {
        let object = |entry: &Entry| {
            json!({
                "name": entry.name,
                "begun_ms": entry.begun_ms,
                "end": entry.end.map(|(end, ..)| end),
                "ended_ms": entry.end.map(|(_, at, _)| at),
                "line": entry.end.map(|(.., line)| line),
            })
        };
        self.entries.iter().map(object).collect()
    }
}

/// How a job ended, by how its epoch did.
const fn end_word(end: EndOfEpoch) -> &'static str {
    match end {
        EndOfEpoch::Completed => "done",
        EndOfEpoch::Aborted => "aborted",
        EndOfEpoch::Faulted | EndOfEpoch::Tripped => "fault",
        EndOfEpoch::None | EndOfEpoch::Open => "over",
    }
}

/// The time of day, ms since 1970.
pub(super) fn now_ms() -> u64 {
    #[expect(clippy::disallowed_methods, reason = "a stamp for people")]
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    now.map_or(0, |now| u64::try_from(now.as_millis()).unwrap_or(u64::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn status(number: u64, stage: JobStage, end: EndOfEpoch) -> Status {
        let mut status: Status = bytemuck::Zeroable::zeroed();
        (status.job_number, status.epoch, status.line) = (number, number, 12);
        (status.job_stage, status.end_of_epoch) = (stage.code(), end.code());
        status.job = glidepath_link::Text::new("mdi G0 X1: is executed");
        status
    }

    #[test]
    fn a_job_is_told_with_its_end() {
        let mut day = Day::default();
        day.take(&status(1, JobStage::Preparing, EndOfEpoch::None), None, 5);
        assert_eq!(day.object(), json!([]), "nothing has moved");
        day.take(&status(1, JobStage::Begun, EndOfEpoch::Open), None, 10);
        assert_eq!(day.object()[0]["end"], Value::Null);
        day.take(&status(1, JobStage::Over, EndOfEpoch::Completed), None, 30);
        assert_eq!(
            day.object()[0],
            json!({ "name": "mdi G0 X1", "begun_ms": 10, "end": "done", "ended_ms": 30, "line": 12 })
        );
        day.take(
            &status(2, JobStage::Begun, EndOfEpoch::Open),
            Some("part.ngc"),
            40,
        );
        day.take(&status(2, JobStage::Over, EndOfEpoch::Aborted), None, 50);
        day.take(&status(2, JobStage::Over, EndOfEpoch::Aborted), None, 60);
        let jobs = day.object();
        assert_eq!(jobs.as_array().unwrap().len(), 2);
        assert_eq!(
            (&jobs[0]["name"], &jobs[0]["end"]),
            (&"part.ngc".into(), &"aborted".into())
        );
        assert_eq!(jobs[0]["ended_ms"], 50);
    }

    #[test]
    fn a_job_whose_end_was_not_seen_is_over() {
        let mut day = Day::default();
        day.take(&status(1, JobStage::Begun, EndOfEpoch::Open), None, 10);
        day.take(&status(3, JobStage::Begun, EndOfEpoch::Open), None, 20);
        day.take(&status(3, JobStage::Over, EndOfEpoch::Faulted), None, 30);
        let jobs = day.object();
        assert_eq!(
            (&jobs[0]["end"], &jobs[1]["end"]),
            (&"fault".into(), &"over".into())
        );
    }
}
