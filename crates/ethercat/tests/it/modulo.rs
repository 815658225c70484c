//! Axes that turn on and on: a counter that goes round.

use crate::life::{Day, assert_clean};
use crate::machine::{COUNTS, Case, Hands, Outcome, Setup, run};
use glidepath_emulator::{Segment, SyncRecord};
use glidepath_ethercat::{BusFault, Event};

/// What a counter shows, as all that was counted.
fn unrolled(records: &mut [SyncRecord], (lowest, highest): (i32, i32)) {
    let count = i64::from(highest) - i64::from(lowest) + 1;
    let mut near = 0_i64;
    for record in records {
        for shown in [&mut record.target, &mut record.actual] {
            let off = (i64::from(*shown) - near + count / 2).rem_euclid(count) - count / 2;
            near += off;
            *shown = near as i32;
        }
    }
}

/// A day of a machine whose drives count round.
fn day(setup: &Setup, range: (i32, i32)) -> Outcome {
    let mut outcome = run(setup, &mut Day::default());
    for records in &mut outcome.records {
        let shown = records.iter().map(|record| record.target);
        assert!(
            shown
                .clone()
                .all(|shown| (range.0..=range.1).contains(&shown))
        );
        unrolled(records, range);
    }
    outcome
}

#[test]
fn a_counter_that_goes_round_is_a_way_that_does_not() {
    // 1.8 mm a round, and 8 mm there and 12 back.
    for range in [(0, 2_999_999), (-1_000_000, 1_999_999)] {
        let mut setup = Setup::absolute(2_000_000);
        for (drive, emulated) in setup.drives.iter_mut().zip(&mut setup.emulated) {
            drive.is_modulo = true;
            emulated.range = Some(range);
        }
        let outcome = day(&setup, range);
        assert_clean(&setup, &outcome);
        let end = outcome.setpoints.last().unwrap();
        assert!((end.position[0] - 5.0).abs() < 1e-3 && (end.position[2] - 3.0).abs() < 1e-3);
        let last = outcome.records[0].last().unwrap().actual;
        assert!((f64::from(last) / COUNTS - 5.0).abs() < 1e-3, "{last}");
    }
}

/// Three axes that stand 1000 counts before the end of 32 bits, which is their zero.
fn at_the_end() -> Setup {
    let mut setup = Setup::absolute(2_000_000);
    let begin = i32::MAX - 1000;
    for (drive, emulated) in setup.drives.iter_mut().zip(&mut setup.emulated) {
        let sign = if drive.is_inverted { -1.0 } else { 1.0 };
        drive.home_offset = -sign * f64::from(begin) / COUNTS;
        emulated.start_counts = vec![begin];
        emulated.range = Some((i32::MIN, i32::MAX));
    }
    setup
}

#[test]
fn thirty_two_bits_go_round_where_the_drive_may_turn_on_and_on() {
    let mut setup = at_the_end();
    for drive in &mut setup.drives {
        drive.is_modulo = true;
    }
    let outcome = run(&setup, &mut Day::default());
    let counts = &outcome.counts;
    assert_eq!((counts.lost, counts.short, outcome.allocations), (0, 0, 0));
    let end = outcome.setpoints.last().unwrap();
    assert!((end.position[0] - 5.0).abs() < 1e-3, "{}", end.position[0]);
    // Beyond the end, by 5 mm less a thousand counts.
    let last = outcome.records[0].last().unwrap().actual;
    let beyond = f64::from(last) - f64::from(i32::MIN);
    assert!(
        (beyond + 1000.0 - 5.0 * COUNTS).abs() < 0.001 * COUNTS,
        "{last}"
    );
}

/// Runs until its end or until a drive is told to go where it does not count.
#[derive(Debug, Default)]
struct UntilRange {
    day: Day,
    ended: bool,
}

impl Case for UntilRange {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        let is_out = |event: &Event| matches!(event, Event::Trouble(BusFault::Range(_)));
        self.ended |= hands.events.iter().any(is_out);
        if self.ended {
            hands.wants.end = true;
        } else {
            self.day.tick(hands, segment);
        }
    }
}

#[test]
fn without_that_a_counter_ends_where_it_ends() {
    let mut until = UntilRange::default();
    let _ = run(&at_the_end(), &mut until);
    assert!(until.ended);
}
