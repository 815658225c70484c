//! A spindle on a drive in velocity mode: to speed before the first feed, and to rest whatever happens.
//!
//! ```text
//!  drives 0 1 2 ─── coupler 3 ─── outputs 4 ─── spindle 5
//! ```

use crate::machine::{Case, Hands, Outcome, Setup, run};
use glidepath_emulator::{
    ClockKind, DriveSettings as Emulated, InjectedFault, Maps, Segment, SpindleMotor, SyncRecord,
};
use glidepath_ethercat::{
    At, DigitalOutput, Event, Mapping, Signal, SpindleMode, SpindleSettings, TerminalSettings,
};
use glidepath_interpolator::{AnswerSource, MCodeWait};
use glidepath_link::{Command, MachineState, Setpoint, SpindleFlags};

pub(crate) const SPINDLE: usize = 5;
/// As many as 0x60FF and 0x606C have in a revolution.
pub(crate) const COUNTS: f64 = 60_000.0;
const CUT: &str = "G21 G90 G64 P0.02 F3000\nS6000 M3\nG1 X10\nS3000 M4\nG1 X0\nM5\nG1 Y1\nM2\n";
const LONG: &str = "G21 G90 G64 P0.02 F1200\nS6000 M3\nM62 P5\nG1 X50\nM2\n";

fn settings(mode: SpindleMode) -> SpindleSettings {
    SpindleSettings {
        mode,
        units_per_rpm: if mode == SpindleMode::Velocity {
            1.0
        } else {
            COUNTS / 60.0
        },
        is_inverted: mode == SpindleMode::ProfileVelocity,
        max_rpm: 8000.0,
        ramp_rpm_per_s: 10_000.0,
        at_speed_r: 0.02,
        gears: None,
        orientation: None,
        tells_load: false,
        mapping: Mapping::Written,
    }
}

pub(crate) fn setup(mode: SpindleMode) -> Setup {
    let mut setup = Setup::absolute(2_000_000);
    setup.emulated.extend([
        Emulated::terminal("COUPLER", ClockKind::Bits64),
        Emulated::outputs(4),
        Emulated {
            spindle: Some(SpindleMotor {
                counts_per_rev: COUNTS,
                torque_rpm_per_s: 20_000.0,
                coast_t: 4.0,
            }),
            // An inverter has no clock.
            clock: if mode == SpindleMode::CyclicVelocity {
                ClockKind::Bits64
            } else {
                ClockKind::ReceiveTimes
            },
            ..Emulated::default()
        },
    ]);
    setup.terminals = vec![
        TerminalSettings {
            position: 4,
            outputs: vec![DigitalOutput {
                at: At::Object {
                    index: 0x7000,
                    sub: 1,
                },
                from: Signal::Output(5),
                is_inverted: false,
                rest: false,
            }],
            ..TerminalSettings::default()
        },
        TerminalSettings {
            position: SPINDLE,
            spindle: Some(settings(mode)),
            ..TerminalSettings::default()
        },
    ];
    // M3 and M4 are done at speed.
    setup.waits = vec![MCodeWait {
        first: 3,
        last: 4,
        answer: AnswerSource::SpindleAtSpeed,
        within: Some(core::time::Duration::from_secs(10)),
        is_late: false,
    }];
    setup
}

/// What happens in a program.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Upset {
    Nothing,
    Abort,
    /// The bridge is to end.
    End,
    /// The spindle's drive reports a fault, which is reset later.
    Fault(u16),
    Pause,
    /// The operator sets its override.
    Override(f64),
    /// A device is unplugged for a while.
    Unplugged(usize),
    /// A drive of a joint falls out of OP.
    DriveLost,
}

#[derive(Debug)]
struct Cutting {
    program: &'static str,
    upset: Upset,
    asked: u64,
    began: Option<u64>,
    done: Option<u64>,
    /// Speed (rev/min) and flags that were told with each setpoint, by its number.
    told: Vec<(u64, f64, SpindleFlags)>,
    /// Its load as status and feedback had it then.
    loads: Vec<(f64, f64)>,
    fault: Option<String>,
    outputs: Vec<bool>,
    resets: bool,
    again: bool,
    runs: bool,
}

