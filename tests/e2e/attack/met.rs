//! The states of the machine and the phases of a job in which orders came.

use std::collections::BTreeMap;
use std::fmt;

use glidepath_link::{JobStage, MachineState, Status};

/// How often orders came in each.
#[derive(Debug, Default)]
pub(super) struct Met {
    states: BTreeMap<String, u64>,
    stages: BTreeMap<String, u64>,
}

impl Met {
    /// An order comes while the machine says this.
    pub(super) fn take(&mut self, status: &Status) {
        if let Ok(state) = status.state() {
            *self.states.entry(format!("{state:?}")).or_default() += 1;
        }
        if let Ok(stage) = status.job_stage() {
            *self.stages.entry(format!("{stage:?}")).or_default() += 1;
        }
    }

    /// Those in which none came, though an attack that is long enough comes to all of them.
    pub(super) fn missed(&self) -> Vec<String> {
        use MachineState::{
            Awaiting, Faulted, Held, Homing, Idle, Jogging, NotHomed, Off, Preparing, ProgramStop,
            Running,
        };
        let states = [
            Awaiting,
            Faulted,
            Held,
            Homing,
            Idle,
            Jogging,
            NotHomed,
            Off,
            Preparing,
            ProgramStop,
            Running,
        ];
        let stages = [
            JobStage::Waiting,
            JobStage::Preparing,
            JobStage::Begun,
            JobStage::Over,
            JobStage::Aborted,
        ];
        let states = states.map(|state| format!("{state:?}"));
        let stages = stages.map(|stage| format!("{stage:?}"));
        let states = states
            .iter()
            .filter(|name| !self.states.contains_key(*name));
        let stages = stages
            .iter()
            .filter(|name| !self.stages.contains_key(*name));
        states.chain(stages).cloned().collect()
    }
}

impl fmt::Display for Met {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (what, counts) in [("state", &self.states), ("job", &self.stages)] {
            for (name, count) in counts {
                writeln!(f, "{count:6} orders with {what} {name}")?;
            }
        }
        Ok(())
    }
}
