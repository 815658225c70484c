//! What is kept of a motion while it passes by: CSV and plot.

use crate::config::MachineConfig;
use crate::file_error::FileError;
use crate::plot::Plot;
use crate::report::state_name;
use crate::sample::Sample;
use crate::setpoints::CsvWriter;
use glidepath_link::MachineState;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

/// The files of a motion as they grow.
#[derive(Debug)]
pub struct Recording {
    csv: Option<(PathBuf, CsvWriter<BufWriter<File>>)>,
    plot: Option<(PathBuf, Plot)>,
}

impl Recording {
    /// Creates the files that were asked for.
    ///
    /// # Errors
    /// A file cannot be created.
    pub fn create(
        config: &MachineConfig,
        csv: Option<&Path>,
        plot: Option<&Path>,
    ) -> Result<Self, FileError> {
        let axes = config.axis_names();
        let csv = csv
            .map(|path| {
                let file = File::create(path).map_err(FileError::open(path))?;
                let writer = CsvWriter::new(
                    BufWriter::with_capacity(1 << 16, file),
                    &axes,
                    config.joints(),
                )
                .map_err(FileError::file("write", path))?;
                Ok::<_, FileError>((path.to_owned(), writer))
            })
            .transpose()?;
        let plot = plot
            .map(|path| {
                // Now, so that a path that cannot be written is known before an hour of motion.
                File::create(path).map_err(FileError::open(path))?;
                let plot = Plot::new(&axes, config.limits(), config.period_t())
                    .with_joints(&config.joint_limits, config.joints());
                Ok::<_, FileError>((path.to_owned(), plot))
            })
            .transpose()?;
        Ok(Self { csv, plot })
    }

    /// Whether anything is kept.
    #[must_use]
    pub const fn is_wanted(&self) -> bool {
        self.csv.is_some() || self.plot.is_some()
    }

    /// Takes the next sample.
    ///
    /// # Errors
    /// The CSV cannot be written.
    pub fn push(&mut self, sample: &Sample) -> Result<(), FileError> {
        if let Some((path, csv)) = &mut self.csv {
            csv.row(sample).map_err(FileError::file("write", path))?;
        }
        // Waiting before and after the program is no part of the picture.
        let shown = sample.state != state_name(MachineState::Idle);
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
        if let Some((path, csv)) = self.csv {
            csv.finish().map_err(FileError::file("write", &path))?;
        }
        if let Some((path, plot)) = self.plot {
            std::fs::write(&path, plot.render(title, caption))
                .map_err(FileError::file("write", &path))?;
        }
        Ok(())
    }
}
