//! The folder of programs: what is in it, and how a page puts one there, piece by piece.
//!
//! A program has its name only once it is whole, and takes the place of no other unless that is wanted. A
//! name is that of a file in the folder itself: it leads nowhere else.

use glidepath_link::is_printable;
use rustix::fs::{CWD, OFlags, RenameFlags, renameat_with};
use serde_json::{Value, json};
use std::fs::{File, OpenOptions};
use std::io::{self, Write as _};
use std::os::unix::fs::OpenOptionsExt as _;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

/// Longest name, bytes: with what a part of it is called it is one that file systems take.
const MOST_NAME: usize = 200;
/// Largest program, bytes.
const MOST_BYTES: u64 = 1 << 30;
/// Programs that are listed.
const MOST_LISTED: usize = 2000;

/// Why a program is not taken, or not there.
#[derive(Debug, thiserror::Error)]
pub(super) enum FolderError {
    #[error("{0} is no name of a program: give one without `/` that does not begin with a point")]
    Name(String),
    #[error("there is no program {0} in the folder")]
    NotThere(String),
    #[error("there is a program {0} already")]
    There(String),
    #[error("a piece is missing, or two pages send the same program: send it from its beginning")]
    Piece,
    #[error("a program has at most 1 GiB")]
    TooLarge,
    #[error("{path}: {cause}", path = .0.display(), cause = .1)]
    File(PathBuf, io::Error),
}

/// A piece of a program.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece<'p> {
    pub(super) name: &'p str,
    /// Where it begins, bytes.
    pub(super) at: u64,
    /// Length of the whole program.
    pub(super) size: u64,
    /// The program may take the place of another one.
    pub(super) replaces: bool,
    pub(super) bytes: &'p [u8],
}

/// A folder of programs.
#[derive(Debug, Clone)]
pub(super) struct Folder(PathBuf);

impl Folder {
    pub(super) fn at(path: &Path) -> io::Result<Self> {
        let path = path.canonicalize()?;
        if !path.is_dir() {
            return Err(io::ErrorKind::NotADirectory.into());
        }
        Ok(Self(path))
    }

    /// The programs, the newest first.
    pub(super) fn object(&self) -> Result<Value, FolderError> {
        let failed = |cause| FolderError::File(self.0.clone(), cause);
        let mut found = Vec::new();
        for entry in std::fs::read_dir(&self.0).map_err(failed)? {
            let Ok(entry) = entry else { continue };
            let Ok(name) = entry.file_name().into_string() else {
                continue;
            };
            // Where a link leads is looked at: a program may be one.
            let Ok(about) = std::fs::metadata(entry.path()) else {
                continue;
            };
            if about.is_file() && is_name(&name) {
                let changed = about.modified().ok();
                let changed = changed.and_then(|at| at.duration_since(UNIX_EPOCH).ok());
                let changed_ms = changed.map_or(0, |at| at.as_millis());
                found.push((changed_ms, name, about.len()));
            }
        }
        found.sort_by(|a, b| b.0.cmp(&a.0).then_with(|| a.1.cmp(&b.1)));
        let programs: Vec<Value> = found
            .iter()
            .take(MOST_LISTED)
            .map(|(changed_ms, name, bytes)| {
                let changed_ms = u64::try_from(*changed_ms).unwrap_or(u64::MAX);
                json!({ "name": name, "bytes": bytes, "changed_ms": changed_ms })
            })
            .collect();
        Ok(json!({
            "folder": self.0.display().to_string(),
            "count": found.len(),
            "programs": programs,
        }))
    }

    /// The file of a program.
    pub(super) fn file(&self, name: &str) -> Result<PathBuf, FolderError> {
        if !is_name(name) {
            return Err(FolderError::Name(name.to_owned()));
        }
        let path = self.0.join(name);
        let is_there = path.metadata().is_ok_and(|about| about.is_file());
        is_there
            .then_some(path)
            .ok_or_else(|| FolderError::NotThere(name.to_owned()))
    }

    /// Takes a piece. Returns whether the program is whole.
    pub(super) fn take(&self, piece: &Piece<'_>) -> Result<bool, FolderError> {
        let name = piece.name;
        if !is_name(name) {
            return Err(FolderError::Name(name.to_owned()));
        }
        let end = piece.at.saturating_add(piece.bytes.len() as u64);
        if piece.size > MOST_BYTES {
            return Err(FolderError::TooLarge);
        }
        if end > piece.size {
            return Err(FolderError::Piece);
        }
        let (path, part) = (self.0.join(name), self.0.join(format!(".{name}.part")));
        if path.symlink_metadata().is_ok() && !piece.replaces {
            return Err(FolderError::There(name.to_owned()));
        }
        let failed = |cause| FolderError::File(part.clone(), cause);
        let mut file = open(&part, piece.at == 0).map_err(failed)?;
        if file.metadata().map_err(failed)?.len() != piece.at {
            return Err(FolderError::Piece);
        }
        file.write_all(piece.bytes).map_err(failed)?;
        if end < piece.size {
            return Ok(false);
        }
        file.sync_all().map_err(failed)?;
        let renamed = if piece.replaces {
            std::fs::rename(&part, &path)
        } else {
            renameat_with(CWD, &part, CWD, &path, RenameFlags::NOREPLACE).map_err(io::Error::from)
        };
        match renamed {
            Ok(()) => Ok(true),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                Err(FolderError::There(name.to_owned()))
            }
            Err(error) => Err(FolderError::File(path, error)),
        }
    }
}

