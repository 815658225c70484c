//! Which program a text is: a number that another text, or an edited one, does not have.

use std::io::{self, Read};

/// Reads on, and takes the fingerprint of what is read (FNV-1a, 64 bits: Fowler, Noll, Vo).
#[derive(Debug)]
pub(crate) struct Fingerprinting<R> {
    inner: R,
    hash: u64,
}

impl<R> Fingerprinting<R> {
    pub(crate) const fn new(inner: R) -> Self {
        Self {
            inner,
            hash: 0xcbf2_9ce4_8422_2325,
        }
    }

    /// Takes more into account, as if it had been read.
    pub(crate) fn add(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.hash = (self.hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// Of everything read so far; not 0, which stands for a program that is not known.
    pub(crate) fn fingerprint(&self) -> u64 {
        self.hash.max(1)
    }
}

impl<R: Read> Read for Fingerprinting<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(buffer)?;
        self.add(buffer.get(..count).unwrap_or_default());
        Ok(count)
    }
}

/// The fingerprint of a text.
pub(crate) fn fingerprint(text: &str) -> u64 {
    let mut reader = Fingerprinting::new(text.as_bytes());
    // Reading from memory into nowhere does not fail.
    io::copy(&mut reader, &mut io::sink()).map_or(0, |_| reader.fingerprint())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fingerprint_is_the_published_one() {
        let of = |text: &[u8]| {
            let mut reader = Fingerprinting::new(text);
            io::copy(&mut reader, &mut io::sink()).unwrap();
            reader.fingerprint()
        };
        assert_eq!(of(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(of(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(of(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
