//! The test of the life of a machine, from the first switching on to the loss of every process, on
//! a machine of the test's own that it upsets: every setpoint of it is audited.
//!
//! The power goes at moments that a seed decides. `GLIDEPATH_LIFE=200 cargo test -p glidepath-tests
//! --test e2e life -- --nocapture` takes so many, `GLIDEPATH_LIFE_SEED` others.

use std::time::Duration;

use glidepath_link::{
    EndOfEpoch, EventKind, EventRecord, FaultCause, MachineState, Power, Setpoint,
};
use glidepath_plant::{HomeSettings, InjectedFault, JointSettings, SwitchSettings};
use glidepath_program::CodeWord;
use glidepath_tests::{Instance, Operated, Process, ServoStack, Tape, Watchdog};
use rustix::process::Signal;

use crate::faults::Chance;
use crate::service::SHORT_WAY_UP;

/// How often the power goes unless the environment says otherwise.
const SAMPLE: u64 = 5;

const TABLES: &str = "
[m_codes.M3]\ndone = \"spindle-at-speed\"\nat = \"next-feed\"\ntimeout_s = 20
[m_codes.M6]\ntimeout_s = 60
[m_codes.M100-M199]
[m_codes.M110]\nat = \"block-end\"
[m_codes.M150]\ntimeout_s = 0.3
";

/// Of a joint: a switch 5 mm below where it is switched on, and its edge at −7 mm.
const HOME: &str = "search_velocity = -20.0\nlatch_velocity = 4.0\noffset = -7.0\nposition = 0.0\n\
                    search_travel = 60.0\nclearance = 3.0\n";

const PART: &str = "G21 G90 G54\nT2 M6 (change to tool 2)\nS600 M3\nM8\nG1 X1 Y1 F3000\nM66 P3 L3 Q20\n\
                    G1 X[2+#5399] (DEBUG, input #5399)\nM101 Q-2.5\nX14 Y3\nM110 X2 Y2\nM5 M9\nM2\n";

/// About a second and a half, with a way in three axes and corners.
const WAY: &str = "G21 G90 G54\nG1 X12 Y4 Z-2 F2400\nX2 Y8\nX9 Y1 Z1\nX0 Y0 Z0\nM2\n";

/// Whether joints stand there, but for the last places that are lost where the offset of their count
/// is added and taken away again, mm.
fn is_there(joints: &[f64; 9], place: &[f64; 9]) -> bool {
    let mut pairs = joints.iter().zip(place);
    pairs.all(|(joint, place)| (joint - place).abs() < 1e-12)
}

/// Joints that stand at places of the machine, and whose drives count from `count` there.
fn joints(stands: [f64; 3], count: f64) -> [JointSettings; 3] {
    stands.map(|start| JointSettings {
        start,
        count: count + start,
        switch: Some(SwitchSettings {
            cam: (start - 55.0, start - 5.0),
            bounce_ns: 3_000_000,
        }),
        ..JointSettings::default()
    })
}

/// The machine under test, its drives, and what it is made to do.
struct Life<'a> {
    operated: Operated<'a>,
    stack: ServoStack,
    interpolator: Process,
    tape: Tape,
}

impl<'a> Life<'a> {
    /// Cold: nobody has power, and nobody knows where it stands.
    fn begin(instance: &'a Instance, homing: &str, joints: &[JointSettings]) -> Self {
        let homing = format!("homing = \"{homing}\"");
        let changes = [
            ("homing = \"none\"", homing.as_str()),
            ("\nlift = 0.0 ", "\nlift = 3.5 "),
            ("inputs_outputs = \"none\"", "inputs_outputs = \"feedback\""),
            ("# directory = ", "directory = "),
            ("[adaptive_feed]\n", "[adaptive_feed]\ninput = 2\n"),
            SHORT_WAY_UP,
            // Drives that are lost are not back before it is known.
            ("stale_s = 2.0 ", "stale_s = 0.6 "),
            ("off_s = 3.0 ", "off_s = 1.0 "),
        ];
        let homes = (0..3).map(|joint| format!("[home.J{joint}]\n{HOME}"));
        let tables = format!("{TABLES}{}", homes.collect::<String>());
        let operated = Operated::new(instance, &changes, &tables);
        let tape = Tape::start(instance);
        let interpolator = operated.process(&["interpolator", "--best-effort"]);
        let stack = ServoStack::start(instance, 1, joints);
        Self {
            operated,
            stack,
            interpolator,
            tape,
        }
    }

