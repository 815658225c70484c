//! The panel of one who jogs, by steps or by keys: the demands, and what the machine says.

use super::demands::Demands;
use crate::command::failure::Failure;
use crate::command::other_users::OtherUsers;
use crate::config::MachineConfig;
use core::time::Duration;
use glidepath_geometry::{AXES, Axis};
use glidepath_link::{
    InterpolatorProcess, Ipc, LinkConfig, LinkError, MachineState, Record as _, Status, Subscriber,
    Transport as _, UnmetPrecondition,
};
use glidepath_realtime::{Clock as _, Monotonic};
use std::time::Instant;

/// How long an interpolator may be silent: it shows its status every 20 ms.
const PATIENCE: Duration = Duration::from_secs(1);
const POLL: Duration = Duration::from_millis(2);

/// The panel of one who jogs.
pub(in crate::command) struct Panel {
    pub(super) demands: Demands,
    status: Box<dyn Subscriber<Status>>,
    last: Status,
    axes: Vec<Axis>,
    link: LinkConfig,
    _transport: Ipc,
}

impl Panel {
    /// Joins an instance, and waits for its status.
    ///
    /// # Errors
    /// The link cannot be used, or nothing is heard of the interpolator.
    pub(super) fn open(link: &LinkConfig, config: &MachineConfig) -> Result<Self, Failure> {
        let transport = Ipc::connect(link)?;
        let demands = Demands::new(transport.jog_sink()?);
        let mut status = transport.status_source()?;
        let started = Instant::now();
        let last = loop {
            if let Some(status) = fresh(&mut *status)? {
                break status;
            }
            if started.elapsed() > PATIENCE {
                return Err(gone(link));
            }
            std::thread::sleep(POLL);
        };
        Ok(Self {
            demands,
            status,
            last,
            axes: config.axis_names(),
            link: link.clone(),
            _transport: transport,
        })
    }

    /// The latest status.
    ///
    /// # Errors
    /// The interpolator is heard of no more.
    pub(super) fn status(&mut self) -> Result<&Status, Failure> {
        if let Some(status) = fresh(&mut *self.status)? {
            self.last = status;
        }
        let age = Monotonic.now_ns().saturating_sub(self.last.updated_ns);
        if Duration::from_nanos(age) > PATIENCE {
            return Err(gone(&self.link));
        }
        Ok(&self.last)
    }

    /// What the machine does.
    pub(super) fn state(&mut self) -> Result<MachineState, Failure> {
        Ok(self.status()?.state().map_err(LinkError::from)?)
    }

    /// Whether what was asked for last moves the axes, or did.
    ///
    /// # Errors
    /// The interpolator is heard of no more.
    pub(super) fn is_followed(&mut self) -> Result<bool, Failure> {
        let status = *self.status()?;
        Ok(self.demands.asked().is_followed(&status))
    }

    /// Positions of the axes that the machine has.
    pub(super) fn position(&self) -> Vec<(Axis, f64)> {
        self.of_axes(&self.last.position)
    }

    /// How far the axes are from the path.
    pub(super) fn away(&self) -> Vec<(Axis, f64)> {
        self.of_axes(&self.last.away)
    }

    fn of_axes(&self, values: &[f64; AXES]) -> Vec<(Axis, f64)> {
        let value = |axis: &Axis| Some((*axis, *values.get(axis.index())?));
        self.axes.iter().filter_map(value).collect()
    }

    /// Why the machine cannot be jogged as it is, if it cannot.
    pub(in crate::command) const fn precondition(state: MachineState) -> Option<UnmetPrecondition> {
        match state {
            MachineState::Idle
            | MachineState::NotHomed
            | MachineState::Held
            | MachineState::ProgramStop
            | MachineState::Awaiting => None,
            MachineState::Faulted => Some(UnmetPrecondition::FaultLatched),
            MachineState::Off => Some(UnmetPrecondition::NeedsPower),
            MachineState::Preparing => Some(UnmetPrecondition::JobHasMachine),
            MachineState::Homing => Some(UnmetPrecondition::HomingAlready),
            MachineState::Running
            | MachineState::Holding
            | MachineState::Starving
            | MachineState::Starved
            | MachineState::Stopping
            | MachineState::Waiting => Some(UnmetPrecondition::NoJogNow),
            MachineState::Jogging => Some(UnmetPrecondition::ByHand),
        }
    }
}

/// Nothing is heard of the interpolator: it has ended, or hangs.
fn gone(link: &LinkConfig) -> Failure {
    let instance = link.instance.clone();
    match InterpolatorProcess::find(link) {
        Ok(Some(process)) => Failure::Silent {
            instance,
            process: process.id(),
            waited_s: PATIENCE.as_secs(),
        },
        Ok(None) => Failure::NoInterpolator {
            instance,
            // It was there.
            others: OtherUsers::default(),
        },
        Err(error) => error.into(),
    }
}

/// The newest status there is, checked.
fn fresh(port: &mut dyn Subscriber<Status>) -> Result<Option<Status>, LinkError> {
    let mut newest = None;
    while let Some(status) = port.take()? {
        status.check()?;
        newest = Some(status);
    }
    Ok(newest)
}
