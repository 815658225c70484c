//! The text form of a generation: a line with version, generation and checksum, and TOML behind it.
//! Numbers are the shortest that read back to the same bits.

use crate::error::StoreError;
use crate::state::PersistentState;
use core::hash::Hasher as _;
use twox_hash::XxHash64;

/// The version that is written.
const VERSION: u32 = 2;

/// How a file begins.
const HEAD: &str = "# glidepath kept";

/// A generation as text.
///
/// # Errors
/// What is to be kept holds numbers that are none.
pub(crate) fn to_text(kept: &PersistentState, generation: u64) -> Result<String, StoreError> {
    let refuse = |reason| StoreError::NotKeepable { reason };
    if let Some(reason) = kept.fault() {
        return Err(refuse(reason));
    }
    let body = toml::to_string(kept).map_err(|error| refuse(error.to_string()))?;
    let sum = checksum(VERSION, generation, &body);
    Ok(format!(
        "{HEAD} version {VERSION} generation {generation} checksum {sum:016x}\n{body}"
    ))
}

/// A text as a generation.
///
/// # Errors
/// It is damaged, or of a later version.
pub(crate) fn from_text(file: &str, bytes: &[u8]) -> Result<(u64, PersistentState), StoreError> {
    let damaged = |reason: &str| StoreError::Damaged {
        file: file.to_owned(),
        reason: reason.to_owned(),
    };
    let text = core::str::from_utf8(bytes).map_err(|_| damaged("it is no UTF-8 text"))?;
    let (head, body) = text
        .split_once('\n')
        .ok_or_else(|| damaged("its first line has no end"))?;
    let words: Vec<&str> = head
        .strip_prefix(HEAD)
        .ok_or_else(|| damaged("it does not begin as such a file does"))?
        .split_whitespace()
        .collect();
    let ["version", version, rest @ ..] = words.as_slice() else {
        return Err(damaged("its first line has no version"));
    };
    let found: u32 = version
        .parse()
        .map_err(|_| damaged("its version is no number"))?;
    if found > VERSION {
        return Err(StoreError::Newer {
            file: file.to_owned(),
            found,
            known: VERSION,
        });
    }
    let ["generation", generation, "checksum", sum] = rest else {
        return Err(damaged("its first line has no generation and checksum"));
    };
    let generation: u64 = generation
        .parse()
        .map_err(|_| damaged("its generation is no number"))?;
    if generation == u64::MAX {
        return Err(damaged("its generation leaves no number for the next"));
    }
    if format!("{:016x}", checksum(found, generation, body)) != **sum {
        return Err(damaged("its checksum is another"));
    }
    let kept: PersistentState = toml::from_str(body).map_err(|error| damaged(error.message()))?;
    match kept.fault() {
        Some(reason) => Err(damaged(&reason)),
        None => Ok((generation, kept)),
    }
}

/// XXH64 (Collet), seed 0, of everything that is said.
fn checksum(version: u32, generation: u64, body: &str) -> u64 {
    let mut hash = XxHash64::with_seed(0);
    hash.write(&version.to_le_bytes());
    hash.write(&generation.to_le_bytes());
    hash.write(body.as_bytes());
    hash.finish()
}

/// A fingerprint as sixteen digits: TOML's whole numbers are too small for all of them.
pub(crate) mod hexadecimal {
    use serde::de::Error as _;
    use serde::{Deserialize as _, Deserializer, Serializer};

    pub(crate) fn serialize<S: Serializer>(number: &u64, out: S) -> Result<S::Ok, S::Error> {
        out.serialize_str(&format!("{number:016x}"))
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<u64, D::Error> {
        let text = String::deserialize(from)?;
        u64::from_str_radix(&text, 16).map_err(D::Error::custom)
    }
}
