//! The judgement of commands: what may be done when, and the answer.
//!
//! A job that has the machine is a state of its own here. What would move the axes, or change where
//! they are, is refused then; what is to end a motion ends the job; a hold counts for its beginning.

use crate::ports::acknowledgements::Acknowledgements;
use crate::ports::feedback::DriveMonitor;
use crate::ports::frame_validation::FrameValidator;
use crate::ports::job::{JobBook, Told, unfit};
use crate::shared::message::{Order, PortsEnds, TickReport};
use glidepath_link::{
    Command, CommandOutcome, CommandRefusal, CommandReply, CommandRequest, DISABLED, EndOfEpoch,
    JobPhase, JobStage, MachineState, SWITCHED_OFF, UnmetPrecondition,
};

/// Orders that one command comes to, at most.
const ORDERS_PER_COMMAND: usize = 3;

/// The state that commands are judged by, and that they change.
pub(crate) struct CommandContext<'d, 'a> {
    pub(crate) report: TickReport,
    pub(crate) boot_id: u64,
    pub(crate) now_ns: u64,
    pub(crate) drives: Option<&'d mut DriveMonitor>,
    pub(crate) acknowledgements: &'d mut Acknowledgements,
    pub(crate) jobs: &'d mut JobBook,
    pub(crate) frame_validator: &'d mut FrameValidator,
    pub(crate) ends: &'d mut PortsEnds<'a>,
    /// The least and the highest spindle override.
    pub(crate) spindle_override: [f64; 2],
    /// Something was passed on that may change what the machine does: the next report tells.
    pub(crate) is_ordered: bool,
}

impl CommandContext<'_, '_> {
    /// Answers a command: passes it on to the real-time thread, or says why not.
    ///
    /// Acceptance means that the command is on its way. It is carried out at the next tick if the
    /// state then still allows it.
    pub(crate) fn answer(&mut self, request: &CommandRequest) -> CommandReply {
        let reported = self.report.state;
        self.report.state = self.jobs.state(&self.report);
        let state = self.report.state;
        let (outcome, message) = if self.has_room() {
            self.carry_out(request)
        } else {
            let why = CommandRefusal::Busy;
            (Err(why), why.text().to_owned())
        };
        self.report.state = reported;
        CommandReply::new(self.boot_id, request.number, outcome, state, &message)
    }

    /// What a command means on this machine: where no drive reports, there is no power to take, and
    /// what is left of switching off is that it ends the motion.
    pub(crate) fn meant(&self, command: Command) -> Command {
        let is_at_rest = matches!(
            self.report.state,
            MachineState::Idle | MachineState::Faulted
        );
        let ends_something = !is_at_rest || self.jobs.is_to_come();
        if command == Command::Disable && self.drives.is_none() && ends_something {
            return Command::Abort;
        }
        command
    }

    /// The override of the spindle, which no motion depends on: the auxiliary record has it.
    fn override_spindle(&self, ratio: f64) -> (CommandOutcome, String) {
        let [least, most] = self.spindle_override;
        if (least..=most).contains(&ratio) {
            return (Ok(()), String::new());
        }
        let [least, most, asked] = [least, most, ratio].map(|ratio| 100.0 * ratio);
        let why = format!(
            "a spindle override of {asked:.0} %: this machine allows {least:.0} to {most:.0} % (override_min \
             and override_max of [spindle])"
        );
        (Err(CommandRefusal::Malformed), why)
    }

    fn has_room(&self) -> bool {
        self.ends.room() >= ORDERS_PER_COMMAND
    }

