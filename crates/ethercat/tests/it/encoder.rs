//! The spindle's encoder at a terminal: its angle at the time that is told, and counts that are lost.
//!
//! ```text
//!  drives 0 1 2 ─── spindle 3 ─── encoder 4
//! ```

use crate::machine::START_NS;
use crate::machine::{Case, Hands, Setup, run_on};
use crate::wire::{MemoryWire, Quiet, WAY_NS};
use glidepath_emulator::{ClockKind, DriveSettings as Emulated, Encoder, Segment, SpindleMotor};
use glidepath_ethercat::{
    EncoderSettings, Event, Init, Mapping, Settings, SpindleMode, SpindleSettings, TerminalSettings,
};
use glidepath_link::{Command, MachineState, SpindleFlags};

const SPINDLE: usize = 3;
const ENCODER: usize = 4;
const COUNTS_PER_REV: u32 = 4096;
const INDEX_AT: f64 = 0.3;
/// 20 rev/s.
const TURN: &str = "G21 G90 G64 P0.02 F600\nS1200 M3\nG1 X30\nM2\n";

fn setup(period_ns: u64, bits: u32, has_index: bool) -> Setup {
    let mut setup = Setup::absolute(period_ns);
    setup.bus.shift_ns = period_ns * 2 / 5;
    setup.emulated.extend([
        Emulated {
            spindle: Some(SpindleMotor {
                counts_per_rev: 60_000.0,
                torque_rpm_per_s: 20_000.0,
                coast_t: 4.0,
            }),
            clock: ClockKind::ReceiveTimes,
            ..Emulated::default()
        },
        Emulated::encoder(bits),
    ]);
    let spindle = SpindleSettings {
        mode: SpindleMode::Velocity,
        units_per_rpm: 1.0,
        is_inverted: false,
        max_rpm: 8000.0,
        ramp_rpm_per_s: 10_000.0,
        at_speed_r: 0.02,
        gears: None,
        orientation: None,
        tells_load: false,
        mapping: Mapping::Written,
    };
    let encoder = EncoderSettings {
        counts_per_rev: COUNTS_PER_REV,
        has_index,
        is_inverted: false,
        near_r: 0.03,
    };
    setup.terminals = vec![
        TerminalSettings {
            position: SPINDLE,
            spindle: Some(spindle),
            ..TerminalSettings::default()
        },
        TerminalSettings {
            position: ENCODER,
            encoder: Some(encoder),
            ..TerminalSettings::default()
        },
    ];
    setup
}

/// Turns the spindle, and compares what is told of it with where it is.
#[derive(Debug, Default)]
struct Turning {
    began: Option<u64>,
    asked: u64,
    runs: bool,
    slips_at: Option<u64>,
    delay_ns: u64,
    /// How far the angle is from where the spindle was, revolutions, at each look; and the flags.
    off: Vec<f64>,
    flags: Vec<SpindleFlags>,
    pulses: Vec<u64>,
}

impl Case for Turning {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        self.runs = hands.state() == Some(MachineState::Running);
        let seen = (hands.state(), hands.status, hands.feedback, hands.events);
        assert!(hands.tick < 5_000, "{seen:#?}");
        if let Some(began) = self.began {
            let since = hands.tick - began;
            if self.slips_at == Some(since) {
                segment.slip_encoder(ENCODER, 40);
            }
            // At a steady speed.
            if (150..600).contains(&since)
                && let Some(said) = hands.feedback
            {
                let now = segment.revolutions((SPINDLE, 0), hands.now_ns).unwrap();
                // A frame comes to the terminal a way after it was sent.
                let back_ns = hands.now_ns - (said.sample_ns + self.delay_ns + WAY_NS);
                let there = now - 20.0 * back_ns as f64 * 1e-9 - INDEX_AT;
                self.off.push(said.spindle_angle - there);
                self.flags.push(said.spindle());
                self.pulses.push(said.spindle_index_count);
            }
            hands.wants.end = since > 600;
            return;
        }
        if hands.tick.saturating_sub(self.asked) < 30 {
            return;
        }
        self.asked = hands.tick;
        match hands.state() {
            Some(MachineState::Off) => hands.wants.command = Some(Command::Enable),
            Some(MachineState::Idle) => {
                hands.wants.program = Some(TURN);
                self.began = Some(hands.tick);
            }
            _ => {}
        }
    }

    fn counts(&self) -> bool {
        self.runs
    }
}

