//! The list of paired devices, in a file: what it has of each is the hash of its token, never the token.
//!
//! Whoever changes it, this process or a command beside it, takes the lock, reads, changes and replaces it. It is read
//! anew as soon as it is another one. Where it cannot be read, nobody is paired.

use super::folder::{SecretFolder, Stamp};
use crate::file_error::FileError;
use glidepath_live::{Role, Sha256};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The file.
const FILE: &str = "devices.json";
/// What this writes.
const VERSION: u32 = 1;
/// Most devices.
pub(super) const MOST: usize = 32;
/// Longest name of one, characters.
const LONGEST_NAME: usize = 32;
/// How old at most what the file says of when a device was seen last.
const NOTED_EVERY_S: u64 = 300;
/// A device that was heard so long ago is not there.
const HERE: Duration = Duration::from_secs(3);

/// A paired device.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Device {
    /// Its name, which no other one has.
    pub(super) name: String,
    /// What it may: the name of a role.
    pub(super) may: String,
    /// The hash of its token.
    pub(super) token_sha256: String,
    /// When it was paired, s since 1970.
    pub(super) paired_s: u64,
    /// When it was seen last, s since 1970: to some minutes.
    pub(super) seen_s: u64,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct List {
    version: u32,
    devices: Vec<Device>,
}

/// The list.
#[derive(Debug)]
pub(super) struct Book {
    folder: SecretFolder,
    known: Mutex<Known>,
}

#[derive(Debug, Default)]
struct Known {
    /// Of the file that was read; outer `None` before any.
    stamp: Option<Stamp>,
    devices: Vec<Device>,
    /// Why the file cannot be used.
    trouble: Option<String>,
    /// When each device was heard last.
    heard: BTreeMap<Sha256, Instant>,
}

/// The list of a folder, as it is.
fn read(folder: &SecretFolder) -> Result<Vec<Device>, FileError> {
    let Some(bytes) = folder.read(FILE)? else {
        return Ok(Vec::new());
    };
    let broken = |why: String| {
        let why = format!("{why}; move it away, and pair the devices anew");
        let error = io::Error::new(io::ErrorKind::InvalidData, why);
        FileError::file("use", &folder.file(FILE))(error)
    };
    let list: List = serde_json::from_slice(&bytes).map_err(|error| broken(error.to_string()))?;
    if list.version != VERSION {
        let (is, version) = (VERSION, list.version);
        return Err(broken(format!("it is of version {version}, not {is}")));
    }
    Ok(list.devices)
}

impl Book {
    /// The list of a machine that is served, whose folder is made.
    pub(super) fn open(state: &Path) -> Result<Self, FileError> {
        let book = Self::of(SecretFolder::open(state)?);
        // What is wrong is told at the start.
        let _devices = read(&book.folder)?;
        Ok(book)
    }

    /// The list of a machine, to be read and shortened.
    pub(super) fn at(state: &Path) -> Self {
        Self::of(SecretFolder::at(state))
    }

    fn of(folder: SecretFolder) -> Self {
        Self {
            folder,
            known: Mutex::default(),
        }
    }

    /// Where it is kept.
    pub(super) const fn folder(&self) -> &SecretFolder {
        &self.folder
    }

    /// The devices, as the file has them.
    pub(super) fn devices(&self) -> Result<Vec<Device>, FileError> {
        read(&self.folder)
    }

