//! A file that opens the page: a small page of its own, which leads to the address with its token.
//!
//! The token is in the file, and not in the words of a command that opens it, which every user of the host can read.
//! Whoever can read the file may do what the page may. Nobody but this user can, but in a folder with the setgid bit
//! (mode 2750, say): there its group can, too.

use std::fs::{self, OpenOptions};
use std::io::{self, Write as _};
use std::os::unix::fs::{MetadataExt as _, OpenOptionsExt as _, PermissionsExt as _};
use std::path::{Path, PathBuf};

/// The bit of a folder that gives its files its group.
const SETGID: u32 = 0o2000;
/// What the file says while nobody serves the page.
const ENDED: &str = "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>Glidepath</title>\n\
    <p>The page of this machine is not served now. The machine may be off, or its services were stopped.</p>\n\
    <p>Open this again when they run: <code>systemctl status glidepath-panel</code> says what became of the page.</p>\n";

/// The file, which leads to the page for as long as this lives.
pub(super) struct Shortcut {
    file: PathBuf,
}

impl Shortcut {
    /// Writes the file, which opens this address.
    ///
    /// # Errors
    /// The file cannot be written.
    pub(super) fn begin(file: &Path, url: &str) -> io::Result<Self> {
        let text = format!(
            "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>Glidepath</title>\n\
             <meta name=\"referrer\" content=\"no-referrer\">\n\
             <meta http-equiv=\"refresh\" content=\"0; url={url}\">\n\
             <p><a href=\"{url}\">Open the page of the machine</a></p>\n"
        );
        write(file, &text)?;
        Ok(Self {
            file: file.to_owned(),
        })
    }
}

impl Drop for Shortcut {
    fn drop(&mut self) {
        // An address that nobody answers is as clear, if less kind.
        let _written = write(&self.file, ENDED);
    }
}

/// Beside the file first, made anew: nobody reads a half of it, and nothing is written through a link that somebody else
/// has put there.
fn write(file: &Path, text: &str) -> io::Result<()> {
    let folder = file.parent().filter(|folder| *folder != Path::new(""));
    let is_shared = fs::metadata(folder.unwrap_or(Path::new(".")))?.mode() & SETGID != 0;
    let mode = if is_shared { 0o640 } else { 0o600 };
    let fresh = file.with_extension("new");
    match fs::remove_file(&fresh) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    let mut options = OpenOptions::new();
    let mut made = options
        .create_new(true)
        .write(true)
        .mode(mode)
        .open(&fresh)?;
    // The mask of the process may have taken the group's right.
    made.set_permissions(fs::Permissions::from_mode(mode))?;
    made.write_all(text.as_bytes())?;
    fs::rename(&fresh, file)
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let planted = folder.path().join("elsewhere");
        std::os::unix::fs::symlink(&planted, file.with_extension("new")).unwrap();
        let _shortcut = Shortcut::begin(&file, "http://127.0.0.1:8420/").unwrap();
        assert_eq!(mode(&file), 0o640);
        assert!(!planted.exists());
    }
}