    fn carry_out(&mut self, request: &CommandRequest) -> (CommandOutcome, String) {
        let wrong = |why: String| (Err(CommandRefusal::WrongState), why);
        let done = (Ok(()), String::new());
        let command = match request.command() {
            Err(error) => return (Err(CommandRefusal::Malformed), error.to_string()),
            Ok(Command::Ping | Command::Tell) => return done,
            Ok(Command::Job {
                number,
                phase,
                asked_ns,
                is_stream,
            }) => {
                let heard = self.hear_job((number, phase, asked_ns), request);
                self.jobs.note_stream(number, is_stream);
                return heard.map_or_else(wrong, |()| done);
            }
            Ok(Command::Acknowledge {
                event,
                done: is_done,
            }) => {
                let judged = self.acknowledgements.judge(event, is_done, &self.report);
                if let Err(why) = judged {
                    return wrong(why.text().to_owned());
                }
                self.acknowledgements.answer(event);
                self.order(Order::Command(Command::Acknowledge {
                    event,
                    done: is_done,
                }));
                return done;
            }
            Ok(Command::SpindleOverride(ratio)) => return self.override_spindle(ratio),
            Ok(command) => self.meant(command),
        };
        if command.sets_out() && self.jobs.was_stopped_after(request.asked_ns) {
            return wrong(UnmetPrecondition::StoppedSince.text().to_owned());
        }
        match self.judge(command) {
            Err(why) => return wrong(why.text().to_owned()),
            Ok(is_for_motion) => {
                self.tell_job(command, self.why_it_ends(request));
                if is_for_motion {
                    self.order(Order::Command(command));
                }
            }
        }
        self.is_ordered |= matches!(
            command,
            Command::Home(_)
                | Command::Unhome(_)
                | Command::SetPosition { .. }
                | Command::Enable
                | Command::Disable
        );
        done
    }

    /// A planner tells of its job.
    fn hear_job(
        &mut self,
        job: (u64, JobPhase, u64),
        request: &CommandRequest,
    ) -> Result<(), String> {
        let is_homing = self
            .drives
            .as_ref()
            .is_some_and(|monitor| monitor.is_homing());
        let free = if is_homing || self.is_ordered {
            Err("the machine was given another order")
        } else {
            unfit(self.report.state).map_or(Ok(()), Err)
        };
        let told = self.jobs.tell(job, request.text, self.now_ns, free)?;
        match told {
            Told::Nothing => {}
            Told::Takes => {
                self.order(Order::Prepare(true));
                if self.jobs.is_held() {
                    self.order(Order::Command(Command::Hold));
                }
            }
            Told::GivesBack => self.bar(),
        }
        Ok(())
    }

    /// Why a motion ends, or a job, that an abort ends or the loss of power; empty where an operator has it aborted.
    pub(crate) fn why_it_ends<'r>(&self, request: &'r CommandRequest) -> &'r str {
        let command = request.command();
        if command == Ok(Command::Abort) {
            request.text.as_str()
        } else if command != Ok(Command::Disable) {
            ""
        } else if self.drives.is_some() {
            SWITCHED_OFF
        } else {
            DISABLED
        }
    }

    /// What a command is to a job that has not begun.
    fn tell_job(&mut self, command: Command, why: &str) {
        if matches!(command, Command::Hold | Command::Resume) {
            self.jobs.hold(command == Command::Hold);
        }
        if command == Command::Hold {
            let is_open = self.report.end_of_epoch == EndOfEpoch::Open;
            self.jobs.hold_what_was_asked(self.now_ns, is_open);
        }
        if !matches!(command, Command::Abort | Command::Disable) {
            return;
        }
        let (stage, why) = if why.is_empty() {
            (JobStage::Aborted, "aborted before anything moved")
        } else {
            (JobStage::Refused, why)
        };
        self.jobs.stop(self.now_ns, (stage, why));
        let had_machine = self.jobs.end(stage, why);
        if let Some(epoch) = self.frame_validator.opening(self.report.setpoint.epoch) {
            self.frame_validator.bar(epoch);
            self.order(Order::Bar(epoch));
            self.jobs.does_not_begin(stage, why);
        } else if had_machine {
            self.bar();
        }
    }

    /// The machine is not a job's any more, and the epoch that would have come does not begin.
    fn bar(&mut self) {
        let epoch = self.frame_validator.next_epoch(self.report.setpoint.epoch);
        self.frame_validator.bar(epoch);
        self.order(Order::Bar(epoch));
        self.order(Order::Prepare(false));
    }

    fn order(&mut self, order: Order) {
        // There is room: that was looked at before.
        self.ends.order(order);
    }

    /// Whether the real-time thread has to know of a command.
    ///
    /// # Errors
    /// Why it is not possible.
    fn judge(&mut self, command: Command) -> Result<bool, UnmetPrecondition> {
        let report = &self.report;
        let is_for_job = command == Command::Resume && self.jobs.is_held();
        if !is_for_job && let Some(why) = precondition(command, report, self.drives.is_some()) {
            return Err(why);
        }
        match &mut self.drives {
            Some(monitor) => monitor.command(command, report, self.now_ns),
            None => Ok(true),
        }
    }
}

