//! The matrix of what goes wrong with drives and whatever the machine does meanwhile.
//!
//! Every cell is a situation, an upset and a moment. A sample of them is in every run; all of them,
//! and more by other seeds:
//!
//! ```text
//! GLIDEPATH_DRIVE_FAULTS=480 cargo test --release -p glidepath-interpolator --lib matrix -- --nocapture
//! ```
//!
//! What must be true of each: the machine comes to rest inside its limits and stays there until
//! somebody asks for motion, with a cause that fits; without power setpoints are where the joints
//! are; no joint with power jumps; and the operator can go on.

use super::bench::{Bench, config, numbers};
use super::homing::SWITCH;
use crate::testing::Numbers;
use glidepath_link::{Command, FaultCause, JogDemand, JogMode, MachineState};
use glidepath_plant::{JointSettings, SwitchSettings, Upset};

/// What the machine does when it goes wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Situation {
    Off,
    Enabling,
    NotHomed,
    Homing,
    Ready,
    Running,
    Holding,
    Held,
    Jogging,
    JoggingUnhomed,
    AwayFromThePath,
    Returning,
}

impl Situation {
    const ALL: [Self; 12] = [
        Self::Off,
        Self::Enabling,
        Self::NotHomed,
        Self::Homing,
        Self::Ready,
        Self::Running,
        Self::Holding,
        Self::Held,
        Self::Jogging,
        Self::JoggingUnhomed,
        Self::AwayFromThePath,
        Self::Returning,
    ];

    /// Whether the first joint has not come home.
    const fn is_before_homing(self) -> bool {
        matches!(self, Self::NotHomed | Self::Homing | Self::JoggingUnhomed)
    }
}

/// What goes wrong, of a joint where it is one of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Wrong {
    EmergencyStop,
    PowerLost,
    DriveFault,
    ShortSilence,
    LongSilence,
    Stuck,
    DeadContact,
    OperatorAborts,
}

impl Wrong {
    const ALL: [Self; 8] = [
        Self::EmergencyStop,
        Self::PowerLost,
        Self::DriveFault,
        Self::ShortSilence,
        Self::LongSilence,
        Self::Stuck,
        Self::DeadContact,
        Self::OperatorAborts,
    ];

    /// What begins it, and what ends it.
    const fn upsets(self, joint: usize) -> Option<(Upset, Upset)> {
        Some(match self {
            Self::EmergencyStop => (Upset::EmergencyStop(true), Upset::EmergencyStop(false)),
            Self::PowerLost => (
                Upset::PowerLost(joint, true),
                Upset::PowerLost(joint, false),
            ),
            Self::DriveFault => (Upset::DriveFault(joint, 9), Upset::DriveFault(joint, 0)),
            Self::ShortSilence | Self::LongSilence => (Upset::Dropout(true), Upset::Dropout(false)),
            Self::Stuck => (Upset::Stuck(joint, true), Upset::Stuck(joint, false)),
            Self::DeadContact => (Upset::Contact(0, Some(false)), Upset::Contact(0, None)),
            Self::OperatorAborts => return None,
        })
    }

    /// Whether a latched cause fits.
    const fn may_cause(self, cause: FaultCause) -> bool {
        matches!(
            (self, cause),
            (Self::EmergencyStop | Self::PowerLost, FaultCause::EnableLost)
                | (Self::DriveFault, FaultCause::Drive | FaultCause::EnableLost)
                | (
                    Self::ShortSilence | Self::LongSilence,
                    FaultCause::FeedbackLost
                )
                | (Self::Stuck, FaultCause::FollowingError)
                // A joint that does not move finds no switch, and no edge.
                | (Self::Stuck | Self::DeadContact, FaultCause::Homing)
        )
    }
}

/// A mill whose first joint is brought home by the controller; its client jogs.
struct Machine {
    bench: Bench,
    demand: JogDemand,
}

impl Machine {
    fn new() -> Self {
        let mut settings = config(false);
        settings.feedback.as_mut().unwrap().joints[0].homing = Some(SWITCH);
        let others = JointSettings::default();
        let first = JointSettings {
            start: 2.0,
            count: 300.0,
            switch: Some(SwitchSettings {
                cam: (-18.0, -10.0),
                bounce_ns: 3_000_000,
            }),
            ..others
        };
        let demand = JogDemand {
            client: 3,
            mask: 0b111,
            mode: JogMode::Continuous.code(),
            ..bytemuck::Zeroable::zeroed()
        };
        Self {
            bench: Bench::new(settings, &[first, others, others]),
            demand,
        }
    }

