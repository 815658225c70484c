//! A whole life of the machine with terminals, and what terminals are to the drives.

use super::shift::{LONG, MARKED, Part, Shift, TOUCH};
use super::{
    FIFTH, FLOOD, FORWARD, INPUTS, LAMP, LEVEL, OUTPUTS, PART_Z, QUARTER, input, output, setup,
};
use crate::judge::{commanded, output_changes};
use crate::life::{Day, assert_clean};
use crate::machine::{COUNTS, Case, Hands, run};
use glidepath_emulator::{ClockKind, DriveSettings as Emulated, Segment};
use glidepath_ethercat::{Signal, TerminalSettings};
use glidepath_link::ContactKind;

#[test]
fn a_whole_life_with_terminals() {
    let setup = setup();
    let mut shift = Shift::new(&[
        Part::Program(MARKED),
        Part::Program(TOUCH),
        Part::Aborted(LONG, 60),
        Part::Program(LONG),
    ]);
    let mut outcome = run(&setup, &mut shift);
    let counts = &outcome.counts;
    let bad = (counts.lost, counts.short, counts.stale, counts.missed);
    assert_eq!(bad, (0, 0, 0, 0));
    assert_eq!(outcome.allocations, 0, "the bus thread allocates");
    // Home: the edge of the switch is at −10.5 of the machine, and −10 of the drive.
    let home = outcome
        .setpoints
        .iter()
        .find(|setpoint| setpoint.epoch == 1);
    let home = home.unwrap();
    let off = home.joint_position[0] - home.position[0];
    assert!((off - 0.5).abs() < 0.05, "{off}");
    // The probe touched within what it went in a tick of the case and a period of the bus.
    let (kind, z) = shift.contact.unwrap();
    assert_eq!(kind, ContactKind::Made.code());
    assert!((z - PART_Z).abs() < 5.0 * 0.008, "{z}");
    // Spindle and coolant are on after a program that does not switch them off, and off after M2 and an abort,
    // which leave outputs of programs as they are.
    let (running, aborted) = (FORWARD | FLOOD, FIFTH | LAMP);
    assert_eq!(shift.after[0], (running | LAMP, QUARTER));
    assert_eq!(shift.during[2], (running | FIFTH | LAMP, QUARTER));
    assert_eq!(shift.after[2], (aborted, 0));
    assert_eq!(shift.after[3], (aborted, 0));
    // M62 and M63 are in place to the period of the bus: half of it before to half of it after.
    let records = outcome.left.0.take_output_records(OUTPUTS);
    let seen = output_changes(&records, FIFTH);
    let meant = commanded(&outcome, 5);
    assert!(meant.len() >= 4, "{meant:?}");
    for (at_ns, on) in &meant[..2] {
        let due_ns = at_ns + setup.bus.delay_ns;
        let near = |(seen_ns, seen_on): &&(u64, bool)| {
            seen_on == on && seen_ns.abs_diff(due_ns) <= setup.bus.period_ns / 2 + 50_000
        };
        assert!(
            seen.iter().any(|change| near(&change)),
            "{due_ns} {on}: {seen:?}"
        );
    }
    // At the end the spindle comes to rest first, then all others; before the bus is left.
    let ends = &records[records.len() - 2..];
    let last: Vec<_> = ends.iter().map(|record| record.outputs[0]).collect();
    assert_eq!(last[1], 0, "{records:?}");
    let spindle_ns = output_changes(&records, FORWARD).last().unwrap().0;
    let flood_ns = output_changes(&records, FLOOD).last().unwrap().0;
    assert!(
        spindle_ns + setup.bus.period_ns <= flood_ns + 1_000,
        "{records:?}"
    );
    assert!(!output_changes(&records, LAMP).last().unwrap().1);
}

#[test]
fn inputs_are_told_with_the_joints() {
    #[derive(Debug, Default)]
    struct Look {
        day: Day,
        seen: Option<(u64, u32, u32, f64)>,
    }
    impl Case for Look {
        fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
            segment.set_input(INPUTS, 0, true);
            segment.set_input(INPUTS, 1, true);
            segment.set_input(INPUTS, 2, true);
            segment.set_input_bytes(LEVEL, 4, &(-16_384_i16).to_le_bytes());
            if hands.tick > 50
                && let Some(said) = hands.feedback
            {
                let switches = (said.home_switch, said.limit_high);
                self.seen = Some((said.digital_in, switches.0, switches.1, said.analog_in[2]));
            }
            self.day.tick(hands, segment);
        }

        fn counts(&self) -> bool {
            self.day.counts()
        }
    }
    let mut setup = setup();
    (setup.homing, setup.probe) = (None, None);
    let mut look = Look::default();
    let outcome = run(&setup, &mut look);
    assert_clean(&setup, &outcome);
    // The limit switch is one that opens.
    assert_eq!(look.seen, Some((1, 1, 0, -5.0)));
}

#[test]
fn terminals_change_nothing_for_the_drives() {
    let mut with = setup();
    (with.homing, with.probe) = (None, None);
    for (drive, position) in with.drives.iter_mut().zip([0, 6, 7]) {
        drive.position = position;
    }
    // Drives before and behind the terminals, one of which knows no LRW.
    let [drive, coupler, inputs, outputs] = [
        Emulated::default(),
        Emulated::terminal("COUPLER", ClockKind::Bits64),
        Emulated::inputs(4),
        Emulated::outputs(16),
    ];
    let lacks = Emulated {
        image: glidepath_emulator::ImageAccess::NoLrwByFeatures,
        ..Emulated::inputs(2)
    };
    for last in [Emulated::inputs(2), lacks] {
        let mut setup = with.clone();
        setup.emulated = vec![
            drive.clone(),
            coupler.clone(),
            inputs.clone(),
            outputs.clone(),
            Emulated::terminal("OLD", ClockKind::None),
            last,
            drive.clone(),
            drive.clone(),
        ];
        let at = |position| TerminalSettings {
            position,
            ..TerminalSettings::default()
        };
        setup.terminals = vec![
            at(5),
            TerminalSettings {
                inputs: vec![input(0x6030)],
                ..at(2)
            },
            TerminalSettings {
                // In the second window.
                outputs: vec![output(0x70f0, Signal::Output(0))],
                ..at(3)
            },
        ];
        let outcome = run(&setup, &mut Day::default());
        let counts = &outcome.counts;
        let bad = (counts.lost, counts.short, counts.stale, counts.missed);
        assert_eq!((bad, outcome.allocations), ((0, 0, 0, 0), 0));
        let end = outcome.setpoints.last().unwrap();
        assert!((end.position[0] - 5.0).abs() < 1e-3, "{}", end.position[0]);
        let rests = outcome.records[2].last().unwrap().actual;
        assert!((f64::from(rests) / COUNTS - 3.0).abs() < 1e-3, "{rests}");
    }
}
