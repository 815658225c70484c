//! The inbox: the lines of a job between whoever takes them in and whoever reads them.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use glidepath_gcode::InForce;
use glidepath_geometry::AxisVector;
use glidepath_link::{LinesReply, LinesRequest, LinesState, LongText, Text};

use super::facts::{Found, LineFacts};
use super::followed::Followed;
use super::storing::stores;

/// Text that was taken and not read, at most, bytes.
const MOST_UNREAD: usize = 4096;

/// How long no line comes before the motion rests at the end of those that have, if there is no more of it to
/// publish.
const FLUSH: Duration = Duration::from_millis(20);

/// The same for a machine that stands and has several moves: a program begins, and senders pause in its first
/// windows, by up to 0.2 s. A motion that rests at the end of one would mark the part.
const FLUSH_AT_START: Duration = Duration::from_millis(250);

/// How long no line comes before the job ends, when all is executed.
const LINGER: Duration = Duration::from_millis(100);

/// What is told of motion that is to come and is not planned, s.
const UNPLANNED_T: f64 = 1e-3;

/// How a job of lines has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LinesEnd {
    Done,
    NotBegun,
    Failed,
}

/// Why a line ends its job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum LastLine {
    /// M2, M30.
    EndsProgram,
    /// It stores something that outlasts programs.
    Stores,
}

/// A line that was refused.
#[derive(Debug, Clone, Default)]
pub(super) struct Refused {
    pub(super) column: u32,
    pub(super) diagnostic: String,
    pub(super) text: String,
    pub(super) in_motion: bool,
}

/// The lines of a job, and what came of them. Clones are the same.
#[derive(Debug, Clone)]
pub struct LineInbox(Arc<Mutex<Inbox>>);

impl PartialEq for LineInbox {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Eq for LineInbox {}

#[derive(Debug)]
struct Inbox {
    unread: VecDeque<u8>,
    taken: u64,
    read: u64,
    /// When a line came last, or a client was told last that one was read: until then it may have to wait.
    heard: Instant,
    /// Lines that a client was told to be read.
    told: u64,
    /// Moves given out since all was executed.
    moves: u64,
    /// How much motion may be ahead, s.
    most_ahead_t: f64,
    followed: Followed,
    /// Nothing more is read when what was taken is.
    is_closing: bool,
    /// Nothing more is taken or read.
    is_over: bool,
    /// The line given last stores something ([`stores`]): no line is given behind it.
    is_storing: bool,
    /// The line that ends the job, which counts as read when the job is over, and why it does.
    last: Option<(u64, LastLine)>,
    refused: Option<Refused>,
    end: Option<(LinesEnd, String)>,
    facts: LineFacts,
    found: Found,
    /// The zero behind a block, for those that are not executed.
    zeros: VecDeque<(u32, AxisVector)>,
    zero: AxisVector,
    /// What is in force behind a block, likewise.
    states: VecDeque<(u32, InForce)>,
    state: Option<InForce>,
}

impl Inbox {
    /// Motion that is to come, s: above 0 as long as anything that was given out is not executed, also where it is
    /// not planned yet.
    const fn ahead_t(&self) -> f64 {
        match self.followed {
            Followed { rests: true, .. } => 0.0,
            Followed { ahead_t, .. } => ahead_t.max(UNPLANNED_T),
        }
    }
}

impl LineInbox {
    /// Without a line, for a machine that is set up so.
    pub(crate) fn new(facts: LineFacts, found: Found) -> Self {
        let zero = facts.zero;
        Self(Arc::new(Mutex::new(Inbox {
            unread: VecDeque::new(),
            taken: 0,
            read: 0,
            heard: Instant::now(),
            told: 0,
            moves: 0,
            most_ahead_t: 1.0,
            followed: Followed {
                rests: true,
                ..Followed::default()
            },
            is_closing: false,
            is_over: false,
            is_storing: false,
            last: None,
            refused: None,
            end: None,
            facts,
            found,
            zeros: VecDeque::new(),
            zero,
            states: VecDeque::new(),
            state: None,
        })))
    }

    fn lock(&self) -> MutexGuard<'_, Inbox> {
        // Nothing is left half done where a thread can panic.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    // For whoever takes lines in.