    /// A key is pressed, or still is.
    fn press(&mut self, velocity: [f64; 3], is_new: bool) {
        self.demand.number += u64::from(is_new);
        self.demand.value[..3].copy_from_slice(&velocity);
        self.demand.sent_ns = self.bench.now_ns();
        self.bench.jog(&self.demand);
    }

    fn let_go(&mut self) {
        self.demand.mode = JogMode::None.code();
        self.press([0.0; 3], true);
        self.demand.mode = JogMode::Continuous.code();
    }

    /// Keeps a key pressed for so many ticks.
    fn jog(&mut self, velocity: [f64; 3], ticks: usize) {
        for tick in 0..ticks {
            self.press(velocity, tick == 0);
            self.bench.tick();
        }
    }

    fn home(&mut self) {
        self.bench.command(Command::Home(1)).unwrap();
        assert!(self.bench.run_to(MachineState::Homing, 3));
        assert!(self.bench.run_to(MachineState::Idle, 4_000));
    }

    /// Brings the machine into a situation; returns what its client keeps pressed.
    fn bring(
        &mut self,
        situation: Situation,
        seed: u64,
        numbers: &mut Numbers,
    ) -> Option<[f64; 3]> {
        use MachineState::{Held, NotHomed, Running};
        let jog = [30.0, -20.0, 10.0];
        let bench = &mut self.bench;
        bench.run(10);
        match situation {
            Situation::Off => return None,
            Situation::Enabling => {
                bench.command(Command::Enable).unwrap();
                bench.run(numbers.whole(0, 30) as usize);
                return None;
            }
            _ => bench.enable(NotHomed),
        }
        bench.run(30);
        match situation {
            Situation::NotHomed => return None,
            Situation::Homing => {
                bench.command(Command::Home(1)).unwrap();
                assert!(bench.run_to(MachineState::Homing, 3));
                bench.run(numbers.whole(0, 330) as usize);
                return None;
            }
            Situation::JoggingUnhomed => {
                self.jog([5.0, -8.0, 3.0], numbers.whole(2, 60) as usize);
                return Some([5.0, -8.0, 3.0]);
            }
            _ => self.home(),
        }
        self.bench.run(30);
        match situation {
            Situation::Ready => return None,
            Situation::Jogging => {
                self.jog(jog, numbers.whole(2, 80) as usize);
                return Some(jog);
            }
            _ => {}
        }
        self.bench.load(seed, 500);
        assert!(self.bench.run_to(Running, 60));
        self.bench.run(numbers.whole(20, 200) as usize);
        if situation == Situation::Running {
            return None;
        }
        self.bench.command(Command::Hold).unwrap();
        if situation == Situation::Holding {
            self.bench.run(numbers.whole(0, 20) as usize);
            return None;
        }
        assert!(self.bench.run_to(Held, 200));
        self.bench.run(5);
        match situation {
            Situation::AwayFromThePath => {
                self.jog(jog, numbers.whole(2, 60) as usize);
                return Some(jog);
            }
            Situation::Returning => {
                self.jog(jog, numbers.whole(10, 60) as usize);
                self.let_go();
                assert!(self.bench.run_to(Held, 200));
                self.bench.command(Command::Return).unwrap();
                self.bench.run(numbers.whole(0, 30) as usize);
            }
            _ => {}
        }
        None
    }
}

/// Something that was found wrong with a cell.
type Checked = Result<(), String>;

fn check(is_right: bool, what: &str) -> Checked {
    if is_right {
        Ok(())
    } else {
        Err(what.to_owned())
    }
}

fn play(situation: Situation, wrong: Wrong, seed: u64) -> Checked {
    let mut numbers = numbers(seed * 7 + 1);
    let mut machine = Machine::new();
    let pressed = machine.bring(situation, seed, &mut numbers);
    let joint = numbers.whole(0, 2) as usize;
    let begun = machine.bench.setpoints.len();
    let upsets = wrong.upsets(joint);
    match upsets {
        Some((begin, _)) => machine.bench.upset(begin),
        None => drop(machine.bench.command(Command::Abort)),
    }
    let lasts = match wrong {
        Wrong::ShortSilence => numbers.whole(1, 12),
        Wrong::LongSilence => numbers.whole(30, 60),
        _ => numbers.whole(20, 90),
    };
    // The key stays pressed the whole time.
    for _ in 0..lasts {
        if let Some(velocity) = pressed {
            machine.press(velocity, false);
        }
        machine.bench.tick();
    }
    never_leads(&machine.bench, wrong, begun)?;
    if let Some((_, end)) = upsets {
        machine.bench.upset(end);
    }
    for _ in 0..60 {
        if let Some(velocity) = pressed {
            machine.press(velocity, false);
        }
        machine.bench.tick();
    }
    comes_to_rest(&mut machine, situation, wrong)?;
    goes_on(&mut machine, situation, seed)
}

