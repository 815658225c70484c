//! The judge of a line that is being typed: what `mdi` would say of it now. Nothing moves, nothing is kept, and what the
//! service has in force stays as it is.

use super::answers::{Done, not_now, object, refusal};
use crate::command::begins_with::begin_as_told;
use crate::command::session;
use crate::config::MachineConfig;
use glidepath_gcode::{Diagnostic, Program, ReadingWatch};
use glidepath_geometry::AxisVector;
use glidepath_link::{Auxiliary, LinkConfig, MachineState, Status};
use glidepath_live::{Caller, Response, Status as Answer, Turns, TypedLine};
use glidepath_realtime::{Clock as _, Monotonic};
use serde_json::{Value, json};
use std::sync::mpsc::channel;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// How long a line is read: one may call a subroutine that does not end.
const PATIENCE: Duration = Duration::from_millis(300);
/// A status that is older does not say any more where the machine stands, ns.
const OLD_NS: u64 = 1_000_000_000;

/// Judges lines, each as if it was the next one.
pub(super) struct Judge {
    config: MachineConfig,
    link: LinkConfig,
    heard: Mutex<Heard>,
    turns: Turns,
}

/// What is known of a line.
enum Verdict {
    Wrong(Box<Diagnostic>),
    Fine,
    /// Nobody can say now.
    Unknown,
}

/// What the machine has told last.
#[derive(Debug, Clone, Copy, Default)]
struct Heard {
    /// Where it stood when, ns, if it was ready for a line.
    ready: Option<(AxisVector, u64)>,
    /// What spindle, coolant and tool are to do.
    told: Option<Auxiliary>,
}

impl Judge {
    pub(super) fn new(config: &MachineConfig, link: &LinkConfig) -> Self {
        Self {
            config: config.clone(),
            link: link.clone(),
            heard: Mutex::default(),
            turns: Turns::default(),
        }
    }

    /// Hears how the machine is.
    pub(super) fn hear(&self, status: &Status, told: Option<&Auxiliary>) {
        let is_ready = status.state() == Ok(MachineState::Idle);
        let ready = is_ready.then(|| (AxisVector::from(status.position), status.updated_ns));
        let told = told.copied();
        *self.heard.lock().unwrap_or_else(PoisonError::into_inner) = Heard { ready, told };
    }

    /// The answer to a page that operates.
    pub(super) fn answer(&self, caller: Caller, query: &str) -> Response {
        match self.judge(caller, query) {
            Ok(told) => object(&told),
            Err(refused) => refusal(&refused),
        }
    }

    fn judge(&self, caller: Caller, query: &str) -> Done {
        let busy = || (Answer::Unavailable, "another line is being read".to_owned());
        let _turn = self.turns.take(caller.page).ok_or_else(busy)?;
        let line = TypedLine::of(query).map_err(|error| not_now(error.to_string()))?;
        let heard = *self.heard.lock().unwrap_or_else(PoisonError::into_inner);
        let stands = heard.ready.filter(|(_, heard_ns)| {
            let age_ns = Monotonic.now_ns().saturating_sub(*heard_ns);
            age_ns < OLD_NS
        });
        let verdict = stands.map_or(Verdict::Unknown, |(stands, _)| {
            self.read(line.text(), stands, heard.told)
        });
        Ok(match verdict {
            Verdict::Wrong(found) => json!({ "known": true, "finding": finding(&found) }),
            Verdict::Fine => json!({ "known": true, "finding": Value::Null }),
            Verdict::Unknown => json!({ "known": false, "finding": Value::Null }),
        })
    }

    fn read(&self, line: &str, stands: AxisVector, told: Option<Auxiliary>) -> Verdict {
        let mut config = self.config.clone();
        let instance = session::named_instance(&config);
        let of = (instance.as_str(), &self.link);
        match begin_as_told(&mut config, of, || told, || Some(stands)) {
            Ok(_) => in_time(line, config, stands),
            // Whoever has the line executed is told why what is kept cannot be read.
            Err(_) => Verdict::Unknown,
        }
    }
}

