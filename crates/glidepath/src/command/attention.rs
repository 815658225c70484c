//! The calls for attention: what a person is to do for a job, told at the client that waits for it.

use super::tool_names::ToolNames;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::output;
use crate::report::awaited_code;
use glidepath_interpolator::{AnswerSource, MCodeWaits};
use glidepath_link::{
    Auxiliary, Ipc, LinkError, MachineState, Record as _, Status, Subscriber, Transport as _,
};
use glidepath_program::Event;
use std::time::{Duration, Instant};

/// How long what is said of a stop may be on its way.
const MOMENT: Duration = Duration::from_millis(150);

/// A hold, or another state that is over sooner, needs no word.
const PASSING: Duration = Duration::from_secs(1);
/// Between two looks of whoever does something else meanwhile.
const EVERY: Duration = Duration::from_millis(20);
/// How long nothing is heard of an interpolator before it is said that it is waited for.
const SILENCE: Duration = Duration::from_secs(1);

/// What the machine waits for, and what of it was told.
struct Attention {
    statuses: Box<dyn Subscriber<Status>>,
    records: Box<dyn Subscriber<Auxiliary>>,
    told: Option<Auxiliary>,
    names: ToolNames,
    /// Who answers the M codes that are waited for.
    m_code_waits: MCodeWaits,
    /// Whether anything was heard of an interpolator.
    is_heard: bool,
    /// The fault that the machine stands by, and what to do about it.
    fault: Option<String>,
    /// Where something was asked, since when, and whether that was told: the epoch, the frames
    /// executed and the code of the state. What is said of it comes a moment later.
    asked: Option<((u64, u64, u32), Instant, bool)>,
}

/// A client's waiting, at which it looks now and then what the machine waits for.
pub(super) struct Waiting {
    attention: Option<Attention>,
    began: Instant,
    looked: Instant,
    is_heard: bool,
}

impl Waiting {
    /// `None` for a client that says nothing. Where the machine cannot be watched, only that is not told.
    pub(super) fn new(of: Option<(&Ipc, &MachineConfig)>) -> Self {
        Self {
            attention: of.and_then(|(transport, config)| Attention::new(transport, config).ok()),
            began: Instant::now(),
            looked: Instant::now(),
            is_heard: false,
        }
    }

    /// Lets time pass.
    pub(super) fn pause(&mut self, time: Duration) {
        std::thread::sleep(time);
        if self.looked.elapsed() < EVERY {
            return;
        }
        self.looked = Instant::now();
        if let Some(attention) = &mut self.attention
            && let Err(failure) = attention.look()
        {
            self.attention = None;
            output::note(&format!(
                "what the machine waits for is not told any more: {failure}; see `glidepath status`"
            ));
        }
    }

    /// The fault that the machine stands by, as far as it was looked at.
    pub(super) fn fault(&self) -> Option<&str> {
        self.attention.as_ref()?.fault.as_deref()
    }

    /// The same of a client that says by nothing else that it waits for an interpolator.
    pub(super) fn pause_for_interpolator(&mut self, time: Duration) {
        self.pause(time);
        let Some(attention) = self.attention.as_ref().filter(|_| !self.is_heard) else {
            return;
        };
        self.is_heard = attention.is_heard;
        if !self.is_heard && self.began.elapsed() >= SILENCE {
            self.is_heard = true;
            output::note("waiting for an interpolator: start `glidepath interpolator`");
        }
    }
}

impl Attention {
    fn new(transport: &Ipc, config: &MachineConfig) -> Result<Self, Failure> {
        Ok(Self {
            statuses: transport.status_source()?,
            records: transport.auxiliary_source()?,
            told: None,
            names: ToolNames::new(config),
            m_code_waits: config.m_code_waits(),
            is_heard: false,
            fault: None,
            asked: None,
        })
    }

