//! The modal interpreter: one block at a time, in the order RS274/NGC prescribes.
//!
//! Whatever stands where in a line, a block acts in this order: feed mode, F, S, T, tool change,
//! spindle, coolant, overrides, saved state, inputs and outputs, dwell, plane, units, diameter mode, cutter
//! radius, tool length, coordinate system, path mode, distance modes, retract mode, then G10, G28,
//! G30, G52 or G92, then the motion, and last the stop.
//!
//! A block that is refused has no effect at all: the state from before it is put back.

use std::sync::Arc;

use glidepath_geometry::AxisVector;
use glidepath_program::{Event, Item, ItemKind};

use crate::auxiliary::Coolant;
use crate::block::{Block, Letters};
use crate::codes::Coded;
use crate::compensation::Compensation;
use crate::cycle::Cycles;
use crate::diagnostic::Outcome;
use crate::modal::Modal;
use crate::modes::{Distance, Motion, Spline, Stop};
use crate::moves::Reach;
use crate::offsets::Offsets;
use crate::options::Options;
use crate::plain_move::Course;
use crate::probe::ProbeResult;
use crate::saved_state::SavedStates;
use crate::spindle::Spindle;
use crate::spline::{self, OpenSpline};
use crate::tool_table::ToolTable;
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
    /// Where the program has brought the machine, machine coordinates. With cutter radius
    /// compensation that is the programmed contour, not the tool.
    pub(crate) position: AxisVector,
    /// End of the last segment made. Within [`crate::moves::MIN_MOVE`] of `position`, unless cutter
    /// radius compensation is on or was just turned off.
    pub(crate) path_end: AxisVector,
    pub(crate) spindle: Spindle,
    pub(crate) coolant: Coolant,
    /// M49: the operator is to have no overrides.
    pub(crate) overrides_off: bool,
    /// Tool number of the last T word.
    pub(crate) selected_tool: u32,
    /// Tool number in the spindle; 0: none.
    pub(crate) tool: u32,
    pub(crate) cycles: Cycles,
    pub(crate) probe: ProbeResult,
    /// Value of the input M66 read last.
    pub(crate) input: f64,
    /// E words of printers are relative.
    pub(crate) extruder_relative: bool,
    /// G41 or G42 is in force, be it with a radius of zero.
    pub(crate) on_contour: bool,
    /// Cutter radius compensation was turned off and no move has been made since.
    pub(crate) leaving_contour: bool,
    /// From its end to the control point that continues the last move smoothly, if that was a G5, mm.
    pub(crate) cubic_tail: Option<[f64; 2]>,
}

/// Turns blocks into items.
#[derive(Debug)]
pub(crate) struct Interpreter {
    pub(crate) options: Options,
    pub(crate) state: State,
    pub(crate) offsets: Offsets,
    /// Words of the axes the machine does not have.
    pub(crate) lacking: Letters,
    /// Where moves may end.
    pub(crate) reach: Reach,
    pub(crate) compensation: Option<Compensation>,
    /// The NURBS whose control points are being read.
    pub(crate) open_spline: Option<OpenSpline>,
    /// The tool table, with what G10 has made of it.
    pub(crate) tools: Option<Arc<ToolTable>>,
    pub(crate) saved_states: SavedStates,
    /// Of the block executed last.
    pub(crate) zero_length: ZeroLength,
    /// Straight moves of plain lines are judged, and not given out.
    pub(crate) only_judges: bool,
    /// The block executed last was one of them.
    pub(crate) has_judged: bool,
    /// Of the straight move of a plain line made last; holds as long as nothing else is executed.
    pub(crate) course: Course,
    /// Line of the block being executed.
    pub(crate) line: u32,
}