/// While no drive has power, setpoints are where the joints are.
fn never_leads(bench: &Bench, wrong: Wrong, begun: usize) -> Checked {
    if wrong != Wrong::EmergencyStop {
        return Ok(());
    }
    let rest = bench.joints();
    // The drives stop where they are at once; three ticks on, setpoints know.
    let late = bench.setpoints.get(begun + 4..).unwrap_or(&[]);
    let leads = late
        .iter()
        .find(|s| s.joint_position != rest || s.joint_velocity != [0.0; 9]);
    check(leads.is_none(), "a setpoint leads drives without power")
}

fn comes_to_rest(machine: &mut Machine, situation: Situation, wrong: Wrong) -> Checked {
    use MachineState::{Faulted, Held, Idle, NotHomed, Off};
    machine.let_go();
    let bench = &mut machine.bench;
    let rests = |s: MachineState| matches!(s, Faulted | Held | Idle | NotHomed | Off);
    // What goes on goes on to its end.
    let is_over = (0..6_000).any(|_| rests(bench.tick().state().unwrap()));
    check(is_over, "it does not come to rest")?;
    bench.feed.clear();
    if bench.state() == Held {
        bench.command(Command::Abort)?;
        check(bench.run_to(Idle, 300), "an abort does not end it")?;
    }
    if situation == Situation::Enabling && bench.state() == Off {
        // It may still be on its way on.
        bench.run(60);
    }
    bench.run(5);
    let rest = bench.joints();
    bench.run(60);
    check(bench.joints() == rest, "it moves and nobody asked")?;
    check(bench.worst_ratio() <= 1.0 + 1e-6, "a limit is broken")?;
    let status = bench.status();
    let cause = status.fault().unwrap();
    let fits = cause.is_none_or(|cause| wrong.may_cause(cause));
    check(fits, &format!("the cause is {cause:?}"))?;
    let must_fault = matches!(
        wrong,
        Wrong::EmergencyStop | Wrong::PowerLost | Wrong::DriveFault
    ) && !matches!(situation, Situation::Off | Situation::Enabling);
    check(cause.is_some() || !must_fault, "nobody is told")
}

/// The operator goes on: takes note, gives power, brings it home, and runs a program.
fn goes_on(machine: &mut Machine, situation: Situation, seed: u64) -> Checked {
    use MachineState::{Faulted, Idle, NotHomed, Off, Running};
    let bench = &mut machine.bench;
    if bench.state() == Faulted {
        bench.command(Command::Reset)?;
        bench.run(3);
    }
    let rest = bench.joints();
    bench.run(40);
    check(bench.joints() == rest, "a reset moves it")?;
    if bench.state() == Off {
        bench.command(Command::Enable)?;
        let on = (0..200).any(|_| matches!(bench.tick().state(), Ok(Idle | NotHomed)));
        check(on, "it has no power any more")?;
        bench.run(20);
        check(bench.joints() == rest, "the hand-over moves it")?;
    }
    let is_homed = bench.state() == Idle;
    let should_be =
        !situation.is_before_homing() && !matches!(situation, Situation::Off | Situation::Enabling);
    check(is_homed || !should_be, "it has forgotten its home")?;
    if !is_homed {
        bench.command(Command::Home(1))?;
        check(bench.run_to(Idle, 6_000), "it does not come home")?;
    }
    bench.load(seed + 1, 50);
    check(bench.run_to(Running, 80), "no program begins")?;
    check(bench.run_to(Idle, 1_500), "a program does not end")?;
    check(bench.worst_ratio() <= 1.0 + 1e-6, "a limit is broken")
}