impl Cutting {
    const fn new(program: &'static str, upset: Upset) -> Self {
        Self {
            program,
            upset,
            asked: 0,
            began: None,
            done: None,
            told: Vec::new(),
            loads: Vec::new(),
            fault: None,
            outputs: Vec::new(),
            resets: false,
            again: false,
            runs: false,
        }
    }

    fn happen(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        self.done = Some(hands.tick);
        match self.upset {
            Upset::Nothing => {}
            Upset::Abort => hands.wants.command = Some(Command::Abort),
            Upset::End => hands.wants.end = true,
            Upset::Fault(code) => {
                segment.inject(SPINDLE, InjectedFault::Fault(code), hands.now_ns);
            }
            Upset::Override(ratio) => {
                hands.wants.command = Some(Command::SpindleOverride(ratio));
            }
            Upset::Pause => hands.wants.pause = Some(15),
            Upset::Unplugged(device) => segment.unplug(device..device + 1, true, hands.now_ns),
            Upset::DriveLost => segment.inject(1, InjectedFault::Drop(0x1a), hands.now_ns),
        }
    }
}

impl Case for Cutting {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        if let (Some(said), Some(last)) = (hands.feedback, hands.last) {
            let flags = SpindleFlags(said.spindle_flags);
            self.told.push((last.number, 60.0 * said.spindle_v, flags));
            let status = hands.status.map_or(0.0, |status| status.spindle_load);
            self.loads.push((status, said.spindle_load));
        }
        self.runs = hands.state() == Some(MachineState::Running);
        hands.set_out(&mut self.asked, &mut self.began, self.program);
        let state = hands.state();
        match (state, self.began) {
            (Some(MachineState::Running), Some(_)) if self.done.is_none() => {
                let moves = hands.last.is_some_and(|s| s.position[0] > 3.0);
                if moves && self.upset != Upset::Nothing {
                    self.happen(hands, segment);
                }
            }
            (Some(MachineState::Idle), Some(began))
                if self.upset == Upset::Nothing && hands.tick > began + 50 =>
            {
                hands.wants.end = true;
            }
            _ => {}
        }
        let Some(done) = self.done else {
            assert!(hands.tick < 20_000, "{:?} {:?}", state, hands.events);
            return;
        };
        if let Upset::Unplugged(device) = self.upset
            && hands.tick == done + 300
        {
            segment.unplug(device..device + 1, false, hands.now_ns);
        }
        if hands.tick == done + 500 {
            self.fault = hands.status.and_then(|status| status.fault_text());
            self.outputs.push(segment.outputs(4)[0] & 1 == 1);
            self.resets = matches!(self.upset, Upset::Fault(_));
            hands.wants.command = self.resets.then_some(Command::Reset);
        }
        if hands.tick == done + 550 && self.resets {
            hands.wants.program = Some(self.program);
            self.again = true;
        }
        hands.wants.end |= hands.tick > done + 560 + if self.resets { 600 } else { 0 };
    }

    fn counts(&self) -> bool {
        self.runs
    }
}

/// Speed of the spindle at every step of its drive, rev/min, and whether it had power.
fn speeds(records: &[SyncRecord]) -> Vec<(u64, f64, bool)> {
    let steps = records
        .windows(2)
        .filter(|pair| pair[1].at_ns > pair[0].at_ns + 100_000);
    steps
        .map(|pair| {
            let t = (pair[1].at_ns - pair[0].at_ns) as f64 * 1e-9;
            let counts = pair[1].actual.wrapping_sub(pair[0].actual);
            let rpm = f64::from(counts) / t / COUNTS * 60.0;
            (pair[1].at_ns, rpm, pair[1].status & 0x6f == 0x27)
        })
        .collect()
}

