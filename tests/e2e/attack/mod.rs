//! Orders of several clients in every phase of a job, processes that are killed or hang, and drives that fail, as a
//! seed decides: a service with drives that answer, and every setpoint of it judged. The wall clock jumps all the time.
//!
//! What must hold: a command that is to be answered is answered, or ends on a signal; after an abort that
//! was accepted nothing moves until it is told to; what `status` names clears every fault; nothing wedges:
//! after every bout the machine comes back with the documented commands, executes a line and jogs; limits and travel
//! are kept.
//!
//! `GLIDEPATH_ATTACK=5000 cargo test -p glidepath-tests --test e2e attack -- --nocapture` takes so many
//! steps, `GLIDEPATH_ATTACK_SEED` others, and shows in which states and phases of jobs they came.

mod met;
mod travel;

use std::time::{Duration, Instant};

use glidepath_link::{JobStage, MachineState, Power, Setpoint, Status};
use glidepath_plant::{InjectedFault, JointSettings, SwitchSettings};
use glidepath_testing::is_crowded;
use glidepath_tests::{Instance, Operated, Output, Process, ServoStack, Tape, Watchdog, settings};
use met::Met;
use rustix::process::Signal;

use crate::faults::Chance;

/// Steps unless the environment says otherwise: some 40 s.
const SAMPLE: u64 = 60;
/// Steps in which every state and phase is met.
const MANY: u64 = 1000;
/// Steps of a bout, behind which the machine is brought back.
const BOUT: u64 = 12;
/// How long an answer may take: two seconds, and the start of its process.
const ANSWER: Duration = Duration::from_millis(2500);
/// Likewise, on a host that has more to do than it can.
const ANSWER_CROWDED: Duration = Duration::from_secs(6);
/// How long a process may take from its start to being heard.
const START: Duration = Duration::from_secs(3);
/// How long a process may take to end behind a signal.
const END: Duration = Duration::from_secs(6);

const HOME: &str = "search_velocity = -40.0\nlatch_velocity = 8.0\noffset = -7.0\nposition = 0.0\n\
                    search_travel = 60.0\nclearance = 3.0\n";

/// A short way, and one that is checked for some tenths of a second first.
const WAY: &str = "G21 G90 G54\nG1 X12 Y4 Z-2 F2400\nX2 Y8\nX9 Y1 Z1\nX0 Y0 Z0\nM2\n";

/// One that asks for a tool, stops, and goes on to an end of travel.
const STOPS: &str = "G21 G90 G54\nG1 X6 F2400\nT2 M6\nX2\nM0\nX13.9 Y2\nM1\nX9\nM2\n";

/// The travel of X, Y and Z, mm: little more than what the programs need.
const TRAVEL: [[f64; 2]; 3] = [[-2.0, 14.0], [-3.0, 10.0], [-4.0, 3.0]];

/// A rest with all of the jerk within a period swings over by this before it comes, mm: J·T³/768.
fn swing_mm() -> f64 {
    let settings = settings();
    settings.limits.jerk[2] * settings.period_t.powi(3) / 768.0
}

fn slow_way() -> String {
    let lines = "#1=0\no1 while [#1 lt 200000]\n#2=[sin[#1]*cos[#1]]\n#1=[#1+1]\no1 endwhile\n";
    format!("G21 G90 G54\n{lines}{}", &WAY[12..])
}

fn joints() -> [JointSettings; 3] {
    [0.0; 3].map(|start| JointSettings {
        start,
        count: 100.0,
        switch: Some(SwitchSettings {
            cam: (start - 55.0, start - 5.0),
            bounce_ns: 3_000_000,
        }),
        ..JointSettings::default()
    })
}

/// The machine, its service, and who has asked for something and waits.
struct Attack<'a> {
    operated: Operated<'a>,
    stack: ServoStack,
    interpolator: Process,
    service: Process,
    tape: Tape,
    clients: Vec<(String, Process)>,
    /// When the last of them that moves without a job was asked for.
    asked: Instant,
    ways: [String; 3],
    chance: Chance,
    met: Met,
    log: Vec<String>,
}

