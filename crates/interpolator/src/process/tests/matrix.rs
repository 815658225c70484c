//! The matrix of what goes wrong with drives and whatever the machine does meanwhile.
//!
//! Every cell is a situation, something that goes wrong, and a moment. Each is in every run once; more of
//! them, at other moments:
//!
//! ```text
//! GLIDEPATH_DRIVE_FAULTS=960 cargo test --release -p glidepath-interpolator --lib matrix -- --nocapture
//! ```
//!
//! What must be true of each: the machine comes to rest inside its limits and stays there until
//! somebody asks for motion, with a cause that fits; without power setpoints are where the joints
//! are; no joint with power jumps; and the operator can go on.

use super::bench::{Bench, numbers};
use super::client::Machine;
use crate::testing::Numbers;
use glidepath_link::{Command, EventId, FaultCause, MachineState};
use glidepath_plant::InjectedFault;

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
    ToATool,
    Awaiting,
    WayBack,
    OnwardAgain,
}

impl Situation {
    const ALL: [Self; 16] = [
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
        Self::ToATool,
        Self::Awaiting,
        Self::WayBack,
        Self::OnwardAgain,
    ];

    /// Whether a tool change is waited for, or will be.
    const fn has_m_code_wait(self) -> bool {
        matches!(self, Self::ToATool | Self::Awaiting)
    }

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
    LateAnswer,
    NoAnswer,
    FailedAnswer,
    StrayAnswers,
}

impl Wrong {
    const ALL: [Self; 12] = [
        Self::EmergencyStop,
        Self::PowerLost,
        Self::DriveFault,
        Self::ShortSilence,
        Self::LongSilence,
        Self::Stuck,
        Self::DeadContact,
        Self::OperatorAborts,
        Self::LateAnswer,
        Self::NoAnswer,
        Self::FailedAnswer,
        Self::StrayAnswers,
    ];

