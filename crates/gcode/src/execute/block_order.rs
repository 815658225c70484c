//! The modal interpreter: one block at a time, in the order RS274/NGC prescribes.
//!
//! Whatever stands where in a line, a block acts in this order: feed mode, F, S, T, tool change,
//! spindle, coolant, overrides, saved state, inputs and outputs, dwell, plane, units, diameter
//! mode, cutter radius, tool length, coordinate system, path mode, distance modes, retract mode,
//! then G10, G28, G30, G52 or G92, then the motion, and last the stop.
//!
//! A block that is refused has no effect at all ([`whole_or_nothing`](crate::execute::whole_or_nothing)).

use glidepath_geometry::AXES;
use glidepath_program::{Event, Item, ItemKind, PathMode};

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::block_words::{check_named_words, check_words, path_mode};
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::corner::CornerMove;
use crate::execute::motion::speed::Pace;
use crate::execute::state::open_spline::{goes_on, interrupted};
use crate::execute::state::sticky_words::CycleSeries;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::dialect::Dialect;
use crate::syntax::letters::Letters;
use crate::syntax::modes::{Distance, Motion, Spline, Stop};

/// What follows a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum AfterBlock {
    Continue,
    /// M2 or M30: nothing after it is read.
    End,
}

impl Interpreter {
    /// Executes a block: appends what it does to `out`, and nothing when the block is refused.
    pub(crate) fn execute(
        &mut self,
        block: &Block,
        line: u32,
        out: &mut Vec<Item>,
    ) -> Outcome<AfterBlock> {
        self.begin(line);
        self.mapped_items = out.len();
        if block.is_plain() {
            let code = block.codes.motion.and_then(|motion| motion.code);
            if self.go(code, &block.words, false, out) {
                return Ok(AfterBlock::Continue);
            }
        }
        self.whole_or_nothing(out, |interpreter, out| {
            let after = interpreter.run(block, out)?;
            interpreter.map_moves(block, out)?;
            Ok(after)
        })
    }

