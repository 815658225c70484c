//! The part of a line behind its block delete mark and block number.

/// True if the text begins with the word, and no letter follows it.
pub(crate) fn starts_with_word(text: &[u8], word: &[u8]) -> bool {
    text.get(..word.len())
        .is_some_and(|head| head.eq_ignore_ascii_case(word))
        && !text.get(word.len()).is_some_and(u8::is_ascii_alphabetic)
}

/// The text behind blanks, a `/` and a block number.
pub(crate) fn body(text: &[u8]) -> usize {
    let blank = |at: usize| {
        let rest = text.get(at..).unwrap_or_default();
        at + rest
            .iter()
            .take_while(|byte| matches!(byte, b' ' | b'\t'))
            .count()
    };
    let mut at = blank(0);
    if text.get(at) == Some(&b'/') {
        // FANUC and SINUMERIK have switches with numbers: `/2`.
        let switch = usize::from(text.get(at + 1).is_some_and(u8::is_ascii_digit));
        at = blank(at + 1 + switch);
    }
    let digits = |at: usize| {
        let rest = text.get(at..).unwrap_or_default();
        rest.iter().take_while(|byte| byte.is_ascii_digit()).count()
    };
    if matches!(text.get(at), Some(b'N' | b'n')) {
        let number = blank(at + 1);
        if digits(number) > 0 {
            return blank(number + digits(number));
        }
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_body_is_behind_the_block_number() {
        for (text, at) in [
            ("G1", 0),
            (" / N10 G1", 7),
            ("N 1 2G1", 4),
            ("N#1", 0),
            ("", 0),
        ] {
            assert_eq!(body(text.as_bytes()), at, "{text}");
        }
    }
}