    /// What begins it, and what ends it.
    const fn upsets(self, joint: usize) -> Option<(InjectedFault, InjectedFault)> {
        Some(match self {
            Self::EmergencyStop => (
                InjectedFault::EmergencyStop(true),
                InjectedFault::EmergencyStop(false),
            ),
            Self::PowerLost => (
                InjectedFault::PowerLost(joint, true),
                InjectedFault::PowerLost(joint, false),
            ),
            Self::DriveFault => (
                InjectedFault::DriveFault(joint, 9),
                InjectedFault::DriveFault(joint, 0),
            ),
            Self::ShortSilence | Self::LongSilence => {
                (InjectedFault::Dropout(true), InjectedFault::Dropout(false))
            }
            Self::Stuck => (
                InjectedFault::Stuck(joint, true),
                InjectedFault::Stuck(joint, false),
            ),
            Self::DeadContact => (
                InjectedFault::Contact(0, Some(false)),
                InjectedFault::Contact(0, None),
            ),
            Self::OperatorAborts
            | Self::LateAnswer
            | Self::NoAnswer
            | Self::FailedAnswer
            | Self::StrayAnswers => return None,
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
                | (Self::NoAnswer, FaultCause::AuxTimeout)
                | (Self::FailedAnswer, FaultCause::AuxFailed)
        )
    }

    /// What somebody answers in the end, if anybody does.
    const fn answer(self) -> Option<bool> {
        match self {
            Self::NoAnswer => None,
            Self::FailedAnswer => Some(false),
            _ => Some(true),
        }
    }

    /// It begins.
    fn begin(self, bench: &mut Bench, joint: usize) -> Checked {
        if let Some((begin, _)) = self.upsets(joint) {
            bench.inject(begin);
            return Ok(());
        }
        match self {
            Self::OperatorAborts => drop(bench.command(Command::Abort)),
            Self::FailedAnswer => answer(bench, false)?,
            Self::StrayAnswers => {
                let awaited = bench.last_awaited();
                answer(bench, true)?;
                stray_answers(bench, awaited)?;
            }
            _ => {}
        }
        Ok(())
    }
}

impl Machine {
    /// Brings the machine into a situation; returns what its client keeps pressed.
    fn bring(
        &mut self,
        situation: Situation,
        seed: u64,
        numbers: &mut Numbers,
    ) -> Option<[f64; 3]> {
        use MachineState::{Awaiting, Held, NotHomed, Running};
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
        if situation.has_m_code_wait() {
            self.bench.load_codes(seed, 120, &[8, 6, 9]);
        } else {
            self.bench.load(seed, 500);
        }
        assert!(self.bench.run_to(Running, 60));
        if situation == Situation::Awaiting {
            assert!(self.bench.run_to(Awaiting, 2_000));
        }
        let most = if situation.has_m_code_wait() { 90 } else { 200 };
        self.bench.run(numbers.whole(20, most) as usize);
        if situation.has_m_code_wait() {
            return None;
        }
        if matches!(situation, Situation::WayBack | Situation::OnwardAgain) {
            self.turn(situation, numbers);
            return None;
        }
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

impl Machine {
    /// Turns the motion round, and perhaps again.
    fn turn(&mut self, situation: Situation, numbers: &mut Numbers) {
        self.bench.command(Command::Reverse).unwrap();
        self.bench.run(numbers.whole(0, 60) as usize);
        if situation == Situation::OnwardAgain {
            self.bench.command(Command::Forward).unwrap();
            self.bench.run(numbers.whole(0, 60) as usize);
        }
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
    wrong.begin(&mut machine.bench, joint)?;
    let lasts = match wrong {
        Wrong::ShortSilence => numbers.whole(1, 12),
        Wrong::LongSilence => numbers.whole(30, 60),
        _ => numbers.whole(20, 90),
    };
    // The key stays pressed the whole time.
    machine.run(lasts as usize, pressed);
    never_leads(&machine.bench, wrong, begun)?;
    if let Some((_, end)) = wrong.upsets(joint) {
        machine.bench.inject(end);
    }
    machine.run(60, pressed);
    comes_to_rest(&mut machine, situation, wrong)?;
    goes_on(&mut machine, situation, seed)
}

/// Answers what is awaited, if anything is.
fn answer(bench: &mut Bench, done: bool) -> Checked {
    match bench.last_awaited() {
        Some(event) => bench.command(Command::Acknowledge { event, done }),
        None => Ok(()),
    }
}

/// Answers that nobody asked for: of another life, of another epoch, of an event to come, and a
/// second time.
fn stray_answers(bench: &mut Bench, answered: Option<EventId>) -> Checked {
    let last = bench.last();
    let known = answered.unwrap_or(EventId {
        boot_id: last.boot_id,
        epoch: last.epoch,
        sequence: last.sequence,
    });
    let strays = [
        known,
        EventId {
            boot_id: 5,
            ..known
        },
        EventId {
            epoch: known.epoch + 1,
            ..known
        },
        EventId {
            sequence: known.sequence + 1,
            ..known
        },
    ];
    for event in strays {
        let taken = bench.command(Command::Acknowledge { event, done: true });
        check(
            taken.is_err(),
            &format!("a stray answer is taken: {event:?}"),
        )?;
    }
    Ok(())
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
    let mut is_over = false;
    for _ in 0..6_000 {
        let state = bench.tick().state().unwrap();
        if let Some(done) = wrong.answer().filter(|_| state == MachineState::Awaiting) {
            answer(bench, done)?;
        }
        if rests(state) {
            is_over = true;
            break;
        }
    }
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
    ) && !matches!(situation, Situation::Off | Situation::Enabling)
        || matches!(wrong, Wrong::NoAnswer | Wrong::FailedAnswer) && situation.has_m_code_wait();
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
    let count: usize = wanted.map_or(192, |text| text.parse().unwrap());
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
