//! The note of the tool length in force, which a planner leaves for whoever shows positions.
//!
//! Which length is in force (G43) is a matter of the program, and programs are read long before they are
//! executed. Only the planner knows when the machine has come to a change, and puts it then into the
//! directory that the processes of its instance share. The note outlasts its planner: what a program left is
//! in force until something else is, or a service of programs begins without.

use crate::text_file;
use glidepath_gcode::ToolLength;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The file in the instance's directory.
const FILE: &str = "tool-length.toml";
/// The most of it that is read, bytes.
const MOST_BYTES: u64 = 4096;

/// Where a planner notes the length of the tool in force.
#[derive(Debug, Clone)]
pub(crate) struct ToolLengthNote {
    directory: PathBuf,
}

impl ToolLengthNote {
    /// That of an instance's directory.
    pub(crate) const fn new(directory: PathBuf) -> Self {
        Self { directory }
    }

    /// Leaves it in the place of the one before.
    ///
    /// # Errors
    /// It cannot be written.
    pub(crate) fn leave(&self, length: &ToolLength) -> io::Result<()> {
        let text = toml::to_string(length).map_err(io::Error::other)?;
        text_file::replace(&self.directory, FILE, &text)
    }

    /// No length is in force.
    pub(crate) fn clear(&self) {
        // Where there is none, none is in force.
        fs::remove_file(self.directory.join(FILE)).ok();
    }
}

/// The length of the tool in force on the machine of an instance, as far as it is known: none without a note,
/// or with one that this version cannot read.
pub(crate) fn in_force(directory: &Path) -> ToolLength {
    let text = text_file::read(&directory.join(FILE), MOST_BYTES).unwrap_or_default();
    toml::from_str(&text).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_gcode::Tip;

    #[test]
    fn what_is_left_is_what_is_read_and_none_is_none() {
        let folder = tempfile::tempdir().unwrap();
        let note = ToolLengthNote::new(folder.path().to_owned());
        assert_eq!(in_force(folder.path()), ToolLength::default());
        let mut length = ToolLength::default();
        length.offset[2] = 52.125;
        for tip in [Tip::Stands, Tip::Follows { longer_mm: -3.5 }] {
            length.tip = tip;
            note.leave(&length).unwrap();
            assert_eq!(in_force(folder.path()), length);
        }
        fs::write(folder.path().join(FILE), "offset = 7").unwrap();
        assert_eq!(in_force(folder.path()), ToolLength::default());
        note.clear();
        note.clear();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
