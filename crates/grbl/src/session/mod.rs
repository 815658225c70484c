//! One sender: its lines, what it was told, and what it has the machine do.

mod answers;
mod awaited;
mod code;
mod machine_seen;
mod questions;
mod real_time;
mod statement;
#[cfg(test)]
mod tests;
mod waiting;

use std::collections::VecDeque;
use std::time::Duration;

use crate::error::ErrorNumber;
use crate::intake::{Heard, Intake, Line};
use crate::jogging::Jogging;
use crate::numbers::Units;
use crate::overrides::Overrides;
use crate::report::{BUFFER, MACHINE_POSITION, Reporter};
use crate::stream::{Request, Stream, Told};
use crate::{Act, Alarm, Doing, Facts, MachineSettings, MachineView};
use awaited::{Reset, Waiting};

/// Bytes that are kept of what a sender sends without being answered, whatever it was told: it is read no
/// further.
const MOST_KEPT: usize = 4096;
/// Bytes that wait for a sender that does not read.
const MOST_UNSENT: usize = 32 * 1024;

/// What keeps lines from being begun.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Latch {
    Free,
    Hold,
    Door,
}

/// One sender after the other, and what is known of the machine.
#[derive(Debug)]
pub struct Session {
    settings: MachineSettings,
    machine: MachineView,
    facts: Facts,
    ahead_t: f64,
    intake: Intake,
    /// Received and not answered, the oldest first.
    lines: VecDeque<Line>,
    /// So many of them were given to the stream.
    given: usize,
    stream: Stream,
    jogging: Jogging,
    waiting: Waiting,
    reset: Option<Reset>,
    /// Aborts that the machine has not answered.
    aborts: u32,
    latch: Latch,
    alarm: Option<Alarm>,
    /// A machine that does not know where it is may be jogged.
    is_unlocked: bool,
    is_checking: bool,
    is_asleep: bool,
    /// `$10` and `$13`.
    mask: u32,
    units: Units,
    overrides: Overrides,
    reporter: Reporter,
    heard_at: Duration,
    /// When what is heard now was sent at the earliest.
    asked_ns: u64,
    reports: u32,
    spindle_was_told: bool,
    /// For the next sender.
    note: Option<String>,
    acts: Vec<Act>,
    out: Vec<u8>,
}

impl Session {
    /// A machine that nobody has told of, and no sender.
    #[must_use]
    pub fn new(settings: MachineSettings) -> Self {
        Self {
            settings,
            machine: MachineView::default(),
            facts: Facts::default(),
            ahead_t: 0.0,
            intake: Intake::default(),
            lines: VecDeque::new(),
            given: 0,
            stream: Stream::default(),
            jogging: Jogging::default(),
            waiting: Waiting::Nothing,
            reset: None,
            aborts: 0,
            latch: Latch::Free,
            alarm: None,
            is_unlocked: false,
            is_checking: false,
            is_asleep: false,
            mask: MACHINE_POSITION | BUFFER,
            units: Units::Millimetre,
            overrides: Overrides::WHOLE,
            reporter: Reporter::default(),
            heard_at: Duration::ZERO,
            asked_ns: 0,
            reports: 0,
            spindle_was_told: false,
            note: None,
            acts: Vec::new(),
            out: Vec::new(),
        }
    }

    /// A sender has connected. `now` is the time since any fixed instant, here and everywhere.
    pub fn connected(&mut self, now: Duration) {
        (self.mask, self.units) = (MACHINE_POSITION | BUFFER, Units::Millimetre);
        (self.heard_at, self.reports) = (now, 0);
        self.spindle_was_told = false;
        self.welcome();
        if let Some(note) = self.note.take() {
            self.message(&note);
        }
    }

    /// The sender has gone. Lines that were read are executed, up to the end of the last, and jogs come to rest. One
    /// that leaves with lines unanswered, or in the middle of one, is lost: these lines are dropped, and the next sender
    /// finds a hold.
    pub fn lost(&mut self) {
        if self.jogging.cancel() {
            self.acts.push(Act::LetGo);
        }
        // One that was told `ok` for all that it sent has left when it was done, as far as anybody can tell: what it
        // sent is executed to its end.
        let dropped = self.lines.len();
        let is_cut = dropped > 0 || self.intake.open_bytes() > 0;
        // At rest, with all executed that was read; the job may be open for a moment yet.
        let rests = matches!(self.machine.doing, Doing::Waiting | Doing::Idle)
            && !self.stream.has_unread()
            && self.ahead_t <= 0.0;
        let was_open = self.stream.is_open() && !rests;
        self.stream.abandon();
        self.lines.clear();
        self.given = 0;
        self.intake = Intake::default();
        (self.waiting, self.is_checking) = (Waiting::Nothing, false);
        if was_open && is_cut {
            self.latch = Latch::Hold;
        }
        if dropped > 0 || was_open && is_cut {
            let lines = if dropped == 1 { "line" } else { "lines" };
            self.note = Some(format!(
                "The sender before was lost: {dropped} {lines} of it dropped"
            ));
        }
        self.out.clear();
    }

