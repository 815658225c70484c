//! What the tool table says of a tool for people: the comment of its line.

use crate::config::MachineConfig;
use crate::kept::read::MOST_TABLE_BYTES;
use crate::text_file;
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
        let bytes = text_file::bytes(self.table.as_deref()?, MOST_TABLE_BYTES).ok()?;
        comment(&String::from_utf8_lossy(&bytes), tool)
    }
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