    fn known(&self) -> MutexGuard<'_, Known> {
        // The list is whole, whoever panicked.
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let stamp = self.folder.stamp(FILE);
        if known.stamp != Some(stamp) {
            known.stamp = Some(stamp);
            (known.devices, known.trouble) = match read(&self.folder) {
                Ok(devices) => (devices, None),
                Err(error) => (Vec::new(), Some(error.to_string())),
            };
        }
        known
    }

    /// The devices as they are known, each with whether it is there, and why nobody is one.
    pub(super) fn now(&self) -> (Vec<(Device, bool)>, Option<String>) {
        let known = self.known();
        let is_here = |device: &Device| {
            let heard = Sha256::from_digits(&device.token_sha256);
            let heard = heard.and_then(|hash| known.heard.get(&hash));
            heard.is_some_and(|heard| heard.elapsed() < HERE)
        };
        let devices = known.devices.iter();
        let devices = devices.map(|device| (device.clone(), is_here(device)));
        (devices.collect(), known.trouble.clone())
    }

    /// What the device of a token may.
    pub(super) fn role(&self, token: &Sha256) -> Option<Role> {
        let (known, digits) = (self.known(), token.to_string());
        let mut devices = known.devices.iter();
        let device = devices.find(|device| device.token_sha256 == digits)?;
        Role::named(&device.may)
    }

    /// A device was heard.
    pub(super) fn heard(&self, token: &Sha256, now_s: u64) {
        let digits = token.to_string();
        let is_of = |device: &&mut Device| device.token_sha256 == digits;
        let mut known = self.known();
        known.heard.insert(*token, Instant::now());
        let noted = known.devices.iter_mut().find(is_of);
        let Some(device) = noted.filter(|device| device.seen_s + NOTED_EVERY_S <= now_s) else {
            return;
        };
        // Where it cannot be noted, that is tried again as late.
        device.seen_s = now_s;
        drop(known);
        let _noted = self.change(|devices| {
            let mut devices = devices.iter_mut();
            devices.find(is_of).map(|device| device.seen_s = now_s)
        });
    }

    /// Changes the list, unless `change` gives nothing.
    fn change<T>(
        &self,
        change: impl FnOnce(&mut Vec<Device>) -> Option<T>,
    ) -> Result<Option<T>, FileError> {
        let _lock = self.folder.lock()?;
        let mut devices = read(&self.folder)?;
        let Some(done) = change(&mut devices) else {
            return Ok(None);
        };
        let version = VERSION;
        let text = serde_json::to_vec_pretty(&List { version, devices });
        let text = text.map_err(io::Error::other);
        let text = text.map_err(FileError::file("write", &self.folder.file(FILE)))?;
        self.folder.write(FILE, &text)?;
        Ok(Some(done))
    }

    /// Takes in a device under a name like the one that it gives itself; the name, or `None` if there are too many.
    pub(super) fn add(
        &self,
        name: &str,
        role: Role,
        token: &Sha256,
        now_s: u64,
    ) -> Result<Option<String>, FileError> {
        self.change(|devices| {
            let name = free_name(name, devices)?;
            devices.push(Device {
                name: name.clone(),
                may: role.name().to_owned(),
                token_sha256: token.to_string(),
                paired_s: now_s,
                seen_s: now_s,
            });
            Some(name)
        })
    }

    /// Takes out the device of a name. Whether there was one.
    pub(super) fn revoke(&self, name: &str) -> Result<bool, FileError> {
        let revoked = self.change(|devices| {
            let at = devices.iter().position(|device| device.name == name)?;
            Some(devices.remove(at))
        });
        Ok(revoked?.is_some())
    }
}

