//! The ports thread: everything that talks to other processes.
//!
//! Setpoints go out as soon as they are there. Then, each turn: commands in, frames in as long as the ring to the real-time thread has
//! room (what does not fit stays in the planner's queue, which pushes back), now and then a status,
//! and the leftovers of dead processes. It may allocate, log and wait; the real-time thread does
//! not notice.

mod commands;
mod demands;
mod feedback;
mod frames;
mod links;
mod statuses;

use crate::ports::acknowledgements::Acknowledgements;
use crate::ports::auxiliary::AuxiliaryBook;
use crate::ports::demand_reader::DemandReader;
use crate::ports::feedback::DriveMonitor;
use crate::ports::frame_validation::FrameValidator;
use crate::ports::job::JobBook;
use crate::ports::status::{StatusBook, grants_of};
use crate::shared::config::Config;
use crate::shared::config::stops::StopCause;
use crate::shared::fault::Fault;
use crate::shared::message::{LogEvent, Order, PortsEnds, TickReport};
use glidepath_link::{
    Command, EndOfEpoch, FaultCause, LinkError, MachineState, Setpoint, SetpointFrame, Status,
    TOLD_TO_END, Transport,
};
use glidepath_realtime::{EventReader, Grants, Mode};
use links::Links;
use std::collections::VecDeque;

/// Between two looks for dead processes.
const CLEAN_UP_NS: u64 = 200_000_000;

/// The state of the ports thread.
pub(crate) struct Ports<'a> {
    links: Links,
    ends: PortsEnds<'a>,
    log_events: EventReader<'a, LogEvent>,
    log: &'a mut dyn FnMut(&str),
    frame_validator: FrameValidator,
    reader: DemandReader,
    /// The client whose demand was passed on last, and its number.
    demanded_by: Option<(u64, u64)>,
    /// Number of the setpoint after which a demand was passed on that may begin a jog.
    demanded_after: Option<u64>,
    /// The client whose demand was refused last, so that the log names it once.
    refused_jogger: Option<u64>,
    drives: Option<DriveMonitor>,
    /// A frame that is to be judged again.
    pending: Option<SetpointFrame>,
    /// Reports whose setpoints were handed over, to be taken note of in the next turn.
    handed_over: VecDeque<TickReport>,
    /// How handing over went since the last turn.
    handing_over: Result<(), LinkError>,
    report: Option<TickReport>,
    book: StatusBook,
    auxiliary: AuxiliaryBook,
    acknowledgements: Acknowledgements,
    /// It was said why an event or a port has failed, and the fault that comes of it is not told yet.
    failure_is_explained: bool,
    jobs: JobBook,
    /// Number of the setpoint after which an order was passed on that a job waits for.
    ordered_after: Option<u64>,
    boot_id: u64,
    /// The least and the highest spindle override.
    spindle_override: [f64; 2],
    status_due_ns: u64,
    clean_up_due_ns: u64,
    failing: bool,
    /// Nobody finds this instance any more: what was removed.
    removed: Option<String>,
    has_told_ready: bool,
}

impl<'a> Ports<'a> {
    pub(crate) fn new(
        config: &Config,
        boot_id: u64,
        transport: Box<dyn Transport>,
        ends: PortsEnds<'a>,
        log_events: EventReader<'a, LogEvent>,
        log: &'a mut dyn FnMut(&str),
    ) -> Result<Self, LinkError> {
        Ok(Self {
            links: Links::new(transport, config.feedback.is_some())?,
            ends,
            log_events,
            log,
            frame_validator: FrameValidator::new(config),
            reader: DemandReader::new(config),
            demanded_by: None,
            demanded_after: None,
            refused_jogger: None,
            drives: config
                .feedback
                .map(|settings| DriveMonitor::new(config, settings)),
            pending: None,
            handed_over: VecDeque::new(),
            handing_over: Ok(()),
            report: None,
            book: StatusBook::new(config, boot_id),
            auxiliary: AuxiliaryBook::new(boot_id, config.m_code_waits, config.stops),
            acknowledgements: Acknowledgements::new(boot_id, config.m_code_waits),
            failure_is_explained: false,
            jobs: JobBook::new(),
            ordered_after: None,
            boot_id,
            spindle_override: config.spindle_override,
            status_due_ns: 0,
            clean_up_due_ns: 0,
            failing: false,
            removed: None,
            has_told_ready: false,
        })
    }

    /// Tells what the real-time thread was granted.
    pub(crate) fn granted(&mut self, grants: &Grants, mode: Mode) {
        for refusal in grants.refusals() {
            (self.log)(&format!("not granted: {refusal}"));
        }
        self.book.status.grants = grants_of(grants, mode).0;
    }

    /// What the real-time thread last reported.
    pub(crate) fn state(&self) -> Option<MachineState> {
        self.report.map(|report| report.state)
    }

    /// What was removed by which others found this process: nobody can stop a motion any more, or clear a fault.
    pub(crate) const fn removed(&self) -> Option<&String> {
        self.removed.as_ref()
    }

    /// Asks the motion to end, because the process is to end, and says so.
    pub(crate) fn abort(&mut self) {
        // Whoever was found no more has said why.
        if self.removed.is_none() {
            self.book.last_error(TOLD_TO_END);
        }
        self.ends.order(Order::Command(Command::Abort));
    }

    pub(crate) const fn status(&self) -> &Status {
        &self.book.status
    }