    /// Takes the lines of a request that were not taken before, as far as there is room.
    pub(crate) fn take(&self, request: &LinesRequest) {
        let mut inbox = self.lock();
        inbox.most_ahead_t = request.ahead_t;
        let lines = request.text.as_str().split_inclusive('\n');
        for (number, line) in (request.first..).zip(lines) {
            if inbox.is_over || inbox.is_closing {
                return;
            }
            if number != inbox.taken + 1 {
                continue;
            }
            if inbox.unread.len() + line.len() >= MOST_UNREAD {
                return;
            }
            inbox.unread.extend(line.bytes());
            if !line.ends_with('\n') {
                inbox.unread.push_back(b'\n');
            }
            inbox.taken += 1;
            inbox.heard = Instant::now();
        }
    }

    /// The job ends behind what was read.
    pub(crate) fn close(&self) {
        let mut inbox = self.lock();
        inbox.is_closing = true;
        inbox.unread.clear();
    }

    /// How far the lines are executed.
    pub(crate) fn follow(&self, followed: &Followed) {
        let mut inbox = self.lock();
        // What rests goes on when something is given out, and not before.
        let rests = inbox.followed.rests || followed.rests;
        inbox.followed = Followed { rests, ..*followed };
        if rests {
            inbox.moves = 0;
        }
        let block = followed.block;
        while let Some((behind, zero)) = inbox.zeros.front().copied()
            && (behind < block || rests)
        {
            inbox.zero = zero;
            inbox.zeros.pop_front();
        }
        while let Some((behind, _)) = inbox.states.front()
            && *behind < block
        {
            inbox.state = inbox.states.pop_front().map(|(_, state)| state);
        }
    }

    /// The job has ended.
    pub(crate) fn end(&self, end: LinesEnd, text: &str) {
        let mut inbox = self.lock();
        inbox.is_over = true;
        inbox.followed = Followed {
            rests: true,
            ..Followed::default()
        };
        if let (LinesEnd::Done, Some((line, _))) = (end, inbox.last) {
            inbox.read = line;
        }
        inbox.end = Some((end, text.to_owned()));
    }

    pub(crate) fn found(&self) -> Found {
        self.lock().found
    }

    /// The answer to a request about them.
    pub(crate) fn reply(&self, request: &LinesRequest) -> LinesReply {
        let mut inbox = self.lock();
        if inbox.told != inbox.read {
            inbox.told = inbox.read;
            inbox.heard = Instant::now();
        }
        let state = match &inbox.end {
            None => LinesState::Open,
            Some((LinesEnd::Done, _)) => match inbox.last {
                Some((_, LastLine::EndsProgram)) => LinesState::ProgramEnd,
                Some((_, LastLine::Stores)) | None => LinesState::Done,
            },
            Some((LinesEnd::NotBegun, _)) => LinesState::NotBegun,
            Some((LinesEnd::Failed, _)) => LinesState::Failed,
        };
        let refused = inbox.refused.clone().unwrap_or_default();
        let text = match &inbox.end {
            Some((_, text)) if inbox.refused.is_none() => text,
            _ => &refused.text,
        };
        LinesReply {
            taken: inbox.taken,
            read: inbox.read,
            is_refused: inbox.refused.is_some().into(),
            refused_column: refused.column,
            refused_in_motion: refused.in_motion.into(),
            ahead_t: inbox.ahead_t(),
            zero: inbox.zero.into(),
            diagnostic: Text::new(&refused.diagnostic),
            text: LongText::new(text),
            ..told(request, state, (&inbox.facts, &inbox.found))
        }
    }

    // For whoever reads them.

    /// The next line with its end, if one is there and may be read.
    pub(super) fn next_line(&self, into: &mut Vec<u8>) {
        let mut inbox = self.lock();
        if inbox.is_over || inbox.is_closing || inbox.is_storing {
            return;
        }
        let end = inbox.unread.iter().position(|byte| *byte == b'\n');
        if let Some(end) = end {
            into.extend(inbox.unread.drain(..=end));
            inbox.is_storing = stores(into);
        }
    }

    /// The line given last stores something, and was read. Where it is settled behind it, the job ends, so that what it
    /// stores is kept when it is told to be read; elsewhere more lines are given. Returns whether the job ends.
    pub(super) fn end_if_storing(&self, line: u64, is_settled: bool) -> bool {
        let mut inbox = self.lock();
        if !core::mem::take(&mut inbox.is_storing) || !is_settled {
            return false;
        }
        (inbox.is_over, inbox.last) = (true, Some((line, LastLine::Stores)));
        true
    }

    /// Whether the line given last stores something, and nothing is given behind it.
    pub(super) fn is_storing(&self) -> bool {
        self.lock().is_storing
    }

