//! The carry-over of what is in force from one program to the next.

use std::io::BufRead;
use std::mem;
use std::sync::Arc;

use glidepath_geometry::Plane;

use crate::execute::power_on::{motion_at_start, siemens_x_at_start};
use crate::execute::program::Program;
use crate::execute::state::fanuc_modal::FanucModal;
use crate::execute::state::in_force::{InForce, InForceParts};
use crate::execute::state::modal::Modal;
use crate::execute::state::pole::Pole;
use crate::execute::state::spindle::Spindle;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{Distance, FeedMode, Motion};

impl<R: BufRead> Program<R> {
    /// The state in force behind the line read last, as the next program begins: cutter radius
    /// compensation, open curves, saved states (M70) and what is local to subroutines end with a
    /// program. One that ended by M2 or M30 leaves what these leave in LinuxCNC.
    #[must_use]
    pub fn in_force(&self) -> InForce {
        let interpreter = &self.interpreter;
        let mut state = interpreter.state.clone();
        state.end_with_program();
        if self.ended && !self.ran_out {
            let modal = &mut state.modal;
            modal.distance = Distance::Absolute;
            // A lathe of FANUC has one plane, and keeps G98 and G99.
            if !self.block.is_lathe {
                modal.plane = if interpreter.options.is_siemens_lathe() {
                    Plane::Zx
                } else {
                    Plane::Xy
                };
                modal.feed_mode = FeedMode::PerMinute;
            }
            modal.motion = Some(motion_at_start(self.block.dialect).unwrap_or(Motion::Linear));
            // M2 and M30 have stopped it; the percent line at the end does not.
            state.spindle = Spindle {
                is_rigid: false,
                is_axis: state.spindle.stands_for_tap(),
                ..state.spindle
            };
            state.overrides_off = false;
            state.arc_feed = self.arc_feed_at_start();
            siemens_x_at_start(&interpreter.options, &mut state);
        }
        let mut parameters = self.parameters.clone();
        parameters.leave_all();
        InForce(Arc::new(InForceParts {
            state,
            parameters,
            dialect: self.block.dialect,
            is_lathe: self.block.is_lathe,
            is_typed: self.is_typed,
        }))
    }

    /// Begins with what is in force, where the options say that the machine stands. Coordinate
    /// systems, which of them is chosen, the offset G92.3 brings back and reference positions are those of
    /// the options: somebody may have set them since.
    pub(crate) fn begin_with(&mut self, in_force: &InForce) {
        let InForceParts {
            state,
            parameters,
            dialect,
            is_lathe,
            is_typed,
        } = in_force.0.as_ref();
        let interpreter = &mut self.interpreter;
        let start = interpreter.options.start;
        let own = mem::replace(&mut interpreter.state, state.clone());
        interpreter.state.fanuc = FanucModal::default();
        // Other languages leave a length that is of no edge.
        let has_edges = [*dialect, self.block.dialect] == [Dialect::Siemens; 2];
        interpreter.state.edge = interpreter.state.edge.filter(|_| has_edges);
        interpreter.state.tip = interpreter.options.first_tip();
        interpreter.state.turns_on_circles = false;
        interpreter.state.tilted = None;
        interpreter.state.contour_plane = None;
        interpreter.state.rounds_mm = 0.0;
        interpreter.state.corner_feed = None;
        interpreter.state.diameter_by_distance &= *is_typed;
        interpreter.state.pole = Pole::default();
        interpreter.state.feeds_in_mm = false;
        let map = interpreter.tip_map();
        let place = map.map_or(start, |map| map.place(&start));
        (interpreter.state.position, interpreter.state.path_end) = (place, place);
        (interpreter.state.axes_end, interpreter.state.is_mapped) = (start, map.is_some());
        let mut offsets = own.offsets;
        offsets.tool = state.offsets.tool;
        offsets.shift = state.offsets.shift;
        let (fanuc, carried) = (&mut offsets.fanuc, &state.offsets.fanuc);
        fanuc.external = carried.external;
        fanuc.extended.clone_from(&carried.extended);
        fanuc.wear.clone_from(&carried.wear);
        interpreter.state.offsets = offsets;
        interpreter.state.tools = own.tools.or_else(|| state.tools.clone());
        interpreter.state.changes = own.changes;
        interpreter.state.firmware = own.firmware;
        // Those of another language mean something else.
        if parameters.is_like(&self.parameters) {
            self.parameters = parameters.clone();
        }
        if !*is_typed {
            siemens_x_at_start(&self.interpreter.options, &mut self.interpreter.state);
        }
        if self.block.is_lathe && *is_lathe {
            self.interpreter.state.fanuc.is_feed_unsaid = state.fanuc.is_feed_unsaid;
        } else if *dialect != self.block.dialect || self.block.is_lathe != *is_lathe {
            self.begin_behind_another_language(*dialect, *is_lathe);
        }
    }

    /// Whether X is a diameter, on lathes of FANUC and SINUMERIK the plane, and on those of FANUC what F is, are of a
    /// language, and not of what another one has left.
    fn begin_behind_another_language(&mut self, before: Dialect, was_lathe: bool) {
        self.interpreter.state.arc_feed = self.arc_feed_at_start();
        let options = &self.interpreter.options;
        let is_turning = options.is_lathe();
        let (at_start, feed) = (
            Modal::new(options.default_feed_mm_min),
            options.fanuc.feed_at_start,
        );
        let modal = &mut self.interpreter.state.modal;
        modal.diameter = at_start.diameter;
        modal.motion = motion_at_start(self.block.dialect).or(modal.motion);
        if before == Dialect::Siemens && is_turning {
            modal.plane = at_start.plane;
        }
        if was_lathe || self.block.is_lathe {
            (modal.motion, modal.plane) = (at_start.motion, at_start.plane);
            (modal.feed_mode, modal.feed) = (at_start.feed_mode, at_start.feed);
            self.power_on(feed);
        } else {
            self.siemens_power_on();
        }
    }
}
