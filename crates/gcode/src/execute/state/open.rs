//! What the blocks before have left open for the next one.

use crate::execute::compensation::path::Compensation;
use crate::execute::state::open_corner::OpenCorner;
use crate::execute::state::open_line::OpenLine;
use crate::execute::state::open_spline::OpenSpline;
use crate::execute::state::open_tap::OpenTap;
use crate::execute::state::open_thread::OpenThread;

/// What the blocks before have left open: no item of it was given out, or not all.
#[derive(Debug, Clone, Default)]
pub(crate) struct Open {
    pub(crate) compensation: Option<Compensation>,
    /// The move to a corner that is to be broken.
    pub(crate) corner: Option<Box<OpenCorner>>,
    /// The line of which the direction alone is known.
    pub(crate) line: Option<Box<OpenLine>>,
    /// The tap that is in its hole.
    pub(crate) tap: Option<OpenTap>,
    /// The thread that its next block goes on with.
    pub(crate) thread: Option<OpenThread>,
    /// The NURBS whose control points are being read.
    pub(crate) spline: Option<OpenSpline>,
}

impl Open {
    /// True if nothing is open.
    pub(crate) const fn is_nothing(&self) -> bool {
        let Self {
            compensation,
            corner,
            line,
            tap,
            thread,
            spline,
        } = self;
        compensation.is_none()
            && corner.is_none()
            && line.is_none()
            && tap.is_none()
            && thread.is_none()
            && spline.is_none()
    }
}
