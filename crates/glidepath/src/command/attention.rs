//! What a person is to do for a job, told at the client that waits for it.

use super::tool_names::ToolNames;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::output;
use crate::report::awaited_code;
use glidepath_link::{
    Auxiliary, Ipc, LinkError, MachineState, Record as _, Status, Subscriber, Transport as _,
};
use glidepath_program::Event;
use std::time::{Duration, Instant};

/// How long what is said of a stop may be on its way.
const MOMENT: Duration = Duration::from_millis(150);

/// What the machine waits for, and what of it was told.
pub(super) struct Attention {
    statuses: Box<dyn Subscriber<Status>>,
    records: Box<dyn Subscriber<Auxiliary>>,
    tool: u32,
    names: ToolNames,
    /// Where something was asked, since when, and whether that was told: the epoch and the frames
    /// executed. What is said of it comes a moment later.
    asked: Option<((u64, u64), Instant, bool)>,
}

impl Attention {
    pub(super) fn new(transport: &Ipc, config: &MachineConfig) -> Result<Self, Failure> {
        Ok(Self {
            statuses: transport.status_source()?,
            records: transport.auxiliary_source()?,
            tool: 0,
            names: ToolNames::new(config),
            asked: None,
        })
    }

    /// Tells what is waited for, once.
    pub(super) fn look(&mut self) -> Result<(), Failure> {
        while let Some(record) = self.records.take()? {
            record.check().map_err(LinkError::from)?;
            self.tool = record.tool;
        }
        let mut newest = None;
        while let Some(status) = self.statuses.take()? {
            status.check().map_err(LinkError::from)?;
            newest = Some(status);
        }
        let Some(status) = newest else {
            return Ok(());
        };
        let Some(words) = self.words(&status) else {
            self.asked = None;
            return Ok(());
        };
        let place = (status.epoch, status.frames_executed);
        let of_place = self.asked.filter(|(asked, ..)| *asked == place);
        let (_, since, is_told) = of_place.unwrap_or((place, Instant::now(), false));
        let is_due = !is_told && since.elapsed() >= MOMENT;
        if is_due {
            output::note(&words);
        }
        self.asked = Some((place, since, is_told || is_due));
        Ok(())
    }

    fn words(&self, status: &Status) -> Option<String> {
        let state = status.state().ok()?;
        if state == MachineState::ProgramStop {
            let said = match status.message.as_str() {
                "" => String::new(),
                said => format!(" ({said})"),
            };
            return Some(format!(
                "line {}: the program stopped the machine{said}; `glidepath resume` goes on",
                status.line
            ));
        }
        if state != MachineState::Awaiting {
            return None;
        }
        let line = status.awaited_line;
        let asked = match status.awaited_event().ok()?? {
            Event::MCode(6) | Event::Await(6) => format!("change to tool {}", self.tool()),
            Event::MCode(_) | Event::Await(_) => {
                format!("the program asks {}", awaited_code(status))
            }
            // The spindle answers that.
            _ => return None,
        };
        Some(format!(
            "line {line}: {asked}; when that is done: `glidepath acknowledge`, and if it cannot be \
             done: `glidepath acknowledge --fail \"why\"`"
        ))
    }

    /// The tool that is asked for, with what the table says of it.
    fn tool(&self) -> String {
        self.names.of(self.tool).map_or_else(
            || format!("T{}", self.tool),
            |text| format!("T{} ({text})", self.tool),
        )
    }
}
