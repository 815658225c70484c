//! The server's answers to what pages ask for and order.

use super::answers::{Done, answer, malformed, not_now};
use super::certificates::Certificates;
use super::devices::PairedDevices;
use super::folder::{Folder, FolderError, Piece};
use super::given::Given;
use super::job_submitter::{Handed, JobSubmitter, Wanted};
use super::jogger::{Hand, Jogger};
use super::judge::Judge;
use super::order::{Order, by_axis};
use super::preview::Preview;
use super::query::fingerprint;
use super::queue::Queue;
use super::set_up::SetUp;
use super::shown::Shown;
use super::shuttle::{Drag, Shuttle};
use super::what_if::WhatIf;
use crate::command::operator::PATIENCE;
use crate::config::MachineConfig;
use crate::machine_options::complete;
use glidepath_link::{
    Command, CommandRequest, LinkConfig, LinkError, Operator, TOLERANCE_RATIOS, refused,
};
use glidepath_live::query::{decoded, parameter};
use glidepath_live::{Caller, Response, Role, Seat, Site, Status};
use glidepath_realtime::{Clock as _, Monotonic};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// What the server gives out, and has done.
pub(super) struct Pages {
    pub(super) config: MachineConfig,
    pub(super) link: LinkConfig,
    pub(super) shown: Arc<Shown>,
    pub(super) set_up: Arc<SetUp>,
    pub(super) judge: Arc<Judge>,
    pub(super) seat: Arc<Mutex<Seat>>,
    pub(super) folder: Option<Folder>,
    pub(super) preview: Preview,
    pub(super) what_if: WhatIf,
    /// Whoever jogs and hands jobs in, where pages may operate.
    pub(super) jogger: Option<Jogger>,
    /// Whoever moves along the path.
    pub(super) moves: Option<Arc<Shuttle>>,
    pub(super) queue: Arc<Queue>,
    pub(super) jobs: Option<Arc<JobSubmitter>>,
    pub(super) certificates: Arc<Certificates>,
    /// The paired devices, where they are served.
    pub(super) devices: Option<Arc<PairedDevices>>,
    pub(super) number: AtomicU64,
}

/// The clock that pages say of which they have heard last, ms.
#[expect(
    clippy::cast_precision_loss,
    reason = "ms of three centuries are exact"
)]
pub(super) fn clock_ms() -> f64 {
    (Monotonic.now_ns() / 1_000_000) as f64
}

fn nobody_jogs() -> (Status, String) {
    not_now("nobody jogs for this page any more: start it anew")
}

/// How many times its tolerance a program may use; as it is, if nothing is said.
fn ratio(said: Option<f64>) -> Option<f64> {
    let ratio = said.unwrap_or(1.0);
    TOLERANCE_RATIOS.contains(&ratio).then_some(ratio)
}

impl Pages {
    pub(super) fn seat(&self) -> MutexGuard<'_, Seat> {
        // Who has it is one word.
        self.seat.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Does what is ordered, if the caller may.
    fn order(&self, caller: Caller, body: &[u8]) -> Done {
        let given = Given::of(body).ok_or_else(malformed)?;
        let order = &given.order;
        if caller.role < order.role() {
            let (may, wants) = (caller.role.name(), order.role().name());
            let text = format!("this page may {may}; that takes a page that may {wants}");
            return Err((Status::Forbidden, text));
        }
        if order.role() == Role::Operate && caller.page == 0 {
            let text = "a page that operates says which one it is".to_owned();
            return Err((Status::BadRequest, text));
        }
        if order.takes_the_seat() && !self.seat().here(caller.page, Instant::now()) {
            return Err(not_now("another page operates; ask it for the seat"));
        }
        let asked_ns = given.asked_ns(Monotonic.now_ns()).map_err(not_now)?;
        match given.order {
            order @ (Order::Here {}
            | Order::AskSeat {}
            | Order::AnswerSeat { .. }
            | Order::LeaveSeat {}) => Ok(self.sit(caller, &order)),
            order @ (Order::Jog { .. } | Order::JogEnd { .. } | Order::JogStep { .. }) => {
                self.jog(&order)
            }
            Order::Mdi { line } => self.hand_in(Wanted::Line(line), asked_ns),
            Order::Sequence { name, lines } => self.hand_in(sequence(name, &lines)?, asked_ns),
            Order::Run {
                name,
                program,
                tolerance_ratio,
                from_line,
                pass,
                agreed,
                resume,
                queued,
            } => {
                let tolerance_ratio = ratio(tolerance_ratio).ok_or_else(malformed)?;
                self.may_start(queued, &name, tolerance_ratio)?;
                let wanted = Wanted::File {
                    path: self.program(&name)?,
                    program: fingerprint(&program).ok_or_else(malformed)?,
                    tolerance_ratio,
                    from_line: from_line.unwrap_or(0),
                    pass: pass.unwrap_or(0),
                    agreed,
                    resumes: resume,
                };
                let done = self.hand_in(wanted, asked_ns)?;
                if let (Some(entry), Some(job)) = (queued, done["number"].as_u64()) {
                    self.queue.started(entry, job);
                }
                Ok(done)
            }
            order @ (Order::QueueAdd { .. }
            | Order::QueueMove { .. }
            | Order::QueueRemove { .. }) => self.queue(order),
            order @ (Order::PairDevice { .. }
            | Order::EndPairing {}
            | Order::RevokeDevice { .. }) => self.pair(caller, &order),
            order @ (Order::Shuttle { .. } | Order::ShuttleEnd { .. }) => self.shuttle(&order),
            order => self.command(&order, asked_ns),
        }
    }

