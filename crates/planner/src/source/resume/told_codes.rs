//! The M codes that a program has told, with their words, so that one that was not answered is told again.

use std::collections::{BTreeMap, VecDeque};

use glidepath_program::{Event, Item, ItemKind};

/// The M codes told so far.
#[derive(Debug, Default)]
pub(super) struct ToldCodes {
    /// The words of the code that comes next.
    words: Vec<Item>,
    /// Each code as it was told last, behind its words.
    codes: BTreeMap<u32, Vec<Item>>,
}

impl ToldCodes {
    /// Takes note of an item that was executed.
    pub(super) fn take(&mut self, item: &Item) {
        match item.kind {
            ItemKind::Event(
                Event::CodeWord { .. } | Event::SpindleAngle { .. } | Event::SpindleGear(_),
            ) => {
                self.words.push(*item);
            }
            ItemKind::Event(Event::MCode(code)) => {
                let mut told = core::mem::take(&mut self.words);
                told.push(*item);
                self.codes.insert(code, told);
            }
            _ => self.words.clear(),
        }
    }

    /// What is told again in front of an event that was not answered.
    pub(super) fn again(&mut self, event: Event) -> VecDeque<Item> {
        match event {
            Event::MCode(_) => core::mem::take(&mut self.words).into(),
            // Spindle and coolant are what they were before anything moves.
            Event::Await(3..=5 | 7..=9) => VecDeque::new(),
            Event::Await(code) => self.codes.remove(&code).unwrap_or_default().into(),
            _ => VecDeque::new(),
        }
    }
}
