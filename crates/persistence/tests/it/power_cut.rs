//! Tests of power that goes at any step of a write: what is read afterwards is the generation that
//! was answered last or the one that was being written, whole.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use crate::disk::{Disk, Fault};
use crate::generations::kept_of;
use glidepath_persistence::{InputLog, LoggedInput, LoggedValue, Storage as _, Store, StoreError};

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
fn read(disk: &Disk) -> Result<u64, StoreError> {
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
            Err(StoreError::Io { .. }) => return (answered, true),
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

/// The answer of a number, which tells it.
fn answer(number: u32) -> LoggedInput {
    let at = [
        f64::from(number),
        -0.1,
        1e-9,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        7.0 / 3.0,
    ];
    let said = match number % 4 {
        0 => LoggedValue::Input(f64::from(number) / 3.0),
        kind => LoggedValue::Probe {
            contact: (kind > 1).then_some(at),
            was_so: kind == 3,
            stands: at,
        },
    };
    LoggedInput { line: number, said }
}

/// Answers are kept until the power goes at a step. Those that were are there afterwards, and at
/// most the one that was being kept; the program goes on behind them.
fn answers_cut_at_random(fault: Fault) -> Result<u32, String> {
    const PROGRAM: u64 = 0xfeed;
    let mut random = Random(0x51ed_270b_1f0b_9d2d);
    let mut disk = Disk::new(fault);
    let mut known = 0;
    for cut in 0..1000 {
        disk.fail_at(random.below(30));
        let opened = InputLog::go_on(&mut disk, PROGRAM).map_err(|error| format!("{error}"))?;
        let (mut answers, found) = opened;
        let expected: Vec<LoggedInput> = (1..=known).map(answer).collect();
        if found != expected {
            return Err(format!("cut {cut}: {} of {known} answers", found.len()));
        }
        let (mut kept, mut may_be) = (known, None);
        // Now and then a part of the run is gone back over.
        if random.below(20) == 0 {
            match answers.keep_first(known as usize / 2) {
                Ok(()) => kept = known / 2,
                Err(_) => may_be = Some(known / 2),
            }
        }
        while answers.keep(&answer(kept + 1)).is_ok() {
            kept += 1;
        }
        disk.lose_power(&mut || random.next());
        let (_, found) = InputLog::go_on(&mut disk, PROGRAM).map_err(|error| format!("{error}"))?;
        let found = u32::try_from(found.len()).map_err(|error| error.to_string())?;
        if found != kept && found != kept + 1 && Some(found) != may_be {
            return Err(format!(
                "cut {cut}: {found} answers are read, {kept} were kept"
            ));
        }
        known = found;
    }
    Ok(known)
}

#[test]
fn a_thousand_random_cuts_leave_every_answer_that_was_told() {
    let known = answers_cut_at_random(Fault::None).expect("none is lost");
    assert!(known > 50, "{known}");
    let lost = answers_cut_at_random(Fault::DataIsNotAwaited).expect_err("an answer is lost");
    assert!(lost.contains("answers"), "{lost}");
}

#[test]
fn answers_are_those_of_one_run() {
    let mut disk = Disk::new(Fault::None);
    let mut first = InputLog::begin(&mut disk, 1).expect("an empty disk");
    for number in 1..=5 {
        first.keep(&answer(number)).expect("it is kept");
    }
    let of = |disk: &mut Disk, program| {
        let (_, found) = InputLog::go_on(disk, program).expect("nothing is damaged");
        found.len()
    };
    assert_eq!((of(&mut disk, 1), of(&mut disk, 2)), (5, 0));
    // Another program asks nothing: what the first was told stays.
    InputLog::begin(&mut disk, 2).expect("it is whole");
    assert_eq!(of(&mut disk, 1), 5);
    // The first begins anew.
    InputLog::begin(&mut disk, 1).expect("it is whole");
    assert_eq!(of(&mut disk, 1), 0);
    let mut second = InputLog::begin(&mut disk, 2).expect("it is whole");
    second.keep(&answer(9)).expect("it is kept");
    assert_eq!((of(&mut disk, 1), of(&mut disk, 2)), (0, 1));
}

#[test]
fn what_is_damaged_in_the_middle_is_told() {
    let mut disk = Disk::new(Fault::None);
    let mut answers = InputLog::begin(&mut disk, 1).expect("an empty disk");
    for number in 1..=3 {
        answers.keep(&answer(number)).expect("it is kept");
    }
    let whole = disk.read("answers").expect("a disk").expect("a file");
    let damaged = |index: usize| {
        let mut disk = Disk::new(Fault::None);
        let mut bytes = whole.clone();
        bytes[index] ^= 1;
        disk.create("answers").expect("a disk");
        disk.append("answers", &bytes).expect("a disk");
        InputLog::go_on(disk, 1).map(|(_, found)| found.len())
    };
    let ends: Vec<usize> = (0..whole.len()).filter(|at| whole[*at] == b'\n').collect();
    for index in 0..whole.len() {
        match damaged(index) {
            Ok(found) if index <= ends[0] => assert_eq!(found, 0, "byte {index} of the head"),
            Ok(found) => {
                assert!(index >= ends[2], "byte {index}: {found} are read");
                assert_eq!(found, if index == ends[2] { 1 } else { 2 });
            }
            Err(StoreError::Damaged { .. }) => assert!(index <= ends[2], "byte {index}"),
            Err(error) => panic!("{error}"),
        }
    }
}
