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
    /// Folder to look in for subroutines in files of their own, behind that of the program; may be
    /// given several times, and comes before `program.subroutine_path` of the configuration
    #[arg(long, value_name = "FOLDER")]
    pub subroutine_path: Vec<PathBuf>,
    /// Language of the program: linuxcnc, marlin, fanuc or siemens; else told by its beginning
    #[arg(long, value_name = "NAME", value_parser = dialect)]
    pub dialect: Option<Dialect>,
    /// Take a program whose loops go on for too long to be checked to their end (20 million lines):
    /// what it does behind that is judged only when it comes to it
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
