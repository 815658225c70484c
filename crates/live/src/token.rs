//! The token that a page has to know to be told anything, and codes like it.

use std::io;

/// A random text, of 128 bits in hexadecimal digits as a rule.
#[derive(Debug, Clone)]
pub struct Token(String);

impl Token {
    /// A new one, of the system's random numbers.
    ///
    /// # Errors
    ///
    /// The system has none.
    pub fn new() -> io::Result<Self> {
        Self::of(b"0123456789abcdef0123456789abcdef", 32)
    }

    /// A new one of so many of these digits.
    pub(crate) fn of(digits: &[u8; 32], length: usize) -> io::Result<Self> {
        let mut bits = vec![0_u8; length];
        let got = rustix::rand::getrandom(&mut bits, rustix::rand::GetRandomFlags::empty())?;
        if got != length {
            return Err(io::Error::other("the system gave too few random numbers"));
        }
        let digit = |byte: &u8| digits.get(usize::from(*byte % 32)).copied();
        Ok(Self(
            bits.iter().filter_map(digit).map(char::from).collect(),
        ))
    }

    /// Its digits.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Whether `text` is this token. Takes as long for one that is nearly right as for one that is
    /// all wrong.
    #[must_use]
    pub fn is(&self, text: &[u8]) -> bool {
        let own = self.0.as_bytes();
        let differ = own
            .iter()
            .zip(text)
            .fold(0, |differ, (a, b)| differ | (a ^ b));
        own.len() == text.len() && core::hint::black_box(differ) == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_token_is_itself_and_nothing_else() {
        let (token, other) = (Token::new().unwrap(), Token::new().unwrap());
        assert_eq!(token.as_str().len(), 32);
        assert!(token.is(token.as_str().as_bytes()));
        assert!(!token.is(other.as_str().as_bytes()));
        assert!(!token.is(&token.as_str().as_bytes()[..31]));
        assert!(!token.is(format!("{}0", token.as_str()).as_bytes()));
        assert!(!token.is(b""));
    }
}
