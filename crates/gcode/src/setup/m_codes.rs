//! M codes that the machine has beside those that every program may use.

/// M codes that the machine's builder gave a meaning: ranges of numbers.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct MCodes(Vec<(u32, u32)>);

impl MCodes {
    /// Adds all codes from one to another, both included.
    pub fn declare(&mut self, first: u32, last: u32) {
        self.0.push((first, last));
    }

    /// Whether a code was declared.
    #[must_use]
    pub fn contains(&self, code: u32) -> bool {
        self.0
            .iter()
            .any(|(first, last)| (*first..=*last).contains(&code))
    }

    /// Whether a code may be declared: it has no meaning of its own in programs.
    #[must_use]
    pub const fn is_free(code: u32) -> bool {
        !matches!(
            code,
            0..=9 | 19 | 30 | 48..=53 | 60..=68 | 70..=73 | 82 | 83 | 98 | 99
        )
    }
}