impl<'a> Attack<'a> {
    fn begin(instance: &'a Instance, seed: u64) -> Self {
        let homing = ("homing = \"none\"", "homing = \"controller\"");
        let of_x = (
            "min_position = -500.0      # mm, soft limit in machine coordinates\nmax_position = 500.0       # mm",
            "min_position = -2.0\nmax_position = 14.0",
        );
        let of_y = (
            "[axis.Y]\nmin_position = -500.0\nmax_position = 500.0",
            "[axis.Y]\nmin_position = -3.0\nmax_position = 10.0",
        );
        let of_z = (
            "[axis.Z]\nmin_position = -500.0\nmax_position = 500.0",
            "[axis.Z]\nmin_position = -4.0\nmax_position = 3.0",
        );
        let homes = (0..3).map(|joint| format!("[home.J{joint}]\n{HOME}"));
        let operated = Operated::new(
            instance,
            &[homing, of_x, of_y, of_z],
            &format!("\n{}", homes.collect::<String>()),
        );
        let tape = Tape::start(instance);
        let interpolator = operated.process(&["interpolator", "--best-effort"]);
        let stack = ServoStack::start(instance, 1, &joints());
        let service = operated.process(&["planner", "--listen"]);
        let _drives = operated.wait_for_drives();
        Self {
            operated,
            stack,
            interpolator,
            service,
            tape,
            clients: Vec::new(),
            asked: Instant::now(),
            ways: [
                instance.file("way.ngc", WAY),
                instance.file("slow.ngc", &slow_way()),
                instance.file("stops.ngc", STOPS),
            ],
            chance: Chance::new(seed),
            met: Met::default(),
            log: Vec::new(),
        }
    }

    fn note(&mut self, what: &str) {
        let status = self.operated.wait(|_| true);
        let fault = status.fault_text().unwrap_or_default();
        let state = status.state();
        self.met.take(&status);
        self.log.push(format!("{what} ({state:?}) {fault}"));
    }

    #[allow(clippy::panic, reason = "a test that fails panics")]
    fn fail(&self, what: &str) -> ! {
        panic!("{what}\nafter:\n{}", self.log.join("\n"));
    }

    /// Types something that is answered at once, whatever the answer.
    fn type_in(&mut self, command: &[&str]) -> Output {
        self.note(&command.join(" "));
        let begun = Instant::now();
        let output = self.operated.process(command).wait();
        let patience = if is_crowded() { ANSWER_CROWDED } else { ANSWER };
        if begun.elapsed() > patience {
            self.fail(&format!(
                "{command:?} took {:?}: {output:#?}",
                begun.elapsed()
            ));
        }
        if !matches!(output.status.code(), Some(0 | 1 | 5)) {
            self.fail(&format!("{command:?}: {output:#?}"));
        }
        output
    }

    /// Asks for something that waits for its end.
    fn ask(&mut self, command: &[&str]) {
        self.note(&format!("{} &", command.join(" ")));
        let client = self.operated.process(command);
        if matches!(command, ["jog" | "home" | "return", ..]) {
            self.asked = Instant::now();
        }
        self.clients.push((command.join(" "), client));
    }

    /// One of those that wait gets a signal, and ends.
    fn signal_client(&mut self, signal: Signal) {
        if self.clients.is_empty() {
            return;
        }
        let which = self.chance.below(self.clients.len());
        let (name, client) = self.clients.swap_remove(which);
        self.note(&format!("{signal:?} to {name}"));
        client.signal(signal);
        let begun = Instant::now();
        let output = client.wait();
        if begun.elapsed() > END {
            self.fail(&format!(
                "{name} took {:?} to end: {output:#?}",
                begun.elapsed()
            ));
        }
    }

