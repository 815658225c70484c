//! The beginning of a recorded program: its text, and the set-up that it began with.

use core::hash::Hasher as _;
use std::collections::BTreeMap;
use std::sync::Arc;
use twox_hash::XxHash64;

/// The beginning of a program.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Begun {
    /// The epoch of its motion.
    pub epoch: u64,
    /// What it began with, as text. What that says is the business of who wrote it.
    pub set_up: String,
    /// Its text, if it is known.
    pub program: Option<Arc<[u8]>>,
    /// The texts of its subroutines in other files, by name.
    pub subroutines: BTreeMap<String, Arc<[u8]>>,
}

/// The name of the metadata record, and of its entries.
pub(crate) const BEGUN: &str = "begun";
pub(crate) const EPOCH: &str = "epoch";
pub(crate) const SET_UP: &str = "set_up";
const PROGRAM: &str = "program";
const SUBROUTINE: &str = "subroutine ";

impl Begun {
    /// Its texts, by the names of the entries that say which attachment each is.
    pub(crate) fn texts(&self) -> impl Iterator<Item = (String, &Arc<[u8]>)> {
        let program = self.program.iter().map(|text| (PROGRAM.to_owned(), text));
        let subroutines = self.subroutines.iter();
        let subroutines = subroutines.map(|(name, text)| (format!("{SUBROUTINE}{name}"), text));
        program.chain(subroutines)
    }

    /// Takes a text by the name of its entry.
    pub(crate) fn take(&mut self, entry: &str, text: &Arc<[u8]>) {
        if entry == PROGRAM {
            self.program = Some(Arc::clone(text));
        } else if let Some(name) = entry.strip_prefix(SUBROUTINE) {
            self.subroutines.insert(name.to_owned(), Arc::clone(text));
        }
    }
}

/// The name of the attachment with a text: the same for the same text, so that it is written once.
pub(crate) fn attachment_of(text: &[u8]) -> String {
    let mut hash = XxHash64::with_seed(0);
    hash.write(text);
    format!("text-{:016x}", hash.finish())
}