/// A name that can be printed and typed, and that no other device has; `None` if there are too many.
fn free_name(wanted: &str, devices: &[Device]) -> Option<String> {
    if devices.len() >= MOST {
        return None;
    }
    let is_good = |c: &char| c.is_alphanumeric() || " -_.".contains(*c);
    let name: String = wanted.chars().filter(is_good).take(LONGEST_NAME).collect();
    let name = name.trim().trim_start_matches('-');
    let name = if name.is_empty() { "device" } else { name };
    let is_free = |name: &str| {
        let mut others = devices.iter();
        !others.any(|other| other.name.to_lowercase() == name.to_lowercase())
    };
    let mut names = (2..).map(|number| format!("{name} {number}"));
    if is_free(name) {
        Some(name.to_owned())
    } else {
        names.find(|name| is_free(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;
    use std::os::unix::fs::PermissionsExt as _;

    fn token(of: u8) -> Sha256 {
        Sha256::of(&[of])
    }

    #[test]
    fn a_device_is_known_until_it_is_revoked_whoever_does_it() {
        let state = tempfile::tempdir().unwrap();
        let served = Book::open(state.path()).unwrap();
        assert_eq!(served.role(&token(1)), None);
        let added = served.add("Tablet", Role::Hold, &token(1), 1000).unwrap();
        assert_eq!(added.as_deref(), Some("Tablet"));
        let again = served.add("tablet", Role::Look, &token(2), 1000).unwrap();
        assert_eq!(again.as_deref(), Some("tablet 2"));
        assert_eq!(served.role(&token(1)), Some(Role::Hold));
        assert_eq!(served.role(&token(2)), Some(Role::Look));
        // Another life of the process, and a command beside it.
        let beside = Book::at(state.path());
        assert_eq!(beside.role(&token(1)), Some(Role::Hold));
        assert!(!beside.revoke("TABLET").unwrap());
        assert!(beside.revoke("Tablet").unwrap());
        assert_eq!(served.role(&token(1)), None);
        assert_eq!(served.role(&token(2)), Some(Role::Look));
        let file = fs::read_to_string(state.path().join("devices/devices.json")).unwrap();
        assert!(file.contains(&token(2).to_string()) && !file.contains("Tablet"));
    }

    #[test]
    fn a_list_that_others_can_read_or_that_is_broken_lets_nobody_in() {
        let state = tempfile::tempdir().unwrap();
        let book = Book::open(state.path()).unwrap();
        let _added = book.add("Tablet", Role::Hold, &token(1), 1000).unwrap();
        assert!(book.role(&token(1)).is_some());
        let file = state.path().join("devices/devices.json");
        let text = fs::read(&file).unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o644)).unwrap();
        assert_eq!(book.role(&token(1)), None);
        let (devices, trouble) = book.now();
        assert!(devices.is_empty() && trouble.unwrap().contains("other users can open it"));
        assert!(Book::open(state.path()).is_err());
        fs::set_permissions(&file, fs::Permissions::from_mode(0o600)).unwrap();
        assert!(book.role(&token(1)).is_some());
        for broken in ["", "{}", "{\"version\":2,\"devices\":[]}"] {
            fs::write(&file, broken).unwrap();
            assert_eq!(book.role(&token(1)), None, "{broken}");
            assert!(book.add("x", Role::Look, &token(2), 1).is_err());
        }
        fs::write(&file, text).unwrap();
        assert!(book.role(&token(1)).is_some());
    }

    #[test]
    fn a_role_that_is_none_lets_nobody_in() {
        let state = tempfile::tempdir().unwrap();
        let book = Book::open(state.path()).unwrap();
        let _added = book.add("Tablet", Role::Hold, &token(1), 1000).unwrap();
        let file = state.path().join("devices/devices.json");
        let text = fs::read_to_string(&file).unwrap();
        fs::write(&file, text.replace("\"hold\"", "\"all\"")).unwrap();
        assert_eq!(book.role(&token(1)), None);
    }

    #[test]
    fn when_a_device_was_seen_is_noted_now_and_then() {
        let state = tempfile::tempdir().unwrap();
        let book = Book::open(state.path()).unwrap();
        let _added = book.add("Tablet", Role::Hold, &token(1), 1000).unwrap();
        assert!(!book.now().0[0].1);
        book.heard(&token(1), 1001);
        assert!(book.now().0[0].1, "it is here");
        assert_eq!(book.devices().unwrap()[0].seen_s, 1000);
        book.heard(&token(1), 1300);
        assert_eq!(book.devices().unwrap()[0].seen_s, 1300);
        // One that is none is not noted.
        book.heard(&token(9), 9000);
        assert_eq!(book.devices().unwrap().len(), 1);
    }

    #[test]
    fn names_are_printable_and_there_is_an_end_to_them() {
        let state = tempfile::tempdir().unwrap();
        let book = Book::open(state.path()).unwrap();
        let mut names = Vec::new();
        for wanted in ["\u{1b}[2J", "", " - ", "<b>Küche</b>", &"x".repeat(99)] {
            names.push(book.add(wanted, Role::Look, &token(1), 1).unwrap().unwrap());
        }
        let long = "x".repeat(LONGEST_NAME);
        let expected = ["2J", "device", "device 2", "bKücheb", &long];
        assert_eq!(names, expected);
        for _ in names.len()..MOST {
            assert!(book.add("x", Role::Look, &token(1), 1).unwrap().is_some());
        }
        assert_eq!(book.add("x", Role::Look, &token(1), 1).unwrap(), None);
    }
}
