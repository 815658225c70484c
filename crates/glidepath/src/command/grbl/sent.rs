//! The way of senders' lines to the planner's service.

use crate::command::failure::Failure;
use crate::command::jobs::client;
use glidepath_geometry::AXES;
use glidepath_grbl::{End, Facts, JobIntent, Refused, Request, Session, Stage, Told};
use glidepath_link::{
    Client, Ipc, LinesReply, LinesRequest, LinesState, LinesWish, LinkError, LongText, Record as _,
    Text, Transport as _,
};
use std::time::Duration;

/// Between two questions while no line is executed.
const ASK_EVERY: Duration = Duration::from_millis(200);
/// How long a service may take to start.
const START_PATIENCE: Duration = Duration::from_secs(2);
/// How long the service may take for an answer.
const PATIENCE: Duration = Duration::from_secs(3);

type Port = Box<dyn Client<LinesRequest, LinesReply>>;

/// The way to the planner's service, and what it told last.
pub(super) struct Sent {
    port: Option<Port>,
    client: u64,
    ahead_t: f64,
    /// Since when an answer is waited for.
    asked: Option<Duration>,
    next: Duration,
    /// Since when there is no service.
    missed: Option<Duration>,
    /// It has answered since.
    has_heard: bool,
    zero: [f64; AXES],
}

impl Sent {
    pub(super) fn new(ahead_t: f64) -> Self {
        Self {
            port: None,
            client: client(),
            ahead_t,
            asked: None,
            next: Duration::ZERO,
            missed: None,
            has_heard: false,
            zero: [0.0; AXES],
        }
    }

    /// Where the zero of programs is for what is executed now.
    pub(super) const fn zero(&self) -> [f64; AXES] {
        self.zero
    }

    /// Takes answers, and asks when it is time to.
    pub(super) fn turn(&mut self, transport: &Ipc, session: &mut Session, now: Duration) {
        if let Err(error) = self.try_turn(transport, session, now) {
            (self.port, self.asked) = (None, None);
            self.next = now + ASK_EVERY;
            let why = match error {
                LinkError::NoServer { .. } => Failure::NoService.to_string(),
                error => error.to_string(),
            };
            // It may have been started just now.
            let missed = *self.missed.get_or_insert(now);
            if self.has_heard || now.saturating_sub(missed) >= START_PATIENCE {
                self.has_heard = false;
                session.service_lost(&why, now);
            }
        }
    }

    fn try_turn(
        &mut self,
        transport: &Ipc,
        session: &mut Session,
        now: Duration,
    ) -> Result<(), LinkError> {
        let port = match &mut self.port {
            Some(port) => port,
            slot => slot.insert(transport.lines_client()?),
        };
        while let Some(reply) = port.reply()? {
            reply.check()?;
            (self.asked, self.missed, self.has_heard) = (None, None, true);
            if reply.client == self.client {
                self.zero = reply.zero;
                session.told(&told(&reply)?, now);
            }
        }
        if self.missed.is_some() && now < self.next {
            return Ok(());
        }
        if let Some(asked) = self.asked {
            if now.saturating_sub(asked) < PATIENCE {
                return Ok(());
            }
            let service = "glidepath/lines";
            return Err(LinkError::NoServer { service });
        }
        if !session.is_urgent() && now < self.next {
            return Ok(());
        }
        let request = session.request();
        let record = LinesRequest {
            client: self.client,
            number: request.job,
            asked_ns: request.asked_ns,
            first: request.first,
            ahead_t: self.ahead_t,
            wish: wish(request.wish).code(),
            reserved: 0,
            name: Text::new("lines of a sender"),
            text: LongText::new(&text(&request)),
        };
        port.ask(&record)?;
        (self.asked, self.next) = (Some(now), now + ASK_EVERY);
        Ok(())
    }
}

fn text(request: &Request) -> String {
    let lines = request.lines.iter();
    lines.flat_map(|line| [line.as_str(), "\n"]).collect()
}

const fn wish(wish: JobIntent) -> LinesWish {
    match wish {
        JobIntent::Execute => LinesWish::Execute,
        JobIntent::Ask => LinesWish::Ask,
        JobIntent::Close => LinesWish::Close,
        JobIntent::Cancel => LinesWish::Cancel,
        JobIntent::Reset => LinesWish::Reset,
    }
}

fn told(reply: &LinesReply) -> Result<Told, LinkError> {
    let text = || reply.text.as_str().to_owned();
    let stage = match reply.state()? {
        LinesState::Unknown => Stage::Unknown,
        LinesState::Open => Stage::Open,
        LinesState::Done => Stage::Over(End::Done),
        LinesState::ProgramEnd => Stage::Over(End::ProgramEnd),
        LinesState::NotBegun => Stage::Over(End::NotBegun(text())),
        LinesState::Failed => Stage::Over(End::Failed(text())),
    };
    let refused = (reply.is_refused == 1).then(|| Refused {
        column: reply.refused_column,
        name: reply.diagnostic.as_str().to_owned(),
        text: text(),
        is_in_motion: reply.refused_in_motion == 1,
    });
    Ok(Told {
        job: reply.number,
        stage,
        taken: reply.taken,
        read: reply.read,
        refused,
        ahead_t: reply.ahead_t,
        facts: Facts {
            modes: reply.words.as_str().to_owned(),
            systems: reply.systems,
            references: reply.references,
            shift: reply.shift,
            tool: reply.tool,
            probe: reply.probe,
            probe_made: reply.probe_made == 1,
            probes: reply.probes,
        },
    })
}
