//! A receiving end that spoils what it receives, on purpose and repeatably: for tests of what
//! stands behind it.

use glidepath_link::{LinkError, Record, RecordError, Subscriber};
use std::collections::VecDeque;

/// What happens to a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// It and those after it are lost, so many in all.
    Lose(u32),
    /// So many calls find nothing before it comes.
    Delay(u32),
    /// It comes again, so many times.
    Repeat(u32),
    /// It comes after the one that follows it.
    Swap,
    /// One of its bits is inverted.
    Corrupt,
    /// One of its numbers is made infinite or not a number.
    NotFinite,
    /// Nothing comes any more, this one included.
    Stop,
}

/// When which fault happens.
#[derive(Debug, Clone)]
enum Schedule {
    /// At the given records, counted from 0 as they arrive.
    Script(Vec<(u64, Fault)>),
    /// One of the faults at one record in so many.
    Random { one_in: u64, faults: Vec<Fault> },
}

/// A receiving end that makes faults. The same schedule and seed make the same faults.
pub struct Faulty<R> {
    inner: Box<dyn Subscriber<R>>,
    schedule: Schedule,
    random: SplitMix64,
    arrived: u64,
    ready: VecDeque<R>,
    held_back: Option<R>,
    silent_calls: u32,
    to_lose: u32,
    stopped: bool,
}

impl<R> core::fmt::Debug for Faulty<R> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Faulty")
            .field("schedule", &self.schedule)
            .field("arrived", &self.arrived)
            .finish_non_exhaustive()
    }
}

impl<R: Record> Faulty<R> {
    /// Makes each fault at the record of its number, counted from 0 as they arrive. `seed` chooses
    /// bits and numbers.
    #[must_use]
    pub fn scripted(inner: Box<dyn Subscriber<R>>, seed: u64, script: &[(u64, Fault)]) -> Self {
        Self::new(inner, seed, Schedule::Script(script.to_vec()))
    }

    /// Makes a fault at one record in `one_in` ≥ 1 on average, chosen from `faults`.
    #[must_use]
    pub fn random(inner: Box<dyn Subscriber<R>>, seed: u64, one_in: u64, faults: &[Fault]) -> Self {
        Self::new(
            inner,
            seed,
            Schedule::Random {
                one_in: one_in.max(1),
                faults: faults.to_vec(),
            },
        )
    }

    fn new(inner: Box<dyn Subscriber<R>>, seed: u64, schedule: Schedule) -> Self {
        Self {
            inner,
            schedule,
            random: SplitMix64(seed),
            arrived: 0,
            ready: VecDeque::new(),
            held_back: None,
            silent_calls: 0,
            to_lose: 0,
            stopped: false,
        }
    }

    fn next_fault(&mut self) -> Option<Fault> {
        match &self.schedule {
            Schedule::Script(script) => script
                .iter()
                .find(|(at, _)| *at == self.arrived)
                .map(|(_, fault)| *fault),
            Schedule::Random { one_in, faults } => {
                let happens = self.random.below(*one_in) == 0;
                let choice = self.random.index(faults.len());
                faults.get(choice).copied().filter(|_| happens)
            }
        }
    }

    /// Puts an arrived record where its fault, if any, leaves it.
    fn arrive(&mut self, record: R) {
        let fault = self.next_fault();
        self.arrived += 1;
        if self.to_lose > 0 {
            self.to_lose -= 1;
            return;
        }
        match fault {
            None => self.ready.push_back(record),
            Some(Fault::Lose(count)) => self.to_lose = count.saturating_sub(1),
            Some(Fault::Delay(calls)) => {
                self.silent_calls = calls;
                self.ready.push_back(record);
            }
            Some(Fault::Repeat(times)) => {
                self.ready.extend((0..=times).map(|_| record));
            }
            Some(Fault::Swap) if self.held_back.is_none() => {
                self.held_back = Some(record);
                return;
            }
            Some(Fault::Swap) => self.ready.push_back(record),
            Some(Fault::Corrupt) => {
                let corrupt = self.corrupt(record);
                self.ready.push_back(corrupt);
            }
            Some(Fault::NotFinite) => {
                let spoilt = self.spoil_number(record);
                self.ready.push_back(spoilt);
            }
            Some(Fault::Stop) => self.stopped = true,
        }
        self.ready.extend(self.held_back.take());
    }

    fn corrupt(&mut self, mut record: R) -> R {
        let bytes = bytemuck::bytes_of_mut(&mut record);
        let (at, bit) = (self.random.index(bytes.len()), self.random.below(8));
        if let Some(byte) = bytes.get_mut(at) {
            *byte ^= 1 << bit;
        }
        record
    }

    fn spoil_number(&mut self, record: R) -> R {
        let numbers: Vec<R> = (0..size_of::<R>() / 8)
            .filter_map(|index| {
                let mut spoilt = record;
                let bytes = bytemuck::bytes_of_mut(&mut spoilt);
                let number = bytes.get_mut(8 * index..8 * index + 8)?;
                let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
                number.copy_from_slice(&bad.get(index % 3)?.to_ne_bytes());
                // Other fields of eight bytes are no numbers of the kind that can be infinite.
                matches!(spoilt.check(), Err(RecordError::NotFinite { .. })).then_some(spoilt)
            })
            .collect();
        numbers
            .get(self.random.index(numbers.len()))
            .copied()
            .unwrap_or(record)
    }
}

impl<R: Record> Subscriber<R> for Faulty<R> {
    fn take(&mut self) -> Result<Option<R>, LinkError> {
        while self.ready.is_empty() && !self.stopped {
            match self.inner.take()? {
                Some(record) => self.arrive(record),
                None => return Ok(None),
            }
        }
        if self.silent_calls > 0 {
            self.silent_calls -= 1;
            return Ok(None);
        }
        Ok(self.ready.pop_front())
    }
}

/// Steele, Lea, Flood 2014: a few operations, any seed, good enough to choose faults.
#[derive(Debug, Clone)]
struct SplitMix64(u64);

impl SplitMix64 {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `end`, 0 if that is 0.
    fn below(&mut self, end: u64) -> u64 {
        self.next().checked_rem(end).unwrap_or(0)
    }

    fn index(&mut self, length: usize) -> usize {
        usize::try_from(self.below(length as u64)).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests;
