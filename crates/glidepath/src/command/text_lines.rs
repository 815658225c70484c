//! The text of a program by its lines, kept once for all who show it.

use std::sync::Arc;

/// A text of less than 4 GiB, with where its lines begin. Clones share it.
#[derive(Debug, Clone, Default)]
pub(super) struct TextLines(Arc<Kept>);

#[derive(Debug, Default)]
struct Kept {
    text: String,
    /// Where each line begins, bytes.
    begins: Vec<u32>,
}

impl TextLines {
    /// The lines of a text. What is no UTF-8 is shown as such; of a text that is too long there are none.
    pub(super) fn of(bytes: Vec<u8>) -> Self {
        if u32::try_from(bytes.len()).is_err() {
            return Self::default();
        }
        let text = String::from_utf8(bytes)
            .unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned());
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        let begins = core::iter::once(0).chain(ends.map(|(at, _)| at + 1));
        let begins = begins.filter(|at| *at < text.len());
        let begins = begins.filter_map(|at| u32::try_from(at).ok()).collect();
        Self(Arc::new(Kept { text, begins }))
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.0.begins.len()
    }

    /// Bytes of the text.
    pub(super) fn bytes(&self) -> usize {
        self.0.text.len()
    }

    /// A line, from 0, without its end.
    pub(super) fn get(&self, line: usize) -> Option<&str> {
        let begins = *self.0.begins.get(line)? as usize;
        self.0.text.get(begins..)?.lines().next()
    }

    /// Lines from one on, from 0, without their ends.
    pub(super) fn from(&self, line: usize) -> impl Iterator<Item = &str> {
        let begins = self.0.begins.get(line).map(|begins| *begins as usize);
        let rest = begins.and_then(|begins| self.0.text.get(begins..));
        rest.unwrap_or_default().lines()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_those_of_the_text() {
        for text in ["", "\n", "a", "a\n", "a\r\nb\n\nc", "ä\nö\n"] {
            let lines = TextLines::of(text.as_bytes().to_vec());
            let wanted: Vec<&str> = text.lines().collect();
            assert_eq!(lines.count(), wanted.len(), "{text:?}");
            assert_eq!(lines.bytes(), text.len());
            let each: Vec<&str> = (0..9).filter_map(|line| lines.get(line)).collect();
            assert_eq!(each, wanted, "{text:?}");
            for line in 0..9 {
                let rest: Vec<&str> = lines.from(line).collect();
                assert_eq!(rest, wanted.get(line..).unwrap_or_default(), "{text:?}");
            }
        }
        assert_eq!(TextLines::of(vec![b'a', 0xff]).get(0), Some("a\u{fffd}"));
    }
}
