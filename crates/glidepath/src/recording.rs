//! The files that are kept of a motion while it passes by: CSV and plot.

use crate::config::MachineConfig;
use crate::file_error::FileError;
use crate::output_file::{OutputFile, OutputKind, OverwriteGuard};
use crate::picture::Picture;
use crate::report::MotionReport;
use crate::sample::TickSample;
use crate::setpoints::CsvWriter;
use glidepath_link::MachineState;
use glidepath_program::Item;
use std::io::{BufWriter, Write as _};
use std::path::{Path, PathBuf};

/// The files of a motion as they grow.
#[derive(Debug)]
pub struct Recording {
    csv: Option<CsvWriter<BufWriter<OutputFile>>>,
    plot: Option<(OutputFile, Picture)>,
    csv_path: PathBuf,
}

impl Recording {
    /// Begins the files that were asked for.
    ///
    /// # Errors
    /// A file may not be written, or cannot be.
    pub fn create(
        config: &MachineConfig,
        csv: Option<&Path>,
        plot: Option<&Path>,
        guard: &OverwriteGuard,
    ) -> Result<Self, FileError> {
        let axes = config.axis_names();
        let csv_path = csv.unwrap_or(Path::new("")).to_owned();
        let begin = |path: Option<&Path>, kind| {
            path.map(|path| OutputFile::create(path, kind, guard))
                .transpose()
        };
        // Both now, so that a path that cannot be written is known before an hour of motion.
        let csv = begin(csv, OutputKind::Setpoints)?;
        let kind = plot.map_or(OutputKind::Plot, Picture::kind);
        let plot = begin(plot, kind)?;
        if let (Some(csv), Some(plot)) = (&csv, &plot)
            && csv.has_place_of(plot)
        {
            let reason = "setpoints and plot cannot go to the same file".to_owned();
            return Err(FileError::guarded(csv.path(), reason));
        }
        let writer = |file| CsvWriter::new(BufWriter::new(file), &axes, config.joints());
        let csv = csv.map(writer).transpose();
        let csv = csv.map_err(FileError::file("write", &csv_path))?;
        let plot = plot.map(|file| {
            let picture = Picture::new(config, file.path());
            (file, picture)
        });
        Ok(Self {
            csv,
            plot,
            csv_path,
        })
    }

    /// Whether anything is kept.
    #[must_use]
    pub const fn is_wanted(&self) -> bool {
        self.csv.is_some() || self.plot.is_some()
    }

    /// Takes the next item of the program that the motion follows.
    pub fn program(&mut self, item: &Item) {
        if let Some((_, plot)) = &mut self.plot {
            plot.program(item);
        }
    }

    /// Takes what is known of the motion as a whole, and where its program is.
    pub fn told(&mut self, report: &MotionReport, program: &Path) {
        if let Some((_, plot)) = &mut self.plot {
            plot.told(report, program);
        }
    }

    /// Takes the next sample.
    ///
    /// # Errors
    /// The CSV cannot be written.
    pub fn push(&mut self, sample: &TickSample) -> Result<(), FileError> {
        if let Some(csv) = &mut self.csv {
            let written = csv.row(sample);
            written.map_err(FileError::file("write", &self.csv_path))?;
        }
        // Waiting before and after the program is no part of the picture.
        let shown = sample.state != MachineState::Idle.name();
        if let Some((_, plot)) = self.plot.as_mut().filter(|_| shown) {
            plot.push(sample);
        }
        Ok(())
    }

    /// Completes the files.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn finish(self, title: &str, caption: &str) -> Result<(), FileError> {
        let in_csv = FileError::file("write", &self.csv_path);
        if let Some(csv) = self.csv {
            let buffered = csv.finish().map_err(in_csv)?;
            let flushed = buffered.into_inner();
            let flushed = flushed.map_err(std::io::IntoInnerError::into_error);
            flushed
                .map_err(FileError::file("write", &self.csv_path))?
                .finish()?;
        }
        if let Some((mut file, plot)) = self.plot {
            let written = file.write_all(plot.render(title, caption).as_bytes());
            written.map_err(FileError::file("write", file.path()))?;
            file.finish()?;
        }
        Ok(())
    }
}