    fn run(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<AfterBlock> {
        if let Some(Coded { code, span }) = block.codes.function {
            self.machine_function(block, code, span, out)?;
            return Ok(AfterBlock::Continue);
        }
        let motion = self.motion_of(block)?;
        let motion = motion.map(|motion| self.motion_to_machine_place(block, motion));
        if let Some(open) = &self.state.open.spline
            && !goes_on(block, open, motion)
        {
            return Err(interrupted(open, block.first_span()));
        }
        self.check_open_plane(block)?;
        self.check_plane_of_cycle(block)?;
        self.check_units_of_mach(block)?;
        self.settle_held(block, motion, out)?;
        check_words(block, motion)?;
        self.check_axes(block)?;
        self.check_compensated(block)?;
        self.feed(block, motion)?;
        if block.says_modes || block.has_any(Letters::of(b"STDH")) {
            self.auxiliary(block, out)?;
            self.modes(block, out)?;
            if block.dialect != Dialect::LinuxCnc {
                self.modes_of_dialects(block)?;
            }
        }
        if block.dialect == Dialect::LinuxCnc {
            self.switch_kinematics(block, out)?;
        }
        if let Some(non_modal) = block.codes.non_modal {
            self.act_non_modal(block, non_modal, motion, out)?;
        }
        self.act_once(block, out)?;
        if let Some(Coded { code, .. }) = block.codes.motion
            && !block.codes.is_once
        {
            self.state.modal.motion = self.mode_behind(block, code);
            if !matches!(code, Some(Motion::Cycle(_))) {
                self.state.cycles = CycleSeries::default();
            }
            if !matches!(code, Some(Motion::Turning(_))) {
                self.state.fanuc.turning = None;
            }
        }
        if !matches!(motion, None | Some(Motion::Spline(Spline::Cubic))) {
            self.state.cubic_tail = None;
        }
        if let Some(motion) = motion {
            self.move_with_own_words(block, motion, out)?;
        }
        self.end_length_on_way(block, motion);
        let stop = block.codes.stop.map(|stop| stop.code);
        Ok(match stop {
            Some(Stop::End) => {
                self.end_compensation(out)?;
                self.end_offsets();
                self.end_auxiliary(out);
                AfterBlock::End
            }
            Some(Stop::Program(number)) => {
                self.push(out, ItemKind::Event(Event::ProgramStop(number)));
                AfterBlock::Continue
            }
            Some(Stop::Optional) if self.options.stops_at_m1 => {
                self.push(out, ItemKind::Event(Event::OptionalStop));
                AfterBlock::Continue
            }
            Some(Stop::Optional) | None => AfterBlock::Continue,
        })
    }

    /// The motion of a block, with its exact stop (G9) and its own feed (FB), which end with it.
    fn move_with_own_words(
        &mut self,
        block: &Block,
        motion: Motion,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        self.take_polar_words(block);
        self.take_pole_words(block);
        let mode = self.state.modal.path_mode;
        if block.codes.exact_stop.is_some() {
            self.state.modal.path_mode = PathMode::ExactStop;
        }
        let feed = self.take_block_feed(block)?;
        let from = self.state.position;
        let followed = self.leave_tip(block, out)?;
        self.motion(block, motion, out)?;
        if followed {
            self.follow_tip_again(block, out)?;
        }
        self.forget_untraversed(block, &from);
        if let Some(feed) = feed {
            self.state.modal.feed = feed;
        }
        self.state.modal.path_mode = mode;
        Ok(())
    }

    /// Codes of other dialects that act once, and move by themselves.
    fn act_once(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        if let Some(coded) = block.codes.kept_place {
            self.kept_place(block, coded, out)?;
        }
        if block.codes.tilt.is_some() {
            self.fanuc_tilt(block)?;
            self.fanuc_align(block, out)?;
        }
        Ok(())
    }

    /// What the blocks before have left open, and what in force forbids the block.
    fn settle_held(
        &mut self,
        block: &Block,
        motion: Option<Motion>,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        if block.dialect != Dialect::LinuxCnc {
            self.check_open_tap(block, motion)?;
            self.check_lengthening(block, motion)?;
            self.settle_thread(block, motion, out)?;
            check_named_words(block, motion, self.state.rounds_mm > 0.0)?;
            self.settle_line(block, motion, out)?;
        }
        self.settle_corner(block, motion, out)?;
        if self.state.is_mapped {
            // They were made with what was in force.
            self.map_moves(block, out)?;
        }
        if motion.is_some() {
            self.check_tilt(block)?;
            self.check_dynamic_offset(block)?;
        }
        self.check_machine_place(block)?;
        Ok(())
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
            self.state.feeds_in_mm = codes.feeds_in_mm;
        }
        if let Some(Coded { code, .. }) = codes.diameter {
            modal.diameter = code;
            self.state.diameter_by_distance = false;
        }
        self.state.diameter_by_distance |= codes.diameter_by_distance.is_some();
        if let Some(coded) = codes.cutter_radius {
            self.cutter_radius(block, coded, out)?;
        }
        if let Some(coded) = codes.tool_length {
            self.tool_length(block, coded)?;
        }
        if let Some(coded) = codes.system {
            let before = self.place_names();
            self.choose_system(coded)?;
            self.rename_by_frame(&before, AXES);
        }
        let modal = &mut self.state.modal;
        if let Some(Coded { code, .. }) = codes.path_mode {
            modal.path_mode = path_mode(block, code, modal.units.mm())?;
        }
        if let Some(Coded { code, .. }) = codes.distance {
            modal.distance = code;
            self.state.extruder.distance(code == Distance::Incremental);
        }
        if self.state.diameter_by_distance {
            modal.diameter = modal.distance == Distance::Absolute;
        }
        if let Some(Coded { code, .. }) = codes.extruder {
            self.state.extruder.code(code);
        }
        if let Some(Coded { code, .. }) = codes.arc_distance {
            modal.arc_distance = code;
        }
        if let Some(Coded { code, .. }) = codes.retract {
            modal.retract = code;
        }
        Ok(())
    }