    /// Whether a program of the queue may be started; one beside it may.
    fn may_start(
        &self,
        queued: Option<u64>,
        name: &str,
        tolerance_ratio: f64,
    ) -> Result<(), (Status, String)> {
        let may_start = |entry| self.queue.may_start(entry, name, tolerance_ratio);
        queued
            .map_or(Ok(()), may_start)
            .map_err(|error| not_now(error.to_string()))
    }

    fn queue(&self, order: Order) -> Done {
        let done = match order {
            Order::QueueAdd {
                name,
                tolerance_ratio,
            } => {
                let _there = self.program(&name)?;
                let tolerance_ratio = ratio(tolerance_ratio).ok_or_else(malformed)?;
                let entry = self.queue.add(name, tolerance_ratio);
                entry.map(|entry| json!({ "entry": entry }))
            }
            Order::QueueMove { entry, to } => self.queue.put(entry, to).map(|()| json!({})),
            Order::QueueRemove { entry } => self.queue.remove(entry).map(|()| json!({})),
            _ => return Err(malformed()),
        };
        done.map_err(|error| not_now(error.to_string()))
    }

    fn shuttle(&self, order: &Order) -> Done {
        let drag = match *order {
            Order::Shuttle {
                gesture,
                number,
                at_ms,
                speed,
            } if (-1.0..=1.0).contains(&speed) => Drag::Down {
                gesture,
                number,
                at_ms,
                speed,
            },
            Order::ShuttleEnd { gesture } => Drag::Up { gesture },
            _ => return Err(malformed()),
        };
        let is_served = self.moves.as_ref().is_some_and(|it| it.drag(drag));
        is_served.then(|| json!({})).ok_or_else(nobody_jogs)
    }

    fn sit(&self, caller: Caller, order: &Order) -> Value {
        let (mut seat, now) = (self.seat(), Instant::now());
        match order {
            Order::AskSeat {} => {
                let _has_it = seat.ask(caller.page, now);
            }
            Order::AnswerSeat { give } => {
                let _was_asked = seat.answer(caller.page, *give, now);
            }
            Order::LeaveSeat {} => seat.leave(caller.page),
            _ => {
                let _has_it = seat.here(caller.page, now);
            }
        }
        let [holder, asking] = seat.who(now);
        json!({
            "operates": holder == Some(caller.page),
            "asked": asking.is_some_and(|asking| asking != caller.page),
            "asks": asking == Some(caller.page),
            "clock_ms": clock_ms(),
        })
    }

    fn command(&self, order: &Order, asked_ns: u64) -> Done {
        let joints = (1 << self.config.drives()) - 1;
        let (command, text) = order.command(joints).ok_or_else(malformed)?;
        if matches!(command, Command::Hold | Command::Abort) {
            // What moves by a page rests, whatever the interpolator says to it.
            self.jogger.as_ref().map(|jogger| jogger.hand(Hand::LetGo));
            self.moves.as_ref().map(|moves| moves.drag(Drag::LetGo));
        }
        if command == Command::Abort {
            // One that has not begun is known to nobody but its service.
            self.jobs.iter().for_each(|jobs| jobs.cancel());
        }
        let state = self.send(command, text, asked_ns)?;
        Ok(json!({ "state": state }))
    }