    /// So many lines were read.
    pub(super) fn has_read(&self, lines: u64) {
        self.lock().read = lines;
    }

    /// Whether more motion is planned ahead than may be.
    pub(super) fn is_ahead(&self) -> bool {
        let inbox = self.lock();
        inbox.followed.ahead_t >= inbox.most_ahead_t
    }

    /// Whether all that was given out is executed.
    pub(super) fn rests(&self) -> bool {
        self.lock().followed.rests
    }

    /// Something was given out that is not executed.
    pub(super) fn give(&self, is_move: bool) {
        let mut inbox = self.lock();
        inbox.followed.rests = false;
        inbox.moves += u64::from(is_move);
    }

    /// Whether no line has come for a while, though one could.
    pub(super) fn is_silent(&self) -> bool {
        let inbox = self.lock();
        let stands = inbox.followed.ahead_t <= 0.0;
        let flush = if stands && inbox.moves > 1 {
            FLUSH_AT_START
        } else {
            FLUSH
        };
        inbox.unread.is_empty() && inbox.told == inbox.read && inbox.heard.elapsed() >= flush
    }

    /// Ends the job where nothing more is to come. Returns whether it has.
    pub(super) fn end_if_done(&self, is_settled: bool) -> bool {
        let mut inbox = self.lock();
        let is_silent = inbox.unread.is_empty() && inbox.heard.elapsed() >= LINGER;
        inbox.is_over |= inbox.is_closing || (is_settled && inbox.followed.rests && is_silent);
        inbox.is_over
    }

    pub(super) fn is_over(&self) -> bool {
        self.lock().is_over
    }

    /// A program ends with this line.
    pub(super) fn end_program(&self, line: u64) {
        let mut inbox = self.lock();
        (inbox.is_over, inbox.last) = (true, Some((line, LastLine::EndsProgram)));
    }

    /// The line behind those that were read is refused.
    pub(super) fn refuse(&self, mut refused: Refused) {
        let mut inbox = self.lock();
        refused.in_motion = !inbox.followed.rests;
        (inbox.is_over, inbox.refused) = (true, Some(refused));
    }

    /// What is in force behind the line read last.
    pub(super) fn know(&self, facts: LineFacts, found: Found) {
        let mut inbox = self.lock();
        (inbox.facts, inbox.found) = (facts, found);
    }

    /// The zero behind a block.
    pub(super) fn note_zero(&self, behind: u32, zero: AxisVector) {
        self.lock().zeros.push_back((behind, zero));
    }

    /// What is in force behind a block.
    pub(super) fn note_state(&self, behind: u32, state: InForce) {
        let mut inbox = self.lock();
        if inbox.states.back().is_some_and(|(last, _)| *last == behind) {
            inbox.states.pop_back();
        }
        inbox.states.push_back((behind, state));
    }

    /// The state in force while a block is executed, or, where the machine rests behind all that was given out, behind
    /// the line read last; `None`: what was so before the job.
    #[must_use]
    pub fn in_force_at(&self, block: u32) -> Option<InForce> {
        let mut inbox = self.lock();
        let rests = inbox.followed.rests;
        while let Some((behind, _)) = inbox.states.front()
            && (*behind < block || rests)
        {
            inbox.state = inbox.states.pop_front().map(|(_, state)| state);
        }
        inbox.state.clone()
    }

    /// How long ago a line came.
    #[cfg(test)]
    pub(crate) fn age(&self, age: Duration) {
        let mut inbox = self.lock();
        if let Some(came) = Instant::now().checked_sub(age) {
            inbox.heard = came;
        }
    }
}

/// What is told of a machine that is set up so.
pub(crate) fn told(
    request: &LinesRequest,
    state: LinesState,
    (facts, found): (&LineFacts, &Found),
) -> LinesReply {
    let offsets = &facts.offsets;
    LinesReply {
        client: request.client,
        number: request.number,
        taken: 0,
        read: 0,
        state: state.code(),
        is_refused: 0,
        refused_column: 0,
        refused_in_motion: 0,
        ahead_t: 0.0,
        zero: facts.zero.into(),
        systems: offsets.systems.map(|system| system.origin.into()),
        references: offsets.reference.map(Into::into),
        shift: offsets.shift.into(),
        tool: facts.tool.into(),
        probe: found.at.into(),
        probe_made: found.is_made.into(),
        probes: found.count,
        diagnostic: Text::default(),
        words: Text::new(&facts.words),
        text: LongText::default(),
    }
}
