//! The words of a line of G-code, as far as the protocol looks at them.

/// A line without comments and spaces, in capitals.
pub(crate) fn without_comments(text: &str) -> String {
    let mut bare = String::with_capacity(text.len());
    let mut is_comment = false;
    for character in text.chars() {
        match character {
            ')' => is_comment = false,
            _ if is_comment => {}
            '(' => is_comment = true,
            ';' => break,
            ' ' | '\t' => {}
            _ => bare.push(character.to_ascii_uppercase()),
        }
    }
    bare
}

/// A word of a line of G-code.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Word {
    pub(crate) letter: char,
    /// `None`: an expression, or nothing that is a number.
    pub(crate) value: Option<f64>,
}

/// The words of a line of G-code, without what stands in expressions.
pub(crate) fn words(text: &str) -> Vec<Word> {
    let bare = without_comments(text);
    let mut words = Vec::new();
    let (mut rest, mut depth) = (bare.as_str(), 0_u32);
    while let Some(letter) = rest.chars().next() {
        let behind = rest.get(letter.len_utf8()..).unwrap_or_default();
        match letter {
            '[' | '<' => depth = depth.saturating_add(1),
            ']' | '>' => depth = depth.saturating_sub(1),
            'A'..='Z' if depth == 0 => {
                let is_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+');
                let length = behind.find(|c| !is_number(c)).unwrap_or(behind.len());
                let value = behind.get(..length).and_then(|number| number.parse().ok());
                words.push(Word { letter, value });
            }
            _ => {}
        }
        rest = behind;
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_told_from_comments_and_expressions() {
        let found = words("n5 g1 (X9) x[1+#<g10>] Y-.5 P#5 ; Z1");
        let letters: String = found.iter().map(|word| word.letter).collect();
        assert_eq!(letters, "NGXYP");
        let values = found.iter().map(|word| word.value);
        let expected = [Some(5.0), Some(1.0), None, Some(-0.5), None];
        assert_eq!(values.collect::<Vec<_>>(), expected);
    }
}
