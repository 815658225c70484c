//! The reader of what is kept, for whoever reads a program.

use crate::config::MachineConfig;
use crate::persistence::convert::{
    axis_words, begun_variables, begun_with, system_name, with_tools,
};
use crate::persistence::error::StateError;
use crate::persistence::machine::{fingerprint, fingerprint_of};
use crate::persistence::seen;
use crate::text_file;
use glidepath_persistence::{Directory, PersistentState, Store, UnderWay};
use std::path::Path;
use std::sync::Arc;

/// Largest tool table, bytes.
pub(crate) const MOST_TABLE_BYTES: u64 = 4 << 20;

/// What is kept for a machine; `None` if it keeps nothing, or nothing yet.
///
/// # Errors
/// It cannot be read, or belongs to another machine.
pub(crate) fn read(config: &MachineConfig) -> Result<Option<PersistentState>, StateError> {
    let Some(folder) = &config.state_directory else {
        return Ok(None);
    };
    let store = Store::new(Directory::at(folder));
    let Some((_, kept)) = seen::read(&store, folder)? else {
        return Ok(None);
    };
    of_machine(config, folder, &kept)?;
    Ok(Some(kept))
}

/// Refuses what belongs to another machine.
pub(crate) fn of_machine(
    config: &MachineConfig,
    folder: &Path,
    kept: &PersistentState,
) -> Result<(), StateError> {
    if kept.configuration == fingerprint(config) {
        return Ok(());
    }
    Err(StateError::OtherMachine {
        folder: folder.display().to_string(),
    })
}

/// Puts what is kept into a configuration for the reading of programs; what somebody has to know of
/// it.
pub(crate) fn set_up(config: &mut MachineConfig, kept: &PersistentState) -> Vec<String> {
    let mut notes = Vec::new();
    config.program.offsets = begun_with(&kept.offsets);
    config.program.variables = begun_variables(&kept.variables);
    let offsets = &kept.offsets;
    if offsets.active != 1 {
        notes.push(format!(
            "offsets: programs begin in {}, which is kept",
            system_name(offsets.active)
        ));
    }
    let g92 = axis_words(&offsets.g92);
    let begins = config.program.in_force.as_ref();
    let is_shifted = begins.is_some_and(|it| it.position_offsets().shift.amax() > 0.0);
    if !g92.is_empty() && !is_shifted {
        notes.push(format!(
            "offsets: the kept offset of G92 ({g92}) is not in force here; G92.3 puts it in force"
        ));
    }
    if !kept.tools.is_empty() && kept.tool_table != table_fingerprint(config) {
        let numbers: Vec<String> = kept
            .tools
            .iter()
            .map(|tool| match tool.edge {
                1 => tool.number.to_string(),
                edge => format!("{} D{edge}", tool.number),
            })
            .collect();
        notes.push(format!(
            "offsets: the tool table is not the one that programs have changed by G10; their changes \
             of the tools {} are not used",
            numbers.join(", ")
        ));
    } else if let Some(table) = &config.program.tools {
        config.program.tools = Some(with_tools(table, &kept.tools));
    }
    notes
}

/// Puts what a program began with into a configuration; `None` if that is not known. Behind [`set_up`].
pub(crate) fn set_up_as_begun<'k>(
    config: &mut MachineConfig,
    kept: &'k PersistentState,
    program: u64,
) -> Option<&'k UnderWay> {
    let begun = kept.under_way.as_ref();
    let begun = begun.filter(|begun| begun.program == program)?;
    config.program.offsets = begun_with(&begun.offsets);
    config.program.variables = begun_variables(&begun.variables);
    config.use_tolerance_ratio(begun.tolerance_ratio);
    if let Some(table) = &config.program.tools {
        config.program.tools = Some(with_tools(table, &begun.tools));
    }
    Some(begun)
}

/// The fingerprint of the tool table's file; 0 if there is none.
pub(crate) fn table_fingerprint(config: &MachineConfig) -> u64 {
    let table = config.program.tool_table.as_ref();
    let bytes = table.and_then(|path| text_file::bytes(path, MOST_TABLE_BYTES).ok());
    bytes.map_or(0, |bytes| fingerprint_of(&bytes))
}

/// The tool table of a configuration; empty if it has none.
pub(crate) fn table(config: &MachineConfig) -> Arc<glidepath_gcode::ToolTable> {
    config.program.tools.clone().unwrap_or_default()
}
