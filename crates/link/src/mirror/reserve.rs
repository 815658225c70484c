//! The memory of the mirror's services, taken before it is needed.
//!
//! iceoryx2's stock files have holes: a page is taken when it is written to first, and where the file system is full by
//! then, the process that writes ends by SIGBUS. Any user of the host can fill it.

use super::error::MirrorError;
use iceoryx2::prelude::Config;
use rustix::fs::{FallocateFlags, fallocate};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// Where iceoryx2 keeps memory, whatever its root.
const MEMORY: &str = "/dev/shm";

/// The files whose memory was taken.
#[derive(Debug, Default)]
pub(super) struct Reserved(Vec<PathBuf>);

impl Reserved {
    /// Takes the memory of all files of iceoryx2 that this process has mapped by now.
    ///
    /// # Errors
    /// [`MirrorError::Memory`]: the file for which there is no room, or the list of files. The others have theirs.
    pub(super) fn take(&mut self) -> Result<(), MirrorError> {
        let maps = Path::new("/proc/self/maps");
        let text = fs::read_to_string(maps).map_err(|source| MirrorError::Memory {
            path: maps.to_owned(),
            bytes: 0,
            source,
        })?;
        let prefix = format!("{MEMORY}/{}", Config::global_config().global.prefix);
        let mapped = mapped(&text, &prefix);
        self.0.retain(|path| mapped.contains(path));
        let bytes = mapped.iter().map(|path| length(path)).sum();
        let mut result = Ok(());
        for path in mapped {
            if self.0.contains(&path) {
                continue;
            }
            match taken(&path) {
                Ok(()) => self.0.push(path),
                // A reader that left has removed it.
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                Err(source) => {
                    result = Err(MirrorError::Memory {
                        path,
                        bytes,
                        source,
                    });
                }
            }
        }
        result
    }
}

/// How long a file is, bytes; 0 if it is not there any more.
fn length(path: &Path) -> u64 {
    path.metadata().map_or(0, |file| file.len())
}

fn taken(path: &Path) -> io::Result<()> {
    let file = File::options().read(true).write(true).open(path)?;
    let length = file.metadata()?.len();
    if length > 0 {
        fallocate(&file, FallocateFlags::empty(), 0, length)?;
    }
    Ok(())
}

/// The files of that prefix in a table of mappings, each once.
fn mapped(text: &str, prefix: &str) -> Vec<PathBuf> {
    let paths = text
        .lines()
        .filter_map(|line| Some(&line[line.find(prefix)?..]));
    // The kernel says so of one that was removed.
    let mut paths: Vec<_> = paths
        .filter(|path| !path.ends_with(" (deleted)"))
        .map(PathBuf::from)
        .collect();
    paths.sort();
    paths.dedup();
    paths
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test")]

    use super::*;
    use std::os::unix::fs::MetadataExt as _;

    #[test]
    fn files_are_found_among_mappings_each_once() {
        let text = "55d0-55d1 r--p 00000000 fe:00 12 /usr/bin/iox2_service\n\
                    7f00-7f01 rw-s 00000000 00:1a 30 /dev/shm/iox2_b.data\n\
                    7f02-7f03 rw-s 00000000 00:1a 31 /dev/shm/iox2_a.dynamic\n\
                    7f04-7f05 rw-s 00001000 00:1a 30 /dev/shm/iox2_b.data\n\
                    7f06-7f07 rw-s 00000000 00:1a 32 /dev/shm/iox2_c.data (deleted)\n\
                    7f08-7f09 rw-s 00000000 00:1a 33 /dev/shm/other\n";
        let found = mapped(text, "/dev/shm/iox2_");
        let expected = ["/dev/shm/iox2_a.dynamic", "/dev/shm/iox2_b.data"];
        assert_eq!(found, expected.map(PathBuf::from));
    }

    #[test]
    fn a_file_with_holes_has_none_afterwards() {
        let folder = tempfile::tempdir_in(MEMORY).unwrap();
        let path = folder.path().join("data");
        File::create(&path).unwrap().set_len(1 << 20).unwrap();
        assert_eq!(path.metadata().unwrap().blocks(), 0);
        taken(&path).unwrap();
        assert_eq!(path.metadata().unwrap().blocks() * 512, 1 << 20);
    }
}
