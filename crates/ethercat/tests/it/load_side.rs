//! Encoders of joints at a terminal, beside those of the drives: where the joint is by them, and what slips.
//!
//! ```text
//!  drives 0 1 2 ─── encoders 3
//! ```

use crate::machine::START_NS;
use crate::machine::{COUNTS, Case, Hands, Outcome, Setup, run_on};
use glidepath_emulator::{
    Channels, ClockKind, DriveSettings as Emulated, InjectedFault, LoadEncoder, Segment,
};
use glidepath_ethercat::{At, BusFault, EncoderUse, Event, JointEncoderSettings, TerminalSettings};
use glidepath_link::{Command, MachineState};

const TERMINAL: usize = 3;
/// Counts of the load a mm.
const LOAD: f64 = 10_000.0;
/// Time constant of the lag of an emulated drive, ns.
const LAG_NS: f64 = 2e6;
const THERE: &str = "G21 G90 G64 P0.02 F3000\nG1 X30\nM2\n";
const BACK: &str = "G21 G90 G64 P0.02 F3000\nG1 X-5\nM2\n";

fn encoder(used: EncoderUse, home_offset: Option<f64>) -> JointEncoderSettings {
    JointEncoderSettings {
        joint: 0,
        at: At::Object {
            index: 0x6010,
            sub: 0x11,
        },
        counts_per_unit: LOAD,
        is_inverted: true,
        home_offset,
        is_unsigned: false,
        used,
        apart: 0.1,
    }
}

/// A machine whose first joint has an encoder of so many bits on its load.
fn setup(period_ns: u64, bits: u32, encoder: JointEncoderSettings) -> Setup {
    on_load(Setup::absolute(period_ns), bits, encoder)
}

fn on_load(mut setup: Setup, bits: u32, encoder: JointEncoderSettings) -> Setup {
    setup.emulated.push(Emulated {
        channels: Some(Channels {
            inputs: vec![vec![0x6000_1120, 0x6010_1100 | bits]],
            ..Channels::default()
        }),
        ..Emulated::terminal("ENCODERS", ClockKind::ReceiveTimes)
    });
    setup.terminals = vec![TerminalSettings {
        position: TERMINAL,
        joint_encoders: vec![encoder],
        ..TerminalSettings::default()
    }];
    setup
}

/// What is done, so many ticks after what was before.
#[derive(Debug, Clone, Copy)]
enum Do {
    /// Power, asked for until it is there.
    Enable,
    Command(Command),
    Program(&'static str),
    /// The load slips by so many mm.
    Slip(f64),
    /// The terminal leaves OP, and the bus is brought up anew once no drive has power.
    Drop,
    /// A drive finds a fault, and the load slips in the same moment.
    FaultAndSlip(f64),
    /// The place of the joint is looked at, and the state.
    Look,
}

#[derive(Debug, Default)]
struct Script {
    steps: Vec<(u64, Do)>,
    nth: usize,
    since: u64,
    runs: bool,
    /// Where feedback says that the joint is, and the state.
    seen: Vec<(f64, Option<MachineState>)>,
    /// The largest following error while it ran, mm.
    behind: f64,
}

impl Case for Script {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        self.runs = hands.state() == Some(MachineState::Running);
        if self.runs
            && let Some(status) = hands.status
        {
            self.behind = self.behind.max(status.following_error[0].abs());
        }
        let seen = (hands.state(), hands.status, hands.feedback, hands.events);
        assert!(hands.tick < 10_000, "{seen:#?}");
        let Some((after, what)) = self.steps.get(self.nth).copied() else {
            hands.wants.end = true;
            return;
        };
        if hands.tick < self.since + after {
            return;
        }
        self.since = hands.tick;
        if matches!(what, Do::Enable) && hands.state() == Some(MachineState::Off) {
            hands.wants.command = Some(Command::Enable);
            return;
        }
        self.nth += 1;
        match what {
            Do::Enable => {}
            Do::Command(command) => hands.wants.command = Some(command),
            Do::Program(text) => hands.wants.program = Some(text),
            Do::Slip(by) => segment.slip_load(TERMINAL, -by * LOAD),
            Do::Drop => segment.inject(TERMINAL, InjectedFault::Drop(0x1b), hands.now_ns),
            Do::FaultAndSlip(by) => {
                segment.inject(0, InjectedFault::Fault(0x8611), hands.now_ns);
                segment.slip_load(TERMINAL, -by * LOAD);
            }
            Do::Look => {
                let place = hands.feedback.map_or(f64::NAN, |said| said.position[0]);
                self.seen.push((place, hands.state()));
            }
        }
    }

