//! The machine as senders see it, from what the interpolator tells.

use crate::config::MachineConfig;
use glidepath_geometry::{AXES, AxisVector};
use glidepath_grbl::{Alarm, Doing, MachineView, Spindle};
use glidepath_link::{
    Auxiliary, Coolant, FaultCause, FrameRefusal, MachineState, SpindleState, Status,
};
use glidepath_program::Event;
use glidepath_realtime::{Clock as _, Monotonic};

/// A status that is older tells nothing of the machine any more, ns.
const OLD_NS: u64 = 1_000_000_000;

/// What the interpolator told last.
pub(super) struct View {
    home: AxisVector,
    status: Option<Status>,
    auxiliary: Option<Auxiliary>,
}

impl View {
    pub(super) fn new(config: &MachineConfig) -> Self {
        Self {
            home: config.home(),
            status: None,
            auxiliary: None,
        }
    }

    pub(super) fn take(&mut self, status: Status) {
        self.status = Some(status);
    }

    pub(super) fn told(&mut self, told: Auxiliary) {
        self.auxiliary = Some(told);
    }

    /// The last status, if it is fresh.
    pub(super) fn status(&self) -> Option<&Status> {
        let now_ns = Monotonic.now_ns();
        let is_fresh = |status: &&Status| now_ns.saturating_sub(status.updated_ns) < OLD_NS;
        self.status.as_ref().filter(is_fresh)
    }

    /// Where the axes were commanded to be last.
    pub(super) fn position(&self) -> AxisVector {
        self.status.map_or(self.home, |status| {
            AxisVector::from(status.position) + AxisVector::from(status.away)
        })
    }

    /// All that a sender is told, with the zero of programs there.
    pub(super) fn machine(&self, zero: [f64; AXES]) -> MachineView {
        let mut machine = MachineView {
            position: self.position().into(),
            zero,
            ..MachineView::default()
        };
        if let Some(told) = &self.auxiliary {
            machine.spindle = match told.spindle() {
                Ok(SpindleState::Clockwise) => Spindle::Clockwise,
                Ok(SpindleState::Counterclockwise) => Spindle::Counterclockwise,
                Ok(SpindleState::Stopped | SpindleState::Oriented) | Err(_) => Spindle::Off,
            };
            if machine.spindle != Spindle::Off {
                machine.spindle_rpm = told.spindle_rpm();
            }
            machine.flood = told.coolant().contains(Coolant::FLOOD);
            machine.mist = told.coolant().contains(Coolant::MIST);
        }
        let Some(status) = self.status() else {
            return machine;
        };
        machine.doing = doing(status);
        machine.feed_v = status.feed_v;
        machine.feed_r = status.feed_override.abs();
        machine.rapid_r = status.rapid_override;
        machine.spindle_r = status.spindle_override;
        machine.line = status.line;
        machine.is_away = status.away.iter().any(|away| away.abs() > 0.0);
        machine.fault = fault(status);
        machine.message = match machine.doing {
            Doing::AwaitingTool => {
                let tool = self.auxiliary.map_or(0, |told| told.prepared_tool);
                format!("Tool {tool}: change it, then resume")
            }
            Doing::ProgramStop if status.message.as_str().is_empty() => {
                "The program waits: resume".to_owned()
            }
            _ => status.message.as_str().to_owned(),
        };
        machine
    }
}

fn doing(status: &Status) -> Doing {
    match status.state() {
        Err(_) => Doing::Unknown,
        Ok(state) => match state {
            MachineState::Idle => Doing::Idle,
            MachineState::Preparing => Doing::Preparing,
            MachineState::Running | MachineState::Starving => Doing::Running,
            MachineState::Holding => Doing::Holding,
            MachineState::Held => Doing::Held,
            MachineState::Starved | MachineState::Waiting => Doing::Waiting,
            MachineState::ProgramStop => Doing::ProgramStop,
            MachineState::Awaiting => match status.awaited_event() {
                Ok(Some(Event::MCode(6) | Event::Await(6))) => Doing::AwaitingTool,
                _ => Doing::Awaiting,
            },
            MachineState::Stopping => Doing::Stopping,
            MachineState::Jogging => Doing::Jogging,
            MachineState::Homing => Doing::Homing,
            MachineState::NotHomed => Doing::NotHomed,
            MachineState::Off => Doing::Off,
            MachineState::Faulted => Doing::Faulted,
        },
    }
}

/// Why the machine stopped by itself, as an alarm of grbl.
fn fault(status: &Status) -> Option<(Alarm, String)> {
    let cause = status.fault().ok().flatten()?;
    let alarm = match cause {
        FaultCause::LimitSwitch => Alarm::HardLimit,
        FaultCause::Frame(FrameRefusal::SoftLimit) => Alarm::SoftLimit,
        FaultCause::Homing => Alarm::Homing,
        FaultCause::EnableLost => Alarm::EmergencyStop,
        FaultCause::AuxTimeout
        | FaultCause::AuxFailed
        | FaultCause::SpindleSpeed
        | FaultCause::SpindleDrive
        | FaultCause::SpindleGear => Alarm::Spindle,
        FaultCause::Drive | FaultCause::DeviceLost | FaultCause::BusLost => Alarm::Motor,
        FaultCause::ProbeContact => Alarm::ProbeAtFirst,
        FaultCause::Frame(_)
        | FaultCause::PlannerLost
        | FaultCause::MissedTicks
        | FaultCause::Output
        | FaultCause::Ports
        | FaultCause::RealTime
        | FaultCause::FeedbackLost
        | FaultCause::FollowingError
        | FaultCause::SetpointsLost
        | FaultCause::SpindleAngle
        | FaultCause::ThreadLost
        | FaultCause::TapOvertravel => Alarm::Stopped,
    };
    Some((alarm, status.fault_text().unwrap_or_default()))
}
