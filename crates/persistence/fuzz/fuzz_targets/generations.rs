//! The fuzz target: whatever is in the two files: it is read or refused, and what is read can be
//! written again.
#![no_main]

use glidepath_persistence::{PersistentState, SLOTS, Storage, Store};
use libfuzzer_sys::fuzz_target;
use std::collections::HashMap;
use std::hash::Hasher as _;
use std::io;
use twox_hash::XxHash64;

#[derive(Default)]
struct Memory(HashMap<String, Vec<u8>>);

impl Storage for Memory {
    fn read(&self, name: &str) -> io::Result<Option<Vec<u8>>> {
        Ok(self.0.get(name).cloned())
    }

    fn create(&mut self, name: &str) -> io::Result<()> {
        self.0.insert(name.to_owned(), Vec::new());
        Ok(())
    }

    fn append(&mut self, name: &str, bytes: &[u8]) -> io::Result<()> {
        self.0.entry(name.to_owned()).or_default().extend(bytes);
        Ok(())
    }

    fn sync(&mut self, _: &str) -> io::Result<()> {
        Ok(())
    }

    fn rename(&mut self, from: &str, to: &str) -> io::Result<()> {
        let bytes = self.0.remove(from).ok_or(io::ErrorKind::NotFound)?;
        self.0.insert(to.to_owned(), bytes);
        Ok(())
    }

    fn sync_names(&mut self) -> io::Result<()> {
        Ok(())
    }

    fn describe(&self, name: &str) -> String {
        name.to_owned()
    }
}

/// A file with a right checksum over any text.
fn sealed(generation: u64, body: &[u8]) -> Vec<u8> {
    let mut hash = XxHash64::with_seed(0);
    hash.write(&1_u32.to_le_bytes());
    hash.write(&generation.to_le_bytes());
    hash.write(body);
    let sum = hash.finish();
    let head =
        format!("# glidepath kept version 1 generation {generation} checksum {sum:016x}\n");
    [head.as_bytes(), body].concat()
}

fuzz_target!(|input: (Option<u8>, u16, Option<u64>, Vec<u8>)| {
    let (changed, at, generation, bytes) = input;
    let mut memory = Memory::default();
    let mut store = Store::new(&mut memory);
    for _ in 0..2 {
        store.write(&PersistentState::default()).expect("memory has room");
    }
    // Foreign bytes in the place of a file, or in the middle of one.
    if let Some(generation) = generation {
        let slot = SLOTS[usize::from(generation % 2 == 1)];
        memory.0.insert(slot.to_owned(), sealed(generation, &bytes));
    } else if let Some(slot) = changed {
        let file = memory
            .0
            .get_mut(SLOTS[usize::from(slot) % 2])
            .expect("both were written");
        let at = usize::from(at) % (file.len() + 1);
        let end = file.len().min(at + bytes.len());
        file.splice(at..end, bytes);
    } else {
        memory
            .0
            .insert(SLOTS[usize::from(at) % 2].to_owned(), bytes);
    }
    let mut store = Store::new(&mut memory);
    if let Ok(Some((generation, kept))) = store.read() {
        assert_eq!(store.write(&kept).expect("it was read"), generation + 1);
        let (_, again) = store
            .read()
            .expect("it was written")
            .expect("it was written");
        assert_eq!(again, kept);
    }
    let _ = store.recover();
});
