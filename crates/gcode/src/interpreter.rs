//! The modal interpreter: one block at a time, in the order RS274/NGC prescribes.
//!
//! Whatever stands where in a line, a block acts in this order: feed mode, F, S, T, tool change,
//! spindle, coolant, overrides, dwell, plane, units, coordinate system, path mode, distance modes,
//! then G10, G28, G30, G52 or G92, then the motion, and last the stop.
//!
//! A block that is refused has no effect at all: the state from before it is put back.

use glidepath_geometry::{AXES, Axis, AxisVector};
use glidepath_motion::{Event, Item, ItemKind};

use crate::block::{AXIS_WORDS, Block, Letters};
use crate::codes::{Coded, Distance, FeedMode, Motion, Once, Stop};
use crate::diagnostic::{Code, Fault, Outcome, Span};
use crate::modal::{Feed, Modal};
use crate::offsets::{Offsets, overlay};
use crate::options::Options;
use crate::words::{
    MAX_TOOL, check_words, missing, negative, path_mode, require_axes, unused, whole,
};

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

    /// The motion the block makes, if any: its own code, or the modal one if it has axis words
    /// that nothing else takes.
    fn motion_of(&self, block: &Block) -> Outcome<Option<Motion>> {
        let taken = block.codes.once.filter(|once| once.code.takes_axes());
        let has_axes = block.has_any(AXIS_WORDS);
        match (block.codes.motion, taken) {
            (
                Some(Coded {
                    code: Some(_),
                    span,
                }),
                Some(_),
            ) => Err(Fault::new(
                Code::AxisWordsConflict,
                span,
                "two codes want the axis words",
            )
            .because("G10, G28, G30, G52 and G92 take them for themselves")
            .help("write two blocks")),
            (Some(Coded { code: None, span }), None) if has_axes => {
                Err(
                    Fault::new(Code::NoMotionMode, span, "axis words in a block with G80")
                        .because("G80 ends the motion mode, so nothing uses them")
                        .help("remove G80 or the axis words"),
                )
            }
            (
                Some(Coded {
                    code: Some(motion), ..
                }),
                None,
            ) => {
                let arc = matches!(motion, Motion::ArcClockwise | Motion::ArcCounterclockwise);
                let moves = has_axes || arc;
                Ok(moves.then_some(motion))
            }
            (_, Some(_)) => Ok(None),
            (_, None) => self.modal_motion(block, has_axes),
        }
    }

    fn modal_motion(&self, block: &Block, has_axes: bool) -> Outcome<Option<Motion>> {
        let modal = self.state.modal.motion;
        if has_axes {
            return modal.map(Some).ok_or_else(|| {
                let first = block.axes().map(|(axis, _)| block.axis_span(axis));
                let span = first.min_by_key(|span| span.start).unwrap_or_default();
                Fault::new(Code::NoMotionMode, span, "axis words without a motion mode")
                    .because("no G0, G1, G2 or G3 is in force")
                    .help("write the motion code in front of them")
            });
        }
        let center = block.has_any(Letters::of(b"IJK"));
        Ok(modal.filter(|motion| {
            center && matches!(motion, Motion::ArcClockwise | Motion::ArcCounterclockwise)
        }))
    }

    fn check_axes(&self, block: &Block) -> Outcome<()> {
        if !block.has_any(AXIS_WORDS) {
            return Ok(());
        }
        match block
            .axes()
            .find(|(axis, _)| !self.options.machine.has(*axis))
        {
            None => Ok(()),
            Some((axis, _)) => {
                let message = format!("the machine has no {axis} axis");
                let names: String = Axis::ALL
                    .into_iter()
                    .filter(|a| self.options.machine.has(*a))
                    .flat_map(|a| [' ', a.letter()])
                    .collect();
                Err(
                    Fault::new(Code::AxisNotConfigured, block.axis_span(axis), message)
                        .because(format!("its configuration has:{names}"))
                        .help("remove the word, or configure the axis"),
                )
            }
        }
    }

    /// Feed mode and F.
    fn feed(&mut self, block: &Block) -> Outcome<()> {
        let modal = &mut self.state.modal;
        if let Some(Coded { code, .. }) = block.codes.feed_mode {
            if modal.feed_mode != code {
                // The F of one mode means nothing in the other.
                modal.feed = None;
            }
            modal.feed_mode = code;
        }
        let Some(feed) = block.get(b'F') else {
            return Ok(());
        };
        if feed <= 0.0 {
            let message = format!("the feedrate F{feed} is not above zero");
            return Err(Fault::new(Code::BadFeed, block.span(b'F'), message)
                .because("a move at that feedrate would never end")
                .help("write a positive feedrate; use M0 to stop"));
        }
        if modal.feed_mode == FeedMode::PerMinute {
            modal.feed = Some(Feed {
                linear_v: feed * modal.units.mm() / 60.0,
                rotary_v: feed / 60.0,
            });
        }
        Ok(())
    }

    /// S, T, tool change, spindle, coolant, overrides and dwell.
    fn auxiliary(&self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        if let Some(speed) = block.get(b'S') {
            if speed < 0.0 {
                return Err(negative(block, b'S', "the spindle speed"));
            }
            self.push(out, ItemKind::Event(Event::SpindleSpeed(speed)));
        }
        if let Some(tool) = whole(block, b'T', MAX_TOOL)? {
            self.push(out, ItemKind::Event(Event::SelectTool(tool)));
        }
        let codes = &block.codes;
        let in_order = [
            codes.tool_change,
            codes.spindle,
            codes.coolant,
            codes.overrides,
        ];
        for Coded { code, .. } in in_order.into_iter().flatten() {
            self.push(out, ItemKind::Event(Event::MCode(code)));
        }
        if let Some(Coded {
            code: Once::Dwell,
            span,
        }) = codes.once
        {
            let seconds = block
                .get(b'P')
                .ok_or_else(|| missing(span, "G4", "P", "seconds"))?;
            if seconds < 0.0 {
                return Err(negative(block, b'P', "the dwell"));
            }
            self.push(out, ItemKind::Dwell(seconds));
        }
        Ok(())
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

    fn act_once(
        &mut self,
        block: &Block,
        once: Coded<Once>,
        motion: Option<Motion>,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let position = self.state.position;
        match once.code {
            // The dwell comes earlier, the machine coordinates with the motion.
            Once::Dwell => {}
            Once::MachineCoordinates => self.check_machine_coordinates(once.span, motion)?,
            Once::SetData => self.set_data(block, once.span)?,
            Once::GoToReference(index) => self.go_to_reference(block, index, out)?,
            Once::SetReference(index) => {
                if let Some(reference) = self.offsets.reference.get_mut(index) {
                    *reference = position;
                }
            }
            Once::LocalOffset => {
                let values = self.axis_values(block);
                require_axes(block, once.span, "G52")?;
                self.offsets.shift = overlay(self.offsets.shift, &values);
                self.offsets.saved_shift = self.offsets.shift;
            }
            Once::SetOffset => {
                let values = self.axis_values(block);
                require_axes(block, once.span, "G92")?;
                self.offsets.set_shift(position, &values);
            }
            Once::ClearOffset => {
                self.offsets.shift = AxisVector::zeros();
                self.offsets.saved_shift = AxisVector::zeros();
            }
            Once::SuspendOffset => self.offsets.shift = AxisVector::zeros(),
            Once::RestoreOffset => self.offsets.shift = self.offsets.saved_shift,
        }
        Ok(())
    }

    fn check_machine_coordinates(&self, span: Span, motion: Option<Motion>) -> Outcome<()> {
        let fault = |message: &str| Fault::new(Code::MachineCoordinates, span, message);
        match motion {
            Some(Motion::Rapid | Motion::Linear) => {}
            _ => {
                return Err(fault("G53 without a straight move")
                    .because("machine coordinates hold for one G0 or G1 block")
                    .help("write G0 or G1 and the axis words into this block"));
            }
        }
        if self.state.modal.distance == Distance::Incremental {
            return Err(fault("G53 with incremental distances (G91)")
                .because("machine coordinates are absolute")
                .help("write G90 into this block"));
        }
        Ok(())
    }

    /// G10 L2 and L20.
    fn set_data(&mut self, block: &Block, span: Span) -> Outcome<()> {
        let kind = whole(block, b'L', 99)?.ok_or_else(|| missing(span, "G10", "L", "2 or 20"))?;
        if kind != 2 && kind != 20 {
            let message = format!("G10 L{kind} is not supported");
            return Err(Fault::new(Code::NotSupported, block.span(b'L'), message)
                .because("only coordinate systems (L2 and L20) can be set"));
        }
        let system = whole(block, b'P', 9)?
            .ok_or_else(|| missing(span, "G10", "P", "the coordinate system, 1 for G54"))?;
        let index = usize::try_from(system).unwrap_or_default();
        let index = index.checked_sub(1).unwrap_or(self.offsets.active);
        let values = self.axis_values(block);
        if kind == 20 {
            if block.get(b'R').is_some() {
                return Err(unused('R', block.span(b'R')));
            }
            self.offsets
                .set_current(index, self.state.position, &values);
        } else if let Some(slot) = self.offsets.systems.get_mut(index) {
            slot.origin = overlay(slot.origin, &values);
            slot.rotation_deg = block.get(b'R').unwrap_or(slot.rotation_deg);
        }
        Ok(())
    }

    /// Axis words in mm and degrees.
    pub(crate) fn axis_values(&self, block: &Block) -> [Option<f64>; AXES] {
        let scale = self.state.modal.units.mm();
        let mut values = [None; AXES];
        for (axis, value) in block.axes() {
            values[axis.index()] = Some(if axis.is_rotary() {
                value
            } else {
                value * scale
            });
        }
        values
    }
}
