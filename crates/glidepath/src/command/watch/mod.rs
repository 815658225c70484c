//! `glidepath status --watch`: what the machine does, again and again, until Ctrl-C.

mod history;

use super::forecast::Forecast;
use super::kept_offsets::KeptOffsets;
use super::operator::{reach, read_status};
use super::session;
use crate::cli::StatusArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use crate::output;
use crate::report::{View, status_object, view_object, view_text};
use glidepath_link::{LinkError, Record as _, Transport as _};
use history::History;
use serde_json::Value;
use std::io::IsTerminal as _;
use std::time::{Duration, Instant};

/// Between two looks whether the process was asked to end.
const NAP: Duration = Duration::from_millis(20);
/// On a terminal: to a screen of its own, so that what was on it is there afterwards; back from it;
/// and to its upper left corner.
const ENTER: &str = "\x1b[?1049h\x1b[?25l";
const LEAVE: &str = "\x1b[?25h\x1b[?1049l";
const HOME: &str = "\x1b[H";
/// Clears the rest of a line, and the rest of the screen.
const REST_OF_LINE: &str = "\x1b[K\n";
const REST: &str = "\x1b[J";

/// Shows the machine until the process is asked to end.
///
/// # Errors
/// No interpolator runs, or it ends; the program cannot be read.
pub(super) fn watch(args: &StatusArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let instance = session::instance(&args.operator.instance, config);
    let link = session::link(&instance, config);
    let operator = reach(&link)?;
    let forecast = match &args.program {
        Some(path) => Some(Forecast::start(path, config, ())?),
        None => None,
    };
    let transport = session::join(&args.operator.instance, config)?;
    let mut told = transport.auxiliary_source()?;
    let mut auxiliary = None;
    let as_json = args.operator.basic.json;
    let screen = Screen::new(as_json);
    let mut history = History::default();
    let mut offsets = KeptOffsets::new(config);
    let every = Duration::from_secs_f64(args.every);
    while !interrupt.is_set() {
        let looked = Instant::now();
        let status = read_status(&operator, &link)?;
        history.take(&status);
        while let Some(record) = told.take()? {
            record.check().map_err(LinkError::from)?;
            auxiliary = Some(record);
        }
        let place = forecast
            .as_ref()
            .and_then(|forecast| forecast.place(&status));
        let view = View {
            instance: &instance,
            status: &status,
            auxiliary: auxiliary.as_ref(),
            axes: &config.axis_names(),
            place,
            offsets: offsets.look(),
            events: history.events(),
        };
        if as_json {
            let mut object = status_object(&instance, &status);
            if let Value::Object(object) = &mut object {
                object.extend(view_object(&view));
            }
            output::result(&format!("{object}\n"));
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

/// Where the view is shown.
struct Screen {
    is_terminal: bool,
}

impl Screen {
    fn new(as_json: bool) -> Self {
        let is_terminal = !as_json && std::io::stdout().is_terminal();
        if is_terminal {
            output::result(ENTER);
        }
        Self { is_terminal }
    }

    fn show(&self, text: &str) {
        if self.is_terminal {
            let lines = text.replace('\n', REST_OF_LINE);
            output::result(&format!("{HOME}{lines}{REST}"));
        } else {
            output::result(&format!("{text}\n"));
        }
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        if self.is_terminal {
            output::result(LEAVE);
        }
    }
}
