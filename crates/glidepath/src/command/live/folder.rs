//! The folder of programs: what is in it, and how a page puts one there, piece by piece.
//!
//! A program has its name only once it is whole, and takes the place of no other unless that is wanted. A
//! name is that of a file in the folder itself: it leads nowhere else. One program is on its way at a time,
//! in a file of its own that is gone with this process; and a folder takes no more programs, and no more
//! bytes, than are stated here.

use glidepath_link::is_printable;
use serde_json::{Value, json};
use std::fs::Metadata;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::UNIX_EPOCH;
use tempfile::NamedTempFile;

/// Longest name, bytes: with what a part of it is called it is one that file systems take.
const MOST_NAME: usize = 200;
/// Largest program, bytes.
const MOST_BYTES: u64 = 1 << 30;
/// Programs that are listed, and that a folder has at most when one is put there.
const MOST_PROGRAMS: usize = 2000;
/// Bytes of all programs, at most, when one is put there.
const MOST_IN_FOLDER: u64 = 16 << 30;

/// Why a program is not taken, or not there.
#[derive(Debug, thiserror::Error)]
pub(super) enum FolderError {
    #[error("{0} is no name of a program: give one without `/` that does not begin with a point")]
    Name(String),
    #[error("there is no program {0} in the folder")]
    NotThere(String),
    #[error("there is a program {0} already")]
    There(String),
    #[error(
        "a piece is missing, or another program was sent meanwhile: send it from its beginning"
    )]
    Piece,
    #[error("a program has at most 1 GiB")]
    TooLarge,
    #[error("the folder has {MOST_PROGRAMS} programs, and takes no more: remove some")]
    TooMany,
    #[error(
        "the programs of the folder have 16 GiB with this one, and it takes no more: remove some"
    )]
    Full,
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

/// A program on its way.
#[derive(Debug)]
struct Part {
    name: String,
    size: u64,
    has: u64,
    file: NamedTempFile,
}

/// A folder of programs.
#[derive(Debug)]
pub(super) struct Folder {
    path: PathBuf,
    /// The one that is on its way; another one takes its place.
    part: Mutex<Option<Part>>,
}

impl Folder {
    pub(super) fn at(path: &Path) -> io::Result<Self> {
        let path = path.canonicalize()?;
        if !path.is_dir() {
            return Err(io::ErrorKind::NotADirectory.into());
        }
        let part = Mutex::default();
        Ok(Self { path, part })
    }

    /// Names of the programs, with what is known of their files.
    fn programs(&self) -> Result<Vec<(String, Metadata)>, FolderError> {
        let failed = |cause| FolderError::File(self.path.clone(), cause);
        let entries = std::fs::read_dir(&self.path).map_err(failed)?;
        let program = |entry: std::fs::DirEntry| {
            let name = entry.file_name().into_string().ok()?;
            // Where a link leads is looked at: a program may be one.
            let about = std::fs::metadata(entry.path()).ok()?;
            (about.is_file() && is_name(&name)).then_some((name, about))
        };
        Ok(entries.flatten().filter_map(program).collect())
    }

    /// The programs, the newest first.
    pub(super) fn object(&self) -> Result<Value, FolderError> {
        let changed = |about: &Metadata| {
            let at = about.modified().ok()?.duration_since(UNIX_EPOCH).ok()?;
            Some(at.as_millis())
        };
        let found = self.programs()?.into_iter();
        let mut found: Vec<_> = found
            .map(|(name, about)| (changed(&about).unwrap_or(0), name, about.len()))
            .collect();
        found.sort_by(|a, b| b.0.cmp(&a.0).then_with(|| a.1.cmp(&b.1)));
        let programs: Vec<Value> = found
            .iter()
            .take(MOST_PROGRAMS)
            .map(|(changed_ms, name, bytes)| {
                let changed_ms = u64::try_from(*changed_ms).unwrap_or(u64::MAX);
                json!({ "name": name, "bytes": bytes, "changed_ms": changed_ms })
            })
            .collect();
        Ok(json!({
            "folder": self.path.display().to_string(),
            "count": found.len(),
            "programs": programs,
        }))
    }

