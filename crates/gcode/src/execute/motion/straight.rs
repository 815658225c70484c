//! Straight moves, reference moves, and which motion a block makes.

use glidepath_geometry::{AXES, Axis, AxisVector, Segment};
use glidepath_program::{Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::axis_words::homes_without_mesh;
use crate::execute::motion::settled::{MIN_MOVE, settled};
use crate::execute::motion::speed::{Pace, Speed};
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;

impl Interpreter {
    /// A straight move to a machine position.
    pub(crate) fn straight(
        &mut self,
        block: &Block,
        target: AxisVector,
        pace: Pace,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let goal = self.beside_contour(block, &target);
        self.state.leaving_contour = goal.is_some();
        if self.state.open.compensation.is_some() {
            return self.compensated_straight(block, target, pace, out);
        }
        let start = self.state.path_end;
        let end = settled(start, goal.unwrap_or(target), [None, None]);
        self.state.position = target;
        if end == start {
            self.count_zero_length(pace);
            return Ok(());
        }
        self.check_limits(block, &end, &end, "the end")?;
        if pace == Pace::Feed && self.state.spindle.follows_tool() {
            return self.straight_at_surface(block, end, out);
        }
        let segment = Segment::line(start, end);
        let speed = self.speed(block, &segment, pace)?;
        self.push_move(segment, speed, out);
        Ok(())
    }

    /// Behind G40 a move outside the plane stays beside the contour, on a FANUC and a SINUMERIK: the next
    /// one in the plane leads away from there. `None`: it goes to its target.
    fn beside_contour(&self, block: &Block, target: &AxisVector) -> Option<AxisVector> {
        let keeps_beside = matches!(block.dialect, Dialect::Fanuc | Dialect::Siemens);
        let state = &self.state;
        if !keeps_beside || !state.leaving_contour || state.contour_plane.is_some() {
            return None;
        }
        let (first, second) = state.modal.plane.axes();
        let axes = [first.index(), second.index()];
        let is_still = |axis: &usize| (target[*axis] - state.position[*axis]).abs() <= MIN_MOVE;
        let is_named = block.axes().any(|(axis, _)| axes.contains(&axis.index()));
        if is_named || !axes.iter().all(is_still) {
            return None;
        }
        let mut goal = *target;
        for axis in axes {
            goal[axis] = state.path_end[axis];
        }
        Some(goal)
    }

    pub(crate) fn push_move(&mut self, segment: Segment, speed: Speed, out: &mut Vec<Item>) {
        self.state.path_end = segment.end();
        let kind = ItemKind::Move {
            segment,
            rate: speed.rate(&segment),
            mode: self.path_mode(),
        };
        self.push(out, kind);
    }

    /// G28 and G30: by way of the programmed point to the reference position, at rapid speed. With
    /// axis words, only those axes move; without, neither the extruder nor the spindle does.
    pub(crate) fn go_to_reference(
        &mut self,
        block: &Block,
        index: usize,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        if block.dialect == Dialect::Marlin {
            if block.get(b'O').is_some() {
                // The place of the machine is known.
                return Ok(());
            }
            self.raise_before_homing(block, out)?;
        }
        let is_flag = homes_without_mesh(block) && !self.options.machine.has(Axis::W);
        let named = |axis: Axis| !(is_flag && axis == Axis::W);
        let all = !block.axes().any(|(axis, _)| named(axis));
        if all && block.dialect == Dialect::Fanuc {
            self.check_reference_of_all(block)?;
        }
        // The letters of a printer's G28 say which axes go; their numbers mean nothing.
        if !all && block.dialect != Dialect::Marlin {
            let target = self.target(block)?;
            self.straight(block, target, Pace::Rapid, out)?;
        }
        let followed = self.leave_tip(block, out)?;
        let reference = self
            .state
            .offsets
            .reference
            .get(index)
            .copied()
            .unwrap_or_default();
        let mut target = self.state.position;
        let values = self.axis_values(block)?;
        for axis in Axis::ALL {
            let i = axis.index();
            let stays = [self.options.extruder, self.spindle_axis()].contains(&Some(axis));
            let goes = self.options.machine.has(axis) && !stays;
            if values[i].is_some() || (all && goes) {
                target[i] = self.reference_within_a_turn(block, axis, reference[i])?;
            }
        }
        self.straight(block, target, Pace::Rapid, out)?;
        if followed {
            self.follow_tip_again(block, out)?;
        }
        if block.dialect == Dialect::Marlin {
            self.count_anew(|axis| values[axis.index()].is_some() || all);
        }
        Ok(())
    }

    /// An axis of a printer that is at home counts from there: what G92 shifted is gone, and what Klipper's
    /// `SET_GCODE_OFFSET` set stays.
    fn count_anew(&mut self, is_home: impl Fn(Axis) -> bool) {
        for axis in [Axis::X, Axis::Y, Axis::Z]
            .into_iter()
            .filter(|axis| is_home(*axis))
        {
            let i = axis.index();
            self.state.offsets.shift[i] = self.state.gcode_offset[i];
            self.state.offsets.saved_shift[i] = self.state.offsets.shift[i];
        }
    }

    /// A Haas sends all axes home where G28 names none, a FANUC moves nothing.
    fn check_reference_of_all(&self, block: &Block) -> Outcome<()> {
        if self.options.fanuc.is_haas() {
            return Ok(());
        }
        let span = block
            .codes
            .non_modal
            .map_or_else(|| block.motion_span(), |coded| coded.span);
        let message = "a way to the reference position without axes";
        Err(BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, span, message)
            .because("a Haas sends all axes there, and a FANUC moves none")
            .help("name the axes, as in G91 G28 X0 Y0 Z0; or set offset_memory = \"haas\" in [program]"))
    }

    /// R of a printer's G28: Z goes up to that coordinate first, and never down.
    fn raise_before_homing(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let Some(height) = block.get(b'R').filter(|height| *height > 0.0) else {
            return Ok(());
        };
        let mut wanted = [None; AXES];
        wanted[2] = Some(height * self.state.modal.units.mm());
        let mut target = self.state.position;
        target[2] = target[2].max(self.absolute_target(&wanted)[2]);
        self.straight(block, target, Pace::Rapid, out)
    }
}
