//! The source of items of a file, whatever kind of program it is.

use std::fs::File;
use std::io::{self, BufReader, Read as _};
use std::path::Path;

use glidepath_curve::{CurveFile, NurbsFile};
use glidepath_gcode::{Diagnostics, InForce, Lacking, Options, Report, check, diagnostics};
use glidepath_program::Settings;

use crate::run::refusal::Refusal;
use crate::source::curve::CurveSource;
use crate::source::input_arbiter::InputResult;
use crate::source::item_source::{ItemSource, Settled, Supply};
use crate::source::nurbs::NurbsSource;
use crate::source::program::ProgramSource;
use crate::source::run_channels::RunChannels;
use crate::source::unchanged_file::UnchangedFile;

/// Bytes read from a file at a time.
const BUFFER: usize = 64 * 1024;

/// Largest curve file, bytes: a hundred thousand control points.
const MOST_BYTES: u64 = 4 << 20;

/// How much of a file tells what it is, bytes.
const BEGINNING: u64 = 4096;

/// Items of a file: G-code, or a curve if the name ends in `.toml` or `.json`, or has no ending and
/// the text begins as that of a curve file.
#[derive(Debug)]
pub enum FileSource {
    /// G-code.
    Program(Box<ProgramSource<BufReader<UnchangedFile>>>),
    /// A curve given by formulas.
    Curve(Box<CurveSource>),
    /// A NURBS.
    Nurbs(Box<NurbsSource>),
}

/// A file that was looked at from its beginning to its end.
#[derive(Debug)]
pub struct LookedAt {
    /// Which program it is: see [`ItemSource::fingerprint`]. A curve that cannot be understood has none: 0.
    pub fingerprint: u64,
    /// What it should say and does not; a curve lacks nothing.
    pub lacks: Lacking,
    /// Its items, or all that is wrong with it.
    pub source: Result<FileSource, Refusal>,
}

impl FileSource {
    /// A file that was checked, or is not to be.
    ///
    /// # Errors
    /// It cannot be read, or (curves) not be understood.
    pub fn unchecked(path: &Path, options: Options, settings: &Settings) -> Result<Self, Refusal> {
        if is_curve(path) {
            return Self::curve(path, options, settings);
        }
        let reader = BufReader::with_capacity(BUFFER, UnchangedFile::open(path)?);
        Ok(Self::Program(Box::new(ProgramSource::new(reader, options))))
    }

    /// Opens a file after a pass over the whole of it.
    ///
    /// # Errors
    /// All diagnostics, if there is any; or why the file cannot be read.
    pub fn open(path: &Path, options: Options, settings: &Settings) -> Result<Self, Refusal> {
        Self::look(path, options, settings)?.source
    }

    /// The same, with the fingerprint of the file also where something is wrong with it.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn look(path: &Path, options: Options, settings: &Settings) -> io::Result<LookedAt> {
        if !is_curve(path) {
            let (fingerprint, lacks, source) = ProgramSource::look(path, options)?;
            return Ok(LookedAt {
                fingerprint,
                lacks,
                source: source.map(|source| Self::Program(Box::new(source))),
            });
        }
        let source = Self::open_curve(path, options, settings);
        let fingerprint = source.as_ref().map_or(0, Self::fingerprint);
        Ok(LookedAt {
            fingerprint,
            lacks: Lacking::default(),
            source,
        })
    }

    fn open_curve(path: &Path, options: Options, settings: &Settings) -> Result<Self, Refusal> {
        let report = check_file(path, options.clone(), settings, &mut |_| {})?;
        if !report.diagnostics.is_empty() {
            return Err(Refusal::Program {
                diagnostics: report.diagnostics,
                unlisted: report.more,
            });
        }
        let may_run = options.loops.may_run_unchecked;
        if let Some(line) = report.given_up_at.filter(|_| !may_run) {
            return Err(Refusal::Unchecked { line });
        }
        Self::unchecked(path, options, settings)
    }

    /// The same source, of a program whose fingerprint is known: it was opened before, and is read once more. A curve
    /// knows its own.
    #[must_use]
    pub fn known_as(self, fingerprint: u64) -> Self {
        match self {
            Self::Program(source) => Self::Program(Box::new(source.known_as(fingerprint))),
            curve @ (Self::Curve(_) | Self::Nurbs(_)) => curve,
        }
    }

    /// The same source, which shares what it comes to with whoever attends to its run.
    #[must_use]
    pub fn attended(self, channels: RunChannels) -> Self {
        match self {
            Self::Program(source) => Self::Program(Box::new(source.attended(channels))),
            // Curves change, say and ask nothing.
            curve @ (Self::Curve(_) | Self::Nurbs(_)) => curve,
        }
    }

    /// The state in force behind the items given out; `None` for curves, which change nothing.
    #[must_use]
    pub fn in_force(&self) -> Option<InForce> {
        match self {
            Self::Program(source) => Some(source.in_force()),
            Self::Curve(_) | Self::Nurbs(_) => None,
        }
    }

    fn curve(path: &Path, options: Options, settings: &Settings) -> Result<Self, Refusal> {
        let mut text = String::new();
        let file = UnchangedFile::open(path)?;
        file.take(MOST_BYTES + 1).read_to_string(&mut text)?;
        if text.len() as u64 > MOST_BYTES {
            let message = "a curve file has at most 4 MiB";
            return Err(io::Error::new(io::ErrorKind::InvalidData, message).into());
        }
        let refuse = |diagnostics| Refusal::Program {
            diagnostics,
            unlisted: 0,
        };
        if NurbsFile::is_meant(&text) {
            let source = NurbsSource::new(text, options, settings);
            let source = source.map_err(|diagnostic| refuse(vec![*diagnostic]))?;
            return Ok(Self::Nurbs(Box::new(source)));
        }
        let source = CurveSource::new(text, options, settings).map_err(refuse)?;
        Ok(Self::Curve(Box::new(source)))
    }
}