    /// Tells what is waited for, once.
    fn look(&mut self) -> Result<(), Failure> {
        while let Some(record) = self.records.take()? {
            record.check().map_err(LinkError::from)?;
            self.told = Some(record);
        }
        let mut newest = None;
        while let Some(status) = self.statuses.take()? {
            status.check().map_err(LinkError::from)?;
            newest = Some(status);
        }
        let Some(status) = newest else {
            return Ok(());
        };
        self.is_heard = true;
        self.fault = fault_of(&status);
        let Some(words) = self.words(&status) else {
            self.asked = None;
            return Ok(());
        };
        let place = (status.epoch, status.frames_executed, status.state);
        let of_place = self.asked.filter(|(asked, ..)| *asked == place);
        let (_, since, is_told) = of_place.unwrap_or((place, Instant::now(), false));
        let is_asked = matches!(
            status.state(),
            Ok(MachineState::Awaiting | MachineState::ProgramStop)
        );
        let moment = if is_asked { MOMENT } else { PASSING };
        let is_due = !is_told && since.elapsed() >= moment;
        if is_due {
            output::note(&words);
        }
        self.asked = Some((place, since, is_told || is_due));
        Ok(())
    }

    fn words(&self, status: &Status) -> Option<String> {
        let state = status.state().ok()?;
        if state == MachineState::ProgramStop {
            let said = match status.message.as_str() {
                "" => String::new(),
                said => format!(" ({said})"),
            };
            return Some(format!(
                "line {}{said}: {}",
                status.line,
                status.state_text().unwrap_or_default()
            ));
        }
        if state == MachineState::Held {
            let doing = status.state_text().unwrap_or_default();
            return Some(match status.line {
                0 => doing.to_string(),
                line => format!("line {line}: {doing}"),
            });
        }
        if not_ready(state) {
            let doing = status.state_text().unwrap_or_default();
            return Some(format!("waiting for the machine: {doing}"));
        }
        if state == MachineState::Preparing && status.job_held == 1 {
            return Some("the job begins held; `glidepath resume` begins it".to_owned());
        }
        if state != MachineState::Awaiting {
            return None;
        }
        let line = status.awaited_line;
        let (Event::MCode(code) | Event::Await(code)) = status.awaited_event().ok()?? else {
            // The spindle answers that.
            return None;
        };
        let answer = self
            .m_code_waits
            .of(code)
            .map(|m_code_wait| m_code_wait.answer);
        let done = how_done(answer)?;
        let asked = match self.names.asked_tool(status, self.told.as_ref()) {
            Some(tool) if tool.number == 0 => "take the tool out of the spindle".to_owned(),
            Some(tool) => format!("change to {tool}"),
            None if code == 6 => "change the tool".to_owned(),
            None => format!("the program asks {}", awaited_code(status)),
        };
        Some(format!(
            "line {line}: {asked}; {done}, and if it cannot be done: `glidepath acknowledge --fail \"why\"`"
        ))
    }
}

/// What is to be said of a fault that is latched.
fn fault_of(status: &Status) -> Option<String> {
    let cause = status.fault().ok()??;
    Some(format!(
        "the machine stopped by a fault: {}; {}",
        status.fault_text().unwrap_or_default(),
        cause.remedy()
    ))
}

/// Whether no job can begin, for as long as the state lasts.
const fn not_ready(state: MachineState) -> bool {
    use MachineState::{Faulted, Homing, Jogging, NotHomed, Off, Stopping};
    matches!(
        state,
        Faulted | Homing | Jogging | NotHomed | Off | Stopping
    )
}

/// How it is known that what was asked is done; `None`: the spindle says so, and nobody has to do anything.
fn how_done(answer: Option<AnswerSource>) -> Option<String> {
    match answer {
        None | Some(AnswerSource::Nobody | AnswerSource::Acknowledgement) => {
            Some("when that is done: `glidepath acknowledge`".to_owned())
        }
        Some(AnswerSource::Input { number, .. }) => {
            Some(format!("input {number} says when that is done"))
        }
        Some(AnswerSource::Planner) => Some("the input says when that is done".to_owned()),
        Some(
            AnswerSource::SpindleAtSpeed
            | AnswerSource::SpindleStopped
            | AnswerSource::SpindleOriented
            | AnswerSource::SpindleInGear
            | AnswerSource::SpindleAngle,
        ) => None,
    }
}
