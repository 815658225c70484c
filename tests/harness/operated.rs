//! A machine with drives that answer: every process by itself, and everything it does an
//! operator's doing.

use std::time::{Duration, Instant};

use glidepath_link::{MachineState, Status, Transport as _};

use crate::{Instance, Output, Process};

/// How old what drives say may be, for them to be there, ns.
const FRESH_NS: u64 = 12_000_000;

/// The processes of an instance with a configuration of their own.
#[derive(Debug)]
pub struct Operated<'a> {
    instance: &'a Instance,
    config: String,
}

impl<'a> Operated<'a> {
    /// The built-in machine, with drives that answer, `changes` of its configuration, each of
    /// which must find what it changes, and `tables` behind it.
    #[must_use]
    pub fn new(instance: &'a Instance, changes: &[(&str, &str)], tables: &str) -> Self {
        let printed = Process::start(instance, &["config", "--default"]).wait();
        let mut text = printed.expect(0).stdout;
        let drives = [
            ("source = \"none\"", "source = \"drives\""),
            // A host of tests may stand still for a second, and its drives with it.
            ("# stale_s = 0.012 ", "stale_s = 2.0 "),
            ("off_s = 0.1 ", "off_s = 3.0 "),
            ("\nfollowing_error = 1.0 ", "\nfollowing_error = 50.0 "),
            ("min_following_error = 0.1 ", "min_following_error = 50.0 "),
        ];
        for (from, to) in drives.iter().chain(changes) {
            assert!(text.contains(from), "{from}: {text}");
            text = text.replace(from, to);
        }
        Self {
            instance,
            config: instance.file("machine.toml", &format!("{text}{tables}")),
        }
    }

    /// A machine that is shipped (`lathe`), with drives that answer, and `tables` behind it.
    #[must_use]
    pub fn shipped(instance: &'a Instance, name: &str, tables: &str) -> Self {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../config");
        let text = std::fs::read_to_string(format!("{folder}/{name}.toml")).unwrap();
        let drives = "[feedback]\nsource = \"drives\"\nfollowing_error = 50.0\nmin_following_error = 50.0\n\
                      stale_s = 2.0\noff_s = 3.0\n";
        let text = format!("{text}\n{drives}{tables}");
        Self {
            instance,
            config: instance.file("machine.toml", &text),
        }
    }

    /// The path of the configuration.
    #[must_use]
    pub fn config(&self) -> &str {
        &self.config
    }

    /// Starts a process of the machine, or what an operator types.
    #[must_use]
    pub fn process(&self, arguments: &[&str]) -> Process {
        let config = ["--config", &self.config];
        Process::join(self.instance, &[arguments, &config].concat())
    }

    /// Starts the planner's service; it takes jobs.
    #[must_use]
    pub fn service(&self) -> Process {
        let service = self.process(&["planner", "--listen"]);
        service.wait_until_it_is_ready();
        service
    }

    /// Types what must be done.
    pub fn operate(&self, arguments: &[&str]) -> Output {
        self.process(arguments).wait().expect(0)
    }

    /// Types what must be refused, with an exit code and words that tell why.
    pub fn refused(&self, arguments: &[&str], exit: i32, words: &str) {
        let output = self.process(arguments).wait().expect(exit);
        assert!(output.stderr.contains(words), "{words}: {output:#?}");
    }

    /// Waits for a status that pleases.
    pub fn wait(&self, wanted: impl Fn(&Status) -> bool) -> Status {
        self.instance.wait_for_status(wanted)
    }

    /// Whether the machine comes to a state in some time.
    #[must_use]
    pub fn comes_to(&self, state: MachineState, in_time: Duration) -> bool {
        let transport = self.instance.connect();
        let mut source = transport.status_source().unwrap();
        let begun = Instant::now();
        while begun.elapsed() < in_time {
            let told = source.take().unwrap();
            if told.is_some_and(|status| status.state == state.code()) {
                return true;
            }
            std::thread::sleep(Duration::from_millis(2));
        }
        false
    }

    /// Waits for a state of the machine.
    pub fn wait_for(&self, state: MachineState) -> Status {
        self.wait(|status| status.state == state.code())
    }

    /// Waits until the machine is off, with drives that say where they are.
    pub fn wait_for_drives(&self) -> Status {
        let off = MachineState::Off.code();
        self.wait(|status| status.state == off && status.feedback_age_ns < FRESH_NS)
    }

    /// Where X, Y and Z are, once the machine is ready.
    #[must_use]
    pub fn position(&self) -> [f64; 3] {
        let status = self.wait_for(MachineState::Idle);
        [status.position[0], status.position[1], status.position[2]]
    }

    /// Asserts that X, Y and Z are somewhere, once the machine is ready.
    pub fn assert_at(&self, wanted: [f64; 3]) {
        let position = self.position();
        let mut both = position.iter().zip(wanted);
        let is_there = both.all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(is_there, "{position:?}, wanted {wanted:?}");
    }
}