fn spun(setup: &Setup, cutting: &mut Cutting) -> (Outcome, Vec<(u64, f64, bool)>) {
    let mut outcome = run(setup, cutting);
    let records = outcome.left.0.take_axis_records(SPINDLE, 0);
    (outcome, speeds(&records))
}

/// The speed near a time.
fn speed_at(speeds: &[(u64, f64, bool)], at_ns: u64) -> f64 {
    let later = speeds.iter().find(|(at, ..)| *at >= at_ns);
    later.map_or(0.0, |(_, rpm, _)| *rpm)
}

fn moves(setpoint: &Setpoint) -> bool {
    setpoint.velocity.iter().any(|v| v.abs() > 0.0)
}

#[test]
fn a_spindle_is_at_speed_before_the_feed_in_every_mode() {
    for mode in [
        SpindleMode::CyclicVelocity,
        SpindleMode::ProfileVelocity,
        SpindleMode::Velocity,
    ] {
        let setup = setup(mode);
        let mut cutting = Cutting::new(CUT, Upset::Nothing);
        let (outcome, speeds) = spun(&setup, &mut cutting);
        assert_eq!(outcome.allocations, 0, "the bus thread allocates");
        let bad = (
            outcome.counts.lost,
            outcome.counts.short,
            outcome.counts.restarts,
        );
        assert_eq!(bad, (0, 0, 0));
        let sign = if settings(mode).is_inverted {
            -1.0
        } else {
            1.0
        };
        // To X 10 at 6000 rev/min, back at -3000, and along Y at rest or on the way there.
        let x = |s: &&Setpoint| moves(s) && s.velocity[1] == 0.0;
        let mut seen = 0;
        for setpoint in outcome.setpoints.iter().filter(x) {
            let wanted = if setpoint.velocity[0] > 0.0 {
                6000.0
            } else {
                -3000.0
            };
            let rpm = sign * speed_at(&speeds, setpoint.apply_ns + setup.bus.delay_ns);
            assert!(
                (rpm - wanted).abs() < 0.03 * wanted.abs() + 10.0,
                "{mode:?}: {rpm} {wanted}"
            );
            seen += 1;
        }
        assert!(seen > 60, "{seen}");
        // Its speed is told, and led along the ramp: 10 000 rev/min in a second.
        let told = cutting.told.iter().map(|(_, rpm, _)| *rpm);
        let (least, most) = told.fold((0.0_f64, 0.0_f64), |(low, high), rpm| {
            (low.min(rpm), high.max(rpm))
        });
        assert!(
            (most - 6000.0).abs() < 60.0 && (least + 3000.0).abs() < 60.0,
            "{least} {most}"
        );
        for pair in speeds.windows(11) {
            let t = (pair[10].0 - pair[0].0) as f64 * 1e-9;
            let ramp = (pair[10].1 - pair[0].1).abs() / t;
            assert!(ramp < 10_500.0, "{mode:?}: {ramp} rev/min in a second");
        }
        // It loses its power when it stands.
        let last = speeds.iter().rposition(|(.., is_on)| *is_on).unwrap();
        assert!(speeds[last].1.abs() < 45.0, "{:?}", speeds[last]);
        let flags = cutting.told.last().unwrap().2;
        assert!(flags.contains(SpindleFlags::SPEED));
    }
}

#[test]
fn an_abort_stops_it_along_its_ramp() {
    let setup = setup(SpindleMode::CyclicVelocity);
    let mut cutting = Cutting::new(LONG, Upset::Abort);
    let (outcome, speeds) = spun(&setup, &mut cutting);
    assert_eq!(cutting.fault, None);
    let (_, rpm, _) = speeds.last().unwrap();
    assert!(rpm.abs() < 1.0, "{rpm}");
    // It turns as long as the axes move.
    for setpoint in outcome.setpoints.iter().filter(|s| moves(s)) {
        let rpm = speed_at(&speeds, setpoint.apply_ns + setup.bus.delay_ns);
        assert!((rpm - 6000.0).abs() < 200.0, "{rpm}");
    }
    let last = speeds.iter().rposition(|(.., is_on)| *is_on).unwrap();
    assert!(speeds[last].1.abs() < 45.0, "{:?}", speeds[last]);
    // Outputs of programs stay.
    assert_eq!(cutting.outputs, [true]);
}

