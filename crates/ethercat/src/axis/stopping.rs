//! The state of a drive that comes to rest by its own ramp, then without power.

use super::step::{DISABLE_VOLTAGE, Next, QUICK_STOP, Step};
use glidepath_link::DriveState;

/// How long a ramp may take.
const PATIENCE_NS: u64 = 3_000_000_000;
/// Cycles without motion that count as rest.
const STILL: u32 = 3;

#[derive(Debug, Clone)]
pub(super) struct Stopping {
    since_ns: u64,
    still: u32,
    place: Option<i64>,
}

impl Stopping {
    pub(super) const fn new(since_ns: u64) -> Self {
        Self {
            since_ns,
            still: 0,
            place: None,
        }
    }

    pub(super) fn step(&mut self, step: &mut Step<'_>) -> Next {
        let drive_inputs = step.drive_inputs;
        step.stand(QUICK_STOP);
        let place = Some(drive_inputs.inputs.actual);
        self.still = if self.place == place {
            self.still + 1
        } else {
            0
        };
        self.place = place;
        let drives = matches!(
            drive_inputs.state(),
            DriveState::OperationEnabled | DriveState::QuickStop
        );
        let is_late = drive_inputs.now_ns.saturating_sub(self.since_ns) > PATIENCE_NS;
        if drives && drive_inputs.is_present && self.still < STILL && !is_late {
            return Next::Stay;
        }
        step.stand(DISABLE_VOLTAGE);
        Next::Off
    }
}
