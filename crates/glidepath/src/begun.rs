//! The beginning of a program beside its text: tools, offsets, what was in force, and how it is
//! planned.
//!
//! A recording is judged where the files of the machine are not, or are others by then. Only the planner
//! knows what it works with, and only until the next job. So it puts that, before anything moves, into the
//! directory that the processes of its instance share, and whoever records takes it from there when the
//! motion begins.

use crate::config::{self, ConfigError, MachineConfig};
use crate::output;
use crate::persistence::convert::{begun_variables, left_variables};
use crate::text_file;
use glidepath_gcode::{
    Dialect, InForce, NoSubroutineFile, SubroutineFile, Subroutines, ToolTable, WorkOffsets,
};
use glidepath_link::TOLERANCE_RATIOS;
use glidepath_persistence::Variable;
use glidepath_program::Effort;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The file in the instance's directory.
const FILE: &str = "begun.toml";
/// The most of it that is read, bytes: all parameters, ten thousand names and as many tools.
const MOST_BYTES: u64 = 16 << 20;

/// Which part of its program a motion is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Part {
    /// All of it.
    Whole,
    /// What is behind a line, or behind where it was left.
    Rest,
}

/// What a program began with.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Begun {
    /// Its fingerprint, sixteen digits.
    program: String,
    /// Where its text is.
    pub(crate) path: PathBuf,
    pub(crate) part: Part,
    dialect: Dialect,
    may_run_unchecked: bool,
    effort: Effort,
    tolerance_mm: f64,
    /// How many times `tolerance_mm`, and what the program says of it, was used.
    #[serde(default = "once")]
    tolerance_ratio: f64,
    /// The text of the configuration.
    configuration: String,
    offsets: WorkOffsets,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    tools: Option<Arc<ToolTable>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    in_force: Option<InForce>,
    /// The kept parameters.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    variables: Vec<Variable>,
    /// Where the texts of its subroutines in other files are, by the names by which they were asked for.
    pub(crate) subroutines: BTreeMap<String, PathBuf>,
}

/// Where the planner tells what a program begins with.
#[derive(Debug)]
pub(crate) struct Board {
    directory: PathBuf,
    configuration: String,
}

impl Board {
    /// That of an instance's directory, for a planner with a configuration.
    pub(crate) const fn new(directory: PathBuf, configuration: String) -> Self {
        Self {
            directory,
            configuration,
        }
    }

    /// Tells what a program begins with that was read once, to be checked. What cannot be told is no reason not
    /// to move: then recordings do not have it, and say so.
    pub(crate) fn tell(&self, config: &MachineConfig, program: (&Path, u64), part: Part) {
        if let Err(error) = self.write(config, program, part) {
            self.clear();
            output::note(&format!(
                "planner: recordings will not tell what the program began with: {error}"
            ));
        }
    }

    fn write(&self, config: &MachineConfig, program: (&Path, u64), part: Part) -> io::Result<()> {
        let (path, fingerprint) = program;
        let read = config.program.subroutines.as_ref();
        let read = read.map(Subroutines::read).unwrap_or_default();
        let subroutines = read.into_iter();
        let begun = Begun {
            program: fingerprint_text(fingerprint),
            path: std::path::absolute(path)?,
            part,
            dialect: config.program.dialect.unwrap_or_default(),
            may_run_unchecked: config.program.may_run_unchecked,
            effort: config.path.effort,
            tolerance_mm: config.path.tolerance_mm / config.program.tolerance_ratio,
            tolerance_ratio: config.program.tolerance_ratio,
            configuration: self.configuration.clone(),
            offsets: config.program.offsets.clone(),
            tools: config.program.tools.clone(),
            variables: left_variables(&config.program.variables),
            in_force: config.program.in_force.clone(),
            subroutines: subroutines
                .map(|(name, file)| Ok((name, std::path::absolute(&*file.name)?)))
                .collect::<io::Result<_>>()?,
        };
        let text = toml::to_string(&begun).map_err(io::Error::other)?;
        text_file::replace(&self.directory, FILE, &text)
    }

    /// What moves next is no program in a file.
    pub(crate) fn clear(&self) {
        // Where it stays, its fingerprint tells that it is of something else.
        fs::remove_file(self.directory.join(FILE)).ok();
    }
}

/// The text of what the program began with that the planner of an instance told last; `None` if it told
/// nothing.
///
/// # Errors
/// It cannot be read.
pub(crate) fn told(directory: &Path) -> io::Result<Option<String>> {
    match text_file::read(&directory.join(FILE), MOST_BYTES) {
        Ok(text) => Ok(Some(text)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}

impl Begun {
    /// What a text tells.
    ///
    /// # Errors
    /// It is none.
    pub(crate) fn parse(text: &str) -> Result<Self, toml::de::Error> {
        toml::from_str(text)
    }

    /// Whether it is what a program of this fingerprint began with.
    pub(crate) fn is_of(&self, program: u64) -> bool {
        self.program == fingerprint_text(program)
    }

    /// The configuration that the planner had.
    ///
    /// # Errors
    /// It is none of this version.
    pub(crate) fn configuration(&self, name: &str) -> Result<MachineConfig, ConfigError> {
        let mut config = config::parse(name, &self.configuration)?;
        let path = &mut config.path;
        path.effort = self.effort;
        path.tolerance_mm =
            config::tolerance(&self.tolerance_mm.to_string()).unwrap_or(path.tolerance_mm);
        if TOLERANCE_RATIOS.contains(&self.tolerance_ratio) {
            config.use_tolerance_ratio(self.tolerance_ratio);
        }
        Ok(config)
    }

    /// Has the program read as it was, with the texts of its subroutines by their names.
    pub(crate) fn set_up(&self, config: &mut MachineConfig, texts: BTreeMap<String, Arc<[u8]>>) {
        let program = &mut config.program;
        program.dialect = Some(self.dialect);
        program.may_run_unchecked = self.may_run_unchecked;
        program.offsets = self.offsets.clone();
        program.tools = self.tools.clone();
        program.variables = begun_variables(&self.variables);
        program.in_force = self.in_force.clone();
        program.subroutines = Some(Subroutines::new(move |name| {
            let text = texts.get(name).ok_or_else(|| NoSubroutineFile::Missing {
                looked_in: vec!["the recording".to_owned()],
            })?;
            Ok(SubroutineFile {
                name: name.into(),
                text: Arc::clone(text),
            })
        }));
    }
}

/// A run with the tolerance as it is.
const fn once() -> f64 {
    1.0
}

/// A fingerprint as sixteen digits: TOML's whole numbers are too small for all of them.
fn fingerprint_text(program: u64) -> String {
    format!("{program:016x}")
}
