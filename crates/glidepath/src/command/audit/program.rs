//! The machine and the program that a file is judged by, with what the program began with.

use super::outline::Outline;
use super::trace::Trace;
use crate::begun::{Begun as Told, Part};
use crate::cli::AuditArgs;
use crate::command::failure::Failure;
use crate::command::reading::for_program;
use crate::command::subroutines::subroutines;
use crate::config::{self, MachineConfig, ProgramConfig};
use crate::file_error::FileError;
use crate::program_file::ProgramFile;
use glidepath_recording::{Begun, Origin};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// The machine and the program that a file is judged by.
pub(super) struct Program {
    pub(super) config: MachineConfig,
    path: Option<PathBuf>,
    /// What it began with: the epoch of its motion, and what the planner told.
    begun: Option<(u64, Told)>,
    /// What is missing to read it as it was.
    missing: Option<String>,
    /// The program of the recording, in a file, for as long as it is needed.
    _kept: Option<NamedTempFile>,
}

impl Program {
    /// What the command line says to judge by; what that leaves open, the recording tells.
    pub(super) fn of(args: &AuditArgs, config: &MachineConfig) -> Result<Self, Failure> {
        let mut trace = Trace::open(&args.file, config)?;
        let path = args.program.as_ref().map(|file| file.path().to_owned());
        let mut program = Self::by(config.clone(), path);
        let begun = trace.begun()?.cloned();
        let Some(origin) = trace.origin() else {
            return Ok(program);
        };
        let told = begun.as_ref().map(|begun| Told::parse(&begun.set_up));
        let told = told.transpose().unwrap_or_else(|_| {
            program.lacks("what it began with is told in a form that this version does not know");
            None
        });
        if args.basic.config.is_none() {
            program.config = configuration(args, config, origin, told.as_ref())?;
        }
        let text = begun.as_ref().and_then(|begun| begun.program.as_deref());
        if let (None, Some(text)) = (&args.program, text.or(origin.program.as_deref())) {
            program.keep(text, args.file.name())?;
        }
        match (begun, told) {
            (Some(begun), Some(told)) => program.begins(begun, told),
            _ => program.settle(),
        }
        Ok(program)
    }

    /// A machine and, if there is one, a program that begins with what the configuration says.
    pub(super) const fn by(config: MachineConfig, path: Option<PathBuf>) -> Self {
        Self {
            config,
            path,
            begun: None,
            missing: None,
            _kept: None,
        }
    }

    /// Its text, if it is known.
    pub(super) fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Why a motion is not judged by it.
    pub(super) fn unjudged(&self, outline: &Outline) -> Option<String> {
        if let Some(missing) = &self.missing {
            return Some(format!("{missing}: its path is not judged"));
        }
        let (epoch, told) = self.begun.as_ref()?;
        let is_other = outline.program.is_some_and(|(of, _)| !told.is_of(of));
        if is_other || outline.epochs.first() != Some(epoch) {
            return Some("another program was executed: its path is not judged".to_owned());
        }
        let is_rest = told.part == Part::Rest;
        is_rest.then(|| "the motion goes on with a program: its path is not judged".to_owned())
    }

    fn lacks(&mut self, what: &str) {
        self.missing.get_or_insert_with(|| what.to_owned());
    }

    /// Puts the text of the recording into a file.
    fn keep(&mut self, text: &[u8], recording: &Path) -> Result<(), Failure> {
        let write = || {
            let mut file = NamedTempFile::new()?;
            file.write_all(text)?;
            Ok(file)
        };
        let file = write().map_err(FileError::file("keep the program of", recording))?;
        self.path = Some(file.path().to_owned());
        self._kept = Some(file);
        Ok(())
    }

    /// Has it read with what it began with.
    fn begins(&mut self, begun: Begun, told: Told) {
        let lacking = told
            .subroutines
            .keys()
            .find(|name| !begun.subroutines.contains_key(*name));
        if let Some(name) = lacking {
            self.lacks(&format!(
                "its subroutine {name} is not part of the recording"
            ));
        }
        told.set_up(&mut self.config, begun.subroutines);
        self.begun = Some((begun.epoch, told));
    }

    /// Has it read as its beginning tells, where nothing else does.
    fn settle(&mut self) {
        let Some(path) = &self.path else {
            return;
        };
        let program = &mut self.config.program;
        // Those beside the file are beside a file of ours.
        let found = || subroutines(None, &program.subroutine_path);
        program.subroutines = Some(program.subroutines.take().unwrap_or_else(found));
        self.config = for_program(&ProgramFile::named(path), &self.config);
    }
}

/// The configuration of a recording, read as the command line says.
fn configuration(
    args: &AuditArgs,
    config: &MachineConfig,
    origin: &Origin,
    told: Option<&Told>,
) -> Result<MachineConfig, Failure> {
    let name = format!("configuration of {}", args.file.name().display());
    let mut recorded = match told {
        Some(told) => told.configuration(&name)?,
        None => config::parse(&name, &origin.configuration)?,
    };
    let path = &mut recorded.path;
    if told.is_none() {
        let fact = |name: &str| origin.fact(name).unwrap_or_default();
        // What the command line of the recorder said counts for more than its file.
        path.effort = config::effort(fact("effort")).unwrap_or(path.effort);
        path.tolerance_mm = config::tolerance(fact("tolerance_mm")).unwrap_or(path.tolerance_mm);
    }
    path.effort = args.path.effort.unwrap_or(path.effort);
    path.tolerance_mm = args.path.tolerance.unwrap_or(path.tolerance_mm);
    let read = &config.program;
    recorded.program = ProgramConfig {
        dialect: read.dialect.or(recorded.program.dialect),
        question: read.question.clone(),
        tools: read.tools.clone(),
        offsets: read.offsets.clone(),
        variables: read.variables.clone(),
        subroutines: read.subroutines.clone(),
        subroutine_path: read.subroutine_path.clone(),
        may_run_unchecked: read.may_run_unchecked,
        ..recorded.program
    };
    Ok(recorded)
}
