//! A spindle behind a gearbox: outputs put gears in, inputs say which one is in, and its speed is that of the
//! spindle in each of them.
//!
//! ```text
//!  drives 0 1 2 ─── coupler 3 ─── outputs 4 ─── motor 5 ─── inputs 6
//! ```

use crate::machine::{Case, Hands, Outcome, START_NS, Setup, run_on};
use crate::spindle::{self, SPINDLE};
use core::time::Duration;
use glidepath_emulator::{DriveSettings as Emulated, GearPins, Gearbox, Segment};
use glidepath_ethercat::{
    At, DigitalInput, DigitalOutput, Event, Gear, GearSettings, Signal, SpindleMode, Swing,
    TerminalSettings,
};
use glidepath_interpolator::{AnswerSource, MCodeWait};
use glidepath_link::{Command, MachineState, SpindleFlags};

const INPUTS: usize = 6;
/// Turns of the motor in a turn of the spindle; in the second gear it turns the other way.
const RATIOS: [f64; 2] = [4.0, -0.8];
/// To X 10 at 600 rev/min, to 20 at 3000, back to 10 at -400, along Y while it stands in the second gear.
const PROGRAM: &str = "G21 G90 G64 P0.02 F3000\nS600 M3\nG1 X10\nM42 S3000 M3\nG1 X20\nM41 S400 M4\nG1 X10\nM5\n\
                       M42\nG1 Y1\nM2\n";
const LONG: &str = "G21 G90 G64 P0.02 F1200\nM41 S600 M3\nG1 X30\nM2\n";
/// No word for a gear.
const PLAIN: &str = "G21 G90 G64 P0.02 F1200\nS900 M3\nG1 X30\nM2\n";
const WITHIN_NS: u64 = 3_000_000_000;

fn setup(mode: SpindleMode, swing: Option<Swing>) -> Setup {
    let mut setup = spindle::setup(mode);
    setup.emulated.push(Emulated::inputs(4));
    if let Some(motor) = &mut setup.emulated[SPINDLE].spindle {
        motor.coast_t = 0.5;
    }
    let gear = |nth: usize, max_rpm| Gear {
        ratio: RATIOS[nth].abs(),
        is_inverted: RATIOS[nth] < 0.0,
        max_rpm,
        ramp_rpm_per_s: 4000.0,
        input: 10 + nth,
    };
    if let Some(spindle) = &mut setup.terminals[1].spindle {
        spindle.gears = Some(GearSettings {
            gears: [
                Some(gear(0, 1000.0)),
                Some(gear(1, 6000.0)),
                None,
                None,
                None,
            ],
            swing,
            within_ns: WITHIN_NS,
        });
    }
    let output = |gear: u32| DigitalOutput {
        at: At::Bit(gear),
        from: Signal::SpindleGear(gear),
        is_inverted: false,
        rest: false,
    };
    setup.terminals[0].outputs.extend([output(1), output(2)]);
    let input = |nth: u32| DigitalInput {
        at: At::Bit(nth),
        number: Some(10 + nth as usize),
        home: None,
        limit_low: None,
        limit_high: None,
        is_inverted: false,
    };
    setup.terminals.push(TerminalSettings {
        position: INPUTS,
        inputs: vec![input(0), input(1)],
        ..TerminalSettings::default()
    });
    setup.waits.push(MCodeWait {
        first: 41,
        last: 45,
        answer: AnswerSource::SpindleInGear,
        within: Some(Duration::from_secs(20)),
        is_late: false,
    });
    setup
}