impl Interpreter {
    pub(crate) fn new(options: Options) -> Self {
        let start = options.start;
        let reach = Reach::of(&options.machine);
        let lacking = Letters::of_axes(|axis| !options.machine.has(axis));
        let modal = Modal::new(options.default_feed_mm_min);
        let tools = options.tools.clone();
        Self {
            options,
            state: State {
                modal,
                position: start,
                path_end: start,
                spindle: Spindle::default(),
                coolant: Coolant::default(),
                overrides_off: false,
                selected_tool: 0,
                tool: 0,
                cycles: Cycles::default(),
                probe: ProbeResult::default(),
                input: 0.0,
                extruder_relative: false,
                on_contour: false,
                leaving_contour: false,
                cubic_tail: None,
            },
            open_spline: None,
            offsets: Offsets::new(),
            lacking,
            reach,
            compensation: None,
            tools,
            saved_states: SavedStates::default(),
            zero_length: ZeroLength::default(),
            only_judges: false,
            has_judged: false,
            course: Course::new(),
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

    /// Executes a block: appends what it does to `out`, which is empty when the block is refused.
    pub(crate) fn execute(
        &mut self,
        block: &Block,
        line: u32,
        out: &mut Vec<Item>,
    ) -> Outcome<Flow> {
        self.begin(line);
        if block.is_plain() {
            let code = block.codes.motion.and_then(|motion| motion.code);
            if self.go(code, &block.words, false, out) {
                return Ok(Flow::Continue);
            }
        }
        let state = self.state;
        let codes = &block.codes;
        let saved_states = codes.saved_state.map(|_| self.saved_states.clone());
        let changes_offsets = codes.once.is_some()
            || codes.system.is_some()
            || codes.tool_length.is_some()
            || codes.saved_state.is_some();
        let offsets = changes_offsets.then(|| (self.offsets.clone(), self.tools.clone()));
        let compensation = self.compensation.clone();
        let mark = OpenSpline::mark(self.open_spline.as_ref());
        let result = self.run(block, out);
        if result.is_err() {
            out.clear();
            self.state = state;
            self.compensation = compensation;
            OpenSpline::rewind(&mut self.open_spline, mark);
            if let Some(saved_states) = saved_states {
                self.saved_states = saved_states;
            }
            if let Some((offsets, tools)) = offsets {
                self.offsets = offsets;
                self.tools = tools;
            }
        }
        result
    }

    fn run(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<Flow> {
        if let Some(Coded { code, span }) = block.codes.function {
            self.machine_function(block, code, span, out)?;
            return Ok(Flow::Continue);
        }
        let motion = self.motion_of(block)?;
        if let Some(open) = &self.open_spline
            && !spline::goes_on(block, open, motion)
        {
            let fault = spline::interrupted(open, block.first_span());
            self.open_spline = None;
            return Err(fault);
        }
        check_words(block, motion)?;
        self.check_axes(block)?;
        self.check_compensated(block)?;
        self.feed(block)?;
        if !block.is_plain() || block.has_any(Letters::of(b"ST")) {
            self.auxiliary(block, out)?;
            self.modes(block, out)?;
        }
        if let Some(once) = block.codes.once {
            self.act_once(block, once, motion, out)?;
        }
        if let Some(Coded { code, .. }) = block.codes.motion {
            self.state.modal.motion = code;
            if !matches!(code, Some(Motion::Cycle(_))) {
                self.state.cycles = Cycles::default();
            }
        }
        if !matches!(motion, None | Some(Motion::Spline(Spline::Cubic))) {
            self.state.cubic_tail = None;
        }
        if let Some(motion) = motion {
            self.motion(block, motion, out)?;
        }
        let stop = block.codes.stop.map(|stop| stop.code);
        Ok(match stop {
            Some(Stop::End) => {
                self.end_compensation(out)?;
                Flow::End
            }
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

    /// Gives out an item, in order with the moves cutter radius compensation still holds back.
    #[inline]
    pub(crate) fn push(&mut self, out: &mut Vec<Item>, kind: ItemKind) {
        let item = Item {
            line: self.line,
            kind,
        };
        match &mut self.compensation {
            Some(compensation) => compensation.push_item(item, out),
            None => out.push(item),
        }
    }

    /// Plane, units, diameter mode, cutter radius, tool length, coordinate system, path mode,
    /// distance modes, retract mode.
    fn modes(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let (modal, codes) = (&mut self.state.modal, &block.codes);
        if let Some(Coded { code, .. }) = codes.plane {
            modal.plane = code;
        }
        if let Some(Coded { code, .. }) = codes.units {
            modal.units = code;
        }
        if let Some(Coded { code, .. }) = codes.diameter {
            modal.diameter = code;
        }
        if let Some(coded) = codes.cutter_radius {
            self.cutter_radius(block, coded, out)?;
        }
        if let Some(coded) = codes.tool_length {
            self.tool_length(block, coded)?;
        }
        let modal = &mut self.state.modal;
        if let Some(Coded { code, .. }) = codes.system {
            self.offsets.active = code;
        }
        if let Some(Coded { code, .. }) = codes.path_mode {
            modal.path_mode = path_mode(block, code, modal.units.mm())?;
        }
        if let Some(Coded { code, .. }) = codes.distance {
            modal.distance = code;
            self.state.extruder_relative = code == Distance::Incremental;
        }
        if let Some(Coded { code, .. }) = codes.extruder {
            self.state.extruder_relative = code;
        }
        if let Some(Coded { code, .. }) = codes.arc_distance {
            modal.arc_distance = code;
        }
        if let Some(Coded { code, .. }) = codes.retract {
            modal.retract = code;
        }
        Ok(())
    }
}
