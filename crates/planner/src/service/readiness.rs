//! The readiness of the machine for a program, and the point at which the one before it was left.

use std::time::Duration;

use glidepath_geometry::AxisVector;
use glidepath_link::{LinkError, MachineState};

use crate::exchange::machine::POLL;
use crate::publish::frame_publisher::FramePublisher;
use crate::run::control::{Control, Notice};
use crate::run::error::RunError;
use crate::source::resume::ResumePoint;

/// Without news for so long, the caller is told what is waited for.
const NOTICE_AFTER: Duration = Duration::from_secs(1);

/// Between two clean-ups of what dead processes hold, while waiting.
const CLEAN_UP_INTERVAL: Duration = Duration::from_secs(1);

impl FramePublisher<'_> {
    /// Tells the interpolator of a job by its name and when it was asked for (as [`FramePublisher::claim`] has it), and waits
    /// until that has the machine; returns where the machine stands. No fault is reset: that is for whoever has looked at its cause.
    ///
    /// # Errors
    /// [`RunError::Interrupted`] by the stop flag, [`RunError::Fault`] if a fault is latched, the job
    /// was aborted while it waited, [`RunError::PeriodMismatch`], or a failure of the link.
    pub fn wait_until_ready(
        &mut self,
        (name, asked_ns): (&str, u64),
        control: &mut Control<'_>,
    ) -> Result<AxisVector, RunError> {
        let mut told = None;
        self.claim(name, asked_ns, control);
        loop {
            if control.is_stopped() {
                return Err(RunError::Interrupted);
            }
            if let Some(position) = self.take(control)? {
                return Ok(position);
            }
            self.idle(control)?;
            self.tend(POLL)?;
            let state = self.machine.status().and_then(|status| status.state().ok());
            // In these the job has the machine in a moment.
            let is_coming = matches!(state, Some(MachineState::Idle | MachineState::Preparing));
            if self.idle_t >= NOTICE_AFTER && told != Some(state) && !is_coming {
                (control.notify)(&state.map_or(Notice::NoInterpolator, Notice::NotReady));
                told = Some(state);
            }
        }
    }

    /// Waits a little while there is no epoch, and now and then frees what dead processes hold.
    pub(crate) fn idle(&mut self, control: &mut Control<'_>) -> Result<(), LinkError> {
        self.machine.pause(POLL, control);
        self.idle_t += POLL;
        if self
            .idle_t
            .as_nanos()
            .is_multiple_of(CLEAN_UP_INTERVAL.as_nanos())
        {
            self.transport.clean_up_dead_peers()?;
            self.transport.stands()?;
        }
        Ok(())
    }

    /// Why the machine is not ready, for people.
    pub(crate) fn why_not_ready(&self) -> String {
        let state = self.machine.status().and_then(|status| status.state().ok());
        let why = match (state, self.transport.interpolator_process()) {
            (None, None) => "no interpolator runs",
            (None, Some(process)) => {
                &format!("the interpolator (process {process}) lives and does not answer")
            }
            (Some(MachineState::Idle), _) => "it became ready just now; ask again",
            (Some(state), _) => state.text(),
        };
        format!("the machine is not ready for a program: {why}")
    }

    /// One look at whether the machine is ready for a job, and where it stands.
    ///
    /// # Errors
    /// A fault is latched, [`RunError::PeriodMismatch`], or a failure of the link.
    pub(crate) fn ready(&mut self) -> Result<Option<AxisVector>, RunError> {
        self.machine.observe()?;
        let Some(status) = self.machine.status() else {
            return Ok(None);
        };
        if status.period_ns != self.pace.period_ns {
            return Err(RunError::PeriodMismatch {
                planner_ns: self.pace.period_ns,
                interpolator_ns: status.period_ns,
            });
        }
        if status.state().map_err(LinkError::from)? == MachineState::Faulted {
            return Err(RunError::fault(status));
        }
        Ok(self.machine.ready_position())
    }

    /// The point at which the program that was under way can be taken up again, of a machine that
    /// is ready.
    ///
    /// # Errors
    /// [`RunError::Resume`]: there is no such program.
    pub fn resume_point(&self) -> Result<ResumePoint, RunError> {
        let status = self.machine.status().ok_or(RunError::InterpolatorLost)?;
        ResumePoint::of(status)
    }
}
