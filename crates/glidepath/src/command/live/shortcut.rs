//! A file that opens the page: a small page of its own, which leads to the address with its token.
//!
//! The token is in the file, and not in the words of a command that opens it, which every user of the host can read.
//! Whoever can read the file may do what the page may. Nobody but this user can, but in a folder with the setgid bit
//! (mode 2750, say): there its group can, too.

use crate::file_error::FileError;
use crate::output_file::{OutputKind, SHORTCUT, begins_as};
use crate::part_file::PartFile;
use std::fs;
use std::io::{self, Write as _};
use std::os::unix::fs::MetadataExt as _;
use std::path::{Path, PathBuf};

/// The bit of a folder that gives its files its group.
const SETGID: u32 = 0o2000;

/// The file, which leads to the page for as long as this lives.
pub(super) struct Shortcut {
    file: PathBuf,
}

impl Shortcut {
    /// Writes the file, which opens this address.
    ///
    /// # Errors
    /// The file cannot be written, or another file is there.
    pub(super) fn begin(file: &Path, url: &str) -> Result<Self, FileError> {
        if file.exists() && !begins_as(file, OutputKind::Shortcut).map_err(FileError::open(file))? {
            let reason = "there is a file that does not open a page; give another name";
            return Err(FileError::guarded(file, reason.to_owned()));
        }
        let text = format!(
            "<meta name=\"referrer\" content=\"no-referrer\">\n\
             <meta http-equiv=\"refresh\" content=\"0; url={url}\">\n\
             <p><a href=\"{url}\">Open the page of the machine</a></p>\n"
        );
        write(file, &text).map_err(FileError::file("write", file))?;
        Ok(Self {
            file: file.to_owned(),
        })
    }
}

impl Drop for Shortcut {
    fn drop(&mut self) {
        // An address that nobody answers is as clear, if less kind.
        let ended = "<p>The page of this machine is not served now: the machine may be off, or its services were \
                     stopped. Open this again when they run.</p>\n";
        let _written = write(&self.file, ended);
    }
}

/// Beside its place first: nobody reads a half of it, and nothing is written through a link that somebody else has put
/// there.
fn write(file: &Path, text: &str) -> io::Result<()> {
    let folder = file.parent().filter(|folder| *folder != Path::new(""));
    let folder = folder.unwrap_or(Path::new("."));
    let is_shared = fs::metadata(folder)?.mode() & SETGID != 0;
    let mode = if is_shared { 0o640 } else { 0o600 };
    let mut made = PartFile::create(folder, file, mode)?;
    made.set_mode(mode)?;
    write!(
        made,
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n{SHORTCUT}\n<title>Glidepath</title>\n{text}"
    )?;
    made.persist(file)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::fs::PermissionsExt as _;

    fn mode(file: &Path) -> u32 {
        fs::metadata(file).unwrap().mode() & 0o7777
    }

    #[test]
    fn a_file_leads_to_the_page_and_then_says_that_it_is_over() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("Glidepath.html");
        let shortcut = Shortcut::begin(&file, "http://127.0.0.1:8420/#token=abc").unwrap();
        let text = fs::read_to_string(&file).unwrap();
        assert!(
            text.contains("0; url=http://127.0.0.1:8420/#token=abc\""),
            "{text}"
        );
        assert_eq!(mode(&file), 0o600);
        drop(shortcut);
        let text = fs::read_to_string(&file).unwrap();
        assert!(
            !text.contains("token") && text.contains("not served now"),
            "{text}"
        );
    }

    #[test]
    fn the_group_of_a_folder_with_its_bit_reads_it_and_no_link_is_followed() {
        let folder = tempfile::tempdir().unwrap();
        let shared = fs::Permissions::from_mode(0o2750);
        fs::set_permissions(folder.path(), shared).unwrap();
        let file = folder.path().join("Glidepath.html");
        let elsewhere = folder.path().join("elsewhere");
        fs::write(&elsewhere, "").unwrap();
        std::os::unix::fs::symlink(&elsewhere, &file).unwrap();
        let _shortcut = Shortcut::begin(&file, "http://127.0.0.1:8420/").unwrap();
        assert_eq!(mode(&file), 0o640);
        assert_eq!(fs::read(&elsewhere).unwrap(), b"");
    }

    #[test]
    fn a_file_that_is_none_is_not_overwritten() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("part.ngc");
        fs::write(&file, "G0 X1\nM2\n").unwrap();
        assert!(Shortcut::begin(&file, "http://127.0.0.1:8420/").is_err());
        assert_eq!(fs::read(&file).unwrap(), b"G0 X1\nM2\n");
        // One of before is, also after a server that was killed.
        let file = folder.path().join("page.html");
        core::mem::forget(Shortcut::begin(&file, "http://127.0.0.1:1/").unwrap());
        let _again = Shortcut::begin(&file, "http://127.0.0.1:2/").unwrap();
        assert!(fs::read_to_string(&file).unwrap().contains("127.0.0.1:2/"));
    }
}