    fn counts(&self) -> bool {
        self.runs
    }
}

fn played(setup: &Setup, offset: f64, steps: &[(u64, Do)]) -> (Script, Outcome) {
    let mut segment = Segment::new_at(&setup.emulated, START_NS - 3_000_000_000);
    segment.keep_records();
    segment.add_load_encoder(LoadEncoder {
        device: TERMINAL,
        counter: (0x6010, 0x11),
        drive: (0, 0),
        ratio: -LOAD / COUNTS,
        offset,
    });
    let mut script = Script {
        steps: steps.to_vec(),
        ..Script::default()
    };
    let outcome = run_on(setup, &mut script, segment, START_NS);
    assert_eq!(outcome.allocations, 0, "the bus thread allocates");
    (script, outcome)
}

fn troubles(outcome: &Outcome) -> Vec<BusFault> {
    let of = |event: &Event| match event {
        Event::Trouble(fault) => Some(*fault),
        _ => None,
    };
    outcome.events.iter().filter_map(of).collect()
}

/// What was told of a load that slipped without power.
fn slipped_loads(outcome: &Outcome) -> Vec<(f64, bool)> {
    let of = |event: &Event| match event {
        Event::LoadSlipped(0, by, is_doubted) => Some((*by, *is_doubted)),
        _ => None,
    };
    outcome.events.iter().filter_map(of).collect()
}

fn times_on(outcome: &Outcome) -> usize {
    let is_it = |event: &&Event| matches!(event, Event::Follows(_));
    outcome.events.iter().filter(is_it).count()
}

const ENABLE: (u64, Do) = (30, Do::Enable);
const RUN: (u64, Do) = (60, Do::Program(THERE));
const LOOK: (u64, Do) = (600, Do::Look);

fn assert_at(seen: (f64, Option<MachineState>), place: f64, state: MachineState) {
    assert!((seen.0 - place).abs() < 2.1 / LOAD, "{seen:?}, {place}");
    assert_eq!(seen.1, Some(state), "{seen:?}");
}

#[test]
fn a_joint_is_where_its_own_encoder_says_also_after_it_slipped_without_power() {
    for (period_ns, bits) in [(1_000_000, 16), (2_000_000, 32), (4_000_000, 64)] {
        let setup = setup(period_ns, bits, encoder(EncoderUse::Position, None));
        let off = [ENABLE, RUN, LOOK, (10, Do::Command(Command::Disable))];
        // As by a hand: 0.05 mm in a tick.
        let slips = [(1, Do::Slip(0.05)); 50];
        let on = [(60, Do::Look), ENABLE, (60, Do::Program(BACK)), LOOK];
        let steps = [&off[..], &[(60, Do::Slip(0.0))], &slips, &on].concat();
        let (script, outcome) = played(&setup, 77_777.0, &steps);
        assert_eq!(troubles(&outcome), [], "{:?}", outcome.events);
        let [there, slipped, back] = script.seen[..] else {
            panic!("{:?}", script.seen);
        };
        assert_at(there, 30.0, MachineState::Idle);
        assert_at(slipped, 32.5, MachineState::Off);
        let [(by, false)] = slipped_loads(&outcome)[..] else {
            panic!("{:?}", outcome.events);
        };
        assert!((0.1..0.2).contains(&by), "{by}");
        assert_at(back, -5.0, MachineState::Idle);
        // The motor has gone as far as the joint, and stands where that slipped to.
        let motor = outcome.records[0].last().unwrap().actual;
        assert!((f64::from(motor) / COUNTS + 7.5).abs() < 1e-3, "{motor}");
        // What the lag of the drive makes of 50 mm/s, sampled once a period. A millisecond more or less in the time of
        // the encoder would be 0.05 mm.
        let (period_t, left) = (
            period_ns as f64 * 1e-9,
            (-(period_ns as f64) / LAG_NS).exp(),
        );
        let behind = 50.0 * period_t * left / (1.0 - left);
        let off = script.behind - behind;
        assert!(off.abs() < 0.005, "{} {behind}", script.behind);
    }
}

