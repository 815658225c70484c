//! The settings by which programs are read: the tool table, the search path of subroutines and the
//! dialect.

use super::begins_with::begin_on_machine;
use super::subroutines::subroutines;
use crate::cli::CliCommand;
use crate::command::failure::Failure;
use crate::config::{MachineConfig, ProgramConfig};
use crate::file_error::FileError;
use crate::output;
use crate::persistence::read::{MOST_TABLE_BYTES, read, set_up};
use crate::program_file::ProgramFile;
use crate::text_file;
use glidepath_gcode::{Detection, Dialect, Machine, ToolTable};
use glidepath_kinematics::AxisShare;
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;

/// How much of a program tells its dialect, bytes.
const BEGINNING: u64 = 64 * 1024;

/// Takes up what the command line says about programs, and reads the tool table.
///
/// # Errors
/// The tool table cannot be read, or has something to mend.
pub(super) fn settle(command: &CliCommand, config: &mut MachineConfig) -> Result<(), Failure> {
    let Some((file, args)) = command.program() else {
        return Ok(());
    };
    if let Some(table) = &args.tool_table {
        table.keep(MOST_TABLE_BYTES)?;
        config.program.tool_table = Some(table.path().to_owned());
    }
    // Folders of the command line come before those of the configuration.
    let mut path = args.subroutine_path.clone();
    for folder in config.program.subroutine_path.drain(..) {
        if !path.contains(&folder) {
            path.push(folder);
        }
    }
    config.program.subroutine_path = path;
    config.program.dialect = args.dialect.or(config.program.dialect);
    config.program.may_run_unchecked = args.allow_unchecked;
    if let Some(path) = &config.program.tool_table {
        config.program.tools = Some(Arc::new(tool_table(path)?));
    }
    // `run` says so, and the planner it starts need not say it again.
    if !matches!(command, CliCommand::Planner(_)) {
        tell_share(&config.axis_share);
        // The planner reads it when nobody else can write any more.
        match command {
            // Its machine is imitated, and a recording carries what its program began with.
            CliCommand::Run(_) | CliCommand::Audit(_) => {
                if let Some(kept) = read(config)? {
                    set_up(config, &kept)
                        .iter()
                        .for_each(|note| output::note(note));
                }
            }
            _ => begin_on_machine(config)?
                .notes
                .iter()
                .for_each(|note| output::note(note)),
        }
    }
    if let Some(file) = file {
        // `planner -` begins to move before its input ends.
        if !(matches!(command, CliCommand::Planner(_)) && file.is_standard_input()) {
            file.open()?;
        }
        // A page shows one program after the other, each read as its own.
        if !matches!(command, CliCommand::Live(_)) {
            *config = for_program(file, config);
        }
    }
    Ok(())
}

/// The configuration for one program: its dialect is settled, and where its subroutines are. A dialect that nobody
/// asked for is said.
pub(super) fn for_program(file: &ProgramFile, config: &MachineConfig) -> MachineConfig {
    let (config, line) = for_program_silently(file, config);
    if let (Some(dialect), Some(line)) = (config.program.dialect, line) {
        output::note(&format!(
            "{}: read as a program of the dialect {dialect}, because of line {line}; --dialect says \
             otherwise",
            file.name().display()
        ));
    }
    config
}

/// The same, with the line that tells the dialect, if one does.
pub(super) fn for_program_silently(
    file: &ProgramFile,
    config: &MachineConfig,
) -> (MachineConfig, Option<u32>) {
    let program = &config.program;
    let Detection {
        dialect,
        line,
        question,
    } = match program.dialect {
        Some(dialect) => Detection {
            dialect,
            line: None,
            question: program.question.clone(),
        },
        None => detected(file, config),
    };
    let found = || subroutines(file.in_folder(), &program.subroutine_path);
    let config = MachineConfig {
        program: ProgramConfig {
            dialect: Some(dialect),
            question,
            subroutines: Some(program.subroutines.clone().unwrap_or_else(found)),
            ..program.clone()
        },
        ..config.clone()
    };
    (config, line)
}

/// Says what joints leave of the axes' limits where nobody looks at the joints, if that is not all.
fn tell_share(share: &AxisShare) {
    let parts = [(share.acceleration, "acceleration"), (share.jerk, "jerk")];
    for ((part, name), joint) in parts.into_iter().zip(share.joints) {
        if let Some(joint) = joint {
            output::note(&format!(
                "moves by hand use {:.0} % of the axes' {name}: joint J{joint} allows no more everywhere",
                100.0 * part
            ));
        }
    }
}

fn tool_table(path: &Path) -> Result<ToolTable, Failure> {
    let text = text_file::bytes(path, MOST_TABLE_BYTES).map_err(FileError::open(path))?;
    ToolTable::parse(&text).map_err(|diagnostics| Failure::Rejected {
        program: path.display().to_string(),
        diagnostics,
        more: 0,
        moved: false,
    })
}

/// The dialect that the beginning of a program is in, with the line that tells it, and what has to be asked about it.
fn detected(program: &ProgramFile, config: &MachineConfig) -> Detection {
    let machine = Machine::new(&config.axis_names());
    if program.is_stream() {
        return Detection::of_stream(&machine);
    }
    let mut beginning = Vec::new();
    // A file that cannot be read is reported where it is opened to be executed.
    if let Ok(file) = File::open(program.path()) {
        file.take(BEGINNING).read_to_end(&mut beginning).ok();
    }
    Dialect::detect(&beginning, &machine)
}
