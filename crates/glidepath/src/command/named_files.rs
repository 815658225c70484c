//! The files and folders that a configuration names: whether they are there, and can be read.

use crate::config::MachineConfig;
use crate::persistence::read::{MOST_TABLE_BYTES, read};
use crate::text_file;
use glidepath_gcode::ToolTable;
use std::fs;
use std::io;
use std::path::Path;

/// Most findings of one file that are told.
const MOST: usize = 10;

/// Something to mend in what a key names.
#[derive(Debug)]
pub(super) struct Finding {
    pub(super) key: &'static str,
    pub(super) message: String,
    pub(super) help: String,
}

/// All that is to be mended in the files of a machine.
pub(super) fn findings(machine: &MachineConfig) -> Vec<Finding> {
    let mut found = Vec::new();
    if let Some(table) = &machine.program.tool_table {
        tool_table(table, &mut found);
    }
    for folder in &machine.program.subroutine_path {
        if let Err(why) = is_folder(folder) {
            found.push(Finding {
                key: "program.subroutine_path",
                message: format!("program.subroutine_path names {}: {why}", folder.display()),
                help: "make the folder, or take it out of the list; its name counts from where the configuration is"
                    .to_owned(),
            });
        }
    }
    if let Some(folder) = &machine.state_directory {
        state(folder, machine, &mut found);
    }
    found
}

fn tool_table(path: &Path, found: &mut Vec<Finding>) {
    const KEY: &str = "program.tool_table";
    let name = path.display();
    let text = match path.metadata() {
        // A pipe would keep whoever opens it waiting.
        Ok(there) if !there.is_file() => Err("it is no ordinary file".to_owned()),
        _ => text_file::bytes(path, MOST_TABLE_BYTES).map_err(|error| error.to_string()),
    };
    let text = match text {
        Ok(text) => text,
        Err(why) => {
            found.push(Finding {
                key: KEY,
                message: format!("{KEY} names {name}: {why}"),
                help: "put the tool table there, or name another; its name counts from where the configuration is"
                    .to_owned(),
            });
            return;
        }
    };
    let wrong = ToolTable::parse(&text).err().unwrap_or_default();
    let more = wrong.len().saturating_sub(MOST);
    for diagnostic in wrong.iter().take(MOST) {
        let mut message = format!(
            "{KEY}: {name}, line {}: {}",
            diagnostic.line, diagnostic.message
        );
        if !diagnostic.reason.is_empty() {
            message.push_str(&format!(": {}", diagnostic.reason));
        }
        let help = match diagnostic.help.as_str() {
            "" => format!("mend line {} of {name}", diagnostic.line),
            help => help.to_owned(),
        };
        found.push(Finding {
            key: KEY,
            message,
            help,
        });
    }
    if more > 0 {
        found.push(Finding {
            key: KEY,
            message: format!("{KEY}: {name} has {more} more lines to mend"),
            help: "mend those above first".to_owned(),
        });
    }
}

/// The folder of what is kept: the first who keeps something makes it.
fn state(folder: &Path, machine: &MachineConfig, found: &mut Vec<Finding>) {
    const KEY: &str = "state.directory";
    let name = folder.display();
    let mut tell = |why: String, help: String| {
        found.push(Finding {
            key: KEY,
            message: format!("{KEY} names {name}: {why}"),
            help,
        });
    };
    if folder.exists() {
        // What the services keep is theirs: another user who looks at the configuration cannot read it, and need not.
        let opened = fs::read_dir(folder);
        if opened.is_err_and(|error| error.kind() == io::ErrorKind::PermissionDenied) {
            return;
        }
        if let Err(why) = is_folder(folder) {
            let help = "name a folder; where there is none yet, it is made".to_owned();
            tell(why, help);
        } else if let Err(error) = read(machine) {
            let help = format!(
                "`glidepath offsets --help` tells what can be done with what is kept in {name}"
            );
            tell(error.to_string(), help);
        }
        return;
    }
    let parent = folder.parent().filter(|parent| *parent != Path::new(""));
    let parent = parent.unwrap_or(Path::new("."));
    if let Err(why) = is_folder(parent) {
        let why = format!("it cannot be made in {}: {why}", parent.display());
        let help = format!("make {}, or name another folder", parent.display());
        tell(why, help);
    }
}

fn is_folder(path: &Path) -> Result<(), String> {
    match fs::metadata(path) {
        Ok(there) if there.is_dir() => fs::read_dir(path)
            .map(drop)
            .map_err(|error| error.to_string()),
        Ok(_) => Err("it is no folder".to_owned()),
        Err(error) => Err(error.to_string()),
    }
}