#[test]
fn an_absolute_encoder_says_where_the_joint_is_from_the_start() {
    let setup = setup(2_000_000, 32, encoder(EncoderUse::Position, Some(4.0)));
    // 12.5 mm where the motor is at zero.
    let steps = [(300, Do::Look), ENABLE, RUN, LOOK];
    let (script, outcome) = played(&setup, -8.5 * LOAD, &steps);
    assert_eq!(troubles(&outcome), []);
    assert_at(script.seen[0], 12.5, MachineState::Off);
    assert_at(script.seen[1], 30.0, MachineState::Idle);
    let motor = outcome.records[0].last().unwrap().actual;
    assert!((f64::from(motor) / COUNTS - 17.5).abs() < 1e-3, "{motor}");
}

#[test]
fn what_slips_under_power_stops_the_machine() {
    let again = [
        (400, Do::Look),
        (10, Do::Command(Command::Reset)),
        (60, Do::Look),
        (30, Do::Command(Command::Enable)),
        (200, Do::Look),
    ];
    let slip = [ENABLE, RUN, (40, Do::Slip(-0.2))];
    let steps = [&slip[..], &again[..]].concat();
    for (used, stays) in [(EncoderUse::Position, false), (EncoderUse::Watch, true)] {
        let (script, outcome) = played(&setup(2_000_000, 32, encoder(used, None)), 0.0, &steps);
        let found = troubles(&outcome);
        let is_it = |fault: &BusFault| matches!(fault, BusFault::EncodersApart(0, by, told) if (by + 0.2).abs() < 0.05 && *told == stays);
        assert!(found.iter().all(is_it), "{found:?}");
        assert_eq!(found.len(), if stays { 2 } else { 1 }, "{found:?}");
        let states: Vec<_> = script.seen.iter().map(|seen| seen.1.unwrap()).collect();
        let end = if stays {
            MachineState::Off
        } else {
            MachineState::Idle
        };
        assert_eq!(states, [MachineState::Faulted, MachineState::Off, end]);
        // The joint is where the load is, if that is who says it.
        let motor = outcome.records[0].last().unwrap().actual;
        let by = script.seen[2].0 - f64::from(motor) / COUNTS;
        let slipped = if stays { 0.0 } else { -0.2 };
        assert!((by - slipped).abs() < 2.1 / LOAD, "{by}");
    }
}

#[test]
fn no_drive_gets_power_after_a_slip_that_nobody_can_judge_nor_by_a_bus_that_is_brought_up_anew() {
    let on_again = [
        (400, Do::Command(Command::Reset)),
        (60, Do::Look),
        (30, Do::Command(Command::Enable)),
        (200, Do::Look),
    ];
    let slip = [ENABLE, RUN, (40, Do::Slip(-0.2))];
    let drop = [(400, Do::Command(Command::Reset)), (60, Do::Drop)];
    for steps in [
        [&slip[..], &on_again[..]].concat(),
        [&slip[..], &drop, &on_again].concat(),
        [
            &[ENABLE, (60, Do::Command(Command::Disable))][..],
            &[(60, Do::Slip(0.2)), (60, Do::Drop)],
            &on_again,
        ]
        .concat(),
        [
            &[ENABLE, RUN, (40, Do::FaultAndSlip(0.2))][..],
            &drop,
            &on_again,
        ]
        .concat(),
    ] {
        let setup = setup(2_000_000, 32, encoder(EncoderUse::Watch, None));
        let (script, outcome) = played(&setup, 0.0, &steps);
        let last = troubles(&outcome).pop();
        let is_it = |fault: &BusFault| matches!(fault, BusFault::EncodersApart(0, by, true) if (by.abs() - 0.2).abs() < 0.05);
        assert!(
            last.as_ref().is_some_and(is_it),
            "{steps:?}: {:?}",
            outcome.events
        );
        let states: Vec<_> = script.seen.iter().map(|seen| seen.1.unwrap()).collect();
        assert_eq!(states, [MachineState::Off; 2], "{:?}", outcome.events);
        assert_eq!(times_on(&outcome), 3, "{:?}", outcome.events);
        if steps.iter().any(|(_, what)| matches!(what, Do::Drop)) {
            let is_up = |event: &&Event| **event == Event::InOperation;
            assert_eq!(outcome.events.iter().filter(is_up).count(), 2);
        }
    }
}

