//! The certificate that devices see: made once, and kept with its key.

use super::folder::SecretFolder;
use crate::command::failure::Failure;
use crate::file_error::FileError;
use crate::output;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glidepath_live::{Identity, ServerError};
use serde::{Deserialize, Serialize};
use std::io;
use std::net::SocketAddr;

/// The file.
const FILE: &str = "certificate.json";

/// A certificate as it is kept.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Kept {
    names: Vec<String>,
    from_s: u64,
    until_s: u64,
    certificate: String,
    key: String,
}

/// The names by which devices may open an address of this host.
pub(super) fn names(address: SocketAddr) -> Vec<String> {
    let mut names = vec![address.ip().to_string()];
    if address.ip().is_loopback() {
        names.push("localhost".to_owned());
    }
    let host = rustix::system::uname();
    let host = host.nodename().to_string_lossy().to_ascii_lowercase();
    let is_good = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '.';
    if !host.is_empty() && host.len() < 200 && host.chars().all(is_good) && host != "localhost" {
        if !host.contains('.') {
            names.push(format!("{host}.local"));
        }
        names.push(host);
    }
    names
}

/// The certificate that is kept, or a new one where there is none for these names, or its time is nearly over.
pub(super) fn certificate(
    folder: &SecretFolder,
    instance: &str,
    names: &[String],
    now_s: u64,
) -> Result<Identity, Failure> {
    let _lock = folder.lock()?;
    let kept = read(folder)?;
    let was_there = kept.is_some();
    if let Some(kept) = kept.filter(|kept| kept.serves(names, now_s)) {
        return Ok(kept);
    }
    let made = Identity::new(&format!("Glidepath {instance}"), names, now_s);
    let made = made.map_err(ServerError::from)?;
    let kept = Kept {
        names: made.names.clone(),
        from_s: made.from_s,
        until_s: made.until_s,
        certificate: STANDARD.encode(&made.certificate),
        key: STANDARD.encode(&made.key),
    };
    let text = serde_json::to_vec_pretty(&kept).map_err(io::Error::other);
    let text = text.map_err(FileError::file("write", &folder.file(FILE)))?;
    folder.write(FILE, &text)?;
    if was_there {
        output::note(
            "live: the certificate is a new one, because its names or its time were over: devices warn of it until \
             somebody has compared its fingerprint",
        );
    }
    Ok(made)
}

fn read(folder: &SecretFolder) -> Result<Option<Identity>, FileError> {
    let Some(bytes) = folder.read(FILE)? else {
        return Ok(None);
    };
    let broken = |why: String| {
        let why = format!("{why}; move it away, and a new certificate is made");
        let error = io::Error::new(io::ErrorKind::InvalidData, why);
        FileError::file("use", &folder.file(FILE))(error)
    };
    let kept: Kept = serde_json::from_slice(&bytes).map_err(|error| broken(error.to_string()))?;
    let decoded = |text: &str| {
        let bytes = STANDARD.decode(text);
        bytes.map_err(|error| broken(error.to_string()))
    };
    Ok(Some(Identity {
        certificate: decoded(&kept.certificate)?,
        key: decoded(&kept.key)?,
        names: kept.names,
        from_s: kept.from_s,
        until_s: kept.until_s,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;
    use std::os::unix::fs::PermissionsExt as _;

    const NOW_S: u64 = 1_800_000_000;

    #[test]
    fn a_certificate_is_made_once() {
        let state = tempfile::tempdir().unwrap();
        let folder = SecretFolder::open(state.path()).unwrap();
        let names = names("192.168.1.20:8443".parse().unwrap());
        assert_eq!(names[0], "192.168.1.20");
        let get = |names: &[String], now_s| certificate(&folder, "mill-1", names, now_s).unwrap();
        let made = get(&names, NOW_S);
        assert_eq!(get(&names, NOW_S + 86_400), made);
        // Another address, or the end of its time, takes another one.
        let moved = get(&["10.0.0.5".to_owned()], NOW_S);
        assert_ne!(moved, made);
        assert_ne!(get(&moved.names, NOW_S + 800 * 86_400), moved);
    }

    #[test]
    fn a_key_that_others_can_read_is_not_used() {
        let state = tempfile::tempdir().unwrap();
        let folder = SecretFolder::open(state.path()).unwrap();
        let names = ["localhost".to_owned()];
        let _made = certificate(&folder, "mill-1", &names, NOW_S).unwrap();
        let file = folder.file(FILE);
        fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
        let error = certificate(&folder, "mill-1", &names, NOW_S).unwrap_err();
        assert!(
            error.to_string().contains("other users can open it"),
            "{error}"
        );
        fs::set_permissions(&file, fs::Permissions::from_mode(0o600)).unwrap();
        fs::write(&file, "{}").unwrap();
        let error = certificate(&folder, "mill-1", &names, NOW_S).unwrap_err();
        assert!(error.to_string().contains("move it away"), "{error}");
    }
}