    /// The file of a program.
    pub(super) fn file(&self, name: &str) -> Result<PathBuf, FolderError> {
        if !is_name(name) {
            return Err(FolderError::Name(name.to_owned()));
        }
        let path = self.path.join(name);
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
        let path = self.path.join(name);
        let is_there = path.symlink_metadata().is_ok();
        if is_there && !piece.replaces {
            return Err(FolderError::There(name.to_owned()));
        }
        let mut on_its_way = self.part.lock().unwrap_or_else(PoisonError::into_inner);
        if piece.at == 0 {
            // The one before is gone, whether it was whole or not.
            *on_its_way = None;
            *on_its_way = Some(self.begin(piece, is_there)?);
        }
        let part = on_its_way.as_mut().filter(|part| {
            (part.name.as_str(), part.size, part.has) == (name, piece.size, piece.at)
        });
        let part = part.ok_or(FolderError::Piece)?;
        let failed = |cause| FolderError::File(path.clone(), cause);
        part.file.write_all(piece.bytes).map_err(failed)?;
        part.has = end;
        if end < piece.size {
            return Ok(false);
        }
        let Some(Part { file, .. }) = on_its_way.take() else {
            return Err(FolderError::Piece);
        };
        drop(on_its_way);
        file.as_file().sync_all().map_err(failed)?;
        let named = if piece.replaces {
            file.persist(&path)
        } else {
            file.persist_noclobber(&path)
        };
        match named.map_err(|failed| failed.error) {
            Ok(_) => Ok(true),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                Err(FolderError::There(name.to_owned()))
            }
            Err(error) => Err(FolderError::File(path, error)),
        }
    }

    /// Begins with a program, if there is room for it.
    fn begin(&self, piece: &Piece<'_>, is_there: bool) -> Result<Part, FolderError> {
        let programs = self.programs()?;
        if !is_there && programs.len() >= MOST_PROGRAMS {
            return Err(FolderError::TooMany);
        }
        let bytes = programs.iter().map(|(_, about)| about.len()).sum::<u64>();
        if bytes.saturating_add(piece.size) > MOST_IN_FOLDER {
            return Err(FolderError::Full);
        }
        // Begins with a point: it is none of the programs.
        let file = NamedTempFile::new_in(&self.path);
        Ok(Part {
            name: piece.name.to_owned(),
            size: piece.size,
            has: 0,
            file: file.map_err(|cause| FolderError::File(self.path.clone(), cause))?,
        })
    }
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
        // A piece that is missing, or was sent already, or is of another program.
        for (name, at, size) in [
            ("a.ngc", 4, 6),
            ("a.ngc", 2, 6),
            ("a.ngc", 3, 7),
            ("b.ngc", 3, 6),
        ] {
            let wrong = folder.take(&piece(name, at, size, b"G0"));
            assert!(
                matches!(wrong, Err(FolderError::Piece)),
                "{name} {at} {size}"
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
        std::os::unix::fs::symlink(&target, place.path().join("a.ngc")).unwrap();
        let there = folder.take(&piece("a.ngc", 0, 1, b"x"));
        assert!(matches!(there, Err(FolderError::There(_))));
        let replacing = Piece {
            replaces: true,
            ..piece("a.ngc", 0, 1, b"x")
        };
        assert!(folder.take(&replacing).unwrap());
        assert_eq!(std::fs::read(&target).unwrap(), b"kept");
        assert_eq!(std::fs::read(place.path().join("a.ngc")).unwrap(), b"x");
    }

    #[test]
    fn one_program_is_on_its_way_and_nothing_is_left_of_others() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::at(place.path()).unwrap();
        let files = || std::fs::read_dir(place.path()).unwrap().count();
        for name in ["a.ngc", "b.ngc", "c.ngc"] {
            assert!(!folder.take(&piece(name, 0, 9, b"G0 X")).unwrap());
            assert_eq!(files(), 1);
        }
        // Two of the same length are not mixed.
        let mixed = folder.take(&piece("a.ngc", 4, 9, b"11111"));
        assert!(matches!(mixed, Err(FolderError::Piece)));
        assert!(folder.take(&piece("c.ngc", 4, 9, b"11111")).unwrap());
        assert_eq!(
            (
                files(),
                std::fs::read(folder.file("c.ngc").unwrap()).unwrap()
            ),
            (1, b"G0 X11111".to_vec())
        );
        assert!(!folder.take(&piece("d.ngc", 0, 9, b"G0 X")).unwrap());
        drop(folder);
        assert_eq!(files(), 1);
    }

    #[test]
    fn a_folder_takes_so_many_programs_and_bytes() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::at(place.path()).unwrap();
        for number in 0..MOST_PROGRAMS {
            std::fs::write(place.path().join(number.to_string()), "M2").unwrap();
        }
        let more = folder.take(&piece("a.ngc", 0, 2, b"M2"));
        assert!(matches!(more, Err(FolderError::TooMany)));
        let replaces = true;
        let replacing = Piece {
            replaces,
            ..piece("7", 0, 3, b"M30")
        };
        assert!(folder.take(&replacing).unwrap());
        std::fs::remove_file(place.path().join("8")).unwrap();
        assert!(folder.take(&piece("a.ngc", 0, 2, b"M2")).unwrap());
        std::fs::remove_file(place.path().join("9")).unwrap();
        // It has that length, and takes no room.
        let large = std::fs::File::create(place.path().join("10")).unwrap();
        large.set_len(MOST_IN_FOLDER).unwrap();
        let full = folder.take(&piece("b.ngc", 0, 2, b"M2"));
        assert!(matches!(full, Err(FolderError::Full)));
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
