//! The script of one case from start to end: run into the moment, let it go wrong, follow the
//! machine to its rest, recover.

use std::time::{Duration, Instant};

use glidepath_link::{Command, EndOfEpoch, EventId, MachineState, Setpoint};
use glidepath_program::{Frame, Item};
use glidepath_tests::Process;
use rustix::process::Signal;

use super::bench::{Bench, Checked, Heard};
use super::case::{Case, Fault, Situation};
use super::rogue::Rogue;
use super::verdict::{Verdict, judge};

/// About four seconds of motion at the programmed feed, with corners of all kinds, and no stop.
pub(super) const PROGRAM: &str = "\
G21 G90 G64 P0.02 F6000
G1 X45 Y5
X42 Y30
G3 X32 Y40 I-10 J0
G1 X2 Y42 Z2
X12 Y20
X45 Y22
X15 Y25
X15 Y45 Z0
X50 Y50
X5 Y8
X0 Y0
M2
";
/// Where the program waits for an answer that comes late, if it comes in time at all.
const WAITS: &str = "M101";
/// In front of its last line but one, when everything has gone wrong that will.
pub(super) fn waiting() -> String {
    PROGRAM.replace("X0 Y0\n", &format!("{WAITS}\nX0 Y0\n"))
}
/// Where it turns.
const CORNERS: [[f64; 2]; 8] = [
    [45.0, 5.0],
    [42.0, 30.0],
    [2.0, 42.0],
    [12.0, 20.0],
    [45.0, 22.0],
    [15.0, 25.0],
    [15.0, 45.0],
    [50.0, 50.0],
];
/// Back to where it began, with a way round so that it always moves.
pub(super) const HOME: &str = "G21 G90 G64 P0.02 F6000\nG1 X5 Y5 Z1\nX0 Y0 Z0\nM2\n";

/// What is the same for all cases.
pub(super) struct Programs {
    pub(super) frames: Vec<Frame>,
    pub(super) items: Vec<Item>,
    pub(super) file: String,
    pub(super) home: String,
    pub(super) waiting: String,
}

/// Who plays the program.
enum Player {
    Process(Process),
    /// With the rest of its input.
    Pipe(Process, &'static str),
    Rogue(Rogue),
}

impl Player {
    fn start(bench: &Bench<'_>, programs: &Programs, case: &mut Case) -> Checked<Self> {
        Ok(match case.fault {
            Fault::PausePipe => {
                let mut planner = bench.planner(&["-"]);
                // So many that what is planned of them goes beyond the first corner.
                let lines = case.chance.below(3) + 8;
                let cut = PROGRAM
                    .match_indices('\n')
                    .nth(lines)
                    .map_or(0, |(at, _)| at + 1);
                planner.write(&PROGRAM[..cut]);
                Self::Pipe(planner, &PROGRAM[cut..])
            }
            Fault::AnswerLate => Self::Process(bench.planner(&[&programs.waiting])),
            Fault::KillPlanner
            | Fault::StopPlannerBriefly
            | Fault::StopPlannerForLong
            | Fault::KillInterpolator
            | Fault::KillServo
            | Fault::KillClient => Self::Process(bench.planner(&[&programs.file])),
            _ => Self::Rogue(Rogue::connect(bench, &programs.frames)?),
        })
    }

    /// Lets it go on until what was heard pleases.
    fn until(
        &mut self,
        bench: &Bench<'_>,
        what: &str,
        pleases: impl Fn(&Heard) -> bool,
    ) -> Checked<()> {
        match self {
            Self::Rogue(rogue) => rogue.play(bench, what, pleases),
            Self::Process(_) | Self::Pipe(..) => bench.until(what, pleases),
        }
    }

    fn go_on(&mut self, bench: &Bench<'_>, time: Duration) -> Checked<()> {
        let begun = Instant::now();
        self.until(bench, "time", |_| begun.elapsed() >= time)
    }