    fn operate(&self, arguments: &[&str]) {
        let _done = self.operated.operate(arguments);
    }

    /// Where the joints are.
    fn stands(&self) -> [f64; 9] {
        self.stack.measured().position
    }

    /// Nothing moves, neither what is commanded nor the machine, once the drives are where they were told to be. How long
    /// they take for that is a matter of the host.
    fn still(&self, millis: u64) {
        let _arrived = self.operated.wait(|_| {
            let told = self.tape.since(self.tape.length().saturating_sub(1));
            told.last()
                .is_some_and(|told| is_there(&told.joint_position, &self.stands()))
        });
        let (begun, stands) = (self.tape.length(), self.stands());
        std::thread::sleep(Duration::from_millis(millis));
        assert!(is_there(&self.stands(), &stands));
        let told = self.tape.since(begun.saturating_sub(1));
        let stays = told.iter().all(|s| is_there(&s.joint_position, &stands));
        assert!(stays, "{stands:?}, told {:?}", told.last());
    }

    /// Gives power, which moves nothing.
    fn switch_on(&self, then: MachineState) {
        let _drives = self.operated.wait_for_drives();
        let stands = self.stands();
        self.operate(&["enable"]);
        let status = self.operated.wait_for(then);
        assert_eq!(status.power(), Ok(Power::On));
        self.still(40);
        assert!(is_there(&self.stands(), &stands));
    }

    fn come_home(&self) {
        self.operate(&["home"]);
        let status = self.operated.wait_for(MachineState::Idle);
        assert_eq!(status.homed, 0b111);
        self.still(40);
    }

    /// The present position as bits.
    fn place(&self) -> [u64; 9] {
        self.operated.wait(|_| true).position.map(f64::to_bits)
    }

    fn take_note(&self, cause: FaultCause) {
        let status = self.operated.wait_for(MachineState::Faulted);
        assert_eq!(status.fault(), Ok(Some(cause)));
        self.operate(&["reset"]);
    }

    /// A program with a tool, the spindle, an input, and a code of the machine's own; held on its
    /// way, left, and returned to.
    fn part(&self, part: &str) {
        let (machine, stack) = (&self.operated, &self.stack);
        machine.refused(&["acknowledge"], 5, "no event is awaited");
        let running = machine.process(&["run-file", part]);
        let status = machine.wait_for(MachineState::Awaiting);
        assert_eq!((status.awaited_value, status.awaited_line), (6.0, 2));
        let event = |offset: u64| format!("{}/{}", status.epoch, status.awaited_sequence + offset);
        machine.refused(&["acknowledge", "--event", "9999/1"], 5, "another event");
        machine.refused(&["acknowledge", "--event", &event(1)], 5, "too early");
        // Late, and a second time.
        self.still(250);
        self.operate(&["acknowledge"]);
        let _asks = machine.wait(|status| (status.awaited_value - 66.0).abs() < 1e-9);
        machine.refused(&["acknowledge", "--event", &event(0)], 5, "");
        self.still(100);
        stack.inject(InjectedFault::Input(3, true));
        let status = machine.wait(|status| (status.awaited_value - 101.0).abs() < 1e-9);
        assert_eq!(status.message.as_str(), "input 1.000000");
        assert_eq!(status.awaited_words.get(CodeWord::Q), Some(-2.5));
        self.operate(&["acknowledge"]);
        let _moving = machine.wait(|status| status.line == 9 && status.feed_v > 20.0);
        self.operate(&["hold"]);
        let held = machine.wait_for(MachineState::Held);
        assert!(held.path_s > held.block_path_s, "held within a block");
        self.operate(&["jog", "X1", "Z2", "--feed", "3000"]);
        machine.refused(&["resume"], 5, "return first");
        self.operate(&["return"]);
        let back = machine
            .wait(|s| s.state == MachineState::Held.code() && s.away.map(f64::to_bits) == [0; 9]);
        assert_eq!(
            back.position.map(f64::to_bits),
            held.position.map(f64::to_bits)
        );
        self.still(40);
        let resumed = self.tape.length();
        self.operate(&["resume"]);
        // Told in front of its motion, and answered during it.
        let told = self.told(resumed, 110.0);
        let event = format!("{}/{}", told.epoch, told.sequence);
        self.operate(&["acknowledge", "--event", &event]);
        machine.refused(&["acknowledge", "--event", &event], 5, "");
        let _done = running.wait().expect(0);
    }

