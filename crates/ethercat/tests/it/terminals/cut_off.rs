//! What is left of the machine with terminals where a cable is pulled, or the interpolator or the bridge dies.

use super::shift::{LONG, Part, Shift};
use super::{
    FIFTH, FLOOD, FORWARD, INPUTS, LAMP, OUTPUTS, QUARTER, assert_fell_by_watchdogs, input, setup,
};
use crate::judge::output_changes;
use crate::life::Day;
use crate::machine::{Case, Hands, run};
use glidepath_emulator::{DriveSettings as Emulated, Segment};
use glidepath_ethercat::{DigitalInput, Event, TerminalSettings};

#[test]
fn without_the_cable_behind_the_coupler_everything_comes_to_rest() {
    let setup = setup();
    let mut shift = Shift::new(&[Part::Unplugged(LONG, 60), Part::Plugged, Part::Reset]);
    let mut outcome = run(&setup, &mut shift);
    let running = FORWARD | FLOOD | FIFTH;
    assert_eq!(shift.during[0], (running, QUARTER));
    // By the terminals' own watchdogs.
    let records = outcome.left.0.take_output_records(OUTPUTS);
    let unplugged_ns = shift.unplugged_ns.unwrap();
    let fell = records.iter().find(|record| record.at_ns > unplugged_ns);
    let fell = fell.unwrap();
    assert_fell_by_watchdogs((&setup, &outcome), fell, (INPUTS, unplugged_ns));
    // The drives come to rest on the path.
    let status = outcome.setpoints.iter().rfind(|s| s.enable != 0).unwrap();
    assert!(status.velocity[0].abs() < 1e-9, "{status:?}");
    // The bus comes up again; outputs of programs come back when the fault is reset, and the spindle does not.
    assert!(outcome.counts.restarts > 0);
    assert_eq!(shift.after[1..], [(LAMP, 0), (FIFTH, 0)]);
}

#[test]
fn without_an_interpolator_outputs_are_at_rest_when_the_joints_are() {
    let setup = setup();
    let mut shift = Shift::new(&[Part::Orphaned(LONG, 60), Part::Adopted]);
    let mut outcome = run(&setup, &mut shift);
    assert_eq!(shift.during[0], (FORWARD | FLOOD | FIFTH, QUARTER));
    assert_eq!(shift.after[0], (LAMP, 0));
    // The spindle turned until the joints stood: until the frame that told them the last target.
    let records = outcome.left.0.take_output_records(OUTPUTS);
    let spindle_ns = output_changes(&records, FORWARD)[1].0;
    let moved = outcome.records[0].windows(2);
    let mut moved = moved.filter(|pair| pair[0].follows && pair[0].target != pair[1].target);
    let rests_ns = moved.next_back().unwrap()[1].at_ns;
    let led_ns = spindle_ns + setup.bus.shift_ns + 100_000;
    assert!(led_ns > rests_ns, "{led_ns} {rests_ns}");
    // Nothing is on that another interpolator did not switch on.
    assert_eq!(shift.after[1], (0, 0));
}

#[test]
fn without_a_bridge_outputs_fall_by_their_own_watchdogs() {
    let setup = setup();
    let mut shift = Shift::new(&[Part::Killed(LONG, 60)]);
    let mut outcome = run(&setup, &mut shift);
    let (records, killed_ns) = (
        outcome.left.0.take_output_records(OUTPUTS),
        shift.unplugged_ns.unwrap(),
    );
    assert_eq!(shift.during[0], (FORWARD | FLOOD | FIFTH, QUARTER));
    let fell = records.last().unwrap();
    let late_ns = fell.at_ns - killed_ns;
    assert_eq!(fell.outputs, [0]);
    assert!(
        late_ns <= setup.bus.watchdog_ns + setup.bus.period_ns,
        "{late_ns}"
    );
}

/// The drives behind the terminals are unplugged in motion.
#[derive(Debug, Default)]
struct DrivesGone {
    day: Day,
    gone: Option<u64>,
}

impl Case for DrivesGone {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        let moves = hands.last.is_some_and(|s| s.velocity[0].abs() > 20.0);
        match self.gone {
            None if moves => {
                segment.unplug(2..4, true, hands.now_ns);
                self.gone = Some(hands.tick);
            }
            None => self.day.tick(hands, segment),
            Some(gone) => hands.wants.end = hands.tick > gone + 100,
        }
    }
}

#[test]
fn a_lost_drive_is_told_from_a_lost_terminal() {
    let mut setup = setup();
    (setup.homing, setup.probe) = (None, None);
    let drive = setup.emulated[0].clone();
    setup.emulated = vec![drive.clone(), Emulated::inputs(4), drive.clone(), drive];
    for (drive, position) in setup.drives.iter_mut().zip([0, 2, 3]) {
        drive.position = position;
    }
    setup.terminals = vec![TerminalSettings {
        position: 1,
        inputs: vec![DigitalInput {
            number: Some(0),
            ..input(0x6000)
        }],
        ..TerminalSettings::default()
    }];
    let outcome = run(&setup, &mut DrivesGone::default());
    let gone = |joint| outcome.events.contains(&Event::Gone(joint));
    assert_eq!(
        [0, 1, 2].map(gone),
        [false, true, true],
        "{:?}",
        outcome.events
    );
    let is_of_terminal = |event: &Event| {
        matches!(
            event,
            Event::TerminalGone(_) | Event::TerminalLeftOp(..) | Event::TerminalsShort
        )
    };
    assert!(
        !outcome.events.iter().any(is_of_terminal),
        "{:?}",
        outcome.events
    );
}
