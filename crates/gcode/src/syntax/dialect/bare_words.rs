//! The words of a line, for the detection of its dialect: letters with what is written behind them.

/// A line without its comments, and without the names of parameters in `< >`.
pub(crate) fn without_comments(bare: &[u8]) -> Vec<u8> {
    let (mut depth, mut is_name) = (0_u32, false);
    let code = bare.iter().take_while(|byte| **byte != b';');
    code.filter(|byte| match byte {
        b'(' => {
            depth += 1;
            false
        }
        b')' => {
            depth = depth.saturating_sub(1);
            false
        }
        b'<' | b'>' => {
            is_name = depth == 0 && **byte == b'<';
            depth == 0
        }
        _ => depth == 0 && !is_name,
    })
    .copied()
    .collect()
}

/// The words of a line without blanks and comments, in upper case: each letter with the number
/// behind it, which is empty where something else stands there. Names of several letters are none.
pub(crate) fn bare_words(code: &[u8]) -> Vec<(u8, &[u8])> {
    let (mut words, mut at) = (Vec::new(), 0);
    while let Some(byte) = code.get(at) {
        at += 1;
        let rest = code.get(at..).unwrap_or_default();
        let goes_on = |byte: &u8| byte.is_ascii_alphabetic() || *byte == b'_';
        if goes_on(byte) && rest.first().is_some_and(goes_on) || *byte == b'_' {
            let is_name = |byte: &&u8| byte.is_ascii_alphanumeric() || **byte == b'_';
            at += rest.iter().take_while(is_name).count();
        } else if byte.is_ascii_uppercase() {
            let is_number = |byte: &&u8| byte.is_ascii_digit() || b".+-".contains(byte);
            let length = rest.iter().take_while(is_number).count();
            words.push((*byte, rest.get(..length).unwrap_or_default()));
            at += length;
        }
    }
    words
}

/// The value of a word.
pub(crate) fn value(number: &[u8]) -> Option<f64> {
    core::str::from_utf8(number).ok()?.parse().ok()
}

/// True if one of the words is that code.
pub(crate) fn has_code(words: &[(u8, &[u8])], letter: u8, number: f64) -> bool {
    let is_it = |value: f64| (value - number).abs() < 1e-6;
    words
        .iter()
        .any(|(of, digits)| *of == letter && value(digits).is_some_and(is_it))
}

/// A line without blanks and comments, in upper case.
fn code_of(text: &[u8]) -> Vec<u8> {
    let bare: Vec<u8> = text
        .iter()
        .filter(|byte| !byte.is_ascii_whitespace())
        .map(u8::to_ascii_uppercase)
        .collect();
    without_comments(&bare)
}

/// True for a line of a comment alone, and an empty one.
pub(crate) fn says_nothing(text: &[u8]) -> bool {
    code_of(text).is_empty()
}

/// True if a line behind a thread is one, too: it has places, and no code but that of a thread.
pub(crate) fn goes_on_with_thread(text: &[u8]) -> bool {
    let code = code_of(text);
    let words = bare_words(&code);
    let is_thread = |(letter, number): &(u8, &[u8])| match letter {
        b'G' => value(number).is_some_and(|number| [32.0, 33.0].contains(&number)),
        b'M' | b'T' | b'S' => false,
        _ => true,
    };
    let has_place = b"XZUW".iter().any(|letter| has_letter(&words, *letter));
    has_place && words.iter().all(is_thread)
}

/// True if one of the words has that letter.
pub(crate) fn has_letter(words: &[(u8, &[u8])], letter: u8) -> bool {
    words.iter().any(|(of, _)| *of == letter)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_go_on_with_places_alone() {
        for text in [
            "G32 Z-5. F1.5",
            "n10 x=r1 z-4",
            "U4. W-2. (OUT)",
            "G33 Z-40 K1",
        ] {
            assert!(goes_on_with_thread(text.as_bytes()), "{text}");
        }
        for text in ["G0 X5.", "X5. M9", "M30", "(Z5)", "G32", "T0101 X1", ""] {
            assert!(!goes_on_with_thread(text.as_bytes()), "{text}");
        }
    }

    #[test]
    fn words_are_letters_and_their_numbers() {
        let code = without_comments(b"G01X-1.5(Y2(A))Z#5F.2;S1");
        let found = bare_words(&code);
        let right: [(u8, &[u8]); 4] = [(b'G', b"01"), (b'X', b"-1.5"), (b'Z', b""), (b'F', b".2")];
        assert_eq!(found, right);
        assert!(has_code(&found, b'G', 1.0) && !has_code(&found, b'G', 2.0));
        assert!(has_letter(&found, b'Z') && !has_letter(&found, b'Y'));
        assert_eq!(bare_words(b"NAME=LEG15_STL"), []);
        assert!(without_comments(b"(open").is_empty());
        assert_eq!(without_comments(b"#<SEG15>=1"), b"#<>=1");
    }
}
