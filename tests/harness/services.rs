//! The processes of a machine, each by itself.

use std::path::Path;

use glidepath_link::{MachineState, Status};
use rustix::process::Signal;
use serde_json::Value;

use crate::{Instance, Process, SetpointFile};

/// The setpoints `plan` computes.
#[must_use]
pub fn planned(instance: &Instance, program: &str) -> SetpointFile {
    let csv = instance.path("plan.csv");
    let _report = Process::start(instance, &["plan", program, "--setpoints", &csv, "--json"])
        .wait()
        .expect(0);
    let setpoints = SetpointFile::read(Path::new(&csv));
    assert!(!setpoints.is_still(), "an empty plan proves nothing");
    setpoints
}

/// Interpolator and mock servo, as services would run them.
#[derive(Debug)]
pub struct Services<'a> {
    instance: &'a Instance,
    interpolator: Process,
    servo: Process,
    csv: String,
}

impl<'a> Services<'a> {
    /// Starts both, and waits until the machine is ready.
    #[must_use]
    pub fn start(instance: &'a Instance) -> Self {
        let csv = instance.path("servo.csv");
        let servo = Process::join(
            instance,
            &["servo", "--best-effort", "--setpoints", &csv, "--json"],
        );
        let interpolator = Process::join(instance, &["interpolator", "--best-effort"]);
        let services = Self {
            instance,
            interpolator,
            servo,
            csv,
        };
        let _idle = services.wait_for(MachineState::Idle);
        services
    }

    /// Waits for a state of the machine.
    #[must_use]
    pub fn wait_for(&self, state: MachineState) -> Status {
        self.wait(|status| status.state == state.code())
    }

    /// Waits for a status that pleases.
    #[must_use]
    pub fn wait(&self, wanted: impl Fn(&Status) -> bool) -> Status {
        self.instance.wait_for_status(wanted)
    }

    /// Kills the interpolator, and ends the servo, which misses it.
    pub fn kill_interpolator(self) {
        self.interpolator.signal(Signal::KILL);
        let _killed = self.interpolator.wait();
        let _servo = self.servo.end().expect(0);
    }

    /// Ends both; returns what the servo received, and its report.
    #[must_use]
    pub fn end(self) -> (SetpointFile, Value) {
        let _interpolator = self.interpolator.end().expect(0);
        let report = self.servo.end().expect(0).json();
        (SetpointFile::read(Path::new(&self.csv)), report)
    }
}
