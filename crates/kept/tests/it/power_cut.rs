//! Power that goes at any step of a write: what is read afterwards is the generation that was
//! answered last or the one that was being written, whole.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use crate::disk::{Disk, Fault};
use crate::generations::kept_of;
use glidepath_kept::{KeptError, Store};

/// Random numbers (xorshift64*, Marsaglia, Vigna).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    fn below(&mut self, most: u64) -> u64 {
        (self.next() >> 16) % most
    }
}

/// What the disk has: the generation, which is whole.
fn read(disk: &Disk) -> Result<u64, KeptError> {
    match Store::new(disk.clone()).read()? {
        None => Ok(0),
        Some((generation, kept)) => {
            assert_eq!(
                kept,
                kept_of(generation),
                "generation {generation} is mixed"
            );
            Ok(generation)
        }
    }
}

/// Writes until the power goes at a step; the generation that was answered last, and whether one
/// was being written.
fn write_until(disk: &mut Disk, before: u64, step: u64) -> (u64, bool) {
    disk.fail_at(step);
    let mut store = Store::new(&mut *disk);
    let mut answered = before;
    loop {
        match store.write(&kept_of(answered + 1)) {
            Ok(generation) => {
                assert_eq!(generation, answered + 1);
                answered = generation;
            }
            Err(KeptError::Io { .. }) => return (answered, true),
            Err(error) => panic!("{error}"),
        }
    }
}

/// A thousand cuts, one after the other on the same disk; the error of the first that is not as it
/// has to be.
fn thousand_cuts(fault: Fault) -> Result<u64, String> {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut disk = Disk::new(fault);
    let mut known = 0;
    for cut in 0..1000 {
        let step = random.below(40);
        let (answered, _) = write_until(&mut disk, known, step);
        disk.lose_power(&mut || random.next());
        let found = read(&disk).map_err(|error| format!("cut {cut}: {error}"))?;
        if found != answered && found != answered + 1 {
            return Err(format!(
                "cut {cut}: {found} is read, {answered} was answered"
            ));
        }
        known = found;
    }
    Ok(known)
}

#[test]
fn a_thousand_random_cuts_leave_the_old_or_the_new_generation() {
    let written = thousand_cuts(Fault::None).expect("no mixture");
    assert!(written > 1500, "{written}");
}

/// The tests see what they are for: without either of the waits, a cut does harm.
#[test]
fn a_cut_does_harm_without_the_waits() {
    let torn = thousand_cuts(Fault::DataIsNotAwaited).expect_err("a torn file");
    assert!(torn.contains("damaged"), "{torn}");
    let lost = thousand_cuts(Fault::NamesAreNotAwaited).expect_err("a lost generation");
    assert!(
        lost.contains("was answered") || lost.contains("damaged"),
        "{lost}"
    );
}

#[test]
fn every_step_of_a_write_may_be_the_last() {
    let mut random = Random(7);
    for before in 0..4 {
        for step in 0.. {
            for _ in 0..20 {
                let mut disk = Disk::new(Fault::None);
                let mut store = Store::new(&mut disk);
                for generation in 1..=before {
                    store.write(&kept_of(generation)).expect("it is written");
                }
                disk.fail_at(step);
                let written = Store::new(&mut disk).write(&kept_of(before + 1));
                disk.lose_power(&mut || random.next());
                let found = read(&disk).expect("nothing is damaged");
                match written {
                    Ok(_) => assert_eq!(found, before + 1),
                    Err(_) => assert!(found == before || found == before + 1, "{found}"),
                }
            }
            if !disk_fails_within(before, step) {
                break;
            }
        }
    }
}

/// Whether a write has so many steps.
fn disk_fails_within(before: u64, step: u64) -> bool {
    let mut disk = Disk::new(Fault::None);
    let mut store = Store::new(&mut disk);
    for generation in 1..=before {
        store.write(&kept_of(generation)).expect("it is written");
    }
    disk.fail_at(step);
    Store::new(&mut disk).write(&kept_of(before + 1)).is_err()
}

#[test]
fn a_write_that_failed_can_be_tried_again() {
    for step in 0..8 {
        let mut disk = Disk::new(Fault::None);
        let mut store = Store::new(&mut disk);
        store.write(&kept_of(1)).expect("it is written");
        store.write(&kept_of(2)).expect("it is written");
        disk.fail_at(step);
        let failed = Store::new(&mut disk).write(&kept_of(3));
        disk.fail_at(u64::MAX);
        let mut store = Store::new(&mut disk);
        let before = store.read().expect("whole").expect("a generation").0;
        assert!(failed.is_ok() || before == 2 || before == 3);
        let generation = store.write(&kept_of(before + 1)).expect("it is written");
        assert_eq!(read(&disk).expect("whole"), generation);
    }
}
