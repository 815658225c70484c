//! The interpreter: all that is in force from block to block.

use std::sync::Arc;

use glidepath_geometry::AxisVector;
use glidepath_program::{Item, ItemKind};

use crate::execute::auxiliary::input_wait::InputWait;
use crate::execute::compensation::path::Compensation;
use crate::execute::motion::speed::Pace;
use crate::execute::motion::tip_map::TipMap;
use crate::execute::state::coolant::Coolant;
use crate::execute::state::course::Course;
use crate::execute::state::extruder::ExtruderMode;
use crate::execute::state::fanuc_modal::FanucModal;
use crate::execute::state::modal::Modal;
use crate::execute::state::offsets::Offsets;
use crate::execute::state::open_corner::OpenCorner;
use crate::execute::state::open_line::OpenLine;
use crate::execute::state::open_spline::OpenSpline;
use crate::execute::state::open_tap::OpenTap;
use crate::execute::state::open_thread::OpenThread;
use crate::execute::state::pole::Pole;
use crate::execute::state::printer::KeptByPrinter;
use crate::execute::state::probe_result::{ProbeResult, Search};
use crate::execute::state::program_state::State;
use crate::execute::state::saved_states::SavedStates;
use crate::execute::state::soft_limits::SoftLimits;
use crate::execute::state::spindle::Spindle;
use crate::execute::state::sticky_words::CycleSeries;
use crate::execute::state::untraversed::Untraversed;
use crate::setup::options::Options;
use crate::setup::tool_table::ToolTable;
use crate::syntax::letters::Letters;
use crate::syntax::modes::{ArcFeed, Side};

/// Moves that were left out because they go nowhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct ZeroLength {
    pub(crate) feeds: u32,
    pub(crate) rapids: u32,
}

/// Turns blocks into items.
#[derive(Debug)]
pub(crate) struct Interpreter {
    pub(crate) options: Options,
    pub(crate) state: State,
    pub(crate) offsets: Offsets,
    /// Words of the axes the machine does not have, and of the one that is the spindle.
    pub(crate) lacking: Letters,
    /// Where moves may end.
    pub(crate) soft_limits: SoftLimits,
    pub(crate) compensation: Option<Compensation>,
    /// The move to a corner that is to be broken.
    pub(crate) corner: Option<Box<OpenCorner>>,
    /// The line of which the direction alone is known.
    pub(crate) open_line: Option<Box<OpenLine>>,
    /// The tap that is in its hole.
    pub(crate) open_tap: Option<OpenTap>,
    /// The thread that its next block goes on with.
    pub(crate) open_thread: Option<OpenThread>,
    /// The block that is executed next goes on with the thread of this one.
    pub(crate) thread_goes_on: bool,
    /// The direction in which the last move ended, for a block with CT.
    pub(crate) tangent: Option<AxisVector>,
    /// The NURBS whose control points are being read.
    pub(crate) open_spline: Option<OpenSpline>,
    /// The tool table, with what G10 has made of it.
    pub(crate) tools: Option<Arc<ToolTable>>,
    /// Blocks that changed coordinate systems, reference positions, the offset of G92 or tools.
    pub(crate) changes: u64,
    pub(crate) saved_states: SavedStates,
    /// Places and states that a printer's program keeps.
    pub(crate) kept_by_printer: KeptByPrinter,
    /// What the block executed last has left out.
    pub(crate) zero_length: ZeroLength,
    /// Straight moves of plain lines are judged, and not given out.
    pub(crate) only_judges: bool,
    /// The block executed last was one of them.
    pub(crate) has_judged: bool,
    /// The time that those which were judged take at their feedrate, or somewhat less, s: that of the axis
    /// which goes furthest.
    pub(crate) judged_time_s: f64,
    /// What the straight move of a plain line made last was made with; it holds as long as nothing
    /// else is executed.
    pub(crate) course: Course,
    /// Where the axes stand behind the last move, where places of the program are not the axes.
    pub(crate) axes_end: AxisVector,
    /// They are not.
    pub(crate) is_mapped: bool,
    /// Items of the block whose moves are those of the axes already.
    pub(crate) mapped_items: usize,
    /// Line of the block being executed.
    pub(crate) line: u32,
    /// What the M66 executed last waits for.
    pub(crate) input_wait: Option<InputWait>,
    /// The probing move executed last, as long as it is not known how it ended.
    pub(crate) search: Option<Search>,
}

impl Interpreter {
    pub(crate) fn new(options: Options) -> Self {
        let axes_end = options.start;
        let tip = options.first_tip();
        let map = TipMap::new(options.five_axis, tip);
        let start = map.map_or(axes_end, |map| map.place(&axes_end));
        let soft_limits = SoftLimits::of(&options.machine);
        let spindle = options.spindle_axis.map(|spindle| spindle.axis);
        let lacking = Letters::of_axes(|axis| !options.machine.has(axis) || spindle == Some(axis));
        let modal = Modal::new(options.default_feed_mm_min);
        let tools = options.tools.clone();
        let offsets = Offsets::of(&options.offsets);
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
                tool_before: (0, AxisVector::zeros()),
                cycles: CycleSeries::default(),
                probe: ProbeResult::default(),
                input: 0.0,
                extruder: ExtruderMode::default(),
                gcode_offset: [0.0; 3],
                on_contour: false,
                arc_feed: ArcFeed::default(),
                contour_side: Side::Left,
                leaving_contour: false,
                cubic_tail: None,
                thread_end: None,
                rounds_mm: 0.0,
                corner_feed: None,
                diameter_by_distance: false,
                pole: Pole::default(),
                feeds_in_mm: false,
                edge: None,
                fanuc: FanucModal::default(),
                tip,
                turns_on_circles: false,
                tilted: None,
                contour_plane: None,
                untraversed: Untraversed::default(),
                thread_setup: None,
            },
            open_spline: None,
            offsets,
            changes: 0,
            lacking,
            soft_limits,
            compensation: None,
            corner: None,
            open_line: None,
            open_tap: None,
            open_thread: None,
            thread_goes_on: false,
            tangent: None,
            tools,
            saved_states: SavedStates::default(),
            kept_by_printer: KeptByPrinter::default(),
            zero_length: ZeroLength::default(),
            only_judges: false,
            has_judged: false,
            judged_time_s: 0.0,
            course: Course::new(),
            axes_end,
            is_mapped: map.is_some(),
            mapped_items: 0,
            line: 0,
            input_wait: None,
            search: None,
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
        match &mut self.corner {
            Some(corner) => corner.behind.push(item),
            None => self.give(item, out),
        }
    }

    /// Gives out an item behind those of the moves that are known.
    pub(crate) fn give(&mut self, item: Item, out: &mut Vec<Item>) {
        match &mut self.compensation {
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