fn turned(setup: &Setup, slips_at: Option<u64>) -> (Turning, Vec<Event>) {
    let mut segment = Segment::new_at(&setup.emulated, START_NS - 3_000_000_000);
    segment.keep_records();
    segment.add_encoder(Encoder {
        device: ENCODER,
        spindle: (SPINDLE, 0),
        counts_per_rev: f64::from(COUNTS_PER_REV),
        index_at: INDEX_AT,
    });
    let mut turning = Turning {
        slips_at,
        delay_ns: setup.bus.delay_ns,
        ..Turning::default()
    };
    let outcome = run_on(setup, &mut turning, segment, START_NS);
    assert_eq!(outcome.allocations, 0, "the bus thread allocates");
    (turning, outcome.events)
}

#[test]
fn the_angle_is_that_of_the_time_that_is_told_and_whole_at_the_index() {
    for (period_ns, bits) in [(1_000_000, 16), (2_000_000, 32), (4_000_000, 16)] {
        let setup = setup(period_ns, bits, true);
        let (turning, events) = turned(&setup, None);
        assert!(
            !events.iter().any(|e| matches!(e, Event::EncoderSlipped(_))),
            "{events:?}"
        );
        assert!(turning.off.len() > 300);
        // Whole revolutions, to a count that is rounded down, of the counter and of the index.
        for off in &turning.off {
            let counts = (off - off.round()) * f64::from(COUNTS_PER_REV);
            assert!(counts.abs() < 1.5, "bus {period_ns} ns: {counts} counts");
        }
        let flags = turning.flags.last().unwrap();
        assert!(flags.contains(SpindleFlags::ANGLE) && flags.contains(SpindleFlags::INDEX));
        let pulses = turning.pulses.last().unwrap() - turning.pulses[0];
        let ticks = turning.pulses.len() as f64 * 0.004;
        assert!(
            (pulses as f64 - 20.0 * ticks).abs() < 1.5,
            "{pulses} in {ticks} s"
        );
    }
}

#[test]
fn without_an_index_the_angle_is_told_at_once_and_from_anywhere() {
    let (turning, _) = turned(&setup(2_000_000, 16, false), None);
    let first = turning.off[0];
    for off in &turning.off {
        assert!(
            (off - first).abs() * f64::from(COUNTS_PER_REV) < 2.1,
            "{off} {first}"
        );
    }
    let flags = turning.flags.last().unwrap();
    assert!(flags.contains(SpindleFlags::ANGLE) && !flags.contains(SpindleFlags::INDEX));
}

#[test]
fn counts_that_are_lost_are_told_and_the_angle_is_not() {
    let (turning, events) = turned(&setup(2_000_000, 16, true), Some(300));
    let slips: Vec<_> = events
        .iter()
        .filter(|event| matches!(event, Event::EncoderSlipped(_)))
        .collect();
    assert_eq!(slips, [&Event::EncoderSlipped(40)]);
    let silent = turning
        .flags
        .iter()
        .filter(|flags| !flags.contains(SpindleFlags::ANGLE));
    // Half a second, in ticks, and a revolution at most.
    let silent = silent.count();
    assert!((120..160).contains(&silent), "{silent}");
    let off = turning.off.last().unwrap();
    assert!(
        (off - off.round()).abs() * f64::from(COUNTS_PER_REV) < 2.1,
        "{off}"
    );
}

#[test]
fn a_terminal_without_a_counter_is_refused_by_name() {
    let mut setup = setup(2_000_000, 16, true);
    setup.emulated[ENCODER] = Emulated::analog_inputs(2);
    let settings = Settings {
        bus: setup.bus,
        drives: setup.drives,
        drive_inputs: Vec::new(),
        terminals: setup.terminals,
        servo: crate::machine::servo(),
    };
    let mut wire = MemoryWire::new(Segment::new(&setup.emulated), Quiet, 0);
    let pre_op = Init::find(&mut wire).unwrap().into_pre_op().unwrap();
    let told = pre_op.into_safe_op(&settings).unwrap_err().to_string();
    assert!(
        told.contains("device 4") && told.contains("0x6000:12"),
        "{told}"
    );
}
