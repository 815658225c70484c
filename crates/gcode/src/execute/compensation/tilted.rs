//! Contours in a tilted plane (G68.2 with G53.1, CYCLE800): they are compensated in its own coordinates.
//!
//! ```text
//!   place on the work = B + shift + M · (place in the plane − B)      B: the zero of the program
//! ```

use glidepath_geometry::Plane;
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::contour_plane::ContourPlane;
use crate::execute::state::frame::Frame;
use crate::execute::state::tip::Tilt;
use crate::syntax::block::Block;

impl Interpreter {
    /// True for a contour that is in a tilted plane, and in none of the machine as it is.
    pub(super) fn is_in_tilted_plane(&self, plane: Plane) -> bool {
        let is_same = self
            .state
            .offsets
            .plane(plane)
            .is_some_and(|image| image.plane == plane);
        self.state.tilted == Some(Tilt::Stands)
            && self.options.five_axis.is_some()
            && !is_same
            && !self.state.offsets.is_rotated()
            && self.state.offsets.frame.only_turns()
    }

    /// From here on places are those of the tilted plane.
    pub(super) fn enter_contour_plane(
        &mut self,
        block: &Block,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        self.map_moves(block, out)?;
        let axes = *self.axes_place();
        let frame = core::mem::take(&mut self.state.offsets.frame);
        let zero = self
            .state
            .offsets
            .to_machine(glidepath_geometry::AxisVector::zeros());
        let map = Frame::shifted(zero)
            .with(&frame)
            .with(&Frame::shifted(-zero));
        self.state.contour_plane = Some(ContourPlane { map, frame });
        self.state.position = map.undo(self.state.position);
        self.state.path_end = map.undo(self.state.path_end);
        (self.state.axes_end, self.state.is_mapped) = (axes, true);
        Ok(())
    }

    /// Gives out what was made in the tilted plane; places are those of the work again.
    pub(super) fn leave_contour_plane(&mut self, out: &mut Vec<Item>) -> Outcome<()> {
        let Some(plane) = self.state.contour_plane else {
            return Ok(());
        };
        self.map_moves(&Block::default(), out)?;
        let axes = *self.axes_place();
        self.state.contour_plane = None;
        self.state.offsets.frame = plane.frame;
        self.state.position = plane.map.apply(self.state.position);
        self.state.path_end = plane.map.apply(self.state.path_end);
        (self.state.axes_end, self.state.is_mapped) = (axes, self.tip_map().is_some());
        Ok(())
    }
}