#[test]
fn it_turns_as_fast_as_the_operator_has_it_unless_a_program_does_not_allow_that() {
    const LOCKED: &str = "G21 G90 G64 P0.02 F1200\nM49\nS6000 M3\nM62 P5\nG1 X50\nM2\n";
    for (program, ratio, wanted) in [
        (LONG, 0.8, 4800.0),
        (LONG, 1.2, 7200.0),
        // As far as the drive goes: 8000 rev/min.
        (LONG, 1.5, 8000.0),
        (LOCKED, 0.8, 6000.0),
        // The machine does not allow it.
        (LONG, 1.6, 6000.0),
    ] {
        let mut setup = setup(SpindleMode::CyclicVelocity);
        setup.spindle_override = [0.5, 1.5];
        let mut cutting = Cutting::new(program, Upset::Override(ratio));
        let (outcome, speeds) = spun(&setup, &mut cutting);
        let mut setpoints = outcome.setpoints.iter();
        let last = setpoints.find(|s| s.position[0] > 30.0).unwrap();
        let rpm = speed_at(&speeds, last.apply_ns + setup.bus.delay_ns);
        assert!((rpm - wanted).abs() < 10.0, "{program} {ratio}: {rpm}");
        for pair in speeds.windows(11) {
            let t = (pair[10].0 - pair[0].0) as f64 * 1e-9;
            assert!((pair[10].1 - pair[0].1).abs() / t < 10_500.0);
        }
        let flags = cutting
            .told
            .iter()
            .rfind(|(number, ..)| *number == last.number);
        assert!(flags.is_some_and(|(.., flags)| flags.contains(SpindleFlags::AT_SPEED)));
    }
}

#[test]
fn its_load_is_told() {
    let mut setup = setup(SpindleMode::CyclicVelocity);
    if let Some(spindle) = &mut setup.terminals[1].spindle {
        spindle.tells_load = true;
    }
    let mut cutting = Cutting::new(CUT, Upset::Nothing);
    let (outcome, _) = spun(&setup, &mut cutting);
    assert_eq!(outcome.allocations, 0);
    // Its ramp takes half of what the motor has; at its speed it takes nothing.
    let most = cutting
        .loads
        .iter()
        .map(|(_, load)| *load)
        .fold(0.0, f64::max);
    assert!((most - 0.5).abs() < 0.02, "{most}");
    let at_speed = cutting.told.iter().zip(&cutting.loads);
    let steady = at_speed.filter(|((.., rpm, flags), _)| {
        assert!(flags.contains(SpindleFlags::LOAD));
        (*rpm - 6000.0).abs() < 1.0
    });
    let least = steady.map(|(_, (_, load))| *load).fold(1.0, f64::min);
    assert!(least < 0.05, "{least}");
    // The status has it from there.
    let seen = cutting
        .loads
        .iter()
        .map(|(status, _)| *status)
        .fold(0.0, f64::max);
    assert!((seen - most).abs() < 0.05, "{seen}");
}

#[test]
fn without_setpoints_and_at_the_end_it_stops_along_its_ramp() {
    for upset in [Upset::Pause, Upset::End] {
        let mut setup = setup(SpindleMode::Velocity);
        // Longer than everything else may take at the end.
        if let (Upset::End, Some(spindle)) = (upset, &mut setup.terminals[1].spindle) {
            spindle.ramp_rpm_per_s = 900.0;
        }
        let mut cutting = Cutting::new(LONG, upset);
        let (_, speeds) = spun(&setup, &mut cutting);
        let last = speeds.iter().rposition(|(.., is_on)| *is_on).unwrap();
        assert!(speeds[last].1.abs() < 45.0, "{upset:?}: {:?}", speeds[last]);
        if upset == Upset::Pause {
            let fault = cutting.fault.unwrap_or_default();
            assert!(
                fault.starts_with("the drives heard no setpoints for 12 ms"),
                "{fault}"
            );
            assert_eq!(cutting.outputs, [false]);
        }
    }
}