    /// When what is heard from now on was sent at the earliest, ns of any one clock. What is asked of the planner's
    /// service says it ([`Request::asked_ns`]).
    pub const fn ask_at(&mut self, asked_ns: u64) {
        self.asked_ns = asked_ns;
    }

    /// What a sender has sent.
    pub fn hear(&mut self, bytes: &[u8], now: Duration) {
        if !bytes.is_empty() {
            self.heard_at = now;
        }
        for byte in bytes {
            match self.intake.take(*byte) {
                None => {}
                Some(Heard::Line(line)) => self.lines.push_back(Line {
                    asked_ns: self.asked_ns,
                    ..line
                }),
                Some(Heard::RealTime(real_time)) => {
                    // What stands in front of it comes first.
                    self.process(now);
                    self.take_real_time(real_time, now);
                }
            }
        }
        self.process(now);
    }

    /// Nobody knows when what was heard just now was sent: its reader stood still. A jog of before is not begun,
    /// nor is what waits to be moved by hand.
    pub fn stood_still(&mut self) {
        for line in &mut self.lines {
            line.is_late = true;
        }
        if self.cancel_jogs() {
            self.message("The endpoint stood still: the jog is not begun, or ends");
        }
    }

    /// What waits is asked for now: a stop of this sender came before it, or was taken back. The machine hears of that
    /// stop later than of the lines.
    fn ask_anew(&mut self) {
        for line in &mut self.lines {
            line.asked_ns = self.asked_ns;
        }
        self.stream.ask_anew(self.asked_ns);
    }

    /// What is known of the machine now. To be called every few milliseconds.
    pub fn see(&mut self, machine: &MachineView, now: Duration) {
        let before = core::mem::replace(&mut self.machine, machine.clone());
        self.overrides.follow(&self.machine, now);
        self.tell_of_changes(&before);
        self.look_at_jogs(now);
        self.look_at_waiting(now);
        self.look_at_reset(now);
        self.process(now);
    }

    /// What the planner's service tells of lines.
    pub fn told(&mut self, told: &Told, now: Duration) {
        let probes = core::mem::replace(&mut self.facts, told.facts.clone()).probes;
        self.ahead_t = told.ahead_t;
        if self.facts.probes != probes {
            let line = self.facts.probe_line(self.units, &self.settings.axes);
            self.say(&line);
        }
        for outcome in self.stream.hear(told) {
            self.take_outcome(outcome, now);
        }
        self.process(now);
    }

    /// Nobody executes lines, for this reason.
    pub fn service_lost(&mut self, why: &str, now: Duration) {
        if let Some(outcome) = self.stream.lose_service(why) {
            self.take_outcome(outcome, now);
        }
        self.process(now);
    }

    /// What to ask the planner's service.
    pub fn request(&mut self) -> Request {
        let may_begin = self.latch == Latch::Free && self.reset.is_none() && !self.is_locked();
        self.stream.request(may_begin)
    }

    /// Whether the service is to be asked at once, and not only now and then.
    #[must_use]
    pub fn is_urgent(&self) -> bool {
        self.has_lines() || self.stream.is_resetting()
    }

    /// Whether lines are executed, or about to be.
    fn has_lines(&self) -> bool {
        self.stream.is_open() || self.stream.has_unread()
    }

    /// What the machine is to do, in this order.
    pub fn take_acts(&mut self) -> Vec<Act> {
        core::mem::take(&mut self.acts)
    }

    /// Has the motion ended. A reset is not over before the machine has answered: what is executed behind it would be
    /// ended, too.
    fn abort(&mut self) {
        self.aborts += 1;
        self.acts.push(Act::Abort);
    }

    /// An act was accepted.
    pub fn accepted(&mut self, act: &Act) {
        if *act == Act::Abort {
            self.aborts = self.aborts.saturating_sub(1);
        }
    }

    /// An act was refused.
    pub fn refused(&mut self, act: &Act, why: &str) {
        match act {
            Act::Abort => self.aborts = self.aborts.saturating_sub(1),
            // At rest there is nothing to hold or to end: what keeps lines from beginning is kept here.
            Act::Hold | Act::LetGo => {}
            // It was taken back, and what it waits for tells so.
            Act::Home(_) if matches!(self.waiting, Waiting::Home { is_ended: true, .. }) => {}
            Act::Home(_) if matches!(self.waiting, Waiting::Home { .. }) => {
                self.waiting = Waiting::Nothing;
                self.answer_error(ErrorNumber::NO_HOMING, why);
            }
            _ => self.message(why),
        }
    }

    /// Bytes for the sender.
    pub fn take_output(&mut self) -> Vec<u8> {
        core::mem::take(&mut self.out)
    }

    /// Whether the sender is to be read from: what it has sent is bounded, whatever it was told.
    #[must_use]
    pub fn wants_bytes(&self) -> bool {
        self.kept_bytes() < MOST_KEPT && self.out.len() < MOST_UNSENT
    }

    fn kept_bytes(&self) -> usize {
        let lines: usize = self.lines.iter().map(|line| line.bytes.min(300)).sum();
        lines + self.intake.open_bytes()
    }
}
