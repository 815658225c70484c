//! The token that a page has to know to be told anything.

use std::io;

/// 128 random bits, in hexadecimal digits.
#[derive(Debug, Clone)]
pub struct Token(String);

impl Token {
    /// A new one, of the system's random numbers.
    ///
    /// # Errors
    ///
    /// The system has none.
    pub fn new() -> io::Result<Self> {
        let mut bits = [0_u8; 16];
        let got = rustix::rand::getrandom(&mut bits, rustix::rand::GetRandomFlags::empty())?;
        if got != bits.len() {
            return Err(io::Error::other("the system gave too few random numbers"));
        }
        Ok(Self(
            bits.iter().map(|byte| format!("{byte:02x}")).collect(),
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