    fn signal(&self, signal: Signal) {
        if let Self::Process(process) | Self::Pipe(process, _) = self {
            process.signal(signal);
        }
    }
}

/// Runs a case on a machine that is idle at zero, and leaves it so.
pub(super) fn run(bench: &mut Bench<'_>, programs: &Programs, mut case: Case) -> Checked<Verdict> {
    bench.until("a machine at rest", |heard| heard.is(MachineState::Idle))?;
    bench.forget();
    bench.until_state(MachineState::Idle)?;
    let epoch = bench.look(|heard| heard.status.map_or(0, |status| status.epoch)) + 1;
    let mut player = Player::start(bench, programs, &mut case)?;
    let largest_override = approach(bench, &mut player, &mut case, epoch)?;
    let moment = bench.look(|heard| heard.latest().map_or(0, |setpoint| setpoint.number));
    inject(bench, &mut player, &mut case)?;
    let mut was_moving = true;
    let verdict = if case.fault == Fault::KillInterpolator {
        let verdict = judge(bench, programs, epoch, moment, largest_override);
        was_moving = bench.look(|heard| heard.latest().is_some_and(has_velocity));
        expect_exit(player, 5)?;
        bench.forget();
        bench.start_interpolator();
        bench.until_state(MachineState::Idle)?;
        verdict.cut_off()
    } else {
        let state = follow(bench, &mut player, &mut case)?;
        let verdict = judge(bench, programs, epoch, moment, largest_override);
        let has_completed = state == MachineState::Idle;
        check_end(bench, &case, has_completed)?;
        leave(player, &case, has_completed)?;
        verdict.that_must_be_complete(has_completed)
    };
    let verdict = verdict.and(recover(bench, programs)?);
    check_servo(bench, case.fault, was_moving)?;
    bench.until_clean()?;
    Ok(verdict)
}

/// Runs into the moment. Returns the largest override commanded.
fn approach(
    bench: &mut Bench<'_>,
    player: &mut Player,
    case: &mut Case,
    epoch: u64,
) -> Checked<f64> {
    let is_pipe = matches!(player, Player::Pipe(..));
    let first = case.chance.between(20, if is_pipe { 50 } else { 220 });
    let is_corner = case.situation == Situation::Corner;
    player.until(bench, "the moment", |heard| {
        heard.latest().is_some_and(|now| {
            let place = [now.position[0], now.position[1]];
            let is_near =
                |corner: &[f64; 2]| (corner[0] - place[0]).hypot(corner[1] - place[1]) < 1.5;
            let is_there = if is_corner {
                CORNERS.iter().any(is_near)
            } else {
                now.feed_v > 95.0
            };
            now.epoch == epoch && now.sequence >= first && is_there
        })
    })?;
    let mut largest = 1.0;
    match case.situation {
        Situation::FullSpeed | Situation::Corner => return Ok(largest),
        Situation::Hold => bench.command(Command::Hold)?,
        Situation::BlockEnd => bench.command(Command::StopAtEndOfBlock)?,
        Situation::SingleBlock => bench.command(Command::SingleBlock(true))?,
        Situation::WayBack => bench.command(Command::Reverse)?,
        Situation::Override => {
            let ratio = [0.3, 0.5, 0.8, 1.2, 1.5][case.chance.below(5)];
            largest = f64::max(ratio, 1.0);
            bench.command(Command::FeedOverride(ratio))?;
        }
    }
    player.go_on(bench, case.chance.millis(0, 150))?;
    Ok(largest)
}

/// Lets it go wrong.
fn inject(bench: &mut Bench<'_>, player: &mut Player, case: &mut Case) -> Checked<()> {
    match case.fault {
        Fault::KillPlanner => player.signal(Signal::KILL),
        Fault::StopPlannerForLong => player.signal(Signal::STOP),
        Fault::StopPlannerBriefly => {
            player.signal(Signal::STOP);
            std::thread::sleep(case.chance.millis(20, 1500));
            player.signal(Signal::CONT);
        }
        Fault::KillInterpolator => bench.kill_interpolator(),
        Fault::KillServo => {
            bench.kill_servo();
            bench.start_servo();
        }
        Fault::KillClient => {
            let commands: [&[&str]; 3] = [&["hold"], &["override", "70"], &["status"]];
            let client = Process::join(bench.instance, commands[case.chance.below(3)]);
            std::thread::sleep(case.chance.millis(0, 40));
            client.signal(Signal::KILL);
            let _killed = client.wait();
        }
        Fault::AnswerLate => {} // It comes where the program waits.
        Fault::PausePipe => {}  // It has come already.
        _ => {
            if let Player::Rogue(rogue) = player {
                rogue.spoil(case.fault, &mut case.chance)?;
            }
        }
    }
    Ok(())
}

/// Follows the machine until the program is over or has failed, resuming where an operator would.
fn follow(bench: &mut Bench<'_>, player: &mut Player, case: &mut Case) -> Checked<MachineState> {
    use MachineState::{Awaiting, Faulted, Held, Idle, ProgramStop, Starved, Waiting};
    loop {
        bench.expect_news();
        let wanted = [Awaiting, Faulted, Held, Idle, ProgramStop, Starved, Waiting];
        player.until(bench, "rest", |heard| heard.is_any_of(&wanted))?;
        let is = |state| bench.look(|heard| heard.is(state));
        if is(Faulted) {
            return Ok(Faulted);
        } else if is(Idle) {
            return Ok(Idle);
        } else if is(Awaiting) {
            answer(bench, case)?;
            player.until(bench, "the end of the wait", |heard| !heard.is(Awaiting))?;
        } else if is(Starved) || is(Waiting) {
            // A planner that a busy host keeps from its work may starve the machine once more.
            if let Player::Pipe(planner, rest) = player
                && !rest.is_empty()
            {
                // Longer than a machine waits for a planner that is silent, or not.
                let pause = [300, 2600][case.chance.below(2)];
                std::thread::sleep(Duration::from_millis(pause));
                if bench.look(|heard| heard.is(Faulted)) {
                    return Err("a pause of the input is no fault".to_owned());
                }
                planner.write(rest);
                planner.close();
                *rest = "";
            }
            let waits = |heard: &Heard| heard.is_any_of(&[Starved, Waiting]);
            player.until(bench, "the end of the wait", |heard| !waits(heard))?;
        } else {
            player.go_on(bench, case.chance.millis(0, 100))?;
            go_on(bench, case)?;
            let is_held = |heard: &Heard| heard.is_any_of(&[Held, ProgramStop]);
            player.until(bench, "motion", |heard| !is_held(heard))?;
        }
    }
}

/// Answers what is awaited, at about the time at which that becomes a fault.
fn answer(bench: &mut Bench<'_>, case: &mut Case) -> Checked<()> {
    let status = bench.look(|heard| heard.status).ok_or("no status")?;
    let event = EventId {
        boot_id: status.boot_id,
        epoch: status.epoch,
        sequence: status.awaited_sequence,
    };
    std::thread::sleep(case.chance.millis(0, 600));
    unless_faulted(bench, Command::Acknowledge { event, done: true })
}

/// Goes on as an operator would.
fn go_on(bench: &mut Bench<'_>, case: &Case) -> Checked<()> {
    if case.situation != Situation::WayBack {
        return unless_faulted(bench, Command::Resume);
    }
    // Where it turns it is held for a moment only: then there is nothing to resume.
    let _held = bench.command(Command::Resume);
    unless_faulted(bench, Command::Forward)
}

/// A command that may be refused if what went wrong has made a fault already.
fn unless_faulted(bench: &mut Bench<'_>, command: Command) -> Checked<()> {
    let refused = bench.command(command);
    if refused.is_err() {
        bench.expect_news();
        bench.until("a status", |heard| heard.status.is_some())?;
        if bench.look(|heard| heard.is(MachineState::Faulted)) {
            return Ok(());
        }
    }
    refused
}

/// The program has come to the right end, and the status says why.
fn check_end(bench: &Bench<'_>, case: &Case, has_completed: bool) -> Checked<()> {
    let status = bench.look(|heard| heard.status).ok_or("no status")?;
    let (end, fault) = (status.end_of_epoch(), status.fault());
    let is_right = match (has_completed, fault) {
        (true, Ok(None)) => case.fault.may_complete() && end == Ok(EndOfEpoch::Completed),
        (false, Ok(Some(cause))) => {
            case.fault.may_cause(cause)
                && end == Ok(EndOfEpoch::Faulted)
                && !status.last_error.as_str().is_empty()
        }
        _ => false,
    };
    if is_right {
        return Ok(());
    }
    Err(format!(
        "ended as {end:?} with {fault:?}: {}",
        status.last_error.as_str()
    ))
}

/// The planner has ended as it ought to.
fn leave(player: Player, case: &Case, has_completed: bool) -> Checked<()> {
    if case.fault == Fault::StopPlannerForLong {
        player.signal(Signal::CONT);
    }
    if case.fault == Fault::KillPlanner {
        return Ok(());
    }
    expect_exit(player, if has_completed { 0 } else { 5 })
}

fn expect_exit(player: Player, code: i32) -> Checked<()> {
    let (Player::Process(planner) | Player::Pipe(planner, _)) = player else {
        return Ok(());
    };
    let output = planner.wait();
    if output.status.code() == Some(code) {
        return Ok(());
    }
    Err(format!(
        "the planner ended with {}, not {code}: {}",
        output.status, output.stderr
    ))
}

fn has_velocity(setpoint: &Setpoint) -> bool {
    setpoint.velocity.iter().any(|v| v.abs() > 0.0)
}

/// Takes the machine back to zero with a program from where it stands.
fn recover(bench: &mut Bench<'_>, programs: &Programs) -> Checked<Verdict> {
    bench.until("a status", |heard| heard.status.is_some())?;
    let status = bench.look(|heard| heard.status).ok_or("no status")?;
    let needs_reset = !matches!(status.fault(), Ok(None));
    if needs_reset {
        bench.command(Command::Reset)?;
        bench.until_state(MachineState::Idle)?;
    }
    bench.command(Command::FeedOverride(1.0))?;
    bench.command(Command::SingleBlock(false))?;
    let output = bench.planner(&[&programs.home]).wait();
    if output.status.code() != Some(0) {
        return Err(format!("no recovery: {}", output.stderr));
    }
    bench.until_state(MachineState::Idle)?;
    let status = bench.look(|heard| heard.status).ok_or("no status")?;
    if status.position.iter().any(|place| place.abs() > 0.0) || status.fault != 0 {
        return Err(format!("recovered to {:?}", status.position));
    }
    Ok(super::verdict::judge_home(bench, status.epoch).that_must_be_complete(true))
}

/// The servo was there, or has come back. What moved when the setpoints ended it has stopped by itself; what rested
/// had nothing to be stopped.
fn check_servo(bench: &mut Bench<'_>, fault: Fault, was_moving: bool) -> Checked<()> {
    let expected = match fault {
        Fault::KillInterpolator if was_moving => ["restarts", "own_stops"].as_slice(),
        Fault::KillInterpolator => &["restarts"],
        Fault::KillServo => &["received"],
        _ => return Ok(()),
    };
    let report = bench.end_servo()?;
    bench.start_servo();
    let counts = |name: &&str| report[*name].as_u64().is_some_and(|count| count > 0);
    if expected.iter().all(counts) {
        return Ok(());
    }
    Err(format!("the servo tells {report}"))
}
