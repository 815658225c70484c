//! An output file: written beside its place, and renamed when it is whole.
//!
//! So an interrupted command leaves what was there before, and nobody reads half a file. What the
//! command reads is never overwritten, nor, unless told, a file that is not of the kind that is
//! written. Devices and pipes (`/dev/stdout`, a FIFO) are written as they are; `-` is standard output,
//! with nothing else on it.

use crate::file_error::FileError;
use crate::output;
use crate::part_file::PartFile;
use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, Read as _, Write};
use std::os::fd::AsFd as _;
use std::os::unix::fs::{MetadataExt as _, PermissionsExt};
use std::path::{Path, PathBuf};

/// The kind of a file, by how it begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutputKind {
    /// Setpoints as CSV.
    Setpoints,
    /// A plot.
    Plot,
    /// A plot as a page.
    Page,
    /// A file that opens the page of a machine.
    Shortcut,
    /// A recording.
    Recording,
    /// A program of fitted curves.
    Program,
    /// A curve file.
    Curve,
}

impl OutputKind {
    const fn name(self) -> &'static str {
        match self {
            Self::Setpoints => "a CSV file of setpoints",
            Self::Plot => "a plot of this program",
            Self::Page => "a page of this program",
            Self::Shortcut => "a file that opens the page",
            Self::Recording => "a recording",
            Self::Program => "a program with fitted curves",
            Self::Curve => "a curve file of this program",
        }
    }

    /// Whether a text that begins so was written by this program as one of this kind.
    fn is_begun_by(self, head: &str) -> bool {
        match self {
            Self::Setpoints => head.starts_with("tick,time_s,line,state,feed_mm_s,path_mm"),
            Self::Plot => head.starts_with("<svg ") && head.contains("'DejaVu Sans','Segoe UI'"),
            Self::Page => head.contains(glidepath_live::file::GENERATOR),
            Self::Shortcut => head.contains(SHORTCUT),
            Self::Recording => head.get(..12).unwrap_or(head).contains("MCAP0\r\n"),
            Self::Program => head.starts_with("(machine coordinates: run it with work offsets"),
            Self::Curve => head.starts_with("name = ") && head.contains("control_points = [  # mm"),
        }
    }
}

/// What stands in a file that opens the page.
pub(crate) const SHORTCUT: &str = "<meta name=\"generator\" content=\"glidepath live --shortcut\">";

/// The files that may not be overwritten.
#[derive(Debug, Clone, Default)]
pub struct OverwriteGuard {
    /// What the command reads.
    pub inputs: Vec<PathBuf>,
    /// Whether a file of another kind may be overwritten; never one that is read.
    pub force: bool,
}

/// A file that is being written.
#[derive(Debug)]
pub struct OutputFile {
    path: PathBuf,
    target: Target,
}

#[derive(Debug)]
enum Target {
    /// A device or a pipe.
    Direct(File),
    /// A file without a name, beside the place it will have.
    Beside {
        file: BufWriter<PartFile>,
        place: PathBuf,
    },
}

