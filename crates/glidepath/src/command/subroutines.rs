//! The search for subroutines that a program calls and does not define.

use glidepath_gcode::{MAX_SUBROUTINE_BYTES, NoSubroutineFile, SubroutineFile, Subroutines};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Subroutines of the program in a file: in its folder, then in those of the search path, in order.
/// A program without a file, which comes through a pipe, has the search path alone.
pub(super) fn subroutines(program: Option<&Path>, search_path: &[PathBuf]) -> Subroutines {
    let own = program.map(|file| file.parent().unwrap_or(Path::new("")).to_owned());
    let folders: Vec<PathBuf> = own.into_iter().chain(search_path.iter().cloned()).collect();
    Subroutines::new(move |name| find(&folders, name))
}

fn find(folders: &[PathBuf], name: &str) -> Result<SubroutineFile, NoSubroutineFile> {
    for folder in folders {
        let path = folder.join(name);
        match read(&path) {
            Ok(text) => {
                return Ok(SubroutineFile {
                    name: path.display().to_string().into(),
                    text: text.into(),
                });
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => {
                return Err(NoSubroutineFile::Unreadable {
                    path: path.display().to_string(),
                    reason: error.to_string(),
                });
            }
        }
    }
    let looked_in = folders.iter().map(|folder| match folder.to_str() {
        Some("") => ".".to_owned(),
        _ => folder.display().to_string(),
    });
    Err(NoSubroutineFile::Missing {
        looked_in: looked_in.collect(),
    })
}

/// The text of a file; of one that is too long, as much as shows it.
fn read(path: &Path) -> io::Result<Vec<u8>> {
    let kind = path.metadata()?;
    if kind.is_dir() {
        // Program 20 of a FANUC is looked for as `20`, too, which may well be a folder.
        return Err(io::ErrorKind::NotFound.into());
    }
    // A pipe would keep whoever opens it waiting.
    if !kind.is_file() {
        return Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "it is no ordinary file",
        ));
    }
    let mut text = Vec::new();
    let most = MAX_SUBROUTINE_BYTES as u64 + 1;
    File::open(path)?.take(most).read_to_end(&mut text)?;
    Ok(text)
}