/// Why a command is not possible as things are, if it is not.
fn precondition(
    command: Command,
    report: &TickReport,
    has_drives: bool,
) -> Option<UnmetPrecondition> {
    use MachineState::{
        Awaiting, Faulted, Held, Holding, Homing, Idle, Jogging, NotHomed, Off, Preparing,
        ProgramStop, Stopping,
    };
    let (state, is_away) = (report.state, report.is_away);
    let (is_possible, why) = match command {
        Command::Ping
        | Command::Tell
        | Command::Abort
        | Command::RapidOverride(_)
        | Command::JogOverride(_)
        | Command::SpindleOverride(_)
        | Command::SingleBlock(_) => return None,
        Command::FeedOverride(ratio) if ratio >= 0.0 => return None,
        Command::FeedOverride(_) | Command::Reverse => {
            (may_have_path(state), UnmetPrecondition::NoPathBack)
        }
        Command::Forward => (may_have_path(state), UnmetPrecondition::NoPathForward),
        // At rest it is held already.
        Command::Hold => (state != Homing, UnmetPrecondition::HomingNotHeld),
        Command::Resume | Command::Step if is_away => (false, UnmetPrecondition::Away),
        Command::Resume | Command::Step if rests_by_override(report) => {
            (false, no_override(report))
        }
        Command::Resume => (
            matches!(state, Holding | Held | ProgramStop),
            UnmetPrecondition::NothingHeld,
        ),
        Command::Reset if report.fault.is_some() => {
            (state == Faulted, UnmetPrecondition::NotAtRestYet)
        }
        Command::Reset => (state == Faulted, UnmetPrecondition::NoFault),
        Command::StopAtEndOfBlock => (
            !matches!(
                state,
                Idle | Preparing | Faulted | Stopping | Jogging | Off | NotHomed | Homing
            ),
            UnmetPrecondition::NoBlock,
        ),
        Command::Step => (
            matches!(state, Holding | Held | ProgramStop),
            UnmetPrecondition::NoStep,
        ),
        Command::SetPosition { .. } | Command::Home(_) | Command::Unhome(_)
            if state == Preparing =>
        {
            (false, UnmetPrecondition::JobHasMachine)
        }
        Command::Enable
        | Command::Disable
        | Command::SetPosition { .. }
        | Command::Home(_)
        | Command::Unhome(_) => (has_drives, UnmetPrecondition::Simulated),
        Command::Return if report.end_of_epoch != EndOfEpoch::Open => {
            (false, UnmetPrecondition::NoPathToReturn)
        }
        Command::Return if !is_away => (false, UnmetPrecondition::OnPath),
        Command::Return => (
            matches!(state, Held | ProgramStop | Awaiting),
            UnmetPrecondition::Moving,
        ),
        // They are judged by themselves.
        Command::Acknowledge { .. } | Command::Job { .. } => return None,
    };
    (!is_possible).then_some(why)
}

/// Whether a program runs, or may, in a state: there is a path then, to go back and forward along.
const fn may_have_path(state: MachineState) -> bool {
    use MachineState::{Faulted, Homing, Idle, NotHomed, Off, Preparing};
    !matches!(state, Idle | Preparing | Faulted | Off | NotHomed | Homing)
}

/// Whether an override of 0 keeps the machine at rest, and nothing that a resume ends. On the way back
/// along the path the feed override is below 0, or -0.
fn rests_by_override(report: &TickReport) -> bool {
    let rests = matches!(report.state, MachineState::Held | MachineState::Holding);
    let is_onward = report.feed_override.is_sign_positive();
    let is_zero = report.feed_override <= 0.0 || report.rapid_override <= 0.0;
    rests && is_onward && is_zero && !report.is_held
}

/// Which override that is.
fn no_override(report: &TickReport) -> UnmetPrecondition {
    if report.feed_override <= 0.0 {
        UnmetPrecondition::NoFeed
    } else {
        UnmetPrecondition::NoRapid
    }
}

/// Whether a reply refuses.
pub(crate) fn is_refusal(reply: &CommandReply) -> bool {
    !matches!(reply.outcome(), Ok(CommandOutcome::Ok(())))
}

/// Whether a command, once it is accepted, lets a stop pass that the program has made for a person.
pub(crate) const fn passes_stop(state: MachineState, command: Option<Command>) -> bool {
    let goes_on = matches!(command, Some(Command::Resume | Command::Step));
    goes_on && matches!(state, MachineState::ProgramStop)
}
