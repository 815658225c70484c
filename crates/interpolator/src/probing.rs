//! Looking for a contact, as the real-time thread sees it.
//!
//! A search ends its epoch, and the program goes on in another one, which takes its planner a
//! moment. In between the machine waits: a hold is in force when it goes on, and an abort ends the
//! program, also where the first frame behind the search is already under way.

use glidepath_link::EndOfEpoch;

/// How a search stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Search {
    /// There is none.
    #[default]
    None,
    /// The motion goes on until there is a contact.
    Looking,
    /// There was one: the motion comes to rest, and the rest of it is left out.
    Tripped,
    /// The epoch is over, and the program goes on in another.
    Over,
    /// It was aborted there; what was under way is to have come in after so many ticks.
    Aborted(u64),
}

/// How long frames may be under way: several times what a planner takes to hear of an abort.
const UNDER_WAY_NS: u64 = 250_000_000;

/// A search for a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Probing(Search);

impl Probing {
    pub(crate) const fn begin(&mut self) {
        self.0 = Search::Looking;
    }

    /// What was looked for was found.
    pub(crate) const fn find(&mut self) {
        if self.is_looking() {
            self.0 = Search::Tripped;
        }
    }

    pub(crate) const fn is_looking(self) -> bool {
        matches!(self.0, Search::Looking)
    }

    /// Whether the motion is to come to rest.
    pub(crate) const fn is_tripped(self) -> bool {
        matches!(self.0, Search::Tripped)
    }

    /// Whether the machine waits for the rest of the program.
    pub(crate) const fn goes_on(self) -> bool {
        matches!(self.0, Search::Over)
    }

    /// The epoch has ended.
    pub(crate) const fn close(&mut self, end: EndOfEpoch) {
        let ends_well = matches!(end, EndOfEpoch::Completed | EndOfEpoch::Tripped);
        self.0 = match self.0 {
            Search::Looking | Search::Tripped if ends_well => Search::Over,
            _ => Search::None,
        };
    }

    /// The program does not go on.
    pub(crate) const fn abort(&mut self, period_ns: u64) {
        self.0 = Search::Aborted(UNDER_WAY_NS / period_ns);
    }

    /// A tick has passed without an epoch.
    pub(crate) const fn wait(&mut self) {
        self.0 = match self.0 {
            Search::Aborted(0) => Search::None,
            Search::Aborted(ticks) => Search::Aborted(ticks - 1),
            search => search,
        };
    }

    /// An epoch begins. Returns whether it is one that was aborted before it came.
    pub(crate) const fn open(&mut self) -> bool {
        let is_aborted = matches!(self.0, Search::Aborted(_));
        self.0 = Search::None;
        is_aborted
    }
}
