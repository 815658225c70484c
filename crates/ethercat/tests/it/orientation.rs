//! A spindle on a drive in cyclic velocity that is turned to an angle and held there (M19 R).
//!
//! ```text
//!  drives 0 1 2 ─── coupler 3 ─── outputs 4 ─── spindle 5
//! ```

use crate::machine::{Case, Hands, Outcome, Setup, run};
use crate::spindle::{self, SPINDLE};
use core::time::Duration;
use glidepath_emulator::{InjectedFault, Segment, SyncRecord};
use glidepath_ethercat::{OrientationSettings, SpindleMode};
use glidepath_interpolator::{AnswerSource, MCodeWait};
use glidepath_link::{Command, MachineState, Setpoint, SpindleFlags};

const TURN: i32 = 1 << 16;
const ZERO_DEG: f64 = 37.5;
const WINDOW_DEG: f64 = 0.1;
/// To X 5 while it turns, to 10 at 90°, to 15 at 45°, to 20 while it turns again, back at 300°.
const PROGRAM: &str = "G21 G90 G64 P0.02 F3000\nS3000 M3\nG1 X5\nM19 R90\nG1 X10\nM19 R45 P1\nG1 X15\nM4\nG1 X20\n\
                       M19 R300 P2 Q8\nM6\nG1 X15\nM5\nG1 Y1\nM2\n";

fn setup(is_inverted: bool) -> Setup {
    let mut setup = spindle::setup(SpindleMode::CyclicVelocity);
    if let Some(settings) = &mut setup.terminals[1].spindle {
        settings.units_per_rpm = f64::from(TURN) / 60.0;
        settings.is_inverted = is_inverted;
        settings.orientation = Some(OrientationSettings {
            counts_per_rev: 1 << 16,
            zero_deg: ZERO_DEG,
            max_rpm: 120.0,
            window_deg: WINDOW_DEG,
        });
    }
    let emulated = &mut setup.emulated[SPINDLE];
    // Its counter goes round in the first turns.
    emulated.start_counts = vec![i32::MAX - 100_000];
    if let Some(motor) = &mut emulated.spindle {
        motor.counts_per_rev = f64::from(TURN);
    }
    setup.waits.push(MCodeWait {
        first: 19,
        last: 19,
        answer: AnswerSource::SpindleOriented,
        within: Some(Duration::from_secs(10)),
        is_late: false,
    });
    setup
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Upset {
    Nothing,
    /// The spindle does not move any more, when it is on its way to the second angle.
    Stuck,
    /// An abort while it is held.
    Abort,
    /// Its drive fails while it is held.
    Fault,
}

#[derive(Debug)]
struct Orienting {
    program: &'static str,
    upset: Upset,
    began: Option<u64>,
    done: Option<u64>,
    asked: u64,
    ends: bool,
    fault: Option<String>,
    flags: Vec<SpindleFlags>,
}

impl Case for Orienting {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        if let Some(said) = hands.feedback {
            self.flags.push(SpindleFlags(said.spindle_flags));
        }
        hands.set_out(&mut self.asked, &mut self.began, self.program);
        let state = hands.state();
        match (state, self.began) {
            (_, Some(_))
                if self.done.is_none()
                    && self.upset != Upset::Nothing
                    && hands.last.is_some_and(|s| s.position[0] > 6.0) =>
            {
                self.done = Some(hands.tick);
                match self.upset {
                    Upset::Abort => hands.wants.command = Some(Command::Abort),
                    Upset::Fault => {
                        segment.inject(SPINDLE, InjectedFault::Fault(0x7305), hands.now_ns);
                    }
                    _ => segment.inject(SPINDLE, InjectedFault::Stuck(true), hands.now_ns),
                }
            }
            (Some(MachineState::Idle), Some(began)) if hands.tick > began + 50 => {
                hands.wants.end = true;
            }
            _ => {}
        }
        // At the end the drives lose their power.
        self.ends |= hands.wants.end;
        if let Some(fault) = hands.status.and_then(|status| status.fault_text())
            && !self.ends
        {
            self.fault.get_or_insert(fault);
        }
        if let Some(done) = self.done {
            hands.wants.end |= hands.tick > done + 1500;
        }
        assert!(hands.tick < 20_000, "{state:?} {:?}", hands.events);
    }
}

fn oriented(
    setup: &Setup,
    program: &'static str,
    upset: Upset,
) -> (Outcome, Orienting, Vec<SyncRecord>) {
    let mut case = Orienting {
        program,
        upset,
        began: None,
        done: None,
        asked: 0,
        ends: false,
        fault: None,
        flags: Vec::new(),
    };
    let mut outcome = run(setup, &mut case);
    let records = outcome.left.0.take_axis_records(SPINDLE, 0);
    (outcome, case, records)
}

