//! The modal interpreter: one block at a time, in the order RS274/NGC prescribes.
//!
//! Whatever stands where in a line, a block acts in this order: feed mode, F, S, T, tool change,
//! spindle, coolant, overrides, dwell, plane, units, coordinate system, path mode, distance modes,
//! then G10, G28, G30, G52 or G92, then the motion, and last the stop.
//!
//! A block that is refused has no effect at all: the state from before it is put back.

use glidepath_geometry::AxisVector;
use glidepath_motion::{Event, Item, ItemKind};

use crate::block::Block;
use crate::codes::{Coded, Stop};
use crate::diagnostic::Outcome;
use crate::modal::Modal;
use crate::offsets::Offsets;
use crate::options::Options;
use crate::words::{check_words, path_mode};

/// What follows a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Flow {
    Continue,
    /// M2 or M30: nothing after it is read.
    End,
}

/// Moves that were left out because they go nowhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct ZeroLength {
    pub(crate) feeds: u32,
    pub(crate) rapids: u32,
}

/// The part of the state a block may change, offsets apart.
#[derive(Debug, Clone, Copy)]
pub(crate) struct State {
    pub(crate) modal: Modal,
    /// Where the program has brought the machine, machine coordinates.
    pub(crate) position: AxisVector,
    /// End of the last segment given out. Within [`crate::moves::MIN_MOVE`] of `position`.
    pub(crate) path_end: AxisVector,
}

/// Turns blocks into items.
#[derive(Debug)]
pub(crate) struct Interpreter {
    pub(crate) options: Options,
    pub(crate) state: State,
    pub(crate) offsets: Offsets,
    /// Of the block executed last.
    pub(crate) zero_length: ZeroLength,
    /// Line of the block being executed.
    pub(crate) line: u32,
}

impl Interpreter {
    pub(crate) fn new(options: Options) -> Self {
        let start = options.start;
        let modal = Modal::new(options.default_feed_mm_min);
        Self {
            options,
            state: State {
                modal,
                position: start,
                path_end: start,
            },
            offsets: Offsets::new(),
            zero_length: ZeroLength::default(),
            line: 0,
        }
    }

    /// Executes a block: appends what it does to `out`, which is empty when the block is refused.
    pub(crate) fn execute(
        &mut self,
        block: &Block,
        line: u32,
        out: &mut Vec<Item>,
    ) -> Outcome<Flow> {
        self.line = line;
        self.zero_length = ZeroLength::default();
        let state = self.state;
        let changes_offsets = block.codes.once.is_some() || block.codes.system.is_some();
        let offsets = changes_offsets.then(|| self.offsets.clone());
        let result = self.run(block, out);
        if result.is_err() {
            out.clear();
            self.state = state;
            if let Some(offsets) = offsets {
                self.offsets = offsets;
            }
        }
        result
    }

    fn run(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<Flow> {
        let motion = self.motion_of(block)?;
        check_words(block, motion)?;
        self.check_axes(block)?;
        self.feed(block)?;
        self.auxiliary(block, out)?;
        self.modes(block)?;
        if let Some(once) = block.codes.once {
            self.act_once(block, once, motion, out)?;
        }
        if let Some(Coded { code, .. }) = block.codes.motion {
            self.state.modal.motion = code;
        }
        if let Some(motion) = motion {
            self.motion(block, motion, out)?;
        }
        Ok(match block.codes.stop.map(|stop| stop.code) {
            Some(Stop::End) => Flow::End,
            Some(Stop::Program(number)) => {
                self.push(out, ItemKind::Event(Event::ProgramStop(number)));
                Flow::Continue
            }
            Some(Stop::Optional) => {
                self.push(out, ItemKind::Event(Event::OptionalStop));
                Flow::Continue
            }
            None => Flow::Continue,
        })
    }

    pub(crate) fn push(&self, out: &mut Vec<Item>, kind: ItemKind) {
        out.push(Item {
            line: self.line,
            kind,
        });
    }

    /// Plane, units, coordinate system, path mode, distance modes.
    fn modes(&mut self, block: &Block) -> Outcome<()> {
        let (modal, codes) = (&mut self.state.modal, &block.codes);
        if let Some(Coded { code, .. }) = codes.plane {
            modal.plane = code;
        }
        if let Some(Coded { code, .. }) = codes.units {
            modal.units = code;
        }
        if let Some(Coded { code, .. }) = codes.system {
            self.offsets.active = code;
        }
        if let Some(Coded { code, .. }) = codes.path_mode {
            modal.path_mode = path_mode(block, code, modal.units.mm())?;
        }
        if let Some(Coded { code, .. }) = codes.distance {
            modal.distance = code;
        }
        if let Some(Coded { code, .. }) = codes.arc_distance {
            modal.arc_distance = code;
        }
        Ok(())
    }
}
