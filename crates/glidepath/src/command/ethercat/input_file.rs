//! The file of inputs, which is looked at while the devices run.

use super::emulated_inputs::{Level, Pins};
use crate::command::failure::Failure;
use crate::file_error::FileError;
use crate::{output, text_file};
use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use std::path::{Path, PathBuf};
use std::sync::mpsc::Sender;

/// Largest file, bytes.
const MOST_BYTES: u64 = 1 << 16;
/// Between two looks at the file.
const POLL: Duration = Duration::from_millis(50);

/// The file, and what it said last.
#[derive(Debug)]
pub(super) struct InputFile {
    path: PathBuf,
    pins: Pins,
    text: String,
}

impl InputFile {
    /// Reads the file for the first time: what is wrong in it then is refused.
    ///
    /// # Errors
    /// It cannot be read, or is wrong.
    pub(super) fn open(path: &Path, pins: Pins) -> Result<(Self, Vec<Level>), Failure> {
        let text = read(path).map_err(FileError::file("read", path))?;
        let levels = pins.read(&text).map_err(|error| Failure::Inputs {
            file: path.display().to_string(),
            error: error.to_string(),
        })?;
        let path = path.to_owned();
        Ok((Self { path, pins, text }, levels))
    }

    /// Looks at the file until it is over, and hands on what is new in it. What is wrong in it, or a file
    /// that is gone, is told once, and changes nothing.
    pub(super) fn watch(&mut self, changed: &Sender<Vec<Level>>, is_over: &AtomicBool) {
        while !is_over.load(Ordering::Relaxed) {
            std::thread::sleep(POLL);
            // One that is being written is there again at the next look.
            let Ok(text) = read(&self.path) else {
                continue;
            };
            if text == self.text {
                continue;
            }
            self.text = text;
            match self.pins.read(&self.text) {
                // Nobody is left to be told.
                Ok(levels) => drop(changed.send(levels)),
                Err(error) => output::note(&format!(
                    "ethercat: {}:{error}; the inputs stay as they are",
                    self.path.display()
                )),
            }
        }
    }
}

fn read(path: &Path) -> std::io::Result<String> {
    text_file::read(path, MOST_BYTES)
}