#[test]
fn maps_of_its_own_are_kept_with_what_else_is_in_them() {
    let mut setup = setup(SpindleMode::Velocity);
    // A limit of torque, which is not to become none.
    setup.emulated[SPINDLE].maps = Maps::Fixed {
        outputs: vec![0x6072_0010, 0x6040_0010, 0x6042_0010],
        inputs: vec![0x6044_0010, 0x6041_0010],
    };
    if let Some(spindle) = &mut setup.terminals[1].spindle {
        spindle.mapping = Mapping::Kept;
    }
    let mut cutting = Cutting::new(CUT, Upset::Nothing);
    let (outcome, speeds) = spun(&setup, &mut cutting);
    assert_eq!(outcome.allocations, 0);
    let most = speeds.iter().map(|(_, rpm, _)| *rpm).fold(0.0, f64::max);
    assert!((most - 6000.0).abs() < 60.0, "{most}");
    assert!((outcome.setpoints.last().unwrap().position[1] - 1.0).abs() < 1e-3);
}

#[test]
fn it_stops_along_its_ramp_whatever_else_is_lost_and_by_itself_when_it_is() {
    for upset in [
        Upset::Unplugged(4),
        Upset::Unplugged(SPINDLE),
        Upset::DriveLost,
    ] {
        let setup = setup(SpindleMode::ProfileVelocity);
        let mut cutting = Cutting::new(LONG, upset);
        let (outcome, speeds) = spun(&setup, &mut cutting);
        let rpm = speeds.last().unwrap().1;
        assert!(rpm.abs() < 45.0, "{upset:?}: {rpm} {:?}", outcome.events);
        assert!(
            outcome.counts.restarts > 0,
            "{upset:?}: the bus comes up again"
        );
        let fault = cutting.fault.unwrap_or_default();
        let meant = match upset {
            Upset::DriveLost => "a drive reports a fault",
            Upset::Unplugged(4) => {
                "a device on the bus of the drives is lost: the one at position 4"
            }
            _ => "a device on the bus of the drives is lost: the one at position 5",
        };
        assert!(fault.starts_with(meant), "{upset:?}: {fault}");
        if upset != Upset::Unplugged(SPINDLE) {
            let last = speeds.iter().rposition(|(.., is_on)| *is_on).unwrap();
            assert!(speeds[last].1.abs() < 45.0, "{upset:?}: {:?}", speeds[last]);
        }
        assert_eq!(cutting.outputs, [false], "{upset:?}");
    }
}

#[test]
fn a_fault_of_its_drive_stops_the_motion_and_is_reset() {
    let setup = setup(SpindleMode::ProfileVelocity);
    let mut cutting = Cutting::new(LONG, Upset::Fault(0x7305));
    let (outcome, speeds) = spun(&setup, &mut cutting);
    assert!(
        outcome.events.contains(&Event::SpindleFault(0x7305)),
        "{:?}",
        outcome.events
    );
    let fault = cutting.fault.unwrap_or_default();
    assert!(
        fault.starts_with("the drive of the spindle has failed: its number 29445"),
        "{fault}"
    );
    // Clamps hold, and the drives keep their power.
    assert_eq!(cutting.outputs, [true]);
    assert!(!outcome.events.contains(&Event::Off(0)) || cutting.again);
    // The next program has it turn again.
    let last_rpm = speeds.iter().rev().take(1000).map(|(_, rpm, _)| rpm.abs());
    assert!(last_rpm.fold(0.0, f64::max) > 5000.0);
}