/// Reads a line as `mdi` does, for a bounded time.
fn in_time(line: &str, mut config: MachineConfig, stands: AxisVector) -> Verdict {
    let (watch, text) = (ReadingWatch::default(), format!("{line}\n"));
    config.program.watch = Some(watch.clone());
    let options = config.program_options(stands);
    let (done, found) = channel();
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let program = Program::new(text.as_bytes(), options);
            let mut items = program.take_while(|_| !watch.is_to_end());
            // Nobody listens any more where it took too long.
            let _told = done.send(items.find_map(Result::err));
        });
        let found = found.recv_timeout(PATIENCE);
        watch.end();
        match found {
            Ok(Some(found)) => Verdict::Wrong(Box::new(found)),
            Ok(None) => Verdict::Fine,
            Err(_) => Verdict::Unknown,
        }
    })
}

/// What is wrong with a line, as a page is told it: the text in front of the mark, the mark, and the text behind it.
fn finding(found: &Diagnostic) -> Value {
    let excerpt = &found.excerpt;
    let mut text = excerpt.text.chars();
    let before: String = text.by_ref().take(excerpt.caret).collect();
    let marked: String = text.by_ref().take(excerpt.length).collect();
    json!({
        "message": found.message,
        "reason": found.reason,
        "help": found.help,
        "column": found.column,
        "file": found.file.as_deref(),
        "line": found.line,
        "text": [before, marked, text.collect::<String>()],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_live::Role;

    struct Desk {
        judge: Judge,
        _folder: tempfile::TempDir,
    }

    impl Desk {
        fn new() -> Self {
            let folder = tempfile::tempdir().unwrap();
            let link = LinkConfig {
                root: folder.path().to_owned(),
                ..LinkConfig::new("judge")
            };
            let config = crate::config::load(None).unwrap();
            Self {
                judge: Judge::new(&config, &link),
                _folder: folder,
            }
        }

        fn hear(&self, state: MachineState, x: f64) {
            let mut status: Status = bytemuck::Zeroable::zeroed();
            (status.state, status.updated_ns) = (state.code(), Monotonic.now_ns());
            status.position[0] = x;
            self.judge.hear(&status, None);
        }

        fn ask(&self, line: &str) -> Value {
            let caller = Caller {
                role: Role::Operate,
                page: 1,
                device: None,
            };
            self.judge.judge(caller, &format!("line={line}")).unwrap()
        }
    }

    #[test]
    fn a_line_is_judged_from_where_the_machine_stands() {
        let desk = Desk::new();
        assert_eq!(desk.ask("G0%20X1")["known"], false, "nobody knows where");
        desk.hear(MachineState::Idle, 0.0);
        assert_eq!(
            desk.ask("G0%20X1"),
            json!({ "known": true, "finding": null })
        );
        assert_eq!(desk.ask("")["finding"], Value::Null);
        let said = desk.ask("G1%20X1%20F");
        let found = &said["finding"];
        assert!(found["message"].as_str().unwrap().len() > 5, "{said}");
        let text = found["text"].as_array().unwrap();
        let whole: String = text.iter().map(|part| part.as_str().unwrap()).collect();
        assert_eq!(whole, "G1 X1 F");
        // An arc from another place has another radius.
        let arc = "G2%20X10%20Y0%20I5%20J0%20F100";
        assert_eq!(desk.ask(arc)["finding"], Value::Null);
        desk.hear(MachineState::Idle, 3.0);
        assert!(desk.ask(arc)["finding"].is_object());
        // What is in force behind a program that runs, nobody knows.
        desk.hear(MachineState::Running, 0.0);
        assert_eq!(desk.ask("G1%20X1%20F")["known"], false);
    }

    #[test]
    fn a_page_has_one_line_judged_at_a_time() {
        let desk = Desk::new();
        desk.hear(MachineState::Idle, 0.0);
        let _turn = desk.judge.turns.take(1).unwrap();
        let caller = Caller {
            role: Role::Operate,
            page: 1,
            device: None,
        };
        let refused = desk.judge.judge(caller, "line=G0").unwrap_err();
        assert_eq!(refused.0, Answer::Unavailable);
    }
}
