//! Text of others, made safe to show.
//!
//! Comments and messages of programs, names of files and keys, and what other processes say may hold
//! characters that a terminal obeys: escape sequences, their short forms above 127, and marks that turn
//! the order of letters round. Each becomes a character of as many bytes that only shows that there
//! was one, so that columns and spans of the text stay.

use std::borrow::Cow;

/// What a character is shown as, if not as itself.
const fn instead(character: char) -> Option<char> {
    match character {
        '\n' | '\t' => None,
        '\0'..='\x1f' | '\x7f' => Some('?'),
        // Control characters of one byte in other codes, and the mark of Arabic letters: two bytes.
        '\u{80}'..='\u{9f}' | '\u{61c}' => Some('¿'),
        // Marks, embeddings, overrides and isolates of direction, and ends of lines: three.
        '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => {
            Some('\u{fffd}')
        }
        _ => None,
    }
}

/// Whether a character is shown as itself.
#[must_use]
pub const fn is_printable(character: char) -> bool {
    instead(character).is_none()
}

/// A text that no terminal and no log obeys; ends of lines and tabulators stay.
#[must_use]
pub fn printable(text: &str) -> Cow<'_, str> {
    if text.chars().all(is_printable) {
        return Cow::Borrowed(text);
    }
    let shown = text.chars().map(|it| instead(it).unwrap_or(it));
    Cow::Owned(shown.collect())
}

/// The same in one line.
pub(crate) fn in_one_line(text: &str) -> Cow<'_, str> {
    match printable(text) {
        shown if shown.contains('\n') => Cow::Owned(shown.replace('\n', " ")),
        shown => shown,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_left_that_a_terminal_obeys_and_no_byte_moves() {
        let hostile = "a\x1b[2J\x07\rb\u{9b}31m\u{202e}c\u{2066}\u{7f}\u{61c}\u{200f}\n\tü µ °";
        let shown = printable(hostile);
        assert_eq!(shown, "a?[2J??b¿31m\u{fffd}c\u{fffd}?¿\u{fffd}\n\tü µ °");
        assert_eq!(shown.len(), hostile.len());
        assert_eq!(printable(&shown), shown);
        for character in (0..=0x10_ffff).filter_map(char::from_u32) {
            let text = character.to_string();
            let shown = printable(&text);
            assert_eq!(shown.len(), text.len(), "{character:?}");
            assert!(matches!(&*shown, "\n" | "\t") || !shown.contains(char::is_control));
        }
    }

    #[test]
    fn what_is_harmless_is_not_copied() {
        assert!(matches!(printable("plain, ä, 漢\n"), Cow::Borrowed(_)));
        assert_eq!(in_one_line("two\nlines\x1b"), "two lines?");
    }
}
