//! Tests of the stream of a sender.

use super::*;

fn told(job: u64, stage: Stage, taken: u64, read: u64) -> Told {
    Told {
        job,
        stage,
        taken,
        read,
        refused: None,
        ahead_t: 0.0,
        facts: Facts::default(),
    }
}

#[test]
fn lines_are_given_until_they_have_come_and_read_once() {
    let mut stream = Stream::default();
    ["a", "b", "c"].iter().for_each(|line| stream.push(line, 7));
    let first = stream.request(true);
    assert_eq!((first.job, first.first, first.lines.len()), (1, 1, 3));
    // The answer was lost: the same again.
    assert_eq!(stream.request(true), first);
    assert_eq!(stream.hear(&told(1, Stage::Open, 2, 1)), [Outcome::Read]);
    let next = stream.request(true);
    assert_eq!((next.first, &next.lines[..]), (3, &["c".to_owned()][..]));
    // An old answer changes nothing.
    assert_eq!(stream.hear(&told(1, Stage::Open, 1, 1)), []);
    let all = stream.hear(&told(1, Stage::Open, 3, 3));
    assert_eq!(all, [Outcome::Read, Outcome::Read]);
    assert_eq!(stream.request(true).wish, JobIntent::Ask);
    stream.hear(&told(1, Stage::Over(End::Done), 3, 3));
    assert!(!stream.is_open());
    assert_eq!(stream.request(true).job, 0);
}

#[test]
fn what_a_job_leaves_is_given_to_the_next() {
    let mut stream = Stream::default();
    ["M2", "G0 X1"].iter().for_each(|line| stream.push(line, 7));
    stream.request(true);
    let outcomes = stream.hear(&told(1, Stage::Over(End::ProgramEnd), 2, 1));
    assert_eq!(outcomes, [Outcome::ProgramEnd, Outcome::Read]);
    assert_eq!(stream.request(false).job, 0);
    let next = stream.request(true);
    assert_eq!((next.job, next.first, next.lines.len()), (2, 1, 1));
    assert_eq!(stream.number(1), 2);
}

#[test]
fn a_job_was_asked_for_when_its_first_line_was_sent() {
    let mut stream = Stream::default();
    stream.push("G0 X1", 1);
    assert_eq!(stream.request(true).asked_ns, 1);
    // It came while the job before had not been told to be over.
    stream.hear(&told(1, Stage::Open, 1, 1));
    stream.push("G0 X2", 2);
    assert_eq!(stream.request(true).asked_ns, 1);
    stream.hear(&told(1, Stage::Over(End::Done), 1, 1));
    stream.push("G0 X3", 3);
    let next = stream.request(true);
    assert_eq!((next.job, next.asked_ns, next.lines.len()), (2, 2, 2));
}

#[test]
fn a_line_that_was_refused_is_told_at_once_and_ends_its_job() {
    let mut stream = Stream::default();
    ["G1 X1", "G999", "G1 X2"]
        .iter()
        .for_each(|line| stream.push(line, 7));
    stream.request(true);
    let refused = Refused {
        column: 1,
        name: "unknown-g-code".to_owned(),
        text: String::new(),
        is_in_motion: true,
    };
    let mut answer = told(1, Stage::Open, 3, 1);
    answer.refused = Some(refused.clone());
    let outcomes = stream.hear(&answer);
    assert_eq!(outcomes, [Outcome::Read, Outcome::Refused(refused)]);
    assert_eq!(stream.hear(&answer), []);
    assert_eq!(stream.request(true).wish, JobIntent::Close);
    answer.stage = Stage::Over(End::Done);
    assert_eq!(stream.hear(&answer), []);
    assert_eq!(stream.request(true).lines, ["G1 X2"]);
}

#[test]
fn a_cancelled_job_says_nothing_more() {
    let mut stream = Stream::default();
    stream.push("G1 X1", 7);
    stream.request(true);
    stream.cancel();
    assert_eq!(stream.request(true).wish, JobIntent::Cancel);
    stream.push("G55", 7);
    let failed = Stage::Over(End::Failed("aborted".to_owned()));
    assert_eq!(stream.hear(&told(1, failed, 1, 0)), []);
    assert_eq!(stream.request(true).lines, ["G55"]);
}
