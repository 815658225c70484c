//! The names of tools for people: the comments of the tool table's lines.

use crate::config::MachineConfig;
use crate::persistence::read::MOST_TABLE_BYTES;
use crate::report::{AskedTool, AwaitedEvent};
use crate::text_file;
use glidepath_link::{Auxiliary, MachineState, Status};
use glidepath_program::Event;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The comments of a tool table, read anew whenever one is wanted.
#[derive(Debug, Clone)]
pub(super) struct ToolNames {
    table: Option<PathBuf>,
}

impl ToolNames {
    pub(super) fn new(config: &MachineConfig) -> Self {
        Self {
            table: config.program.tool_table.clone(),
        }
    }

    /// What the table calls a tool; `None` if it has no words for it.
    pub(super) fn of(&self, tool: u32) -> Option<String> {
        self.all().remove(&tool)
    }

    /// The tool that a machine waits for, if it does: the one that was selected last.
    pub(super) fn asked_tool(
        &self,
        status: &Status,
        told: Option<&Auxiliary>,
    ) -> Option<AskedTool> {
        let changes = matches!(
            status.awaited_event(),
            Ok(Some(Event::MCode(6) | Event::Await(6)))
        );
        let waits = status.state() == Ok(MachineState::Awaiting) || status.awaited_since_ns != 0;
        let number = told.filter(|_| changes && waits)?.prepared_tool;
        Some(AskedTool {
            number,
            name: self.of(number),
        })
    }

    /// What a machine waits for, if it does: the tool, and who says that it is done.
    pub(super) fn asked(
        &self,
        config: &MachineConfig,
        status: &Status,
        told: Option<&Auxiliary>,
    ) -> AwaitedEvent {
        let answer = match status.awaited_event() {
            Ok(Some(Event::MCode(code) | Event::Await(code))) => config.m_code_waits().of(code),
            _ => None,
        };
        AwaitedEvent {
            tool: self.asked_tool(status, told),
            answer: answer.map(|m_code_wait| m_code_wait.answer),
        }
    }

    /// What the table calls its tools.
    pub(super) fn all(&self) -> BTreeMap<u32, String> {
        let table = self.table.as_deref();
        // A table that cannot be read was told of when the configuration was.
        let bytes = table.and_then(|table| text_file::bytes(table, MOST_TABLE_BYTES).ok());
        comments(&String::from_utf8_lossy(&bytes.unwrap_or_default()))
    }
}

/// What stands behind the semicolon in the line of each tool, which is that of its first edge.
fn comments(table: &str) -> BTreeMap<u32, String> {
    let rows = table.lines().filter_map(|line| line.split_once(';'));
    let comments = rows.filter_map(|(words, comment)| {
        let word = |letters: [char; 2]| {
            let mut words = words.split_whitespace();
            words.find_map(|word| word.strip_prefix(letters)?.parse::<u32>().ok())
        };
        let comment = comment.trim();
        let names = !comment.is_empty() && word(['E', 'e']).is_none_or(|edge| edge == 1);
        names.then_some((word(['T', 't'])?, comment.to_owned()))
    });
    comments.collect()
}

#[cfg(test)]
mod tests {
    use super::comments;

    #[test]
    fn the_comment_of_a_tool_is_that_of_its_line() {
        let table = "; tools\nT1 P1 Z10 D6 ; 6 mm end mill\nT1 E2 Z5 ; its shoulder\nT12 P2 ;\nt2 Z3; drill\nT3 Z1\n";
        let all: Vec<(u32, String)> = comments(table).into_iter().collect();
        assert_eq!(
            all,
            [(1, "6 mm end mill".to_owned()), (2, "drill".to_owned())]
        );
    }
}