#[test]
fn where_a_load_has_slipped_to_it_is_also_after_the_bus_was_brought_up_anew() {
    let slip = [
        ENABLE,
        RUN,
        (40, Do::Slip(-0.2)),
        (400, Do::Command(Command::Reset)),
    ];
    let on_again = [
        (60, Do::Look),
        (1, Do::Drop),
        (400, Do::Command(Command::Reset)),
        (60, Do::Look),
        ENABLE,
        (60, Do::Program(BACK)),
        LOOK,
    ];
    let steps = [&slip[..], &on_again].concat();
    let setup = setup(2_000_000, 32, encoder(EncoderUse::Position, None));
    let (script, outcome) = played(&setup, 0.0, &steps);
    let [before, after, back] = script.seen[..] else {
        panic!("{:?}", script.seen);
    };
    assert_at(after, before.0, MachineState::Off);
    assert_at(back, -5.0, MachineState::Idle);
    let motor = outcome.records[0].last().unwrap().actual;
    assert!((f64::from(motor) / COUNTS + 4.8).abs() < 1e-3, "{motor}");
}

#[test]
fn a_counter_that_jumps_without_power_is_not_believed() {
    let steps = [
        ENABLE,
        (60, Do::Command(Command::Disable)),
        (60, Do::Slip(20.0)),
        (60, Do::Command(Command::Enable)),
        (200, Do::Look),
    ];
    for home_offset in [None, Some(0.0)] {
        let setup = setup(2_000_000, 32, encoder(EncoderUse::Position, home_offset));
        let (script, outcome) = played(&setup, 0.0, &steps);
        let [(by, true)] = slipped_loads(&outcome)[..] else {
            panic!("{:?}", outcome.events);
        };
        // It is told with the first sample that is off, which may be between two frames.
        assert!((1.0..20.1).contains(&by), "{by}");
        let found = troubles(&outcome);
        assert!(
            matches!(found[..], [BusFault::EncodersApart(0, by, true)] if (by - 20.0).abs() < 1e-3),
            "{found:?}"
        );
        assert_eq!(script.seen[0].1, Some(MachineState::Off));
        assert_eq!(times_on(&outcome), 3);
    }
}

#[test]
fn what_slips_in_the_moment_of_a_fault_is_told() {
    let steps = [ENABLE, RUN, (40, Do::FaultAndSlip(0.2)), (400, Do::Look)];
    let setup = setup(2_000_000, 32, encoder(EncoderUse::Position, None));
    let (_, outcome) = played(&setup, 0.0, &steps);
    let told = slipped_loads(&outcome);
    assert!(
        matches!(told[..], [(by, _)] if (by - 0.2).abs() < 0.05),
        "{:?}",
        outcome.events
    );
}

#[test]
fn what_is_less_than_apart_is_watched_and_nothing_else() {
    let setup = setup(2_000_000, 32, encoder(EncoderUse::Watch, None));
    let steps = [ENABLE, RUN, (40, Do::Slip(0.09)), LOOK];
    let (script, outcome) = played(&setup, 5.0, &steps);
    assert_eq!(troubles(&outcome), []);
    assert_at(script.seen[0], 30.0, MachineState::Idle);
}

#[test]
fn where_the_drive_finds_its_home_the_encoder_begins_anew() {
    for used in [EncoderUse::Position, EncoderUse::Watch] {
        let setup = on_load(Setup::homing(2_000_000), 32, encoder(used, None));
        let home = Command::Home(7);
        let steps = [ENABLE, (60, Do::Command(home)), (1500, Do::Look), RUN, LOOK];
        let (script, outcome) = played(&setup, 1234.0, &steps);
        assert_eq!(troubles(&outcome), [], "{:?}", outcome.events);
        assert_at(script.seen[0], 0.0, MachineState::Idle);
        assert_at(script.seen[1], 30.0, MachineState::Idle);
    }
}

#[test]
fn a_home_that_the_drive_has_found_does_not_hold_after_a_slip() {
    for (slips, state) in [(1, MachineState::Idle), (4, MachineState::NotHomed)] {
        let setup = on_load(
            Setup::homing(2_000_000),
            32,
            encoder(EncoderUse::Position, None),
        );
        let home = (60, Do::Command(Command::Home(7)));
        let off = [
            ENABLE,
            home,
            (1500, Do::Command(Command::Disable)),
            (60, Do::Slip(0.0)),
        ];
        let slips = vec![(1, Do::Slip(0.05)); slips];
        let steps = [&off[..], &slips, &[ENABLE, (60, Do::Look)]].concat();
        let (script, outcome) = played(&setup, 1234.0, &steps);
        assert_eq!(script.seen[0].1, Some(state), "{:?}", outcome.events);
    }
}
