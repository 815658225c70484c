//! The digest of all structures: a number that is made when the library is compiled.

use super::structure::Structure;

/// FNV-1a, 64 bits: <https://datatracker.ietf.org/doc/html/draft-eastlake-fnv>.
const OFFSET_BASIS: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0100_0000_01b3;

const fn byte(digest: u64, byte: u8) -> u64 {
    (digest ^ byte as u64).wrapping_mul(PRIME)
}

const fn text(mut digest: u64, text: &str) -> u64 {
    let bytes = text.as_bytes();
    let mut index = 0;
    while index < bytes.len() {
        digest = byte(digest, bytes[index]);
        index += 1;
    }
    byte(digest, 0)
}

const fn number(mut digest: u64, number: usize) -> u64 {
    let bytes = (number as u64).to_le_bytes();
    let mut index = 0;
    while index < bytes.len() {
        digest = byte(digest, bytes[index]);
        index += 1;
    }
    digest
}

/// Names, types, offsets and sizes of all fields, and the versions of the records.
pub(super) const fn digest(structures: &[&Structure]) -> u64 {
    let mut digest = OFFSET_BASIS;
    let mut index = 0;
    while index < structures.len() {
        let structure = structures[index];
        digest = text(text(digest, structure.name), structure.record);
        digest = number(digest, structure.size);
        let mut place = 0;
        while place < structure.fields.len() {
            let field = &structure.fields[place];
            digest = text(text(digest, field.name), field.element);
            digest = number(
                number(number(digest, field.count), field.offset),
                field.size,
            );
            place += 1;
        }
        index += 1;
    }
    digest
}

/// The hexadecimal number behind a mark in a text, 0 if it is not there.
#[cfg(not(test))]
pub(super) const fn hexadecimal_after(text: &[u8], mark: &[u8]) -> u64 {
    let mut start = 0;
    while start + mark.len() < text.len() {
        let mut same = 0;
        while same < mark.len() && text[start + same] == mark[same] {
            same += 1;
        }
        if same == mark.len() {
            let (mut value, mut at) = (0, start + same);
            while at < text.len() {
                let digit = match text[at] {
                    digit @ b'0'..=b'9' => digit - b'0',
                    digit @ b'a'..=b'f' => digit - b'a' + 10,
                    _ => break,
                };
                value = value << 4 | digit as u64;
                at += 1;
            }
            return value;
        }
        start += 1;
    }
    0
}
