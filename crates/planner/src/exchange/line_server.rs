//! The line server, where the lines of senders are handed in.

use std::collections::VecDeque;

use glidepath_link::{
    JobWish, LinesReply, LinesRequest, LinesState, LinesWish, LinkError, LongText, Record as _,
    Server, Transport,
};

use crate::source::sent::facts::{Found, LineFacts};
use crate::source::sent::inbox::{LineInbox, LinesEnd, told};

/// Requests served between two looks at the motion.
const REQUESTS_PER_TURN: u32 = 32;
/// Jobs that have ended, and are remembered.
const REMEMBERED: usize = 16;

/// A job and its client.
type Client = (u64, u64);

/// A job that begins with lines that have come.
#[derive(Debug)]
pub(crate) struct SentJob {
    pub(crate) client: Client,
    pub(crate) name: String,
    pub(crate) asked_ns: u64,
    pub(crate) inbox: LineInbox,
}

/// The service at which the lines of senders are handed in.
pub(crate) struct LineServer {
    server: Box<dyn Server<LinesRequest, LinesReply>>,
    known: Known,
    /// Who wants modes and offsets reset.
    wants_reset: Option<Client>,
}

/// What is known while nothing is executed.
#[derive(Debug, Default)]
struct Known {
    facts: LineFacts,
    found: Found,
    /// Jobs that have ended, the last one last.
    past: VecDeque<(Client, LineInbox)>,
    /// The reset that was done last.
    reset: Option<Client>,
}

impl LineServer {
    pub(crate) fn open(transport: &dyn Transport) -> Result<Self, LinkError> {
        Ok(Self {
            server: transport.lines_server()?,
            known: Known::default(),
            wants_reset: None,
        })
    }

    /// How the machine is set up for the next job.
    pub(crate) fn know(&mut self, facts: LineFacts) {
        self.known.facts = facts;
    }

    /// Answers what came in while nothing is executed, and takes a job, if one came.
    pub(crate) fn take(&mut self) -> Result<Option<SentJob>, LinkError> {
        let (known, wants_reset) = (&self.known, &mut self.wants_reset);
        for _ in 0..REQUESTS_PER_TURN {
            let mut begun = None;
            let any = self.server.serve(&mut |request| {
                let begins = request.number > 0
                    && request.wish() == Ok(LinesWish::Execute)
                    && request.check().is_ok()
                    && known.past(request).is_none();
                let client = (request.client, request.number);
                if request.wish() == Ok(LinesWish::Reset) && known.reset != Some(client) {
                    *wants_reset = Some(client);
                }
                if !begins {
                    return known.reply(request);
                }
                let inbox = LineInbox::new(known.facts.clone(), known.found);
                inbox.take(request);
                begun = Some(SentJob {
                    client: (request.client, request.number),
                    name: request.name.as_str().to_owned(),
                    asked_ns: request.asked_ns,
                    inbox: inbox.clone(),
                });
                inbox.reply(request)
            })?;
            if begun.is_some() {
                return Ok(begun);
            }
            if !any {
                break;
            }
        }
        Ok(None)
    }

    /// Whether modes and offsets are to be reset. Whoever asks does it at once.
    pub(crate) fn take_reset(&mut self) -> bool {
        let client = self.wants_reset.take();
        self.known.reset = client.or(self.known.reset);
        client.is_some()
    }

    /// Answers what came in while a job is executed, whose client and lines are given if it is made of lines.
    /// Returns what that client wants of it.
    pub(crate) fn serve(
        &mut self,
        current: Option<&(Client, LineInbox)>,
        busy: &str,
    ) -> Result<Vec<JobWish>, LinkError> {
        let known = &self.known;
        let mut wishes = Vec::new();
        for _ in 0..REQUESTS_PER_TURN {
            let any = self.server.serve(&mut |request| {
                let client = (request.client, request.number);
                let wish = request.check().and_then(|()| request.wish());
                match (current, wish) {
                    (Some((of, lines)), Ok(wish)) if *of == client => {
                        wishes.push(wish.of_job());
                        match wish {
                            LinesWish::Close => lines.close(),
                            LinesWish::Execute => lines.take(request),
                            LinesWish::Ask | LinesWish::Cancel | LinesWish::Reset => {}
                        }
                        lines.reply(request)
                    }
                    (_, Ok(LinesWish::Execute)) if known.past(request).is_none() => LinesReply {
                        text: LongText::new(busy),
                        ..told(request, LinesState::NotBegun, (&known.facts, &known.found))
                    },
                    _ => known.reply(request),
                }
            })?;
            if !any {
                break;
            }
        }
        Ok(wishes)
    }

    /// A job has ended.
    pub(crate) fn end(&mut self, client: Client, lines: LineInbox, end: (LinesEnd, &str)) {
        lines.end(end.0, end.1);
        let known = &mut self.known;
        known.found = lines.found();
        if known.past.len() == REMEMBERED {
            known.past.pop_front();
        }
        known.past.push_back((client, lines));
    }
}

impl Known {
    /// The job of a request, if it has ended.
    fn past(&self, request: &LinesRequest) -> Option<&LineInbox> {
        let client = (request.client, request.number);
        let mut past = self.past.iter().rev();
        past.find(|(of, _)| *of == client).map(|(_, lines)| lines)
    }

    /// What is told of lines that nobody executes.
    fn reply(&self, request: &LinesRequest) -> LinesReply {
        let nothing = |state| told(request, state, (&self.facts, &self.found));
        match (request.check(), self.past(request)) {
            (Err(error), _) => LinesReply {
                text: LongText::new(&error.to_string()),
                ..nothing(LinesState::NotBegun)
            },
            (Ok(()), Some(lines)) => lines.reply(request),
            (Ok(()), None) if request.wish() == Ok(LinesWish::Reset) => {
                let is_done = self.reset == Some((request.client, request.number));
                nothing(if is_done {
                    LinesState::Done
                } else {
                    LinesState::Open
                })
            }
            (Ok(()), None) => nothing(LinesState::Unknown),
        }
    }
}