    /// The state in which a command was accepted, or why it was not.
    fn send(
        &self,
        command: Command,
        text: &str,
        asked_ns: u64,
    ) -> Result<&'static str, (Status, String)> {
        let number = self.number.fetch_add(1, Ordering::Relaxed);
        let request = CommandRequest::new(u64::from(std::process::id()), number, command);
        let request = request.saying(text).asked_at(asked_ns);
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
            Err(refusal) => Err(not_now(refused(command.kind().name(), &reply.why(refusal)))),
        }
    }

    fn jog(&self, order: &Order) -> Done {
        let axes = self.config.axis_names();
        let vector = |values: &BTreeMap<String, f64>| by_axis(values, &axes).ok_or_else(malformed);
        let hand = match order {
            Order::Jog {
                gesture,
                number,
                at_ms,
                axes,
            } => Hand::Down {
                gesture: *gesture,
                number: *number,
                at_ms: *at_ms,
                velocity: vector(axes)?.map(|v| v / 60.0),
            },
            Order::JogStep { axes, feed } if *feed > 0.0 && feed.is_finite() => {
                let (by, most_v) = (vector(axes)?, feed / 60.0);
                let number = self.jogger.as_ref().and_then(|it| it.step(by, most_v));
                let number = number.ok_or_else(nobody_jogs)?;
                return Ok(json!({ "number": number }));
            }
            Order::JogEnd { gesture } => Hand::Up { gesture: *gesture },
            _ => return Err(malformed()),
        };
        let is_served = self.jogger.as_ref().is_some_and(|it| it.hand(hand));
        if is_served {
            Ok(json!({}))
        } else {
            Err(nobody_jogs())
        }
    }

    fn hand_in(&self, wanted: Wanted, asked_ns: u64) -> Done {
        let Some(jobs) = &self.jobs else {
            return Err(malformed());
        };
        let (number, handed) = jobs.hand_in(wanted, asked_ns);
        match handed {
            Handed::Running => Ok(json!({ "runs": true, "number": number })),
            Handed::Done(text) => Ok(json!({ "text": text, "number": number })),
            Handed::ToConfirm(text) => Ok(json!({ "to_confirm": text })),
            Handed::Not(text) => Err(not_now(text)),
            Handed::Changed(text) => Err((Status::Other(412), complete(&text))),
        }
    }

    /// The file of a program of the folder.
    fn program(&self, name: &str) -> Result<String, (Status, String)> {
        let file = self
            .folder()?
            .file(name)
            .map_err(|error| not_now(error.to_string()))?;
        Ok(file.display().to_string())
    }

    pub(super) fn folder(&self) -> Result<&Folder, (Status, String)> {
        let none = || {
            let text = "this page has no folder of programs: `glidepath live --programs FOLDER`";
            not_now(text)
        };
        self.folder.as_ref().ok_or_else(none)
    }

    fn take(&self, caller: Caller, query: &str, bytes: &[u8]) -> Done {
        if caller.role < Role::Operate {
            let text = "a program takes a page that may operate";
            return Err((Status::Forbidden, text.to_owned()));
        }
        if caller.page == 0 || !self.seat().here(caller.page, Instant::now()) {
            return Err(not_now("another page operates; ask it for the seat"));
        }
        let folder = self.folder()?;
        let number = |name| parameter(query, name)?.parse::<u64>().ok();
        let piece = || {
            Some((
                decoded(parameter(query, "name")?)?,
                number("at")?,
                number("size")?,
            ))
        };
        let (name, at, size) = piece().ok_or_else(malformed)?;
        let replaces = number("replaces") == Some(1);
        let taken = folder.take(&Piece {
            name: &name,
            at,
            size,
            replaces,
            bytes,
        });
        match taken {
            Ok(is_whole) => Ok(json!({ "whole": is_whole })),
            Err(error @ FolderError::There(_)) => {
                let text = error.to_string();
                Err((Status::Other(412), text))
            }
            Err(error) => Err(not_now(error.to_string())),
        }
    }
}

/// Lines that are executed one after the other; each of them is one.
fn sequence(name: String, lines: &[String]) -> Result<Wanted, (Status, String)> {
    let is_one = |line: &String| !line.contains(['\n', '\r']);
    let are_lines = !lines.is_empty() && lines.iter().all(is_one);
    let lines = lines.join("\n");
    let wanted = are_lines.then_some(Wanted::Sequence { name, lines });
    wanted.ok_or_else(malformed)
}

impl Site for Pages {
    fn document(&self, caller: Caller, path: &str, query: &str) -> Option<Response> {
        self.told(caller, path.strip_prefix("/api/")?, query)
    }

    fn command(&self, caller: Caller, body: &[u8]) -> Response {
        answer(self.order(caller, body))
    }

    fn upload(&self, caller: Caller, query: &str, piece: &[u8]) -> Response {
        answer(self.take(caller, query, piece))
    }
}
