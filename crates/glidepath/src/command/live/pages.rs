//! What pages ask for, and what they command.

use super::shown::Shown;
use crate::command::operator::PATIENCE;
use crate::machine_options::complete;
use glidepath_link::{Command, CommandRequest, LinkConfig, LinkError, Operator, refused};
use glidepath_live::{Answer, ContentType, Site, Status};
use serde::Deserialize;
use serde_json::{Value, json};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Lines that are given out at once.
const MOST_LINES: usize = 500;

/// What the server gives out.
pub(super) struct Pages {
    shown: Arc<Shown>,
    link: LinkConfig,
    commands: bool,
    number: AtomicU64,
}

/// A command as a page sends it. There is no kind that moves axes by hand, brings them home, or gives
/// power.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    kind: Kind,
    value: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Kind {
    Hold,
    Resume,
    Step,
    Abort,
    FeedOverride,
    RapidOverride,
}

impl Asked {
    fn command(&self) -> Option<Command> {
        Some(match (&self.kind, self.value) {
            (Kind::Hold, None) => Command::Hold,
            (Kind::Resume, None) => Command::Resume,
            (Kind::Step, None) => Command::Step,
            (Kind::Abort, None) => Command::Abort,
            (Kind::FeedOverride, Some(ratio @ -2.0..=2.0)) => Command::FeedOverride(ratio),
            (Kind::RapidOverride, Some(ratio @ 0.0..=1.0)) => Command::RapidOverride(ratio),
            _ => return None,
        })
    }
}

impl Pages {
    pub(super) const fn new(shown: Arc<Shown>, link: LinkConfig, commands: bool) -> Self {
        Self {
            shown,
            link,
            commands,
            number: AtomicU64::new(0),
        }
    }

    /// The state in which the command was accepted, or why it was not.
    fn send(&self, command: Command) -> Result<&'static str, (Status, String)> {
        let number = self.number.fetch_add(1, Ordering::Relaxed);
        let request = CommandRequest::new(u64::from(std::process::id()), number, command);
        let unavailable = |error: LinkError| (Status::Unavailable, error.to_string());
        let operator = Operator::find(&self.link).map_err(unavailable)?;
        let reply = operator.call(&request, PATIENCE).map_err(unavailable)?;
        let silent = || {
            let text = "the interpolator lives and does not answer".to_owned();
            (Status::Unavailable, text)
        };
        let reply = reply.ok_or_else(silent)?;
        let broken = |error| unavailable(LinkError::from(error));
        let state = reply.state().map_err(broken)?.name();
        match reply.outcome().map_err(broken)? {
            Ok(()) => Ok(state),
            Err(refusal) => {
                let told = refused(command.kind().name(), &reply.why(refusal));
                Err((Status::Conflict, complete(&told)))
            }
        }
    }
}

impl Site for Pages {
    fn document(&self, path: &str, query: &str) -> Option<Answer> {
        let numbers = |bytes| Answer::new(ContentType::Binary, bytes);
        let number = |name: &str| parameter(query, name)?.parse::<u64>().ok();
        match path {
            "/api/plan" => Some(object(&self.shown.object())),
            "/api/program.bin" => self.shown.program_path(number("of")?).map(numbers),
            "/api/columns.bin" => self.shown.columns(number("of")?).map(numbers),
            "/api/path.bin" => self.shown.path(number("of")?).map(numbers),
            "/api/lines" => {
                let count = |name| usize::try_from(number(name)?).ok();
                let (from, count) = (count("from")?, count("count")?.min(MOST_LINES));
                let lines = self.shown.lines(number("of")?, from, count)?;
                Some(object(&lines))
            }
            _ => None,
        }
    }

    fn command(&self, body: &[u8]) -> Answer {
        let done = if self.commands {
            let asked = serde_json::from_slice::<Asked>(body).ok();
            match asked.and_then(|asked| asked.command()) {
                Some(command) => self.send(command),
                None => Err((
                    Status::BadRequest,
                    "no such command, or its value is out of range".to_owned(),
                )),
            }
        } else {
            let text = "this page only shows: it was started without --commands".to_owned();
            Err((Status::Forbidden, text))
        };
        match done {
            Ok(state) => object(&json!({ "accepted": true, "state": state })),
            Err((status, reason)) => {
                object(&json!({ "accepted": false, "reason": reason })).with(status)
            }
        }
    }
}

/// A parameter of a query.
fn parameter<'q>(query: &'q str, name: &str) -> Option<&'q str> {
    let mut pairs = query.split('&').filter_map(|pair| pair.split_once('='));
    pairs.find(|(key, _)| *key == name).map(|(_, value)| value)
}

fn object(value: &Value) -> Answer {
    Answer::new(ContentType::Json, value.to_string().into_bytes())
}
