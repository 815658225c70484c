//! What the pieces of a stretch have to do with the program: their lines, rates and events, by tag.

use crate::due_event::Beside;
use crate::grid::Passing;
use crate::programmed_rate::{PieceRate, ProgrammedRate};
use glidepath_program::{Event, Override, ProgramLine};
use std::collections::VecDeque;

/// A piece as the program sees it.
#[derive(Debug, Clone)]
pub(crate) struct LedgerEntry {
    /// Line of its start.
    pub(crate) line: ProgramLine,
    /// Where further lines begin, mm after its start, ascending.
    pub(crate) lines: Vec<(f64, ProgramLine)>,
    pub(crate) rate: ProgrammedRate,
    pub(crate) length_s: f64,
    /// Events that happen when it is entered, without stopping.
    pub(crate) events: Vec<Event>,
    /// Where it begins.
    pub(crate) beside: Beside,
}

/// The entries of a stretch that are not passed yet.
#[derive(Debug, Clone)]
pub(crate) struct Ledger {
    entries: VecDeque<LedgerEntry>,
    /// Tag of the first of them, and where it begins.
    first: u64,
    first_s: f64,
    /// Entries whose events are told, counted from the start of the stretch.
    announced: u64,
    wanted: Override,
    /// The override told last. A lower one than wanted is never told.
    told: Override,
}

impl Ledger {
    pub(crate) const fn new(wanted: Override) -> Self {
        Self {
            entries: VecDeque::new(),
            first: 0,
            first_s: 0.0,
            announced: 0,
            wanted,
            told: wanted,
        }
    }

    /// Adds an entry; returns its tag.
    pub(crate) fn push(&mut self, entry: LedgerEntry) -> u64 {
        self.entries.push_back(entry);
        self.first + self.entries.len() as u64 - 1
    }

    pub(crate) const fn set_override(&mut self, wanted: Override) {
        self.wanted = wanted;
        self.told = Override {
            feed_r: self.told.feed_r.max(wanted.feed_r),
            rapid_r: self.told.rapid_r.max(wanted.rapid_r),
        };
    }

    /// The speeds wanted on an entry; those of the first one kept for those before it.
    pub(crate) fn rate(&self, tag: u64) -> PieceRate {
        let index = usize::try_from(tag.saturating_sub(self.first)).unwrap_or(usize::MAX);
        self.entries.get(index).map_or(
            PieceRate {
                top_v: f64::MIN_POSITIVE,
                feed_v: f64::MIN_POSITIVE,
            },
            |entry| entry.rate.of_piece(self.wanted),
        )
    }

    /// The motion comes to the entry with a tag, and to a path position: forgets the entries before it. Tells the
    /// events of each that is entered or within reach, in order.
    pub(crate) fn come_to(
        &mut self,
        (tag, path_s): (u64, f64),
        mut tell: impl FnMut(&[Event], f64, Beside),
    ) {
        while self.first < tag && self.entries.len() > 1 {
            self.announce(0, self.first_s, &mut tell);
            if let Some(entry) = self.entries.pop_front() {
                self.first += 1;
                self.first_s += entry.length_s;
            }
        }
        let mut start_s = self.first_s;
        for index in 0..self.entries.len() {
            let entry = &self.entries[index];
            if index > 0 && start_s - entry.beside.reach_s > path_s {
                break;
            }
            let length_s = entry.length_s;
            self.announce(index, start_s, &mut tell);
            start_s += length_s;
        }
    }

    /// Tells the events of an entry, which begins at a path position, once.
    fn announce(
        &mut self,
        index: usize,
        start_s: f64,
        tell: &mut impl FnMut(&[Event], f64, Beside),
    ) {
        if self.announced > self.first + index as u64 {
            return;
        }
        self.announced = self.first + index as u64 + 1;
        if let Some(entry) = self.entries.get(index) {
            tell(&entry.events, start_s, entry.beside);
        }
    }

    /// The place in the program at a path position of the first entry, passed at a speed.
    ///
    /// A frame tells the override that belongs to its speed, so that whoever scales the speed by
    /// commanded over planned override gets what is commanded while the speed is brought down.
    pub(crate) fn passing_at(&mut self, path_s: f64, path_v: f64) -> Passing {
        if let Some(entry) = self.entries.front() {
            let (programmed_v, told, wanted) = match entry.rate.rate.feed_v() {
                Some(feed_v) => (feed_v, &mut self.told.feed_r, self.wanted.feed_r),
                None => (
                    entry.rate.axes_v,
                    &mut self.told.rapid_r,
                    self.wanted.rapid_r,
                ),
            };
            *told = told.min((path_v / programmed_v).max(wanted));
        }
        self.passing(path_s)
    }

    /// The place in the program at a path position of the first entry.
    pub(crate) fn passing(&self, path_s: f64) -> Passing {
        let Some(entry) = self.entries.front() else {
            return Passing::NONE;
        };
        let passed_s = path_s - self.first_s;
        let before = entry
            .lines
            .partition_point(|&(start_s, _)| start_s <= passed_s);
        let line = match before.checked_sub(1).and_then(|last| entry.lines.get(last)) {
            Some(&(_, line)) => line,
            None => entry.line,
        };
        let rapid = entry.rate.rate.is_rapid();
        let synchronised = entry.rate.rate.is_synchronised();
        Passing {
            line,
            rapid,
            synchronised,
            per_revolution: entry.rate.rate.is_per_revolution(),
            programmed_v: entry.rate.rate.feed_v().unwrap_or(0.0),
            planned_override: if rapid {
                self.told.rapid_r
            } else if synchronised {
                1.0
            } else {
                self.told.feed_r
            },
        }
    }
}
