//! Orders of several clients in every phase of a job, and processes that are killed or hang, as a seed
//! decides: a service with drives that answer, and every setpoint of it judged. The wall clock jumps all the time.
//!
//! What must hold: a command that is to be answered is answered, or ends on a signal; after an abort that
//! was accepted nothing moves until it is told to; what `status` names clears every fault; nothing wedges:
//! after every bout the machine comes back with the documented commands; limits and travel are kept.
//!
//! `GLIDEPATH_ATTACK=5000 cargo test -p glidepath-tests --test e2e attack -- --nocapture` takes so many
//! steps, `GLIDEPATH_ATTACK_SEED` others.

use std::time::{Duration, Instant};

use glidepath_link::{JobStage, MachineState, Power, Setpoint, Status};
use glidepath_plant::{JointSettings, SwitchSettings};
use glidepath_tests::{Instance, Operated, Output, Process, ServoStack, Tape, Watchdog};
use rustix::process::Signal;

use crate::faults::Chance;

/// Steps unless the environment says otherwise: some 40 s.
const SAMPLE: u64 = 60;
/// Steps of a bout, behind which the machine is brought back.
const BOUT: u64 = 12;
/// How long an answer may take, with a start of the process on a busy host.
const ANSWER: Duration = Duration::from_secs(6);
/// How long a process may take from its start to being heard.
const START: Duration = Duration::from_secs(3);
/// How long a process may take to end behind a signal.
const END: Duration = Duration::from_secs(6);

const HOME: &str = "search_velocity = -40.0\nlatch_velocity = 8.0\noffset = -7.0\nposition = 0.0\n\
                    search_travel = 60.0\nclearance = 3.0\n";

/// A short way, and one that is checked for some tenths of a second first.
const WAY: &str = "G21 G90 G54\nG1 X12 Y4 Z-2 F2400\nX2 Y8\nX9 Y1 Z1\nX0 Y0 Z0\nM2\n";

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
    _stack: ServoStack,
    interpolator: Process,
    service: Process,
    tape: Tape,
    clients: Vec<(String, Process)>,
    /// When the last of them that moves without a job was asked for.
    asked: Instant,
    ways: [String; 2],
    chance: Chance,
    log: Vec<String>,
}

impl<'a> Attack<'a> {
    fn begin(instance: &'a Instance, seed: u64) -> Self {
        let changes = [("homing = \"none\"", "homing = \"controller\"")];
        let homes = (0..3).map(|joint| format!("[home.J{joint}]\n{HOME}"));
        let operated = Operated::new(
            instance,
            &changes,
            &format!("\n{}", homes.collect::<String>()),
        );
        let tape = Tape::start(instance);
        let interpolator = operated.process(&["interpolator", "--best-effort"]);
        let stack = ServoStack::start(instance, 1, &joints());
        let service = operated.process(&["planner", "--listen"]);
        let _drives = operated.wait_for_drives();
        Self {
            operated,
            _stack: stack,
            interpolator,
            service,
            tape,
            clients: Vec::new(),
            asked: Instant::now(),
            ways: [
                instance.file("way.ngc", WAY),
                instance.file("slow.ngc", &slow_way()),
            ],
            chance: Chance::new(seed),
            log: Vec::new(),
        }
    }

    fn note(&mut self, what: &str) {
        let status = self.operated.wait(|_| true);
        let fault = status.fault_text().unwrap_or_default();
        let state = status.state();
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
        if begun.elapsed() > ANSWER {
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
        if matches!(command, ["jog" | "home", ..]) {
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

    fn step(&mut self) {
        let pause = self.chance.millis(0, 250);
        std::thread::sleep(pause);
        let [way, slow] = self.ways.clone();
        match self.chance.below(24) {
            0..=2 => self.ask(&["run-file", &way]),
            3..=6 => self.ask(&["run-file", &slow]),
            7 | 8 => self.ask(&["mdi", "G21 G90 G1 X5 F1200"]),
            9 => self.ask(&["jog", "X3", "--feed", "1500"]),
            10 => self.ask(&["home"]),
            11 => drop(self.type_in(&["hold"])),
            12 | 13 => drop(self.type_in(&["resume"])),
            14 | 15 => self.abort(),
            16 => drop(self.type_in(&["override", "70"])),
            17 => drop(self.type_in(&["disable"])),
            18 => drop(self.type_in(&["enable"])),
            19 => drop(self.type_in(&["reset"])),
            20 => self.signal_client(Signal::KILL),
            21 => self.signal_client(Signal::INT),
            22 => self.hang_service(),
            _ => self.kill_service(),
        }
    }

    /// Everybody who waits is told to end. Then the machine is brought back by what its states name, and
    /// does what it is told.
    fn bring_back(&mut self) {
        while !self.clients.is_empty() {
            self.signal_client(Signal::TERM);
        }
        self.abort();
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
                    let told = self.type_in_patiently(&line);
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
        ..
    } = attack;
    let _service = service.end().expect(0);
    let _interpolator = interpolator.end().expect(0);
    let lowest = tape
        .since(0)
        .iter()
        .map(|s| s.position[0])
        .fold(f64::INFINITY, f64::min);
    assert!(lowest > -500.0, "beyond its travel: {lowest}");
    assert_eq!(tape.judge(), Vec::<String>::new(), "seed {seed}");
}
