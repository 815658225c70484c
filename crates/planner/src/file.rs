//! Programs in files, of whatever kind.

use std::fs::File;
use std::io::{self, BufReader};
use std::path::Path;

use glidepath_gcode::{Options, Report, check};
use glidepath_motion::Settings;

use crate::{CurveSource, ItemSource, ProgramSource, Refusal, Supply};

/// Bytes read from a file at a time.
const BUFFER: usize = 64 * 1024;

/// Items of a file: G-code, or a curve if the name ends in `.toml`.
#[derive(Debug)]
pub enum FileSource {
    /// G-code.
    Program(Box<ProgramSource<BufReader<File>>>),
    /// A curve file.
    Curve(Box<CurveSource>),
}

impl FileSource {
    /// A file that was checked, or is not to be.
    ///
    /// # Errors
    /// It cannot be read, or (curves) not be understood.
    pub fn unchecked(path: &Path, options: Options, settings: &Settings) -> Result<Self, Refusal> {
        if CurveSource::is_for(path) {
            let source = CurveSource::open(path, options, settings)?;
            return Ok(Self::Curve(Box::new(source)));
        }
        let reader = BufReader::with_capacity(BUFFER, File::open(path)?);
        Ok(Self::Program(Box::new(ProgramSource::new(reader, options))))
    }

    /// Opens a file after a pass over the whole of it.
    ///
    /// # Errors
    /// All findings, if there is any; or why the file cannot be read.
    pub fn open(path: &Path, options: Options, settings: &Settings) -> Result<Self, Refusal> {
        if !CurveSource::is_for(path) {
            return Ok(Self::Program(Box::new(ProgramSource::open(path, options)?)));
        }
        let report = check_file(path, options.clone(), settings)?;
        if !report.diagnostics.is_empty() {
            return Err(Refusal::Program {
                findings: report.diagnostics,
                unlisted: report.more,
            });
        }
        Self::unchecked(path, options, settings)
    }
}

/// Finds everything wrong with a file, without motion.
///
/// # Errors
/// The file cannot be read.
pub fn check_file(path: &Path, options: Options, settings: &Settings) -> io::Result<Report> {
    if !CurveSource::is_for(path) {
        let file = File::open(path)?;
        return Ok(check(BufReader::with_capacity(BUFFER, file), options));
    }
    let final_position = options.start;
    match CurveSource::open(path, options, settings) {
        Ok(source) => Ok(source.check()),
        Err(Refusal::Read(error)) => Err(error),
        Err(Refusal::Program { findings, .. }) => Ok(Report {
            diagnostics: findings,
            more: 0,
            complete: true,
            totals: glidepath_gcode::Totals::default(),
            survey: glidepath_gcode::Survey::default(),
            final_position,
        }),
        Err(other) => Err(io::Error::other(other)),
    }
}

impl ItemSource for FileSource {
    fn next_item(&mut self) -> Supply {
        match self {
            Self::Program(source) => source.next_item(),
            Self::Curve(source) => source.next_item(),
        }
    }

    fn lines_read(&self) -> u64 {
        match self {
            Self::Program(source) => source.lines_read(),
            Self::Curve(source) => source.lines_read(),
        }
    }

    fn fingerprint(&self) -> u64 {
        match self {
            Self::Program(source) => source.fingerprint(),
            Self::Curve(source) => source.fingerprint(),
        }
    }
}
