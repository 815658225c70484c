//! `glidepath status --watch`: shows what the machine does, again and again, until Ctrl-C.

mod history;

use super::active_program::active_program;
use super::forecast::{Forecast, PlannedFor};
use super::operator::{of_link, reach};
use super::persistent_offsets::PersistentOffsets;
use super::session;
use super::tool_names::ToolNames;
use crate::cli::StatusArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use crate::output;
use crate::report::{View, active_object, status_object, view_object, view_text};
use glidepath_link::{LinkConfig, LinkError, Operator, Record as _, Status, Transport as _};
use history::History;
use serde_json::{Value, json};
use std::io::IsTerminal as _;
use std::time::{Duration, Instant};

/// Between two looks whether the process was asked to end.
const NAP: Duration = Duration::from_millis(20);
/// How long a status is waited for before that is said.
const PATIENCE: Duration = Duration::from_millis(500);
/// On a terminal: to a screen of its own, so that what was on it is there afterwards; back from it;
/// and to its upper left corner.
const ENTER: &str = "\x1b[?1049h\x1b[?25l";
const LEAVE: &str = "\x1b[?25h\x1b[?1049l";
const HOME: &str = "\x1b[H";
/// Clears the rest of a line, and the rest of the screen.
const REST_OF_LINE: &str = "\x1b[K\n";
const REST: &str = "\x1b[J";

/// Shows the machine until the process is asked to end, or nobody reads it any more.
///
/// # Errors
/// No interpolator runs, or it ends; the program cannot be read. One that says nothing is waited for.
pub(super) fn watch(args: &StatusArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let instance = session::instance(&args.operator.instance, config);
    let link = session::link(&instance, config);
    let operator = reach(&link)?;
    let forecast = match &args.program {
        Some(path) => Some(Forecast::start(
            path,
            config,
            PlannedFor::Following(None),
            (),
        )?),
        None => None,
    };
    let transport = session::join(&args.operator.instance, config)?;
    let mut told = transport.auxiliary_source()?;
    let mut auxiliary = None;
    let as_json = args.operator.basic.json;
    let screen = Screen::new(as_json);
    let names = ToolNames::new(config);
    let mut history = History::default();
    let mut offsets = PersistentOffsets::new(config, &link);
    let every = Duration::from_secs_f64(args.every);
    let mut silent_since = None::<Instant>;
    while !interrupt.is_set() && !output::has_no_reader() {
        let looked = Instant::now();
        let Some(status) = next_status(&operator, &link)? else {
            let since = *silent_since.get_or_insert(looked);
            tell_silence(&instance, &operator, since.elapsed(), &screen, as_json);
            continue;
        };
        silent_since = None;
        history.take(&status);
        while let Some(record) = told.take()? {
            record.check().map_err(LinkError::from)?;
            auxiliary = Some(record);
        }
        let place = forecast
            .as_ref()
            .and_then(|forecast| forecast.place(&status));
        let asked = names.asked(config, &status, auxiliary.as_ref());
        let view = View {
            instance: &instance,
            status: &status,
            auxiliary: auxiliary.as_ref(),
            asked: asked.clone(),
            axes: &config.axis_names(),
            not_homed: &config.axes_not_homed(&status),
            place,
            offsets: offsets.look(&status),
            events: history.events(),
        };
        if as_json {
            let mut object = status_object(&instance, &status, &asked);
            if let Value::Object(object) = &mut object {
                object.extend(view_object(&view));
                let active = active_program(&link, &status);
                object.insert("active_program".to_owned(), active_object(active.as_ref()));
            }
            output::object_line(&object);
        } else {
            screen.show(&view_text(&view));
        }
        while !interrupt.is_set() && looked.elapsed() < every {
            std::thread::sleep(NAP.min(every));
        }
    }
    // Ctrl-C is how one stops watching.
    Ok(Exit::Done)
}

/// The next status; none from an interpolator that lives and says nothing for a moment.
///
/// # Errors
/// It ended, or cannot be reached.
fn next_status(operator: &Operator, link: &LinkConfig) -> Result<Option<Status>, Failure> {
    match operator.status(PATIENCE) {
        Err(error) => Err(of_link(error, link)),
        Ok(status) => Ok(status),
    }
}

/// Says that it is waited for an interpolator that lives and says nothing.
fn tell_silence(
    instance: &str,
    operator: &Operator,
    silent: Duration,
    screen: &Screen,
    as_json: bool,
) {
    let (process, silent_s) = (operator.interpolator().id(), silent.as_secs_f64());
    if as_json {
        output::object_line(&json!({
            "instance": instance,
            "pid": process,
            "state": "silent",
            "silent_s": (silent_s * 10.0).round() / 10.0,
        }));
    } else {
        screen.show(&format!(
            "{instance}   SILENT   the interpolator (process {process}) has said nothing for \
             {silent_s:.0} s; what was shown last is old, and it is waited for\n"
        ));
    }
}

/// Where the view is shown.
struct Screen {
    is_terminal: bool,
}

impl Screen {
    fn new(as_json: bool) -> Self {
        let is_terminal = !as_json && std::io::stdout().is_terminal();
        if is_terminal {
            output::control(ENTER);
        }
        Self { is_terminal }
    }

    fn show(&self, text: &str) {
        if self.is_terminal {
            let lines = output::shown(text).replace('\n', REST_OF_LINE);
            output::control(&format!("{HOME}{lines}{REST}"));
        } else {
            output::result(&format!("{text}\n"));
        }
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        if self.is_terminal {
            output::control(LEAVE);
        }
    }
}
