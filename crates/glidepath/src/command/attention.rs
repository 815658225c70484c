//! What a person is to do for a job, told at the client that waits for it.

use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::kept::read::MOST_TABLE_BYTES;
use crate::output;
use crate::report::awaited_code;
use crate::text_file;
use glidepath_link::{
    Auxiliary, Ipc, LinkError, MachineState, Record as _, Status, Subscriber, Transport as _,
};
use glidepath_program::Event;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// How long what is said of a stop may be on its way.
const MOMENT: Duration = Duration::from_millis(150);

/// What the machine waits for, and what of it was told.
pub(super) struct Attention {
    statuses: Box<dyn Subscriber<Status>>,
    records: Box<dyn Subscriber<Auxiliary>>,
    tool: u32,
    table: Option<PathBuf>,
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
            table: config.program.tool_table.clone(),
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
        let text = self
            .table
            .as_deref()
            .and_then(text_of)
            .and_then(|table| comment(&table, self.tool));
        text.map_or_else(
            || format!("T{}", self.tool),
            |text| format!("T{} ({text})", self.tool),
        )
    }
}

fn text_of(table: &Path) -> Option<String> {
    let bytes = text_file::bytes(table, MOST_TABLE_BYTES).ok()?;
    Some(String::from_utf8_lossy(&bytes).into_owned())
}

/// What stands behind the semicolon in the line of a tool.
fn comment(table: &str, tool: u32) -> Option<String> {
    let rows = table.lines().filter_map(|line| line.split_once(';'));
    let is_of = |words: &str| {
        words.split_whitespace().any(|word| {
            let number = word.strip_prefix(['T', 't']);
            number.and_then(|number| number.parse().ok()) == Some(tool)
        })
    };
    let mut comments = rows.filter(|(words, _)| is_of(words));
    let (_, comment) = comments.next()?;
    Some(comment.trim().to_owned()).filter(|comment| !comment.is_empty())
}

#[cfg(test)]
mod tests {
    use super::comment;

    #[test]
    fn the_comment_of_a_tool_is_that_of_its_line() {
        let table = "; tools\nT1 P1 Z10 D6 ; 6 mm end mill\nT12 P2 ;\nt2 Z3; drill\nT3 Z1\n";
        let of = |tool| comment(table, tool);
        assert_eq!(of(1).as_deref(), Some("6 mm end mill"));
        assert_eq!(of(2).as_deref(), Some("drill"));
        for tool in [3, 4, 12] {
            assert_eq!(of(tool), None);
        }
    }
}
