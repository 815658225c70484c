//! What is in the way of iceoryx2's stock storage, for whoever has to move it.
//!
//! Its files have fixed names in directories that all users share, so that another user can have
//! come first.

use iceoryx2::prelude::Config;
use std::fs::{self, File, Metadata};
use std::os::unix::fs::MetadataExt as _;
use std::path::{Path, PathBuf};

/// Where iceoryx2 keeps memory, whatever its root.
const MEMORY: &str = "/dev/shm";

/// Names what of another user is in the way of a domain, or where to look.
#[must_use]
pub fn obstacle(root: Option<&Path>) -> String {
    let config = Config::global_config();
    let stock = PathBuf::from(config.global.root_path().to_string());
    let root = root.unwrap_or(&stock);
    let prefix = config.global.prefix.to_string();
    let found = of_another_user(root).or_else(|| counter(Path::new(MEMORY), &prefix));
    found.unwrap_or_else(|| {
        format!(
            "look at the owners of {} and of {MEMORY}/{prefix}*, and whether {MEMORY} is full (`df -h \
             {MEMORY}`)",
            root.display()
        )
    })
}

fn of_another_user(root: &Path) -> Option<String> {
    let found = root.metadata().ok()?;
    is_foreign(&found).then(|| {
        format!(
            "{} belongs to another user (number {}), who came first: choose another with --root, for \
             the readers, too",
            root.display(),
            found.uid()
        )
    })
}

/// The counter of nodes, which all processes of iceoryx2 on a host share, whatever their root. It
/// outlives them, every user can write it, and its name is known.
fn counter(memory: &Path, prefix: &str) -> Option<String> {
    let files = fs::read_dir(memory).ok()?.flatten();
    files.into_iter().find_map(|file| {
        let name = file.file_name().into_string().ok()?;
        let is_counter = name.starts_with(prefix) && name.ends_with("global_mgmt");
        let found = file.metadata().ok().filter(|_| is_counter)?;
        let path = file.path();
        let cannot_be = !found.is_file() || found.len() == 0;
        let cannot_be = cannot_be || File::options().read(true).write(true).open(&path).is_err();
        Some(format!(
            "{} {} (of user number {}): remove it, as that user or as root, while nothing uses iceoryx2",
            path.display(),
            if cannot_be { "is in the way" } else { "may be damaged" },
            found.uid()
        ))
    })
}

fn is_foreign(found: &Metadata) -> bool {
    found.uid() != rustix::process::geteuid().as_raw()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test")]

    use super::*;

    #[test]
    fn a_counter_that_cannot_be_one_is_told_from_one_that_may_be_damaged() {
        let memory = tempfile::tempdir().unwrap();
        let told = || counter(memory.path(), "iox2_");
        assert_eq!(told(), None);
        let place = memory.path().join("iox2_1_node.0_10_0.global_mgmt");
        fs::write(&place, [0; 16]).unwrap();
        let damaged = told().unwrap();
        assert!(damaged.contains("global_mgmt may be damaged"), "{damaged}");
        fs::write(&place, []).unwrap();
        let empty = told().unwrap();
        assert!(empty.contains("global_mgmt is in the way"), "{empty}");
        fs::remove_file(&place).unwrap();
        fs::create_dir(&place).unwrap();
        assert!(told().unwrap().contains("is in the way"));
    }
}
