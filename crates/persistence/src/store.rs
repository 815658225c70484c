//! The store of generations, in two files that take turns.

use crate::error::StoreError;
use crate::state::PersistentState;
use crate::storage::Storage;
use crate::text::{from_text, to_text};

/// The two files. Generation n is in the one of the number n modulo 2.
pub const SLOTS: [&str; 2] = ["kept.0", "kept.1"];

/// What is being written, beside them.
const NEW: &str = "kept.new";

/// How often both files are looked at while another process writes.
const LOOKS: u32 = 8;

/// Reads and writes generations.
#[derive(Debug)]
pub struct Store<S> {
    storage: S,
}

/// What is in one file.
type Slot = Option<Result<(u64, PersistentState), StoreError>>;

impl<S: Storage> Store<S> {
    /// A store; nothing is read yet.
    pub const fn new(storage: S) -> Self {
        Self { storage }
    }

    /// The newest generation; `None` if nothing was ever kept.
    ///
    /// # Errors
    /// [`StoreError::Damaged`], also if a file is gone that has to be there; [`StoreError::Newer`]; or
    /// a file cannot be read.
    pub fn read(&self) -> Result<Option<(u64, PersistentState)>, StoreError> {
        let mut looked = self.look();
        // Another process may have written twice between the two files.
        for _ in 1..LOOKS {
            if !matches!(looked, Err(StoreError::Damaged { .. })) {
                break;
            }
            looked = self.look();
        }
        looked
    }

    fn look(&self) -> Result<Option<(u64, PersistentState)>, StoreError> {
        let [even, odd] = self.slots()?;
        let (even, odd) = (even.transpose()?, odd.transpose()?);
        let missing = |slot: usize, generation: u64| StoreError::Damaged {
            file: self.name(slot),
            reason: format!(
                "it is not the generation before or after {generation}, which is in {}",
                self.name(1 - slot)
            ),
        };
        match (even, odd) {
            (None, None) => Ok(None),
            (None, Some((1, kept))) => Ok(Some((1, kept))),
            (None, Some((generation, _))) => Err(missing(0, generation)),
            (Some((generation, _)), None) => Err(missing(1, generation)),
            (Some(even), Some(odd)) if even.0.abs_diff(odd.0) == 1 => {
                Ok(Some(if even.0 > odd.0 { even } else { odd }))
            }
            (Some(even), Some(odd)) => {
                let older = usize::from(odd.0 < even.0);
                Err(missing(older, even.0.max(odd.0)))
            }
        }
    }

    fn slots(&self) -> Result<[Slot; 2], StoreError> {
        let read = |slot: usize| {
            let name = self.name(slot);
            let bytes = self.storage.read(SLOTS[slot]);
            let bytes = bytes.map_err(StoreError::io("read", &name))?;
            Ok(bytes.map(|bytes| {
                let (generation, kept) = from_text(&name, &bytes)?;
                if generation % 2 == slot as u64 {
                    return Ok((generation, kept));
                }
                Err(StoreError::Damaged {
                    file: name.clone(),
                    reason: format!(
                        "it has generation {generation}, which belongs to the other file"
                    ),
                })
            }))
        };
        Ok([read(0)?, read(1)?])
    }

    /// Writes the next generation. When this returns its number, that generation outlasts a loss of
    /// power; if it fails, what is read next is this generation or the one before.
    ///
    /// # Errors
    /// As [`Store::read`]; or it cannot be written.
    pub fn write(&mut self, kept: &PersistentState) -> Result<u64, StoreError> {
        let before = self.read()?.map_or(0, |(generation, _)| generation);
        self.write_generation(before + 1, kept)
    }

    /// Takes the newest generation that can be read for the truth, whatever has become of the other
    /// file. For an operator who was told that a file is damaged.
    ///
    /// # Errors
    /// No generation can be read, or it cannot be written.
    pub fn recover(&mut self) -> Result<(u64, PersistentState), StoreError> {
        let mut best: Option<(u64, PersistentState)> = None;
        let mut fault = None;
        for slot in self.slots()?.into_iter().flatten() {
            match slot {
                Ok(found) if best.as_ref().is_none_or(|best| best.0 < found.0) => {
                    best = Some(found);
                }
                Ok(_) => {}
                Err(error) => fault = Some(error),
            }
        }
        let Some((generation, kept)) = best else {
            return Err(fault.unwrap_or_else(|| StoreError::NotKeepable {
                reason: "nothing was ever kept".to_owned(),
            }));
        };
        // Both files are to be right again: the damaged one, then a generation over the other.
        self.write_generation(generation + 1, &kept)?;
        Ok((generation + 1, kept))
    }

    fn write_generation(
        &mut self,
        generation: u64,
        kept: &PersistentState,
    ) -> Result<u64, StoreError> {
        let text = to_text(kept, generation)?;
        let slot = SLOTS[usize::from(generation % 2 == 1)];
        let name = self.storage.describe(NEW);
        let storage = &mut self.storage;
        storage
            .create(NEW)
            .and_then(|()| storage.append(NEW, text.as_bytes()))
            .and_then(|()| storage.sync(NEW))
            .map_err(StoreError::io("write", &name))?;
        storage
            .rename(NEW, slot)
            .and_then(|()| storage.sync_names())
            .map_err(StoreError::io("rename", &name))?;
        Ok(generation)
    }

    fn name(&self, slot: usize) -> String {
        self.storage.describe(SLOTS[slot])
    }
}
