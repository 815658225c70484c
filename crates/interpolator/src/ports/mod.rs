//! The ports thread: everything that talks to other processes.
//!
//! Setpoints go out as soon as they are there. Then, each turn: commands in, frames in as long as the ring to the real-time thread has
//! room (what does not fit stays in the planner's queue, which pushes back), now and then a status,
//! and the leftovers of dead processes. It may allocate, log and wait; the real-time thread does
//! not notice.

mod frames;
mod links;

use crate::acknowledgements::Acknowledgements;
use crate::auxiliary::AuxiliaryBook;
use crate::commands::{CommandContext, is_refusal, passes_stop};
use crate::config::Config;
use crate::fault::Fault;
use crate::feedback::DriveMonitor;
use crate::frame_validation::FrameValidator;
use crate::job::JobBook;
use crate::jog::DemandReader;
use crate::message::{LogEvent, Order, PortsEnds, TickReport};
use crate::status::{StatusBook, grants_of};
use crate::stops::StopCause;
use crate::told_by_hand;
use glidepath_link::{
    Command, EndOfEpoch, FaultCause, LinkError, MachineState, Setpoint, SetpointFrame, Status,
    TOLD_TO_END, Transport, UnmetPrecondition,
};
use glidepath_realtime::{EventReader, Grants, Mode};
use links::Links;
use std::collections::VecDeque;

