//! The state of a probing search, as the real-time thread sees it.
//!
//! A search ends its epoch, and the program goes on in another one, which takes its planner a
//! moment. In between the machine waits: a hold is in force when it goes on, and an abort ends the
//! program: the epoch that would have gone on is barred, whose first frame may be under way.

use glidepath_link::EndOfEpoch;

/// How a search stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum ProbeSearch {
    /// There is none.
    #[default]
    None,
    /// The motion goes on until there is a contact.
    Looking,
    /// There was one: the motion comes to rest, and the rest of it is left out.
    Tripped,
    /// The epoch is over, and the program goes on in another.
    Over,
}

/// A search for a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Probing(ProbeSearch);

impl Probing {
    pub(crate) const fn begin(&mut self) {
        self.0 = ProbeSearch::Looking;
    }

    /// What was looked for was found.
    pub(crate) const fn find(&mut self) {
        if self.is_looking() {
            self.0 = ProbeSearch::Tripped;
        }
    }

    pub(crate) const fn is_looking(self) -> bool {
        matches!(self.0, ProbeSearch::Looking)
    }

    /// Whether the motion is to come to rest.
    pub(crate) const fn is_tripped(self) -> bool {
        matches!(self.0, ProbeSearch::Tripped)
    }

    /// Whether the machine waits for the rest of the program.
    pub(crate) const fn goes_on(self) -> bool {
        matches!(self.0, ProbeSearch::Over)
    }

    /// The epoch has ended.
    pub(crate) const fn close(&mut self, end: EndOfEpoch) {
        let ends_well = matches!(end, EndOfEpoch::Completed | EndOfEpoch::Tripped);
        self.0 = match self.0 {
            ProbeSearch::Looking | ProbeSearch::Tripped if ends_well => ProbeSearch::Over,
            _ => ProbeSearch::None,
        };
    }

    /// The program does not go on.
    pub(crate) const fn abort(&mut self) {
        self.0 = ProbeSearch::None;
    }

    /// An epoch begins.
    pub(crate) const fn open(&mut self) {
        self.0 = ProbeSearch::None;
    }
}
