//! Tests of drives that are a process of their own, lost around a job in each of its phases. What
//! `glidepath status` names brings the machine back, and the next job is executed.
//!
//! `GLIDEPATH_DRIVES=30 cargo test -p glidepath-tests --test e2e drives -- --nocapture` takes each loss in each phase,
//! `GLIDEPATH_DRIVES_SEED` other moments.

use std::time::{Duration, Instant};

use glidepath_link::{FaultCause, JobStage, MachineState, Power, Status};
use glidepath_tests::{Instance, Operated, Process, Watchdog};
use rustix::process::Signal;

use crate::faults::Chance;

/// Cases unless the environment says otherwise: some 30 s.
const SAMPLE: usize = 7;
/// How soon a job ends whose machine is lost.
const SOON: Duration = Duration::from_secs(12);
/// How long what is named may take to bring the machine back.
const BACK: Duration = Duration::from_secs(30);

/// A second of motion.
const WAY: &str = "G21 G90 G54\nG1 X20 Y4 F6000\nX-20\nX20 Z2\nX0 Y0 Z0\nM2\n";

/// The same, which is checked for some tenths of a second first.
fn slow_way() -> String {
    let lines = "#1=0\no1 while [#1 lt 250000]\n#2=[sin[#1]*cos[#1]]\n#1=[#1+1]\no1 endwhile\n";
    format!("G21 G90 G54\n{lines}{}", &WAY[12..])
}

/// Where a job is when its machine is lost.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Phase {
    Checking,
    Planning,
    FirstFrame,
    Motion,
    End,
}

const PHASES: [Phase; 5] = [
    Phase::Checking,
    Phase::Planning,
    Phase::FirstFrame,
    Phase::Motion,
    Phase::End,
];

/// How it is lost.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Loss {
    Disable,
    Abort,
    /// The drives' process dies, and another one is started.
    Killed,
    /// It stands for longer than what it says may be old, and then for longer than power stays.
    Stopped,
    /// It stands for less long: the joints are not where they are to be.
    Lagging,
    /// An operator takes the power, and gives it again at once.
    OffAndOn,
}

const LOSSES: [Loss; 6] = [
    Loss::Disable,
    Loss::Abort,
    Loss::Killed,
    Loss::Stopped,
    Loss::Lagging,
    Loss::OffAndOn,
];

struct Bench<'a> {
    operated: Operated<'a>,
    servo: Process,
    _interpolator: Process,
    _service: Process,
    ways: [String; 2],
    chance: Chance,
}

impl<'a> Bench<'a> {
    fn start(instance: &'a Instance, seed: u64) -> Self {
        let changes = [
            ("homing = \"none\"", "homing = \"drive\""),
            ("\nfollowing_error = 50.0 ", "\nfollowing_error = 5.0 "),
            ("min_following_error = 50.0 ", "min_following_error = 5.0 "),
            // So that a loss is one.
            ("stale_s = 2.0 ", "stale_s = 0.6 "),
            ("off_s = 3.0 ", "off_s = 1.0 "),
        ];
        let operated = Operated::new(instance, &changes, "");
        let interpolator = operated.process(&["interpolator", "--best-effort"]);
        let servo = operated.process(&["servo", "--best-effort"]);
        let service = operated.service();
        let _drives = operated.wait_for_drives();
        Self {
            operated,
            servo,
            _interpolator: interpolator,
            _service: service,
            ways: [
                instance.file("way.ngc", WAY),
                instance.file("slow.ngc", &slow_way()),
            ],
            chance: Chance::new(seed),
        }
    }

    /// A job that has come to a phase.
    fn job(&mut self, phase: Phase) -> Process {
        let way = &self.ways[usize::from(phase == Phase::Checking)];
        let before = self.operated.wait(|_| true).epoch;
        let client = self.operated.process(&["run-file", way]);
        let has_begun = |status: &Status| status.epoch > before;
        match phase {
            Phase::Checking | Phase::Planning => {
                let is_prepared = |status: &Status| status.job_stage() == Ok(JobStage::Preparing);
                let _taken = self.operated.wait(|s| is_prepared(s) || has_begun(s));
                let most_ms = if phase == Phase::Checking { 150 } else { 20 };
                std::thread::sleep(self.chance.millis(0, most_ms));
            }
            Phase::FirstFrame => drop(self.operated.wait(has_begun)),
            Phase::Motion => {
                let _begun = self.operated.wait(has_begun);
                std::thread::sleep(self.chance.millis(50, 700));
            }
            Phase::End => {
                let is_last = |status: &Status| status.epoch > before && status.line >= 5;
                let _begun = self.operated.wait(is_last);
                std::thread::sleep(self.chance.millis(50, 300));
            }
        }
        client
    }

    fn lose(&mut self, loss: Loss) {
        match loss {
            Loss::Disable => drop(self.operated.operate(&["disable"])),
            Loss::Abort => drop(self.operated.operate(&["abort"])),
            Loss::Killed => {
                self.servo.signal(Signal::KILL);
                std::thread::sleep(self.chance.millis(0, 1500));
                self.servo = self.operated.process(&["servo", "--best-effort"]);
            }
            Loss::Stopped => {
                self.servo.signal(Signal::STOP);
                std::thread::sleep(self.chance.millis(800, 1800));
                self.servo.signal(Signal::CONT);
            }
            Loss::Lagging => {
                self.servo.signal(Signal::STOP);
                std::thread::sleep(self.chance.millis(200, 400));
                self.servo.signal(Signal::CONT);
            }
            Loss::OffAndOn => {
                self.operated.operate(&["disable"]);
                // Refused as long as the motion has not come to rest.
                let _answer = self.operated.process(&["enable"]).wait();
            }
        }
    }