/// Records of feedback taken in one turn: those of nine stacks at 2 kHz and 4 ms.
const FEEDBACK_PER_TURN: usize = 72;
/// Commands served in one turn.
const COMMANDS_PER_TURN: usize = 8;
/// Demands for a jog passed on in one turn.
const DEMANDS_PER_TURN: usize = 16;
/// Between two statuses.
const STATUS_NS: u64 = 20_000_000;
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

    fn take_feedback(&mut self, now_ns: u64) -> Result<(), LinkError> {
        for _ in 0..FEEDBACK_PER_TURN {
            let (Some(source), Some(drives)) = (&mut self.links.feedback, &mut self.drives) else {
                return Ok(());
            };
            let Some(feedback) = source.take()? else {
                return Ok(());
            };
            let (Ok(told) | Err(told)) = drives.take(&feedback, now_ns);
            if !told.is_empty() {
                self.tell(&told);
            }
        }
        Ok(())
    }

    /// Tells the real-time thread what the drives say, and judges how they follow.
    fn observe(&mut self, now_ns: u64) -> Result<(), LinkError> {
        let (Some(drives), Some(report)) = (&mut self.drives, &self.report) else {
            return Ok(());
        };
        let observation = drives.observe(report, now_ns);
        // A full ring says that the real-time thread does not run; there is nobody to be told.
        self.ends.observations.enqueue(observation).ok();
        let news = drives.take_news();
        let (order, told) = drives.judge(report);
        for order in [order, drives.advance_homing(report, now_ns)]
            .into_iter()
            .flatten()
        {
            self.ends.order(order);
        }
        if let Some(told) = told {
            self.tell(&told);
        }
        if let Some(news) = news {
            self.tell(news);
        }
        Ok(())
    }

    fn serve_commands(&mut self, now_ns: u64) -> Result<(), LinkError> {
        let Some(report) = self.report else {
            return Ok(());
        };
        let number = Some(report.setpoint.number);
        let is_ordered = self.ordered_after == number || self.demanded_after == number;
        let mut desk = CommandContext {
            report,
            boot_id: self.boot_id,
            now_ns,
            drives: self.drives.as_mut(),
            acknowledgements: &mut self.acknowledgements,
            jobs: &mut self.jobs,
            frame_validator: &mut self.frame_validator,
            ends: &mut self.ends,
            is_ordered,
        };
        let (book, log) = (&mut self.book, &mut self.log);
        for _ in 0..COMMANDS_PER_TURN {
            let served = self.links.commands.serve(&mut |request| {
                let reply = desk.answer(request);
                let text = request.text.as_str();
                let command = request.command().ok().map(|command| desk.meant(command));
                let by_hand = told_by_hand::of_command(desk.report.state, command);
                let has_failed = matches!(command, Some(Command::Acknowledge { done: false, .. }));
                if command == Some(Command::Tell) {
                    log(text);
                    book.message(text);
                } else if has_failed && !is_refusal(&reply) && !text.is_empty() {
                    log(text);
                    book.last_error(text);
                    self.failure_is_explained = true;
                } else if let Some(text) = by_hand.filter(|_| !is_refusal(&reply)) {
                    book.last_error(text);
                } else if passes_stop(desk.report.state, command) && !is_refusal(&reply) {
                    // Whoever lets it pass has read what the program said there.
                    book.message("");
                } else if matches!(command, Some(Command::Job { .. })) {
                    // Its planner waits for that.
                    self.status_due_ns = 0;
                }
                book.status.commands_served += 1;
                book.status.commands_refused += u64::from(is_refusal(&reply));
                reply
            })?;
            if !served {
                break;
            }
        }
        if desk.is_ordered {
            self.ordered_after = number;
        }
        Ok(())
    }

    /// Passes demands for a jog on, in the order in which they came.
    fn pass_on_demands(&mut self) -> Result<(), LinkError> {
        let Some(report) = self.report else {
            return Ok(());
        };
        for _ in 0..DEMANDS_PER_TURN {
            let Some(record) = self.links.demands.take()? else {
                return Ok(());
            };
            match self.reader.read(&record) {
                Ok(mut demand) => {
                    demand.is_outdated = self.jobs.was_stopped_after(record.asked_ns);
                    let caller = (demand.client, demand.number);
                    let is_new = self.demanded_by.replace(caller) != Some(caller);
                    if demand.is_outdated && demand.wants_motion() {
                        // What was followed before the stop is told to have ended by it.
                        if is_new {
                            self.tell(UnmetPrecondition::StoppedSince.text());
                        }
                    } else if told_by_hand::may_begin(&report, &demand) {
                        self.book.last_error("");
                    }
                    self.demanded_after = Some(report.setpoint.number);
                    // A full ring is a real-time thread that hangs: nothing begins then.
                    self.ends.demand(demand);
                }
                Err(error) => {
                    if self.refused_jogger != Some(record.client) {
                        self.refused_jogger = Some(record.client);
                        self.tell(&error.to_string());
                    }
                }
            }
        }
        Ok(())
    }

    fn publish_status(&mut self, now_ns: u64) -> Result<(), LinkError> {
        if now_ns < self.status_due_ns {
            return Ok(());
        }
        self.status_due_ns = now_ns + STATUS_NS;
        let Some(report) = self.report else {
            return Ok(());
        };
        let waiting = self.ends.frames.len() as u64;
        self.book
            .write(&report, &self.frame_validator, waiting, now_ns);
        self.book.status.awaited_words = self.auxiliary.awaited_words();
        self.book.status.state = self.jobs.state(&report).code();
        self.jobs.write(&mut self.book.status);
        if let Some(drives) = &self.drives {
            drives.write(&mut self.book.status, now_ns);
        }
        self.links.setpoints.refresh()?;
        self.links.auxiliary.refresh()?;
        self.links.status.publish(&self.book.status)?;
        if !core::mem::replace(&mut self.has_told_ready, true) {
            (self.log)("ready: it gives setpoints and takes commands");
        }
        Ok(())
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

    /// Publishes a status at once: the last of this life.
    pub(crate) fn farewell(&mut self, now_ns: u64) {
        self.status_due_ns = 0;
        self.auxiliary.stop(StopCause::Abort);
        let told = self.publish_auxiliary();
        if let Err(error) = told.and(self.publish_status(now_ns)) {
            (self.log)(&error.to_string());
        }
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
