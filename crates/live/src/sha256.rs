//! SHA-256 of certificates, by which people compare them, and of tokens, of which nothing else is kept.

use core::fmt;

/// A SHA-256.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Sha256([u8; 32]);

impl Sha256 {
    /// That of these bytes.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        let digest = ring::digest::digest(&ring::digest::SHA256, bytes);
        let mut own = [0; 32];
        own.iter_mut()
            .zip(digest.as_ref())
            .for_each(|(own, byte)| *own = *byte);
        Self(own)
    }

    /// The one of these digits, as [`Sha256`] is displayed.
    #[must_use]
    pub fn from_digits(digits: &str) -> Option<Self> {
        let bytes = digits.as_bytes();
        if bytes.len() != 64 || !bytes.iter().all(u8::is_ascii_hexdigit) {
            return None;
        }
        let mut own = [0; 32];
        for (own, pair) in own.iter_mut().zip(bytes.chunks_exact(2)) {
            *own = u8::from_str_radix(str::from_utf8(pair).ok()?, 16).ok()?;
        }
        Some(Self(own))
    }

    /// As browsers show it: pairs of capital digits with colons between them.
    #[must_use]
    pub fn in_pairs(&self) -> String {
        let pairs: Vec<String> = self.0.iter().map(|byte| format!("{byte:02X}")).collect();
        pairs.join(":")
    }
}

impl fmt::Display for Sha256 {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(to, "{byte:02x}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_that_of_the_standard_and_read_back() {
        let hash = Sha256::of(b"abc");
        let digits = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(hash.to_string(), digits);
        assert_eq!(Sha256::from_digits(digits), Some(hash));
        assert!(hash.in_pairs().starts_with("BA:78:16:BF:"));
        for broken in [&digits[1..], "", &digits.replace('b', "+")] {
            assert_eq!(Sha256::from_digits(broken), None, "{broken}");
        }
    }
}
