//! The mirror as iceoryx2's own command line records it.

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use glidepath_link::Setpoint;
use glidepath_testing::leave_out;
use glidepath_tests::{Instance, Process};
use rustix::process::Signal;

use super::{PATIENCE, Seen, root};

/// A recording under way.
#[derive(Debug)]
pub(super) struct Recording {
    process: Process,
    file: String,
}

impl Recording {
    /// Begins to record, where the command line is installed.
    pub(super) fn start(instance: &Instance) -> Option<Self> {
        let there = Command::new("iox2").args(["service", "--version"]).output();
        if !there.is_ok_and(|output| output.status.success()) {
            leave_out("the mirror read by iox2", "iox2 is not installed");
            return None;
        }
        // It looks for the configuration of its domain in the directory that it runs in.
        std::fs::create_dir_all(instance.path("config")).unwrap();
        let domain = format!("[global]\nroot-path = \"{}\"\n", root(instance));
        let _config = instance.file("config/iceoryx2.toml", &domain);
        let service = format!("glidepath/{}/setpoints", instance.config().instance);
        let file = instance.path("recorded");
        let iox2 = |arguments: &[&str]| {
            let arguments = [&["service"], arguments].concat();
            Process::start_other(Path::new("iox2"), instance, &arguments)
        };
        let process = iox2(&["record", "-o", &file, &service]);
        let recording = Self { process, file };
        let begun = Instant::now();
        while recording.setpoints().is_empty() {
            assert!(begun.elapsed() < PATIENCE / 4, "{recording:?} is empty");
            std::thread::sleep(Duration::from_millis(20));
        }
        let told = iox2(&["details", &service]).wait().expect(0).stdout;
        let size = format!("size: {}", size_of::<Setpoint>());
        let is_told = told.contains("glidepath.SetpointMirror.v") && told.contains(&size);
        assert!(is_told && told.contains("glidepath-mirror"), "{told}");
        Some(recording)
    }

    /// Ends it; gives what it has.
    pub(super) fn end(self) -> Vec<Setpoint> {
        self.process.signal(Signal::INT);
        let setpoints = self.setpoints();
        let _ended = self.process.wait();
        setpoints
    }

    /// What is in its file, which is text, as far as it is written.
    fn setpoints(&self) -> Vec<Setpoint> {
        let text = std::fs::read_to_string(&self.file).unwrap_or_default();
        let payloads = text
            .lines()
            .filter_map(|line| line.strip_prefix("payload:"));
        let bytes = |payload: &str| {
            let bytes = payload.split_whitespace();
            bytes
                .map(|byte| u8::from_str_radix(byte, 16).unwrap())
                .collect::<Vec<u8>>()
        };
        let whole = payloads
            .map(bytes)
            .filter(|bytes| bytes.len() == size_of::<Setpoint>());
        whole
            .map(|bytes| bytemuck::pod_read_unaligned(&bytes))
            .collect()
    }
}

impl Seen {
    /// The same of whole setpoints.
    pub(super) fn of_setpoints(setpoints: &[Setpoint]) -> Self {
        let position = |it: &Setpoint| [it.position[0], it.position[1], it.position[2]];
        let seen = setpoints
            .iter()
            .map(|it| (it.number, it.line, position(it)));
        Self {
            setpoints: seen.collect(),
            gaps: Vec::new(),
        }
    }
}
