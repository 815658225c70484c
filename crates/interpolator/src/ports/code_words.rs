//! The words of the machine's own M codes, kept from when they are told until their code is awaited.

use crate::shared::message::Awaited;
use glidepath_link::{CodeWords, Setpoint};
use glidepath_program::Event;

/// Codes whose words are kept: more than are ever told and not yet awaited.
const MOST: usize = 8;

/// An M code with its words.
#[derive(Debug, Clone, Copy)]
struct Told {
    epoch: u64,
    sequence: u64,
    words: CodeWords,
}

/// The words that were told last.
#[derive(Debug, Default)]
pub(crate) struct CodeWordsBook {
    /// Those of the code that comes next.
    next: CodeWords,
    told: [Option<Told>; MOST],
}

impl CodeWordsBook {
    /// Takes up the event of a setpoint.
    pub(crate) fn note(&mut self, setpoint: &Setpoint, event: Event) {
        match event {
            Event::CodeWord { word, value } => self.next.set(word, value),
            Event::MCode(_) => {
                let words = core::mem::take(&mut self.next);
                if words == CodeWords::default() {
                    return;
                }
                self.told.rotate_right(1);
                self.told[0] = Some(Told {
                    epoch: setpoint.epoch,
                    sequence: setpoint.sequence,
                    words,
                });
            }
            _ => {}
        }
    }

    /// The words of what is awaited.
    pub(crate) fn of(&self, awaited: &Awaited) -> CodeWords {
        let is_it = |told: &&Told| (told.epoch, told.sequence) == (awaited.epoch, awaited.sequence);
        let told = self.told.iter().flatten().find(is_it);
        told.map_or_else(CodeWords::default, |told| told.words)
    }
}