#[test]
fn whatever_goes_wrong_in_whatever_situation_the_machine_rests_and_can_go_on() {
    let wanted = std::env::var("GLIDEPATH_DRIVE_FAULTS").ok();
    let all = wanted.is_some();
    let count: usize = wanted.map_or(96, |text| text.parse().unwrap());
    let cells = Situation::ALL.len() * Wrong::ALL.len();
    let mut bad = Vec::new();
    for case in 0..count {
        let cell = case % cells;
        let situation = Situation::ALL[cell / Wrong::ALL.len()];
        let wrong = Wrong::ALL[cell % Wrong::ALL.len()];
        if let Err(what) = play(situation, wrong, case as u64) {
            bad.push(format!("case {case}, {situation:?}, {wrong:?}: {what}"));
        }
    }
    if all {
        println!("{count} cases in {cells} cells, {} bad", bad.len());
    }
    assert!(bad.is_empty(), "{bad:#?}");
}

#[test]
fn a_key_that_stays_pressed_moves_nothing_after_an_emergency_stop() {
    for seed in 0..12 {
        let mut numbers = numbers(seed);
        let mut machine = Machine::new();
        machine.bring(Situation::Jogging, seed, &mut numbers);
        machine.bench.upset(Upset::EmergencyStop(true));
        let keep = |machine: &mut Machine, ticks: usize| {
            for _ in 0..ticks {
                machine.press([30.0, 0.0, 0.0], false);
                machine.bench.tick();
            }
        };
        keep(&mut machine, 30);
        let rest = machine.bench.joints();
        machine.bench.upset(Upset::EmergencyStop(false));
        keep(&mut machine, 40);
        machine.bench.command(Command::Reset).unwrap();
        keep(&mut machine, 10);
        machine.bench.command(Command::Enable).unwrap();
        keep(&mut machine, 120);
        assert_eq!(machine.bench.state(), MachineState::Idle);
        assert_eq!(machine.bench.joints(), rest, "{seed}");
        // Let go and pressed again, it moves.
        machine.let_go();
        machine.bench.run(2);
        machine.jog([30.0, 0.0, 0.0], 20);
        assert_eq!(machine.bench.state(), MachineState::Jogging);
    }
}

#[test]
fn an_axis_that_is_not_home_is_slow_and_the_others_keep_their_travel() {
    use crate::config::SoftLimits;
    use glidepath_geometry::AxisVector;
    let mut settings = config(false);
    settings.feedback.as_mut().unwrap().joints[0].homing = Some(SWITCH);
    settings.soft_limits = SoftLimits {
        lowest: AxisVector::repeat(-5.0),
        highest: AxisVector::repeat(5.0),
    };
    // The second joint stands outside of its travel, by 3 mm.
    let outside = JointSettings {
        start: 8.0,
        count: 8.0,
        ..JointSettings::default()
    };
    let others = JointSettings::default();
    let mut machine = Machine {
        bench: Bench::new(settings, &[others, outside, others]),
        ..Machine::new()
    };
    machine.bench.enable(MachineState::NotHomed);
    machine.jog([100.0, 0.0, 0.0], 400);
    machine.let_go();
    assert!(machine.bench.run_to(MachineState::NotHomed, 200));
    let fastest = |bench: &Bench, joint: usize| {
        let speeds = bench
            .setpoints
            .iter()
            .map(|s| s.joint_velocity[joint].abs());
        speeds.fold(0.0, f64::max)
    };
    // A tenth of the axis' speed, and the length of travel from where it began.
    assert!((fastest(&machine.bench, 0) - 20.0).abs() < 1e-9);
    assert!((machine.bench.last().position[0] - 10.0).abs() < 1e-9);
    // Those at home: outwards not at all, inwards to the other end.
    machine.jog([0.0, 50.0, 0.0], 100);
    machine.let_go();
    assert!(machine.bench.run_to(MachineState::NotHomed, 200));
    let at = machine.bench.last().position;
    assert!((at[1] - 8.0).abs() < 1e-9, "{at:?}");
    // Together along a line, which ends where the first of them is at its end.
    machine.jog([0.0, -50.0, 25.0], 250);
    machine.let_go();
    assert!(machine.bench.run_to(MachineState::NotHomed, 200));
    let at = machine.bench.last().position;
    assert!((at[1] + 2.0).abs() < 1e-9 && (at[2] - 5.0).abs() < 1e-9);
    machine.jog([0.0, -50.0, 0.0], 100);
    machine.let_go();
    assert!(machine.bench.run_to(MachineState::NotHomed, 200));
    assert!((machine.bench.last().position[1] + 5.0).abs() < 1e-9);
    assert!(machine.bench.worst_ratio() <= 1.0 + 1e-6);
}
