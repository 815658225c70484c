//! The interpolators of other users, for whoever looks for one and finds none: they can be neither
//! read nor commanded, but that they are there anybody can see.

use std::fmt;
use std::fs;
use std::os::unix::fs::MetadataExt as _;
use std::path::Path;

/// Where the services keep their instances: the value of `XDG_RUNTIME_DIR` in their units.
const OF_SERVICES: &str = "/run/glidepath";

/// The interpolator of another user, if one was seen.
#[derive(Debug, Default)]
pub(crate) struct OtherUsers(Option<Other>);

#[derive(Debug)]
struct Other {
    user: String,
    process: u32,
    is_service: bool,
}

impl OtherUsers {
    /// Looks for one among the processes of this host.
    pub(super) fn look() -> Self {
        let own = rustix::process::geteuid().as_raw();
        Self(look_in(Path::new("/proc"), own))
    }
}

impl fmt::Display for OtherUsers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(Other {
            user,
            process,
            is_service,
        }) = &self.0
        else {
            return Ok(());
        };
        let place = if *is_service {
            format!(" XDG_RUNTIME_DIR={OF_SERVICES}")
        } else {
            String::new()
        };
        write!(
            f,
            ". One of user {user} does (process {process}), at which this user may not look, nor \
             command it: do it as that user, `sudo -u {user}{place} glidepath …`"
        )
    }
}

fn look_in(processes: &Path, own: u32) -> Option<Other> {
    let entries = fs::read_dir(processes).ok()?;
    entries.flatten().find_map(|entry| {
        let process = entry.file_name().to_str()?.parse().ok()?;
        let line = fs::read(entry.path().join("cmdline")).ok()?;
        let owner = entry.metadata().ok()?.uid();
        let is_other = is_interpolator(&line) && owner != own;
        is_other.then(|| Other {
            user: name_of(owner),
            process,
            is_service: fs::metadata(OF_SERVICES).is_ok_and(|found| found.uid() == owner),
        })
    })
}

/// Whether a command line is that of `glidepath interpolator`.
fn is_interpolator(line: &[u8]) -> bool {
    let mut words = line.split(|byte| *byte == 0);
    let program = words.next().unwrap_or_default();
    let is_ours = program
        .rsplit(|byte| *byte == b'/')
        .next()
        .is_some_and(|name| name == b"glidepath");
    is_ours && words.next() == Some(b"interpolator")
}

/// The name of a user, or its number where it has none here.
fn name_of(user: u32) -> String {
    let users = fs::read_to_string("/etc/passwd").unwrap_or_default();
    let of = |line: &str| {
        let mut fields = line.split(':');
        let (name, _, number) = (fields.next()?, fields.next()?, fields.next()?);
        (number.parse() == Ok(user)).then(|| name.to_owned())
    };
    users
        .lines()
        .find_map(of)
        .unwrap_or_else(|| format!("#{user}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interpolator_of_another_user_is_named_and_none_else() {
        let folder = tempfile::tempdir().unwrap();
        let own = rustix::process::geteuid().as_raw();
        let process = |number: &str, line: &str| {
            let path = folder.path().join(number);
            fs::create_dir(&path).unwrap();
            fs::write(path.join("cmdline"), line.replace(' ', "\0")).unwrap();
        };
        process("self", "glidepath interpolator");
        process("11", "/usr/bin/vi interpolator");
        process("12", "/usr/bin/glidepath planner --listen");
        process("13", "");
        // What this process makes is its own user's: for another one it is another's.
        assert!(look_in(folder.path(), own + 1).is_none());
        process("14", "/usr/bin/glidepath interpolator --config m.toml");
        assert!(look_in(folder.path(), own).is_none());
        let other = OtherUsers(look_in(folder.path(), own + 1)).to_string();
        assert!(other.contains(&format!("user {}", name_of(own))), "{other}");
        assert!(other.contains("process 14"), "{other}");
        assert_eq!(OtherUsers::default().to_string(), "");
        assert_eq!(name_of(0), "root");
        assert_eq!(name_of(4_000_000_000), "#4000000000");
    }
}