    /// Hands over the setpoints that are there, by a clock; true if there were any since the last turn.
    /// What else a report tells is for the turn.
    pub(crate) fn hand_over(&mut self, now: &dyn Fn() -> u64) -> bool {
        while let Some(report) = self.ends.reports.dequeue() {
            match self.links.setpoints.publish(&report.setpoint) {
                Ok(()) => self.book.published(&report.setpoint, now()),
                Err(error) if self.handing_over.is_ok() => self.handing_over = Err(error),
                Err(_) => {}
            }
            self.handed_over.push_back(report);
        }
        !self.handed_over.is_empty()
    }

    /// One turn, by a clock. A port that fails stops the motion, and is tried again at the next turn.
    pub(crate) fn turn(&mut self, now: &dyn Fn() -> u64) {
        let now_ns = now();
        self.write_log();
        self.hand_over(now);
        let done = [
            core::mem::replace(&mut self.handing_over, Ok(())),
            self.take_reports(),
            self.take_feedback(now_ns),
            self.serve_commands(now_ns),
            self.pass_on_demands(),
            // Before the frames: they are judged by the position that the drives report.
            self.observe(now_ns),
            self.move_frames(),
            self.watch_job(now_ns),
            self.publish_status(now_ns),
            self.clean_up(now_ns),
        ];
        let error = done.into_iter().find_map(Result::err);
        if let Some(error) = &error
            && !self.failing
        {
            // Where the instance was removed, other ports may fail by that first.
            let removed = self.look_whether_it_stands().err();
            self.tell(&removed.as_ref().unwrap_or(error).to_string());
            self.failure_is_explained = true;
            self.fault(Fault::new(FaultCause::Ports, 0, 0));
        }
        self.failing = error.is_some();
    }

    /// To the log, and to whoever reads the status.
    fn tell(&mut self, text: &str) {
        (self.log)(text);
        self.book.last_error(text);
    }

    fn fault(&mut self, fault: Fault) {
        // The ring has room for many more orders than there are commands in a turn.
        self.ends.order(Order::Fault(fault));
    }

    /// Takes note of the reports whose setpoints were handed over.
    fn take_reports(&mut self) -> Result<(), LinkError> {
        while let Some(report) = self.handed_over.pop_front() {
            self.book.count(&report);
            self.auxiliary.note(&report);
            self.acknowledgements.note(&report);
            if let Some(drives) = &mut self.drives {
                drives.note(&report);
            }
            let is_new_fault = self.report.is_none_or(|before| before.fault.is_none());
            if let Some(fault) = report.fault.filter(|_| is_new_fault) {
                let why = self
                    .drives
                    .as_mut()
                    .and_then(|drives| drives.explain(&fault));
                let is_explained = core::mem::take(&mut self.failure_is_explained)
                    && matches!(fault.cause, FaultCause::AuxFailed | FaultCause::Ports);
                match why {
                    // What was said is the last error already, and stands behind the fault.
                    None if is_explained => (self.log)(&fault.to_string()),
                    None => self.tell(&fault.to_string()),
                    // The fault itself is in the status.
                    Some(why) => {
                        (self.log)(&format!("{fault}: {why}"));
                        self.book.last_error(&why);
                    }
                }
            }
            self.report = Some(report);
        }
        self.publish_auxiliary()
    }

    fn publish_auxiliary(&mut self) -> Result<(), LinkError> {
        match self.auxiliary.changed() {
            Some(record) => self.links.auxiliary.publish(record),
            None => Ok(()),
        }
    }

    /// The real-time thread is no more: latches that as the cause, and says so.
    pub(crate) fn real_time_died(&mut self, now_ns: u64) {
        if let Some(report) = &mut self.report {
            let Setpoint { line, sequence, .. } = report.setpoint;
            let fault = Fault::new(FaultCause::RealTime, line, sequence);
            report.fault = Some(fault);
            report.state = MachineState::Faulted;
            if report.end_of_epoch == EndOfEpoch::Open {
                report.end_of_epoch = EndOfEpoch::Faulted;
            }
            self.tell(&fault.to_string());
        }
        self.auxiliary.stop(StopCause::Fault);
        self.farewell(now_ns);
    }

    fn clean_up(&mut self, now_ns: u64) -> Result<(), LinkError> {
        if now_ns < self.clean_up_due_ns {
            return Ok(());
        }
        self.clean_up_due_ns = now_ns + CLEAN_UP_NS;
        let dead = self.links.transport.clean_up_dead_peers()?;
        if dead > 0 {
            let ending = if dead == 1 { "" } else { "es" };
            (self.log)(&format!("cleaned up after {dead} dead process{ending}"));
        }
        if self.removed.is_some() {
            return Ok(());
        }
        self.look_whether_it_stands()
    }

    /// Looks whether others still find this process.
    fn look_whether_it_stands(&mut self) -> Result<(), LinkError> {
        let stands = self.links.transport.stands();
        if let Err(LinkError::Removed { path }) = &stands {
            self.removed = Some(path.clone());
        }
        stands
    }

    fn write_log(&mut self) {
        while let Some(log_event) = self.log_events.read() {
            let text = log_event.to_string();
            (self.log)(&text);
            self.book.last_event(&text);
        }
        let dropped = self.log_events.newly_dropped();
        if dropped > 0 {
            (self.log)(&format!("{dropped} log lines lost"));
        }
    }
}
