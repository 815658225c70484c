//! A disk whose power can go: bytes and names last only once they were waited for.

use glidepath_persistence::Storage;
use std::collections::BTreeMap;
use std::io;

/// What the disk leaves out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fault {
    /// Nothing.
    None,
    /// It does not wait for bytes.
    DataIsNotAwaited,
    /// It does not wait for names.
    NamesAreNotAwaited,
}

/// A file.
#[derive(Debug, Clone, Default)]
struct File {
    /// What outlasts a loss of power.
    lasting: Vec<u8>,
    present: Vec<u8>,
}

/// A name that was given, and not waited for.
#[derive(Debug, Clone)]
struct Naming {
    name: String,
    file: usize,
    /// The name the file had before.
    from: Option<String>,
}

/// A disk.
#[derive(Debug, Clone)]
pub(crate) struct Disk {
    files: Vec<File>,
    lasting_names: BTreeMap<String, usize>,
    names: BTreeMap<String, usize>,
    not_awaited: Vec<Naming>,
    /// Steps until every further one fails.
    left: u64,
    fault: Fault,
}

impl Disk {
    /// An empty disk.
    #[must_use]
    pub(crate) fn new(fault: Fault) -> Self {
        Self {
            files: Vec::new(),
            lasting_names: BTreeMap::new(),
            names: BTreeMap::new(),
            not_awaited: Vec::new(),
            left: u64::MAX,
            fault,
        }
    }

    /// Lets so many steps be done, and none behind them. Half of the one that fails is done.
    pub(crate) fn fail_at(&mut self, step: u64) {
        self.left = step;
    }

    /// What was not waited for comes to something or nothing, by chance, each part by itself.
    pub(crate) fn lose_power(&mut self, random: &mut dyn FnMut() -> u64) {
        for naming in std::mem::take(&mut self.not_awaited) {
            if random() & 0x100 != 0 {
                if let Some(from) = &naming.from
                    && self.lasting_names.get(from) == Some(&naming.file)
                {
                    self.lasting_names.remove(from);
                }
                self.lasting_names.insert(naming.name, naming.file);
            }
        }
        self.names.clone_from(&self.lasting_names);
        for file in &mut self.files {
            if file.present != file.lasting {
                // What was waited for stays where more was written behind it.
                let stays = if file.present.starts_with(&file.lasting) {
                    file.lasting.len()
                } else {
                    0
                };
                let more = file.present.len() - stays + 1;
                let length = stays + usize::try_from(random() >> 8).unwrap_or(0) % more;
                let mut torn = file.present.clone();
                match (random() >> 20) % 3 {
                    0 => torn.truncate(length),
                    1 => torn.iter_mut().skip(length).for_each(|byte| *byte = 0),
                    _ => torn.clone_from(&file.lasting),
                }
                file.lasting = torn;
            }
            file.present.clone_from(&file.lasting);
        }
        self.left = u64::MAX;
        self.forget_unnamed();
    }

    /// Frees what no name leads to any more.
    fn forget_unnamed(&mut self) {
        let naming = self.not_awaited.iter().map(|naming| naming.file);
        let named: Vec<usize> = self.names.values().copied().chain(naming).collect();
        let lasting: Vec<usize> = self.lasting_names.values().copied().collect();
        for (number, file) in self.files.iter_mut().enumerate() {
            if !named.contains(&number) && !lasting.contains(&number) {
                *file = File::default();
            }
        }
    }

    /// Counts a step: true if it is to be done.
    fn step(&mut self) -> io::Result<()> {
        if self.left == 0 {
            return Err(io::Error::other("the power is gone"));
        }
        self.left -= 1;
        Ok(())
    }

    fn file(&mut self, name: &str) -> io::Result<&mut File> {
        let number = self.names.get(name).copied();
        let file = number.and_then(|number| self.files.get_mut(number));
        file.ok_or_else(|| io::ErrorKind::NotFound.into())
    }

    fn give(&mut self, name: &str, file: usize, from: Option<&str>) {
        if let Some(from) = from {
            self.names.remove(from);
        }
        self.names.insert(name.to_owned(), file);
        self.not_awaited.push(Naming {
            name: name.to_owned(),
            file,
            from: from.map(str::to_owned),
        });
    }
}

impl Storage for Disk {
    fn read(&self, name: &str) -> io::Result<Option<Vec<u8>>> {
        let number = self.names.get(name);
        Ok(number.map(|number| self.files[*number].present.clone()))
    }

    fn create(&mut self, name: &str) -> io::Result<()> {
        self.step()?;
        if let Ok(file) = self.file(name) {
            file.present.clear();
            return Ok(());
        }
        let naming = self.not_awaited.iter().map(|naming| naming.file);
        let named = self.names.values().chain(self.lasting_names.values());
        let named: Vec<usize> = named.copied().chain(naming).collect();
        let free = (0..self.files.len()).find(|number| !named.contains(number));
        let file = free.unwrap_or(self.files.len());
        if free.is_none() {
            self.files.push(File::default());
        }
        self.give(name, file, None);
        Ok(())
    }

    fn append(&mut self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let whole = self.step();
        let part = if whole.is_ok() {
            bytes.len()
        } else {
            bytes.len() / 2
        };
        self.file(name)?.present.extend_from_slice(&bytes[..part]);
        whole
    }

    fn sync(&mut self, name: &str) -> io::Result<()> {
        self.step()?;
        let is_awaited = self.fault != Fault::DataIsNotAwaited;
        let file = self.file(name)?;
        if is_awaited {
            file.lasting.clone_from(&file.present);
        }
        Ok(())
    }

    fn rename(&mut self, from: &str, to: &str) -> io::Result<()> {
        self.step()?;
        let file = self.names.get(from).copied();
        let file = file.ok_or(io::ErrorKind::NotFound)?;
        self.give(to, file, Some(from));
        Ok(())
    }

    fn sync_names(&mut self) -> io::Result<()> {
        self.step()?;
        if self.fault != Fault::NamesAreNotAwaited {
            self.lasting_names.clone_from(&self.names);
            self.not_awaited.clear();
            self.forget_unnamed();
        }
        Ok(())
    }

    fn describe(&self, name: &str) -> String {
        name.to_owned()
    }
}