/// How far the spindle is from an angle, degrees, by what its drive counts.
fn off_deg(counts: i32, deg: f64, is_inverted: bool) -> f64 {
    let counted = 360.0 * f64::from(counts.rem_euclid(TURN)) / f64::from(TURN) - ZERO_DEG;
    let angle = if is_inverted { -counted } else { counted };
    (angle - deg + 180.0).rem_euclid(360.0) - 180.0
}

fn is_powered(record: &SyncRecord) -> bool {
    record.status & 0x6f == 0x27
}

fn moves(setpoint: &Setpoint) -> bool {
    setpoint.velocity.iter().any(|v| v.abs() > 0.0)
}

#[test]
fn a_program_goes_on_when_the_spindle_stands_at_its_angle_and_it_is_held_there() {
    for is_inverted in [false, true] {
        let setup = setup(is_inverted);
        let (outcome, case, records) = oriented(&setup, PROGRAM, Upset::Nothing);
        assert_eq!(case.fault, None);
        assert_eq!(outcome.allocations, 0, "the bus thread allocates");
        let wrapped = records
            .windows(2)
            .any(|two| two[0].actual > 0 && two[1].actual < 0);
        assert!(wrapped || is_inverted, "the counter goes round");
        let mut seen = [0; 3];
        let mut back = false;
        for setpoint in outcome.setpoints.iter().filter(|s| moves(s)) {
            let (x, v) = (setpoint.position[0], setpoint.velocity[0]);
            back |= v < -1.0;
            let (nth, deg) = match x {
                x if back && v < 0.0 && x < 20.0 => (2, 300.0),
                x if !back && x > 5.0 && x < 10.0 => (0, 90.0),
                x if !back && x > 10.0 && x < 15.0 => (1, 45.0),
                _ => continue,
            };
            let at_ns = setpoint.apply_ns + setup.bus.delay_ns;
            let record = records.iter().find(|record| record.at_ns >= at_ns).unwrap();
            let off = off_deg(record.actual, deg, is_inverted);
            assert!(
                off.abs() <= WINDOW_DEG && is_powered(record),
                "{x} {off} {is_inverted}"
            );
            seen[nth] += 1;
        }
        assert!(seen.iter().all(|seen| *seen > 10), "{seen:?}");
        // At 5 mm it turned, and no speed was beyond what it was to be, in either mode.
        let most = records.windows(2).map(|two| {
            let t = (two[1].at_ns - two[0].at_ns).max(1_000_000) as f64 * 1e-9;
            f64::from(two[1].actual.wrapping_sub(two[0].actual)).abs() / t
        });
        let most_rpm = most.fold(0.0, f64::max) / f64::from(TURN) * 60.0;
        assert!((2900.0..3100.0).contains(&most_rpm), "{most_rpm}");
        assert!(
            case.flags
                .iter()
                .any(|flags| flags.contains(SpindleFlags::ORIENTED))
        );
        assert!(!records.last().is_some_and(is_powered), "M5 lets it go");
    }
}

#[test]
fn one_that_does_not_come_to_its_angle_stops_the_program_in_the_time_of_q() {
    let setup = setup(false);
    let text = "G21 G90 G64 P0.02 F3000\nM19 R90\nG1 X10\nM19 R45 Q1\nG1 X15\nM2\n";
    let (outcome, case, _) = oriented(&setup, text, Upset::Stuck);
    let fault = case.fault.expect("a fault");
    assert_eq!(fault, "an event was not acknowledged in time, line 4");
    let farthest = outcome.setpoints.iter().map(|s| s.position[0]);
    assert!((farthest.fold(0.0, f64::max) - 10.0).abs() < 1e-9);
    // Not in the time of the machine, which is ten seconds.
    let first = |is_it: &dyn Fn(&Setpoint) -> bool| {
        outcome
            .setpoints
            .iter()
            .find(|s| is_it(s))
            .map(|s| s.scheduled_ns)
            .unwrap()
    };
    let from = first(&|s| s.position[0] > 9.999 && s.state == MachineState::Awaiting.code());
    let to = first(&|s| s.state == MachineState::Faulted.code());
    assert!(
        (990_000_000..1_050_000_000).contains(&(to - from)),
        "{}",
        to - from
    );
}

#[test]
fn an_abort_and_a_fault_of_its_drive_end_the_hold() {
    let setup = setup(false);
    let (_, case, records) = oriented(&setup, PROGRAM, Upset::Abort);
    assert_eq!(case.fault, None);
    assert!(!records.last().is_some_and(is_powered));
    let (outcome, case, records) = oriented(&setup, PROGRAM, Upset::Fault);
    let fault = case.fault.expect("a fault");
    assert!(
        fault.starts_with("the drive of the spindle has failed"),
        "{fault}"
    );
    assert!(!records.last().is_some_and(is_powered));
    assert!(outcome.setpoints.last().is_some_and(|s| !moves(s)));
}
