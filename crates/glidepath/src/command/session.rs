//! The instance that a process takes part in.

use crate::cli::{BasicArgs, InstanceArgs, OverwriteArgs};
use crate::command::failure::Failure;
use crate::config::{self, EMBEDDED, MAX_FRAMES_AHEAD, MachineConfig};
use crate::file_error::FileError;
use crate::output_file::OverwriteGuard;
use crate::program_file::ProgramFile;
use crate::text_file;
use glidepath_gcode::Subroutines;
use glidepath_link::{Ipc, LinkConfig};
use glidepath_planner::Pace;
use std::path::PathBuf;

/// The instance asked for: on the command line, else in the configuration, else the default one.
pub(super) fn instance(args: &InstanceArgs, config: &MachineConfig) -> String {
    let asked = args.instance.clone();
    asked.unwrap_or_else(|| named_instance(config))
}

/// The instance of a configuration, else the default one.
pub(super) fn named_instance(config: &MachineConfig) -> String {
    let named = config.instance.clone();
    named.unwrap_or_else(|| MachineConfig::DEFAULT_INSTANCE.to_owned())
}

/// The text of the machine's configuration, which was judged before.
pub(super) fn configuration(basic: &BasicArgs) -> Result<String, FileError> {
    let Some(file) = &basic.config else {
        return Ok(EMBEDDED.to_owned());
    };
    text_file::read(file.path(), config::MOST_BYTES).map_err(FileError::open(file.name()))
}

/// What a command that reads these files may not overwrite.
pub(super) fn guard(
    program: Option<&ProgramFile>,
    basic: &BasicArgs,
    config: &MachineConfig,
    overwrite: OverwriteArgs,
) -> OverwriteGuard {
    let named = program.map(|program| {
        if program.is_standard_input() {
            PathBuf::from("/dev/stdin")
        } else {
            program.name().to_owned()
        }
    });
    let config_file = basic.config.as_ref().map(|file| file.name().to_owned());
    // Those that checking the program came to.
    let subroutines = config.program.subroutines.as_ref();
    let subroutines = subroutines.map(Subroutines::read).unwrap_or_default();
    let subroutines = subroutines
        .iter()
        .map(|(_, file)| PathBuf::from(&*file.name));
    let inputs = named.into_iter().chain(config_file).chain(subroutines);
    OverwriteGuard {
        inputs: inputs.chain(config.program.tool_table.clone()).collect(),
        force: overwrite.force,
    }
}

/// How the processes of an instance meet.
pub(super) fn link(instance: &str, config: &MachineConfig) -> LinkConfig {
    let mut link = LinkConfig::new(instance);
    let ahead = usize::try_from(pace(config).horizon_frames).unwrap_or(usize::MAX);
    link.capacity.frames = link.capacity.frames.max(ahead);
    link
}

/// How frames are paced.
pub(super) fn pace(config: &MachineConfig) -> Pace {
    let pace = Pace::new(config.period_ns(), config.interpolator.horizon_t);
    Pace {
        horizon_frames: pace.horizon_frames.min(MAX_FRAMES_AHEAD.into()),
        ..pace
    }
}

/// Joins an instance.
pub(super) fn join(args: &InstanceArgs, config: &MachineConfig) -> Result<Ipc, Failure> {
    Ok(Ipc::connect(&link(&instance(args, config), config))?)
}