fn gearbox(first: Option<usize>, needs_motion: bool) -> Gearbox {
    let pins = |nth: usize| GearPins {
        ratio: RATIOS[nth],
        output: (4, 1 + nth),
        input: (INPUTS, nth),
    };
    Gearbox {
        spindle: (SPINDLE, 0),
        gears: vec![pins(0), pins(1)],
        first,
        change_ns: 300_000_000,
        most_v: 1.5,
        needs_motion,
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Upset {
    Nothing,
    /// No gear comes in before the operator has reset that.
    Stuck,
    /// The gear comes out while the spindle turns.
    Out,
    /// The operator sets the override.
    Override(f64),
    /// No setpoints come for a while.
    Pause,
}

#[derive(Debug)]
struct Turning {
    program: &'static str,
    upset: Upset,
    asked: u64,
    began: Option<u64>,
    done: Option<u64>,
    /// The place of X, the speed of the spindle, and what was told of it, while axes move, rev/min.
    seen: Vec<([f64; 2], f64, f64)>,
    turned: Option<(u64, f64)>,
    fastest: f64,
    fault: Option<String>,
    /// Flags and outputs at the end.
    flags: SpindleFlags,
    outputs: u8,
    runs: bool,
    resets: u32,
}

impl Turning {
    const fn new(program: &'static str, upset: Upset) -> Self {
        Self {
            program,
            upset,
            asked: 0,
            began: None,
            done: None,
            seen: Vec::new(),
            turned: None,
            fastest: 0.0,
            fault: None,
            flags: SpindleFlags(0),
            outputs: 0,
            runs: false,
            resets: 0,
        }
    }

    /// Looks how fast the spindle turns.
    fn look(&mut self, hands: &Hands<'_>, segment: &Segment) {
        let turned = segment.spindle_revolutions((SPINDLE, 0)).unwrap();
        let (last_ns, before) = self.turned.unwrap_or((hands.now_ns, turned));
        self.turned = Some((hands.now_ns, turned));
        let Some(said) = hands.feedback.filter(|_| hands.now_ns > last_ns) else {
            return;
        };
        (self.flags, self.outputs) = (said.spindle(), segment.outputs(4)[0]);
        let rpm = (turned - before) / (hands.now_ns - last_ns) as f64 * 60e9;
        self.fastest = self.fastest.max(rpm.abs());
        if let Some(last) = hands.last
            && last.velocity.iter().any(|v| v.abs() > 0.0)
        {
            let place = [last.position[0], last.velocity[0]];
            self.seen.push((place, rpm, 60.0 * said.spindle_v));
        }
    }
}

impl Case for Turning {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        self.look(hands, segment);
        self.runs = hands.state() == Some(MachineState::Running);
        let before = self.began;
        hands.set_out(&mut self.asked, &mut self.began, self.program);
        let begins = before.is_none() && self.began.is_some() && self.resets == 0;
        if begins && self.upset == Upset::Stuck {
            segment.stick_gears(true);
        }
        let state = hands.state();
        let Some(began) = self.began else {
            assert!(hands.tick < 5000, "{state:?} {:?}", hands.events);
            return;
        };
        assert!(hands.tick < began + 20_000, "{state:?} {:?}", hands.events);
        let moves = hands.last.is_some_and(|s| s.position[0] > 5.0);
        if self.done.is_none() && moves {
            match self.upset {
                Upset::Out => segment.drop_gears(),
                Upset::Override(ratio) => {
                    hands.wants.command = Some(Command::SpindleOverride(ratio));
                }
                Upset::Pause => hands.wants.pause = Some(20),
                Upset::Nothing | Upset::Stuck => {}
            }
            self.done = (self.upset != Upset::Stuck).then_some(hands.tick);
        }
        match state {
            Some(MachineState::Faulted) if self.resets == 0 => {
                self.resets = 1;
                self.done = Some(hands.tick);
            }
            Some(MachineState::Idle) if hands.tick > began + 50 && self.resets != 1 => {
                hands.wants.end = true;
            }
            _ => {}
        }
        let Some(done) = self.done.filter(|_| self.resets == 1) else {
            return;
        };
        if hands.tick == done + 500 {
            self.fault = hands.status.and_then(|status| status.fault_text());
            segment.stick_gears(false);
            hands.wants.command = Some(Command::Reset);
        }
        if hands.tick == done + 600 {
            // The word puts the gear in again.
            self.resets = 2;
            (self.asked, self.began) = (hands.tick, None);
        }
    }

    fn counts(&self) -> bool {
        self.runs
    }
}

fn turned(setup: &Setup, gearbox: Gearbox, turning: &mut Turning) -> Outcome {
    let mut segment = Segment::new_at(&setup.emulated, START_NS - 3_000_000_000);
    segment.keep_records();
    segment.add_gearbox(gearbox);
    let outcome = run_on(setup, turning, segment, START_NS);
    assert_eq!(outcome.allocations, 0, "the bus thread allocates");
    assert_eq!(outcome.left.0.broken_gears(), 0, "{:?}", outcome.events);
    outcome
}

/// What the spindle has to do where X is.
fn wanted([x, v]: [f64; 2]) -> Option<f64> {
    match (x, v > 0.0) {
        (1.0..9.5, true) => Some(600.0),
        (11.0..19.5, true) => Some(3000.0),
        (11.0..19.5, false) => Some(-400.0),
        _ => None,
    }
}

#[test]
fn gears_are_changed_at_rest_and_the_spindle_turns_as_fast_as_programmed_in_each() {
    let swing = Swing {
        rpm: 30.0,
        way_ns: 200_000_000,
    };
    for (mode, swing) in [
        (SpindleMode::CyclicVelocity, None),
        (SpindleMode::ProfileVelocity, Some(swing)),
        (SpindleMode::Velocity, None),
        (SpindleMode::Velocity, Some(swing)),
    ] {
        let setup = setup(mode, swing);
        let mut turning = Turning::new(PROGRAM, Upset::Nothing);
        let gearbox = gearbox(Some(0), swing.is_some());
        // Its spindle turns the other way where its drive does.
        let sign = if mode == SpindleMode::ProfileVelocity {
            -1.0
        } else {
            1.0
        };
        let outcome = turned(&setup, gearbox, &mut turning);
        let mut seen = [0; 3];
        for (place, rpm, told_rpm) in &turning.seen {
            let Some(wanted) = wanted(*place) else {
                continue;
            };
            seen[usize::from(wanted > 1000.0) + 2 * usize::from(wanted < 0.0)] += 1;
            let near = 0.02 * wanted.abs() + 20.0;
            assert!(
                (sign * rpm - wanted).abs() < near,
                "{mode:?} {place:?}: {rpm} {wanted}"
            );
            assert!(
                (told_rpm - wanted).abs() < near,
                "{mode:?} {place:?}: {told_rpm} {wanted}"
            );
        }
        assert!(
            seen.iter().all(|seen| *seen > 20),
            "{mode:?} {swing:?}: {seen:?}"
        );
        let last = outcome.setpoints.last().unwrap();
        assert!((last.position[1] - 1.0).abs() < 1e-3);
        assert!(turning.flags.contains(SpindleFlags::IN_GEAR));
        // The valve of the second gear is on, and stays so.
        assert_eq!(turning.outputs, 0b100);
        assert!(outcome.events.iter().all(|event| !is_trouble(event)));
    }
}

const fn is_trouble(event: &Event) -> bool {
    matches!(
        event,
        Event::GearNotIn(_) | Event::GearLost(_) | Event::GearUnknown
    )
}

#[test]
fn a_gear_that_does_not_come_in_is_a_fault_and_comes_in_after_a_reset() {
    let setup = setup(SpindleMode::CyclicVelocity, None);
    let mut turning = Turning::new(PROGRAM, Upset::Stuck);
    let outcome = turned(&setup, gearbox(Some(0), false), &mut turning);
    assert!(
        outcome.events.contains(&Event::GearNotIn(2)),
        "{:?}",
        outcome.events
    );
    let fault = turning.fault.expect("a fault");
    assert!(
        fault.starts_with("the gear of the spindle is not in: gear 2 (M42)"),
        "{fault}"
    );
    // The motion waited in front of it, and did the rest in the second life.
    let faulted = outcome.setpoints.iter();
    let faulted = faulted.filter(|s| s.state == MachineState::Faulted.code());
    assert!(faulted.into_iter().all(|s| s.position[0] < 10.001));
    let last = outcome.setpoints.last().unwrap();
    assert!((last.position[1] - 1.0).abs() < 1e-3);
}

#[test]
fn a_gear_that_comes_out_stops_the_motion() {
    let setup = setup(SpindleMode::CyclicVelocity, None);
    let mut turning = Turning::new(LONG, Upset::Out);
    let outcome = turned(&setup, gearbox(Some(0), false), &mut turning);
    assert!(
        outcome.events.contains(&Event::GearLost(1)),
        "{:?}",
        outcome.events
    );
    let fault = turning.fault.expect("a fault");
    assert!(
        fault.starts_with("the gear of the spindle is not in: gear 1 (M41)"),
        "{fault}"
    );
    // M41 puts it in again, and the whole way is gone at its speed.
    let last = outcome.setpoints.last().unwrap();
    assert!((last.position[0] - 30.0).abs() < 1e-3);
}

#[test]
fn a_spindle_whose_gear_nobody_knows_does_not_turn_until_a_word_says_one() {
    let setup = setup(SpindleMode::Velocity, None);
    let mut turning = Turning::new(PLAIN, Upset::Nothing);
    let outcome = turned_until_fault(&setup, &mut turning);
    assert!(
        outcome.events.contains(&Event::GearUnknown),
        "{:?}",
        outcome.events
    );
    assert!(turning.fastest < 1.0, "{}", turning.fastest);
    let fault = turning.fault.expect("a fault");
    assert!(
        fault.starts_with(
            "the gear of the spindle is not in: inputs tell none, and no program has named one"
        ),
        "{fault}"
    );
    let mut turning = Turning::new(LONG, Upset::Nothing);
    turned(&setup, gearbox(None, false), &mut turning);
    assert!(
        (turning.fastest - 600.0).abs() < 30.0,
        "{}",
        turning.fastest
    );
}

/// The same without a gear, until that is a fault.
fn turned_until_fault(setup: &Setup, turning: &mut Turning) -> Outcome {
    struct UntilFault<'t>(&'t mut Turning);
    impl Case for UntilFault<'_> {
        fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
            self.0.tick(hands, segment);
            if hands.state() == Some(MachineState::Faulted) {
                self.0.fault = hands.status.and_then(|status| status.fault_text());
                hands.wants.end |= self.0.fault.is_some();
            }
        }
    }
    let mut segment = Segment::new_at(&setup.emulated, START_NS - 3_000_000_000);
    segment.add_gearbox(gearbox(None, false));
    run_on(setup, &mut UntilFault(turning), segment, START_NS)
}

#[test]
fn the_gear_that_is_in_stays_in_and_its_highest_speed_is_kept() {
    let setup = setup(SpindleMode::CyclicVelocity, None);
    // 900 rev/min in the first gear, which is in at the start, times 1.2: as far as the gear goes.
    let mut turning = Turning::new(PLAIN, Upset::Override(1.2));
    turned(&setup, gearbox(Some(0), false), &mut turning);
    assert_eq!(turning.outputs, 0b010);
    assert!(
        (turning.fastest - 1000.0).abs() < 20.0,
        "{}",
        turning.fastest
    );
    // No valve falls where nobody is to be obeyed.
    let mut turning = Turning::new(LONG, Upset::Pause);
    let outcome = turned(&setup, gearbox(Some(0), false), &mut turning);
    let fault = turning.fault.expect("a fault");
    assert!(
        fault.starts_with("the drives heard no setpoints"),
        "{fault}"
    );
    assert_eq!(turning.outputs, 0b010);
    assert!(outcome.events.iter().all(|event| !is_trouble(event)));
}
