//! Arguments of the commands that read programs.

use crate::program_file::ProgramFile;
use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};
use glidepath_gcode::Dialect;
use std::path::PathBuf;

/// How a program is read.
#[derive(Debug, Clone, Default, Args)]
pub struct ProgramArgs {
    /// Tool table (LinuxCNC's .tbl); overrides `program.tool_table` of the configuration
    #[arg(long, value_name = "TBL", value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub tool_table: Option<ProgramFile>,
    /// Folder to search for subroutines in files of their own, after the folder of the program and
    /// before `program.subroutine_path` of the configuration; may be given several times
    #[arg(long, value_name = "FOLDER")]
    pub subroutine_path: Vec<PathBuf>,
    /// Language of the program: linuxcnc, marlin, fanuc or siemens. Without it, the configuration
    /// or the beginning of the program decides
    #[arg(long, value_name = "NAME", value_parser = dialect)]
    pub dialect: Option<Dialect>,
    /// Accept a program whose loops are too long to be checked to their end (20 million lines). The
    /// rest is checked only when the machine comes to it
    #[arg(long)]
    pub allow_unchecked: bool,
}

/// A program, or another file that is read, by its name.
pub(super) fn program_file() -> impl TypedValueParser<Value = ProgramFile> {
    PathBufValueParser::new().map(ProgramFile::named)
}

fn dialect(name: &str) -> Result<Dialect, &'static str> {
    let all = [
        Dialect::LinuxCnc,
        Dialect::Marlin,
        Dialect::Fanuc,
        Dialect::Siemens,
    ];
    all.into_iter()
        .find(|dialect| dialect.name() == name)
        .ok_or("give linuxcnc, marlin, fanuc or siemens")
}