    /// Modes that LinuxCNC's language does not have.
    fn modes_of_dialects(&mut self, block: &Block) -> Outcome<()> {
        if let Some(coded) = block.codes.tip
            && block.dialect == Dialect::Siemens
        {
            self.follow_tip(coded)?;
        }
        if let Some(Coded { code, .. }) = block.codes.arc_feed {
            self.state.arc_feed = code;
        }
        if let Some(Coded { code, .. }) = block.codes.turns_on_circles {
            self.state.turns_on_circles = code;
        }
        if block.dialect == Dialect::Siemens {
            let before = self.place_names();
            self.choose_edge(block)?;
            self.rename_by_length(&before);
        }
        if block.dialect == Dialect::Fanuc {
            self.fanuc_modes(block)?;
        }
        Ok(())
    }

    pub(crate) const fn has_corners(&self, block: &Block) -> bool {
        self.state.open.corner.is_some() || block.corner.is_some() || self.state.rounds_mm > 0.0
    }

    /// Makes the motion of a block.
    pub(crate) fn motion(
        &mut self,
        block: &Block,
        motion: Motion,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        if !matches!(
            motion,
            Motion::RigidTap
                | Motion::TapIn
                | Motion::TapOut
                | Motion::Cycle(_)
                | Motion::HolePattern(_)
        ) {
            self.spindle_from_taps(out);
        }
        match motion {
            Motion::Rapid | Motion::Linear => {
                let target = self.lengthened(block, self.target(block)?)?;
                // Printers move at the feedrate in G0 too.
                let printer = block.dialect == Dialect::Marlin && self.state.modal.feed.is_some();
                let pace = if motion == Motion::Rapid && !printer {
                    Pace::Rapid
                } else {
                    Pace::Feed
                };
                if motion == Motion::Linear && self.hold_line(block)? {
                    return Ok(());
                }
                if self.has_corners(block) && motion == Motion::Linear {
                    self.move_between_corners(block, CornerMove { target, arc: None }, out)?;
                } else {
                    self.straight_to_direction(block, target, pace, out)?;
                }
            }
            Motion::ArcClockwise | Motion::ArcCounterclockwise => self.arc(block, motion, out)?,
            Motion::Cycle(cycle) => self.cycle(block, cycle, out)?,
            Motion::Lathe(cycle) => self.begin_lathe_cycle(block, cycle, out)?,
            Motion::Probe(probe) => {
                self.check_probe_map(block)?;
                self.probe(probe, block, out)?;
            }
            Motion::Spline(spline) => self.spline(block, spline, out)?,
            Motion::Thread => self.thread(block, out)?,
            Motion::RigidTap => self.rigid_tap(block, out)?,
            Motion::ArcThrough => self.arc_through(block, out)?,
            Motion::ArcTangent => self.tangent_arc(block, out)?,
            Motion::TapIn => self.tap_in(block)?,
            Motion::TapOut => self.tap_out(block, out)?,
            Motion::ThreadCycle if block.dialect == Dialect::Fanuc => {
                self.fanuc_thread(block, out)?;
            }
            Motion::ThreadCycle => self.thread_cycle(block, out)?,
            Motion::Turning(cycle) => self.turning(block, cycle, out)?,
            Motion::CirclePocket(is_clockwise) => self.circle_pocket(block, is_clockwise, out)?,
            Motion::HolePattern(is_arc) => self.hole_pattern(block, is_arc, out)?,
            Motion::Groove(across) => self.groove(block, across, out)?,
        }
        self.follow_surface(out);
        Ok(())
    }
}
