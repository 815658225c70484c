//! The interpreter: all that is in force from block to block.

use glidepath_program::{Item, ItemKind};

use crate::execute::motion::speed::Pace;
use crate::execute::state::doubts::Doubts;
use crate::execute::state::open_spline::SplineLog;
use crate::execute::state::plain_run::PlainRun;
use crate::execute::state::program_state::State;
use crate::execute::state::soft_limits::SoftLimits;
use crate::setup::options::Options;
use crate::summary::pole_turns::PoleTurns;
use crate::syntax::letters::Letters;

/// Moves that were left out because they go nowhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct ZeroLength {
    pub(crate) feeds: u32,
    pub(crate) rapids: u32,
}

/// Turns blocks into items.
#[derive(Debug)]
pub(crate) struct Interpreter {
    /// All that a block may change, and gives back if it is refused.
    ///
    /// The other fields are none of it, each for its reason.
    pub(crate) state: State,
    /// What the program is read for: no block changes it.
    pub(crate) options: Options,
    /// Words of the axes the machine does not have, and of the one that is the spindle: of the machine, too.
    pub(crate) lacking: Letters,
    /// Where moves may end: of the machine, too.
    pub(crate) soft_limits: SoftLimits,
    /// The block that is executed next goes on with the thread of this one: said of each block in front of it.
    pub(crate) thread_goes_on: bool,
    /// Control points and knots of the open NURBS: the state says how many of them count.
    pub(crate) spline_log: SplineLog,
    /// What the block executed last has left out: nobody counts that of one that was refused.
    pub(crate) zero_length: ZeroLength,
    /// Turns in the cut that were made.
    pub(crate) pole_turns: PoleTurns,
    /// Straight moves of plain lines are judged, and not given out: no block changes that.
    pub(crate) only_judges: bool,
    /// The block executed last was one of them, and so was not refused.
    pub(crate) has_judged: bool,
    /// The time that those which were judged take at their feedrate, or somewhat less, s: that of the axis
    /// which goes furthest. A sum over moves that were made.
    pub(crate) judged_time_s: f64,
    /// What the straight move of a plain line made last was made with; it holds as long as nothing
    /// else is executed, be it refused or not.
    pub(crate) plain_run: PlainRun,
    /// Items of the block whose moves are those of the axes already: a place in what the block gives out.
    pub(crate) mapped_items: usize,
    /// What is told when all was read: a block that was refused afterwards is told anyhow.
    pub(crate) doubts: Doubts,
    /// Line of the block being executed: that of a diagnostic, too.
    pub(crate) line: u32,
}

impl Interpreter {
    pub(crate) fn new(options: Options) -> Self {
        let spindle = options.spindle_axis.map(|spindle| spindle.axis);
        Self {
            state: State::at_start(&options),
            lacking: Letters::of_axes(|axis| !options.machine.has(axis) || spindle == Some(axis)),
            soft_limits: SoftLimits::of(&options.machine),
            options,
            thread_goes_on: false,
            spline_log: SplineLog::default(),
            zero_length: ZeroLength::default(),
            pole_turns: PoleTurns::default(),
            only_judges: false,
            has_judged: false,
            judged_time_s: 0.0,
            plain_run: PlainRun::new(),
            mapped_items: 0,
            doubts: Doubts::default(),
            line: 0,
        }
    }

    /// Begins a line: nothing was made of it yet.
    #[inline]
    pub(crate) const fn begin(&mut self, line: u32) {
        self.line = line;
        self.zero_length = ZeroLength {
            feeds: 0,
            rapids: 0,
        };
        self.has_judged = false;
    }

    /// Gives out an item, in order with the moves that a corner and cutter radius compensation still hold
    /// back.
    #[inline]
    pub(crate) fn push(&mut self, out: &mut Vec<Item>, kind: ItemKind) {
        let item = Item {
            block: 0,
            line: self.line,
            kind,
        };
        match &mut self.state.open.corner {
            Some(corner) => corner.behind.push(item),
            None => self.give(item, out),
        }
    }

    /// Gives out an item behind those of the moves that are known.
    pub(crate) fn give(&mut self, item: Item, out: &mut Vec<Item>) {
        match &mut self.state.open.compensation {
            Some(compensation) => compensation.push_item(item, out),
            None => out.push(item),
        }
    }

    pub(crate) const fn count_zero_length(&mut self, pace: Pace) {
        match pace {
            Pace::Rapid => self.zero_length.rapids += 1,
            Pace::Feed => self.zero_length.feeds += 1,
        }
    }
}