impl OutputFile {
    /// Begins a file, beside its place.
    ///
    /// # Errors
    /// It may not be written, or cannot be.
    pub fn create(
        path: &Path,
        kind: OutputKind,
        guard: &OverwriteGuard,
    ) -> Result<Self, FileError> {
        let path = if path == Path::new("-") {
            take_stdout(kind)?
        } else {
            path
        };
        let there = match path.metadata() {
            Ok(there) => Some(there),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => return Err(FileError::open(path)(error)),
        };
        // As it is written a path says little: `/dev/../x` is no device, and links lead anywhere.
        let folder = path.parent().filter(|folder| *folder != Path::new(""));
        let folder = folder.unwrap_or(Path::new(".")).canonicalize();
        let folder = folder.map_err(FileError::open(path))?;
        let is_same = |input: &PathBuf| {
            let (input, there) = (input.metadata().ok(), there.as_ref());
            input.zip(there).is_some_and(|(input, there)| {
                there.is_file() && (input.dev(), input.ino()) == (there.dev(), there.ino())
            })
        };
        if guard.inputs.iter().any(is_same) {
            let reason = "the command reads it; give another file".to_owned();
            return Err(FileError::guarded(path, reason));
        }
        let ending = path.extension();
        let is_foreign = ending.is_some_and(|ending| !ending.eq_ignore_ascii_case("svg"));
        if kind == OutputKind::Plot && is_foreign {
            let reason = "it would be an SVG drawing: call it NAME.svg; `plan` and `run` write a page \
                          instead, if it is called NAME.html";
            let reason = reason.to_owned();
            return Err(FileError::guarded(path, reason));
        }
        // Memory for files is below `/dev` too, and no device.
        let is_stream = ["/dev", "/proc"].iter().any(|top| folder.starts_with(top))
            && !folder.starts_with("/dev/shm");
        if is_stream || there.as_ref().is_some_and(|there| !there.is_file()) {
            // Standard output that was opened anew would be written from its beginning.
            let file = if path == Path::new("/dev/stdout") {
                let own = io::stdout().as_fd().try_clone_to_owned();
                own.map(File::from)
            } else {
                OpenOptions::new().append(true).open(path)
            };
            let target = Target::Direct(file.map_err(FileError::open(path))?);
            let path = path.to_owned();
            return Ok(Self { path, target });
        }
        let mut mode = 0o666;
        let mut place = folder.join(path.file_name().unwrap_or_default());
        if let Some(there) = there {
            if !guard.force && !begins_as(path, kind).map_err(FileError::open(path))? {
                let reason = format!(
                    "there is a file that is not {}; give another name, or --force to overwrite it",
                    kind.name()
                );
                return Err(FileError::guarded(path, reason));
            }
            mode = there.permissions().mode() & 0o777;
            // A link stays, and what it points to is replaced.
            place = path.canonicalize().map_err(FileError::open(path))?;
        }
        let folder = place.parent().unwrap_or(&folder);
        let file = PartFile::create(folder, &place, mode).map_err(FileError::open(path))?;
        Ok(Self {
            path: path.to_owned(),
            target: Target::Beside {
                file: BufWriter::with_capacity(1 << 16, file),
                place,
            },
        })
    }

    /// Its name on the command line.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// True if both will be the same file.
    #[must_use]
    pub fn has_place_of(&self, other: &Self) -> bool {
        let place = |file: &Self| match &file.target {
            Target::Direct(_) => None,
            Target::Beside { place, .. } => Some(place.clone()),
        };
        place(self).is_some_and(|own| place(other) == Some(own))
    }

    /// Puts the file, which is whole now, in its place.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn finish(self) -> Result<(), FileError> {
        let whole = || match self.target {
            Target::Direct(mut file) => file.flush(),
            Target::Beside { file, place } => {
                let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
                file.persist(&place)
            }
        };
        whole().map_err(FileError::file("write", &self.path))
    }
}

impl Write for OutputFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.target {
            Target::Direct(file) => file.write(bytes),
            Target::Beside { file, .. } => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.target {
            Target::Direct(file) => file.flush(),
            Target::Beside { file, .. } => file.flush(),
        }
    }
}

/// Writes a whole text.
///
/// # Errors
/// As [`OutputFile::create`] and [`OutputFile::finish`].
pub fn write(
    path: &Path,
    kind: OutputKind,
    guard: &OverwriteGuard,
    text: &str,
) -> Result<(), FileError> {
    let mut file = OutputFile::create(path, kind, guard)?;
    let written = file.write_all(text.as_bytes());
    written.map_err(FileError::file("write", path))?;
    file.finish()
}

/// Standard output for a file, which has it to itself.
fn take_stdout(kind: OutputKind) -> Result<&'static Path, FileError> {
    let refused = |reason: &str| FileError::guarded(Path::new("-"), reason.to_owned());
    if kind == OutputKind::Recording {
        return Err(refused("a recording needs a file; give its name"));
    }
    if !output::give_away() {
        return Err(refused(
            "only one file can go to standard output; give the other a name",
        ));
    }
    Ok(Path::new("/dev/stdout"))
}

/// Whether a file begins as one of a kind, or is empty.
/// Whether what is there was written by this program as a file of that kind, or is empty.
///
/// # Errors
/// It cannot be read.
pub(crate) fn begins_as(path: &Path, kind: OutputKind) -> io::Result<bool> {
    let mut head = Vec::new();
    File::open(path)?.take(4096).read_to_end(&mut head)?;
    Ok(head.is_empty() || kind.is_begun_by(&String::from_utf8_lossy(&head)))
}