/// Opens a part to be written at its end, never through a link.
fn open(part: &Path, is_new: bool) -> io::Result<File> {
    if is_new {
        match std::fs::remove_file(part) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
    }
    OpenOptions::new()
        .append(true)
        .create(is_new)
        .mode(0o600)
        .custom_flags(OFlags::NOFOLLOW.bits().cast_signed())
        .open(part)
}

fn is_name(name: &str) -> bool {
    let is_plain = |c: char| c != '/' && !c.is_control();
    !name.is_empty()
        && name.len() <= MOST_NAME
        && !name.starts_with('.')
        && name.chars().all(is_plain)
        && name.chars().all(is_printable)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece<'p>(name: &'p str, at: u64, size: u64, bytes: &'p [u8]) -> Piece<'p> {
        Piece {
            name,
            at,
            size,
            replaces: false,
            bytes,
        }
    }

    #[test]
    fn a_program_has_its_name_once_it_is_whole() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::at(place.path()).unwrap();
        assert!(!folder.take(&piece("a.ngc", 0, 6, b"G0 ")).unwrap());
        assert!(matches!(
            folder.file("a.ngc"),
            Err(FolderError::NotThere(_))
        ));
        assert_eq!(folder.object().unwrap()["count"], 0);
        // The piece before again, and one that is missing.
        for at in [0, 4] {
            let again = folder.take(&piece("b.ngc", at, 6, b"G0"));
            assert_eq!(
                matches!(again, Err(FolderError::Piece | FolderError::File(..))),
                at > 0
            );
        }
        assert!(folder.take(&piece("a.ngc", 3, 6, b"X1\n")).unwrap());
        assert_eq!(
            std::fs::read(folder.file("a.ngc").unwrap()).unwrap(),
            b"G0 X1\n"
        );
        let listed = folder.object().unwrap();
        assert_eq!(
            (&listed["count"], &listed["programs"][0]["name"]),
            (&1.into(), &"a.ngc".into())
        );
        // Another one takes its place only if that is wanted.
        let other = piece("a.ngc", 0, 2, b"M2");
        assert!(matches!(folder.take(&other), Err(FolderError::There(_))));
        let replaces = true;
        assert!(folder.take(&Piece { replaces, ..other }).unwrap());
        assert_eq!(std::fs::read(folder.file("a.ngc").unwrap()).unwrap(), b"M2");
    }

    #[test]
    fn a_name_leads_nowhere_else() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::at(place.path()).unwrap();
        let long = "x".repeat(201);
        for name in [
            "",
            ".",
            "..",
            ".hidden",
            "../a.ngc",
            "a/b.ngc",
            "/etc/passwd",
            "a\nb",
            "a\0b",
            &long,
        ] {
            assert!(
                matches!(
                    folder.take(&piece(name, 0, 1, b"x")),
                    Err(FolderError::Name(_))
                ),
                "{name:?}"
            );
            assert!(
                matches!(folder.file(name), Err(FolderError::Name(_))),
                "{name:?}"
            );
        }
        // What is written does not go through a link that somebody has put there.
        let outside = tempfile::tempdir().unwrap();
        let target = outside.path().join("target");
        std::fs::write(&target, "kept").unwrap();
        std::os::unix::fs::symlink(&target, place.path().join(".a.ngc.part")).unwrap();
        assert!(folder.take(&piece("a.ngc", 0, 1, b"x")).unwrap());
        std::os::unix::fs::symlink(&target, place.path().join(".b.ngc.part")).unwrap();
        assert!(folder.take(&piece("b.ngc", 4, 5, b"x")).is_err());
        assert_eq!(std::fs::read(&target).unwrap(), b"kept");
    }

    #[test]
    fn too_much_is_refused_before_it_is_written() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::at(place.path()).unwrap();
        let huge = piece("a.ngc", 0, u64::MAX, b"x");
        assert!(matches!(folder.take(&huge), Err(FolderError::TooLarge)));
        let beyond = piece("a.ngc", 0, 1, b"xy");
        assert!(matches!(folder.take(&beyond), Err(FolderError::Piece)));
        assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 0);
    }
}