/// Whether a file is a curve file, by its name; where that has no ending, as that of a pipe has none,
/// by its beginning.
fn is_curve(path: &Path) -> bool {
    let Some(extension) = path.extension() else {
        let mut beginning = Vec::new();
        // A file that cannot be read is told of where it is read as a program.
        let read =
            File::open(path).and_then(|file| file.take(BEGINNING).read_to_end(&mut beginning));
        return read.is_ok() && CurveFile::begins(&String::from_utf8_lossy(&beginning));
    };
    extension == "toml" || extension == "json"
}

/// Reads a file, and tells how far it has come.
struct Watched<'w> {
    file: UnchangedFile,
    read: u64,
    watch: &'w mut dyn FnMut(u64),
}

impl<'w> Watched<'w> {
    fn open(path: &Path, watch: &'w mut dyn FnMut(u64)) -> io::Result<BufReader<Self>> {
        let file = UnchangedFile::open(path)?;
        let watched = Self {
            file,
            read: 0,
            watch,
        };
        Ok(BufReader::with_capacity(BUFFER, watched))
    }
}

impl io::Read for Watched<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.file.read(buffer)?;
        self.read += count as u64;
        (self.watch)(self.read);
        Ok(count)
    }
}

/// Finds everything wrong with a file, without motion. `watch` is told now and then how many bytes
/// of a program have been read.
///
/// # Errors
/// The file cannot be read.
pub fn check_file(
    path: &Path,
    options: Options,
    settings: &Settings,
    watch: &mut dyn FnMut(u64),
) -> io::Result<Report> {
    let final_position = options.start;
    if !is_curve(path) {
        return Ok(check(Watched::open(path, watch)?, options));
    }
    match FileSource::curve(path, options, settings) {
        Ok(FileSource::Curve(source)) => Ok(source.check()),
        Ok(FileSource::Nurbs(source)) => Ok(source.check()),
        Ok(FileSource::Program(_)) => Err(io::Error::other("a curve is no program")),
        Err(Refusal::Read(error)) => Err(error),
        Err(Refusal::Program { diagnostics, .. }) => Ok(Report {
            diagnostics,
            more: 0,
            given_up_at: None,
            lacks: Lacking::default(),
            totals: glidepath_gcode::Totals::default(),
            part: Vec::new(),
            survey: glidepath_gcode::Survey::default(),
            final_position,
        }),
        Err(other) => Err(io::Error::other(other)),
    }
}

/// The same diagnostics without all else, for a file that is only to be accepted or refused.
///
/// # Errors
/// The file cannot be read.
pub fn find_in_file(
    path: &Path,
    options: Options,
    settings: &Settings,
    watch: &mut dyn FnMut(u64),
) -> io::Result<Diagnostics> {
    if !is_curve(path) {
        return Ok(diagnostics(Watched::open(path, watch)?, options));
    }
    let report = check_file(path, options, settings, watch)?;
    Ok(Diagnostics {
        diagnostics: report.diagnostics,
        more: report.more,
        given_up_at: report.given_up_at,
        lacks: report.lacks,
        lines: report.totals.lines,
        least_time_s: report.totals.feed_time_s + report.totals.dwell_s,
    })
}

impl ItemSource for FileSource {
    fn is_on_contour(&self) -> bool {
        match self {
            Self::Program(source) => source.is_on_contour(),
            Self::Curve(_) | Self::Nurbs(_) => false,
        }
    }

    fn settle(&mut self, known: Option<InputResult>) -> Result<Settled, Refusal> {
        match self {
            Self::Program(source) => source.settle(known),
            Self::Curve(_) | Self::Nurbs(_) => Ok(Settled::Nothing),
        }
    }

    fn next_item(&mut self) -> Supply {
        match self {
            Self::Program(source) => source.next_item(),
            Self::Curve(source) => source.next_item(),
            Self::Nurbs(source) => source.next_item(),
        }
    }

    fn lines_read(&self) -> u64 {
        match self {
            Self::Program(source) => source.lines_read(),
            Self::Curve(source) => source.lines_read(),
            Self::Nurbs(source) => source.lines_read(),
        }
    }

    fn fingerprint(&self) -> u64 {
        match self {
            Self::Program(source) => source.fingerprint(),
            Self::Curve(source) => source.fingerprint(),
            Self::Nurbs(source) => source.fingerprint(),
        }
    }
}
