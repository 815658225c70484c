//! The jobs that the machine has had since the page is served, whoever wanted them.

use glidepath_link::{EndOfEpoch, JobStage, Power, Status};
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::ops::RangeInclusive;
use std::time::{SystemTime, UNIX_EPOCH};

/// Jobs that are remembered.
const KEPT: usize = 100;

#[derive(Debug)]
struct Entry {
    number: u64,
    /// The epochs of the job so far.
    first_epoch: u64,
    epoch: u64,
    /// The fingerprint of its program, 0 if it has none.
    program: u64,
    /// The least and the largest override of feed and of rapids while it went on.
    overrides: [[f64; 2]; 2],
    /// The largest following error, mm or degrees; `None` where nobody says.
    following: Option<f64>,
    name: String,
    begun_ms: u64,
    /// How it ended, when, and at which line; `None` while it goes on.
    end: Option<(&'static str, u64, u32)>,
}

/// A job that has just ended, as far as its status told of it.
#[derive(Debug, PartialEq)]
pub(super) struct Ended {
    pub(super) number: u64,
    pub(super) epochs: RangeInclusive<u64>,
    pub(super) certificate: Value,
}

/// The jobs, the last one first.
#[derive(Debug, Default)]
pub(super) struct Day {
    entries: VecDeque<Entry>,
}

impl Day {
    /// Looks what is new. `name` is that of the program, where it is known. Returns a job whose end was seen just now.
    pub(super) fn take(
        &mut self,
        status: &Status,
        name: Option<&str>,
        now_ms: u64,
    ) -> Option<Ended> {
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
                first_epoch: status.epoch,
                epoch: status.epoch,
                program: status.program,
                overrides: [status.feed_override, status.rapid_override].map(|it| [it; 2]),
                following: None,
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
        let last = self.entries.front_mut().filter(|last| last.end.is_none())?;
        if last.number == status.job_number && stage == Ok(JobStage::Begun) {
            last.look(status);
            if let Some(name) = name {
                name.clone_into(&mut last.name);
            }
            return None;
        }
        // Of a job whose end was not seen nothing is told.
        let end = if last.epoch == status.epoch {
            status.end_of_epoch().map_or("over", end_word)
        } else {
            "over"
        };
        last.end = Some((end, now_ms, status.line));
        Some(last.ended())
    }

    pub(super) fn object(&self) -> Value {
        let object = |entry: &Entry| {
            json!({
                "number": format!("{:016x}", entry.number),
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

impl Entry {
    /// Looks how the job goes on.
    fn look(&mut self, status: &Status) {
        (self.epoch, self.program) = (status.epoch, status.program);
        let now = [status.feed_override, status.rapid_override];
        for (range, now) in self.overrides.iter_mut().zip(now) {
            *range = [range[0].min(now), range[1].max(now)];
        }
        if status.power() != Ok(Power::Simulated) {
            let errors = status.following_error.iter().map(|error| error.abs());
            let most = errors.fold(self.following.unwrap_or(0.0), f64::max);
            self.following = Some(most);
        }
    }

    fn ended(&self) -> Ended {
        let (end, ended_ms, line) = self.end.unwrap_or_default();
        let [feed, rapid] = self.overrides;
        Ended {
            number: self.number,
            epochs: self.first_epoch..=self.epoch,
            certificate: json!({
                "name": self.name,
                "program": (self.program != 0).then(|| format!("{:016x}", self.program)),
                "begun_ms": self.begun_ms,
                "ended_ms": ended_ms,
                "end": end,
                "line": line,
                "feed_override": feed,
                "rapid_override": rapid,
                "following_mm": self.following,
            }),
        }
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
        let _end = day.take(&status(1, JobStage::Preparing, EndOfEpoch::None), None, 5);
        assert_eq!(day.object(), json!([]), "nothing has moved");
        let _end = day.take(&status(1, JobStage::Begun, EndOfEpoch::Open), None, 10);
        assert_eq!(day.object()[0]["end"], Value::Null);
        let _end = day.take(&status(1, JobStage::Over, EndOfEpoch::Completed), None, 30);
        assert_eq!(
            day.object()[0],
            json!({
                "number": "0000000000000001",
                "name": "mdi G0 X1",
                "begun_ms": 10,
                "end": "done",
                "ended_ms": 30,
                "line": 12,
            })
        );
        let _end = day.take(
            &status(2, JobStage::Begun, EndOfEpoch::Open),
            Some("part.ngc"),
            40,
        );
        let _end = day.take(&status(2, JobStage::Over, EndOfEpoch::Aborted), None, 50);
        let _end = day.take(&status(2, JobStage::Over, EndOfEpoch::Aborted), None, 60);
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
        let _end = day.take(&status(1, JobStage::Begun, EndOfEpoch::Open), None, 10);
        let _end = day.take(&status(3, JobStage::Begun, EndOfEpoch::Open), None, 20);
        let _end = day.take(&status(3, JobStage::Over, EndOfEpoch::Faulted), None, 30);
        let jobs = day.object();
        assert_eq!(
            (&jobs[0]["end"], &jobs[1]["end"]),
            (&"fault".into(), &"over".into())
        );
    }

    #[test]
    fn a_job_that_ends_is_told_with_what_it_was_like() {
        let mut day = Day::default();
        let mut now = status(3, JobStage::Begun, EndOfEpoch::Open);
        (now.feed_override, now.rapid_override, now.program) = (1.0, 1.0, 0xabc);
        now.power = Power::On.code();
        assert_eq!(day.take(&now, Some("part.ngc"), 10), None);
        (now.feed_override, now.epoch, now.following_error[1]) = (0.5, 4, -0.02);
        assert_eq!(day.take(&now, Some("part.ngc"), 20), None);
        (now.feed_override, now.following_error[1]) = (0.8, 0.01);
        (now.job_stage, now.end_of_epoch) = (JobStage::Over.code(), EndOfEpoch::Completed.code());
        let ended = day.take(&now, Some("part.ngc"), 30).unwrap();
        assert_eq!((ended.number, ended.epochs), (3, 3..=4));
        let told = ended.certificate;
        assert_eq!(told["feed_override"], json!([0.5, 1.0]));
        assert_eq!(
            (&told["following_mm"], &told["end"]),
            (&0.02.into(), &"done".into())
        );
        assert_eq!(told["program"], "0000000000000abc");
        assert_eq!(
            day.take(&now, Some("part.ngc"), 40),
            None,
            "it is told once"
        );
    }
}
