//! The note of the offsets in force (length of the tool, shift of G92), which a planner leaves for whoever
//! shows positions.
//!
//! Which are in force is a matter of the program, and programs are read long before they are
//! executed. Only the planner knows when the machine has come to a change, and puts it then into the
//! directory that the processes of its instance share. The note outlasts its planner: what a program left is
//! in force until something else is, or a service of programs begins without.

use crate::text_file;
use glidepath_gcode::PositionOffsets;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The file in the instance's directory.
const FILE: &str = "position-offsets.toml";
/// The most of it that is read, bytes.
const MOST_BYTES: u64 = 4096;

/// Where a planner notes the offsets in force.
#[derive(Debug, Clone)]
pub(crate) struct PositionOffsetsNote {
    directory: PathBuf,
}

impl PositionOffsetsNote {
    /// That of an instance's directory.
    pub(crate) const fn new(directory: PathBuf) -> Self {
        Self { directory }
    }

    /// Leaves it in the place of the one before.
    ///
    /// # Errors
    /// It cannot be written.
    pub(crate) fn leave(&self, offsets: &PositionOffsets) -> io::Result<()> {
        let text = toml::to_string(offsets).map_err(io::Error::other)?;
        text_file::replace(&self.directory, FILE, &text)
    }

    /// None is in force.
    pub(crate) fn clear(&self) {
        // Where there is none, none is in force.
        fs::remove_file(self.directory.join(FILE)).ok();
    }
}

/// The offsets in force on the machine of an instance, as far as it is known: none without a note,
/// or with one that this version cannot read.
pub(crate) fn in_force(directory: &Path) -> PositionOffsets {
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
        let note = PositionOffsetsNote::new(folder.path().to_owned());
        assert_eq!(in_force(folder.path()), PositionOffsets::default());
        let mut offsets = PositionOffsets::default();
        offsets.tool[2] = 52.125;
        offsets.shift[0] = -2.5;
        for tip in [Tip::Stands, Tip::Follows { longer_mm: -3.5 }] {
            offsets.tip = tip;
            note.leave(&offsets).unwrap();
            assert_eq!(in_force(folder.path()), offsets);
        }
        fs::write(folder.path().join(FILE), "tool = 7").unwrap();
        assert_eq!(in_force(folder.path()), PositionOffsets::default());
        note.clear();
        note.clear();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
