//! What pages ask for: the machine and its programs, previews, set-up, certificates, devices.

use super::answers::{not_now, object, refusal};
use super::folder::Folder;
use super::machines::others;
use super::pages::Pages;
use super::preview::{Look, Looker};
use super::shown::Shown;
use crate::command::changed::Change;
use glidepath_live::query::{decoded, parameter};
use glidepath_live::{Caller, ContentType, Response, Role, Status};

/// Lines that are given out at once.
const MOST_LINES: usize = 500;

impl Pages {
    /// What is at a path behind `/api/`.
    pub(super) fn told(&self, caller: Caller, path: &str, query: &str) -> Option<Response> {
        match path {
            "plan" => Some(object(&self.shown.object())),
            "set-up" => Some(object(&self.set_up.object())),
            "programs" => Some(self.programs()),
            "judge" => Some(self.judge_typed(caller, query)),
            "preview" => self.preview(caller, query),
            "what-if" => self.what_if(caller, &self.shown, query),
            "preview/what-if" => {
                let of = parameter(query, "of")?.parse().ok()?;
                self.what_if(caller, &*self.preview.shown(of)?, query)
            }
            "certificate" => {
                let job = u64::from_str_radix(parameter(query, "job")?, 16).ok()?;
                self.certificates
                    .of(job)
                    .map(|certificate| object(&certificate))
            }
            // A device is on the network, where the pages of this host are not.
            "machines" if caller.device.is_none() => Some(object(&others(&self.link, caller.role))),
            "devices" if caller.role == Role::Operate => {
                let devices = self.devices.as_ref();
                devices.map(|devices| object(&devices.object(caller)))
            }
            what => match what.strip_prefix("preview/") {
                Some(what) => {
                    let of = parameter(query, "of")?.parse().ok()?;
                    part(&*self.preview.shown(of)?, what, query)
                }
                None => part(&self.shown, what, query),
            },
        }
    }

    /// What is wrong with a line that somebody types who may have it executed. The seat stays with who has it.
    fn judge_typed(&self, caller: Caller, query: &str) -> Response {
        match self.looker(caller) {
            Looker::Seat => self.judge.answer(caller, query),
            Looker::Other => refusal(&not_now("lines are judged for the page that operates")),
        }
    }

    fn preview(&self, caller: Caller, query: &str) -> Option<Response> {
        let name = decoded(parameter(query, "name")?)?;
        let look = match parameter(query, "look") {
            None => Look::First,
            Some("again") => Look::Again,
            Some("anew") => Look::Anew,
            Some(_) => return None,
        };
        let found = self.folder().map(|folder| folder.file(&name));
        Some(match found {
            Ok(Ok(file)) => {
                let version = self.set_up.version();
                let look = (self.looker(caller), look);
                let known = self.preview.object((&file, &name), version, look);
                known.map_or_else(
                    |given_up| refusal(&(Status::NotFound, given_up.to_string())),
                    |known| object(&known),
                )
            }
            Ok(Err(error)) => refusal(&not_now(error.to_string())),
            Err(refused) => refusal(&refused),
        })
    }

    /// How long a program would take with something changed.
    fn what_if(&self, caller: Caller, shown: &Shown, query: &str) -> Option<Response> {
        let ratio = |name| match parameter(query, name) {
            Some(text) => text.parse::<f64>().ok(),
            None => Some(1.0),
        };
        let change = Change {
            tolerance: ratio("tolerance")?,
            jerk: ratio("jerk")?,
            feed: ratio("feed")?,
        };
        let file = shown.file(parameter(query, "of")?.parse().ok()?)?;
        if !change.is_in_range() {
            return None;
        }
        let (looker, set_up) = (self.looker(caller), self.set_up.version());
        Some(object(&self.what_if.object(looker, &file, change, set_up)))
    }

    /// Whether a page that looks is the one that operates.
    pub(super) fn looker(&self, caller: Caller) -> Looker {
        let operates = caller.role == Role::Operate && self.seat().holds(caller.page);
        if operates {
            Looker::Seat
        } else {
            Looker::Other
        }
    }

    fn programs(&self) -> Response {
        let listed = self.folder().map(Folder::object);
        match listed {
            Ok(Ok(listed)) => object(&listed),
            Ok(Err(error)) => refusal(&not_now(error.to_string())),
            Err(refused) => refusal(&refused),
        }
    }
}

/// Numbers and lines of a program.
fn part(shown: &Shown, what: &str, query: &str) -> Option<Response> {
    let number = |name: &str| parameter(query, name)?.parse::<u64>().ok();
    let of = number("of")?;
    let numbers = |bytes| Response::new(ContentType::Binary, bytes);
    match what {
        "program.bin" => shown.program_path(of).map(numbers),
        "columns.bin" => shown.columns(of).map(numbers),
        "path.bin" => shown.path(of).map(numbers),
        "lines" => {
            let count = |name| usize::try_from(number(name)?).ok();
            let (from, count) = (count("from")?, count("count")?.min(MOST_LINES));
            Some(object(&shown.lines(of, from, count)?))
        }
        _ => None,
    }
}
