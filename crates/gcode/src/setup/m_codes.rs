//! The M codes of the machine's own, beside those that every program may use.

use crate::syntax::number::code_number;

/// The place at which the motion waits until an M code is answered, if it is waited for at all.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum WaitsAt {
    /// At the code itself.
    #[default]
    Code,
    /// In front of the next move that is not a rapid, or a probing move.
    NextFeed,
    /// At the end of its block.
    BlockEnd,
}

/// M codes that the machine's builder gave a meaning: ranges of numbers.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct MCodes(Vec<(u32, u32, WaitsAt)>);

impl MCodes {
    /// Adds all codes from one to another, both included.
    pub fn declare(&mut self, first: u32, last: u32) {
        self.declare_waiting(first, last, WaitsAt::Code);
    }

    /// Adds all codes from one to another, both included, and says where they are waited for. What
    /// was said of a code before stands.
    pub fn declare_waiting(&mut self, first: u32, last: u32, at: WaitsAt) {
        self.0.push((first, last, at));
    }

    /// Where a code is waited for.
    pub(crate) fn waits_at(&self, code: u32) -> WaitsAt {
        let rule = self.0.iter().find(|rule| (rule.0..=rule.1).contains(&code));
        rule.map_or(WaitsAt::Code, |rule| rule.2)
    }

    /// Whether a code is waited for elsewhere than where it stands.
    pub(crate) fn wait_elsewhere(&self) -> bool {
        self.0.iter().any(|rule| rule.2 != WaitsAt::Code)
    }

    /// Whether a code was declared.
    #[must_use]
    pub fn contains(&self, code: u32) -> bool {
        self.0
            .iter()
            .any(|(first, last, _)| (*first..=*last).contains(&code))
    }

    /// Whether a code was declared and has no meaning that every control gives it.
    pub(crate) fn is_own(&self, code: u32) -> bool {
        !matches!(code, 0..=9 | 19 | 30 | 98 | 99) && self.contains(code)
    }

    /// Whether a code may be declared: it has no meaning of its own in the programs of some control.
    /// M48 and the like are the builder's on a FANUC, and what they are in LinuxCNC's language; likewise M82 and M83,
    /// which say what E is on a printer.
    #[must_use]
    pub const fn is_free(code: u32) -> bool {
        !matches!(code, 0..=9 | 19 | 30 | 61 | 66 | 98 | 99)
    }

    /// Whether a message may say that a code can be declared: it is free, or it is M61, which LinuxCNC's language alone
    /// has.
    pub(crate) fn can_be_declared(code: f64) -> bool {
        code_number(code).is_some_and(|code| Self::is_free(code) || code == 61)
    }
}