    /// An abort: if it is accepted, nothing moves any more, whatever is under way. A client that is starting may be
    /// accepted behind it; its job has a number of its own, and jogs and
    /// homing are judged once they must have been heard.
    fn abort(&mut self) {
        let before = self.operated.wait(|_| true).job_number;
        let is_starting = self.asked.elapsed() < START;
        let output = self.type_in(&["abort"]);
        if output.status.code() != Some(0) {
            self.fail(&format!("an abort was refused: {output:#?}"));
        }
        let begun = Instant::now();
        while self
            .operated
            .wait(|_| true)
            .state()
            .is_ok_and(MachineState::is_moving)
        {
            if begun.elapsed() > END {
                self.fail("an abort does not bring the machine to rest");
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        std::thread::sleep(Duration::from_millis(30));
        let place = self.tape.length().saturating_sub(1);
        std::thread::sleep(self.chance.millis(50, 600));
        let told = self.tape.since(place);
        let is_led = |s: &&Setpoint| s.enable != 0 && s.state() != Ok(MachineState::Off);
        let mut led = told.iter().filter(is_led);
        if let Some(first) = led.next()
            && !led.all(|s| {
                s.joint_position.map(f64::to_bits) == first.joint_position.map(f64::to_bits)
            })
            && self.operated.wait(|_| true).job_number == before
            && !is_starting
        {
            self.fail("it moves behind an abort");
        }
    }

    fn hang_service(&mut self) {
        self.note("the service hangs");
        self.service.signal(Signal::STOP);
        let hangs = self.chance.millis(50, 900);
        if self.chance.below(2) == 0 {
            self.abort();
        } else {
            std::thread::sleep(hangs);
        }
        self.service.signal(Signal::CONT);
    }

    fn kill_service(&mut self) {
        self.note("the service is killed");
        self.service.signal(Signal::KILL);
        // One that starts while the killed one is not gone is refused.
        while self.service.runs() {
            std::thread::sleep(Duration::from_millis(1));
        }
        self.service = self.operated.process(&["planner", "--listen"]);
        std::thread::sleep(self.chance.millis(0, 300));
        if !self.service.runs() {
            self.fail("no other service starts");
        }
    }

    /// All of the machine but its drives.
    fn kill_interpolator(&mut self) {
        self.note("the interpolator is killed");
        self.interpolator.signal(Signal::KILL);
        while self.interpolator.runs() {
            std::thread::sleep(Duration::from_millis(1));
        }
        std::thread::sleep(self.chance.millis(0, 300));
        self.interpolator = self.operated.process(&["interpolator", "--best-effort"]);
        std::thread::sleep(self.chance.millis(0, 300));
        if !self.service.runs() {
            self.service = self.operated.process(&["planner", "--listen"]);
        }
    }

    /// For longer than feedback may be old, or for less.
    fn lose_feedback(&mut self) {
        self.note("the feedback stays away");
        self.stack.inject(InjectedFault::Dropout(true));
        std::thread::sleep(self.chance.millis(50, 1400));
        self.stack.inject(InjectedFault::Dropout(false));
    }

    fn lose_power(&mut self) {
        self.note("a joint has no power");
        let joint = self.chance.below(3);
        self.stack.inject(InjectedFault::PowerLost(joint, true));
        std::thread::sleep(self.chance.millis(10, 300));
        self.stack.inject(InjectedFault::PowerLost(joint, false));
    }

    fn step(&mut self) {
        let pause = self.chance.millis(0, 250);
        std::thread::sleep(pause);
        match self.chance.below(40) {
            0..=14 => self.ask_for_motion(),
            15..=31 => self.order(),
            32..=34 => self.abort(),
            35 => self.signal_client(Signal::KILL),
            36 => self.signal_client(Signal::INT),
            37 => self.hang_service(),
            38 => self.kill_service(),
            _ => match self.chance.below(3) {
                0 => self.lose_feedback(),
                1 => self.lose_power(),
                _ => self.kill_interpolator(),
            },
        }
    }

    /// What waits for its end.
    fn ask_for_motion(&mut self) {
        let [way, slow, stops] = self.ways.clone();
        match self.chance.below(16) {
            0 | 1 => self.ask(&["run-file", &way]),
            2..=4 => self.ask(&["run-file", &slow]),
            5..=7 => self.ask(&["run-file", &stops]),
            8 => self.ask(&["run-file", &stops, "--resume"]),
            9 => self.ask(&["run-file", &stops, "--from-line", "6", "--yes"]),
            10 => self.ask(&["feed", &way]),
            11 => self.ask(&["mdi", "G21 G90 G1 X5 F1200"]),
            12 => self.ask(&["mdi", "G21 G90 G1 X40 F1200"]),
            13 => self.ask(&["jog", "X3", "--feed", "1500"]),
            14 => self.ask(&["jog", "X-40", "Z40"]),
            _ => match self.chance.below(2) {
                0 => self.ask(&["home"]),
                _ => self.ask(&["return"]),
            },
        }
    }

    /// What is answered at once.
    fn order(&mut self) {
        let orders: [&[&str]; 16] = [
            &["hold"],
            &["hold"],
            &["resume"],
            &["resume"],
            &["resume"],
            &["acknowledge"],
            &["acknowledge"],
            &["acknowledge", "--fail", "no tool 2"],
            &["step"],
            &["stop-at-block-end"],
            &["single-block", "on"],
            &["override", "70"],
            &["unhome", "J1"],
            &["disable"],
            &["enable"],
            &["reset"],
        ];
        let which = self.chance.below(orders.len());
        let _answer = self.type_in(orders[which]);
    }

    /// Everybody who waits is told to end. Then the machine is brought back by what its states name, and
    /// does what it is told.
    fn bring_back(&mut self) {
        while !self.clients.is_empty() {
            self.signal_client(Signal::TERM);
        }
        self.abort();
        let _block_by_block_no_more = self.type_in(&["single-block", "off"]);
        let begun = Instant::now();
        loop {
            if begun.elapsed() > Duration::from_secs(30) {
                self.fail("it does not come back");
            }
            let status = self.operated.wait(|_| true);
            let state = status.state().unwrap();
            let word: &[&str] = match state {
                MachineState::Idle if status.job_stage() != Ok(JobStage::Waiting) => {
                    let line = ["mdi", "G21 G90 G54 G1 X1 Y0 Z0 F2400"];
                    let jog = ["jog", "X1"];
                    let mut told = self.type_in_patiently(&line);
                    if told.status.code() == Some(0) {
                        told = self.type_in_patiently(&jog);
                    }
                    if told.status.code() == Some(0) {
                        break;
                    }
                    // A busy host may keep drives from saying where they are: then it is brought back again.
                    if self.operated.wait(|_| true).state() != Ok(MachineState::Faulted) {
                        self.fail(&format!("it does nothing any more: {told:#?}"));
                    }
                    continue;
                }
                MachineState::Faulted => {
                    self.clear(&status);
                    continue;
                }
                MachineState::Off if status.power() == Ok(Power::Off) => &["enable"],
                MachineState::NotHomed => &["home"],
                _ => &["status"],
            };
            let _answer = self.type_in_patiently(word);
        }
        self.log.clear();
    }

    /// Types the commands that `status` names for clearing its fault, one after the other.
    fn clear(&mut self, status: &Status) {
        let remedy = status.fault().unwrap().unwrap().remedy();
        for quoted in remedy.split('`').skip(1).step_by(2) {
            let words: Vec<&str> = quoted.split(' ').skip(1).collect();
            let _answer = self.type_in_patiently(&words);
        }
    }

    /// What may take as long as the way that the machine goes.
    fn type_in_patiently(&mut self, command: &[&str]) -> Output {
        self.note(&command.join(" "));
        let output = self.operated.process(command).wait();
        if !output.status.success() {
            self.log.push(output.stderr.clone());
        }
        output
    }
}

#[test]
#[allow(
    clippy::print_stderr,
    reason = "the counts are for whoever runs the attack"
)]
fn whatever_clients_do_a_machine_obeys_and_nothing_wedges() {
    let number = |name: &str| std::env::var(name).ok().map(|text| text.parse().unwrap());
    let steps = number("GLIDEPATH_ATTACK").unwrap_or(SAMPLE);
    let seed = number("GLIDEPATH_ATTACK_SEED").unwrap_or(1);
    let instance = Instance::for_processes().with_a_wall_clock_that_jumps();
    let _watchdog = Watchdog::new(Duration::from_secs(240 + 10 * steps));
    let mut attack = Attack::begin(&instance, seed);
    attack.bring_back();
    for step in 1..=steps {
        attack.step();
        if step % BOUT == 0 {
            attack.bring_back();
        }
    }
    attack.bring_back();
    let Attack {
        service,
        interpolator,
        tape,
        met,
        ..
    } = attack;
    let _service = service.end().expect(0);
    let _interpolator = interpolator.end().expect(0);
    eprint!("{met}");
    assert_eq!(
        travel::beyond(&tape.since(0), &TRAVEL, swing_mm()),
        Vec::<String>::new(),
        "seed {seed}"
    );
    assert_eq!(tape.judge(), Vec::<String>::new(), "seed {seed}");
    if steps >= MANY {
        assert_eq!(met.missed(), Vec::<String>::new(), "seed {seed}");
    }
}