    /// The setpoint that tells of an M code, behind a place of the tape.
    fn told(&self, behind: usize, code: f64) -> Setpoint {
        let is_it = |s: &&Setpoint| {
            let is_code = |event: &EventRecord| event.kind == EventKind::MCode.code();
            let told = s.events().iter().filter(|event| is_code(event));
            told.into_iter()
                .any(|event| (event.value - code).abs() < 1e-9)
        };
        loop {
            if let Some(told) = self.tape.since(behind).iter().find(is_it) {
                return *told;
            }
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// An input slows a program down, and holds it.
    fn slowed(&self, way: &str) {
        let (machine, stack) = (&self.operated, &self.stack);
        stack.inject(InjectedFault::Analog(2, 0.5));
        self.operate(&["mdi", "M52 P1"]);
        let running = machine.process(&["run-file", way]);
        let _half = machine.wait(|s| s.line > 1 && (s.effective_override - 0.5).abs() < 1e-3);
        stack.inject(InjectedFault::Analog(2, 0.0));
        let status = machine.wait_for(MachineState::Held);
        assert!(status.adaptive_feed <= 0.0 && status.feed_override >= 1.0);
        self.still(100);
        let told = machine.operate(&["status"]).stdout;
        assert!(told.contains("lets through 0 %"), "{told}");
        stack.inject(InjectedFault::Analog(2, 1.0));
        let _done = running.wait().expect(0);
        self.operate(&["mdi", "M52 P0"]);
        stack.inject(InjectedFault::Analog(2, 0.0));
    }

    /// The power goes while something moves, or is about to; nothing does afterwards, until
    /// somebody asks.
    fn lose_power(&self, way: &str, chance: &mut Chance) {
        let machine = &self.operated;
        let jog = ["jog", "X8", "Y-3", "--feed", "3000"];
        let moves: [&[&str]; 4] = [&["run-file", way], &["run-file", way], &jog, &["home"]];
        let moving = machine.process(moves[chance.below(4)]);
        std::thread::sleep(chance.millis(0, 900));
        self.stack.inject(InjectedFault::EmergencyStop(true));
        let _off = machine.wait(|status| status.power() == Ok(Power::Off));
        let stands = self.stands();
        self.still(60);
        self.stack.inject(InjectedFault::EmergencyStop(false));
        // What was asked for ends, as it may; its process does in any case.
        let _ended = moving.wait();
        self.still(60);
        assert!(is_there(&self.stands(), &stands));
        if machine.wait(|_| true).state == MachineState::Faulted.code() {
            self.take_note(FaultCause::EnableLost);
        }
        let _drives = machine.wait_for_drives();
        self.operate(&["enable"]);
        let on = machine.wait(|s| s.power() == Ok(Power::On));
        self.still(40);
        assert!(is_there(&self.stands(), &stands));
        if on.homed != 0b111 {
            self.come_home();
        }
    }
}

#[test]
#[allow(
    clippy::too_many_lines,
    reason = "one life of a machine, from step to step"
)]
fn a_life_from_cold_to_the_loss_of_every_process() {
    let number = |name: &str| std::env::var(name).ok().map(|text| text.parse().unwrap());
    let times = number("GLIDEPATH_LIFE").unwrap_or(SAMPLE);
    let mut chance = Chance::new(number("GLIDEPATH_LIFE_SEED").unwrap_or(1));
    let instance = Instance::for_processes();
    let _watchdog = Watchdog::new(Duration::from_secs(240 + 10 * times));

    // Drives that find their home by themselves.
    let with_home = joints([12.5, -3.0, 4.0], 100.0).map(|joint| JointSettings {
        switch: None,
        home: Some(HomeSettings {
            switch: joint.start - 3.0,
            velocity: 20.0,
            position: 1.5,
        }),
        ..joint
    });
    let life = Life::begin(&instance, "drive", &with_home);
    life.switch_on(MachineState::NotHomed);
    let taken_over = life.operated.wait(|_| true).position;
    let counted = [112.5_f64, 97.0, 104.0].map(f64::to_bits);
    assert_eq!(taken_over.map(f64::to_bits)[..3], counted);
    life.come_home();
    life.operated.assert_at([1.5; 3]);
    let _ended = life.interpolator.end().expect(0);
    drop(life.stack);
    assert_eq!(life.tape.judge(), Vec::<String>::new());

    // Joints that are brought home.
    let mut life = Life::begin(&instance, "controller", &joints([12.5, -3.0, 4.0], 100.0));
    let part = instance.file("part.ngc", PART);
    let way = instance.file("way.ngc", WAY);
    let mut service = life.operated.service();
    life.switch_on(MachineState::NotHomed);
    life.operated.refused(&["mdi", "G0 X1"], 5, "not homed");
    life.come_home();
    life.operated.assert_at([0.0; 3]);
    life.operate(&["jog", "X4", "Y2.5", "--feed", "3000"]);
    life.operated.assert_at([4.0, 2.5, 0.0]);
    life.still(40);
    life.operate(&["mdi", "G10 L20 P1 X0 Y0 Z0"]);
    life.operate(&["mdi", "G21 G90 G54 G0 X1"]);
    life.operated.assert_at([5.0, 2.5, 0.0]);

    life.part(&part);
    life.operated.assert_at([6.0, 4.5, 0.0]);
    life.slowed(&way);
    life.operate(&["mdi", "G0 X2 Y2"]);
    life.operated.assert_at([6.0, 4.5, 0.0]);
    let end = life.place();

    // Never acknowledged.
    let never = life.operated.process(&["mdi", "M150"]);
    life.take_note(FaultCause::AuxTimeout);
    let _failed = never.wait().expect(5);
    assert_eq!(life.place(), end);

    // Aborted, lifted, and begun in the middle.
    let running = life.operated.process(&["run-file", &way]);
    let _moving = life
        .operated
        .wait(|status| status.line == 3 && status.feed_v > 10.0);
    let before = life.operated.wait(|_| true).position[2];
    life.operate(&["abort"]);
    let _failed = running.wait().expect(5);
    let status = life.operated.wait_for(MachineState::Idle);
    assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Aborted));
    assert!(
        status.position[2] > before + 3.0,
        "{before}, {:?}",
        status.position
    );
    life.still(40);
    life.operate(&["run-file", &way, "--from-line", "4", "--yes"]);
    life.operated.assert_at([4.0, 2.5, 0.0]);

    for _ in 0..times {
        life.lose_power(&way, &mut chance);
    }

    // The service dies in motion, and another one knows where G54 is.
    let running = life.operated.process(&["run-file", &way]);
    let _moving = life.operated.wait(|status| status.feed_v > 10.0);
    service.signal(Signal::KILL);
    let _killed = service.wait();
    let _failed = running.wait();
    life.take_note(FaultCause::PlannerLost);
    life.still(60);
    service = life.operated.service();
    life.operate(&["mdi", "G21 G90 G54 G0 X0 Y0 Z0"]);
    life.operated.assert_at([4.0, 2.5, 0.0]);

    // The drives die in motion; those that come count from elsewhere.
    let running = life.operated.process(&["run-file", &way]);
    let _moving = life.operated.wait(|status| status.feed_v > 10.0);
    life.stack = ServoStack::start(&instance, 2, &[]);
    let status = life.operated.wait_for(MachineState::Faulted);
    assert_eq!(status.fault(), Ok(Some(FaultCause::FeedbackLost)));
    let _failed = running.wait().expect(5);
    let _off = life
        .operated
        .wait(|status| status.power() == Ok(Power::Off));
    life.stack = ServoStack::start(&instance, 3, &joints([1.0, 2.0, 3.0], -40.0));
    life.operate(&["reset"]);
    life.switch_on(MachineState::NotHomed);
    life.come_home();

    // The interpolator dies in motion: the drives stop by themselves, and another one finds them.
    let running = life.operated.process(&["run-file", &way]);
    let _moving = life.operated.wait(|status| status.feed_v > 10.0);
    life.interpolator.signal(Signal::KILL);
    let _killed = running.wait().expect(5);
    std::thread::sleep(Duration::from_millis(800));
    let stands = life.stands();
    life.interpolator = life.operated.process(&["interpolator", "--best-effort"]);
    life.switch_on(MachineState::NotHomed);
    assert!(is_there(&life.stands(), &stands));
    life.come_home();
    life.operate(&["mdi", "G21 G90 G54 G0 X0 Y0 Z0"]);
    life.operated.assert_at([4.0, 2.5, 0.0]);
    life.operate(&["disable"]);
    let _off = life.operated.wait_for(MachineState::Off);

    let _service = service.end().expect(0);
    let _ended = life.interpolator.end().expect(0);
    drop(life.stack);
    assert_eq!(life.tape.judge(), Vec::<String>::new());
}