    /// Nothing moves that is led: joints that setpoints follow may.
    fn rests(&self, case: &str) {
        let begun = Instant::now();
        let is_moving = |status: &Status| status.state().is_ok_and(MachineState::is_moving);
        while is_moving(&self.operated.wait(|_| true)) {
            assert!(begun.elapsed() < SOON, "{case}: it does not come to rest");
            std::thread::sleep(Duration::from_millis(5));
        }
        let before = self.operated.wait(|_| true);
        std::thread::sleep(Duration::from_millis(400));
        let after = self.operated.wait(|_| true);
        let is_led = |status: &Status| status.power() == Ok(Power::On);
        assert!(
            !is_led(&before)
                || !is_led(&after)
                || before.position.map(f64::to_bits) == after.position.map(f64::to_bits),
            "{case}: it moves on"
        );
        assert_eq!(before.epoch, after.epoch, "{case}: something else began");
    }

    /// What the status tells an operator to type, in this order.
    fn named(&self) -> Vec<String> {
        let output = self.operated.process(&["status", "--json"]).wait();
        let status = output.expect(0).json();
        let told =
            ["fault_remedy", "state_text"].map(|key| status[key].as_str().unwrap_or("").to_owned());
        let commands = told
            .iter()
            .flat_map(|text| text.split('`').skip(1).step_by(2));
        let words = commands.filter_map(|command| command.split_whitespace().nth(1));
        words
            .filter(|word| *word != "status")
            .map(str::to_owned)
            .collect()
    }

    /// Types what the status names until the machine is ready.
    fn bring_back(&self, case: &str) {
        let begun = Instant::now();
        let mut typed = Vec::new();
        loop {
            let status = self.operated.wait(|_| true);
            if status.state() == Ok(MachineState::Idle) {
                return;
            }
            assert!(
                begun.elapsed() < BACK,
                "{case}: it does not come back by what is named: {typed:?}, {:?}, {:?}",
                status.state(),
                status.fault_text()
            );
            for word in self.named() {
                let output = self.operated.process(&[&word]).wait();
                typed.push((word, output.status.code(), output.stderr));
            }
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// The next jobs are executed. A busy host may keep drives from saying where they are: then it is brought back again.
    fn goes_on(&self, case: &str) {
        let jobs = [
            ["mdi", "G21 G90 G54 G1 X3 F6000"],
            ["mdi", "G0 X0 Y0 Z0"],
            ["run-file", &self.ways[0]],
        ];
        let begun = Instant::now();
        for job in jobs {
            loop {
                let output = self.operated.process(&job).wait();
                if output.status.code() == Some(0) {
                    break;
                }
                let fault = self.operated.wait(|_| true).fault();
                let is_busy = fault == Ok(Some(FaultCause::FeedbackLost));
                assert!(is_busy && begun.elapsed() < BACK, "{case}: {output:#?}");
                self.bring_back(case);
            }
        }
    }

    fn case(&mut self, phase: Phase, loss: Loss) {
        let case = format!("{loss:?} in {phase:?}");
        let client = self.job(phase);
        self.lose(loss);
        let output = client.wait_for(SOON);
        let code = output.status.code();
        // A short stand may pass unnoticed, and the end may have come before.
        let may_be_done =
            matches!(loss, Loss::Lagging) || phase == Phase::End || phase == Phase::Motion;
        assert!(
            matches!(code, Some(5 | 1)) || (code == Some(0) && may_be_done),
            "{case}: {output:#?}"
        );
        self.rests(&case);
        if let Ok(Some(cause)) = self.operated.wait(|_| true).fault() {
            let expected = [
                FaultCause::FeedbackLost,
                FaultCause::FollowingError,
                FaultCause::EnableLost,
            ];
            assert!(expected.contains(&cause), "{case}: {cause:?}");
        }
        self.bring_back(&case);
        self.goes_on(&case);
        let position = self.operated.position();
        assert!(
            position.iter().all(|at| at.abs() < 1e-9),
            "{case}: {position:?}"
        );
    }
}

#[test]
fn drives_that_are_lost_around_a_job_come_back_by_what_the_status_names() {
    let number = |name: &str| std::env::var(name).ok().map(|text| text.parse().unwrap());
    let cases = number("GLIDEPATH_DRIVES").unwrap_or(SAMPLE);
    let seed = number("GLIDEPATH_DRIVES_SEED").unwrap_or(1);
    let instance = Instance::for_processes();
    let _watchdog = Watchdog::new(Duration::from_secs(120 + 40 * cases as u64));
    let mut bench = Bench::start(&instance, seed as u64);
    bench.bring_back("at the start");
    // Each loss once, in another phase each time, before any comes again.
    for number in 0..cases {
        let loss = LOSSES[number % LOSSES.len()];
        let phase = PHASES[(number + number / LOSSES.len() + seed) % PHASES.len()];
        bench.case(phase, loss);
    }
}
