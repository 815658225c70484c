//! What is known of a stretch: its path, where the motion is, and what moves the machine.

use crate::in_tube::fallback::{Baseline, StopLeg};
use crate::in_tube::path::ReferencePath;
use crate::in_tube::verify::{Follower, History, Reachable};
use crate::in_tube::window::{Grid, Optimisers, SearchBias};
use crate::joints::{JointRows, SharedJoints};
use glidepath_geometry::AxisVector;
use glidepath_program::{Corners, Limits};

/// Most legs from vertex to vertex before windows are tried again. With 32, legs along the chords of an arc
/// took seconds.
pub(crate) const MOST_LEGS: usize = 8;

/// What moves the machine.
#[derive(Debug, Clone)]
pub(crate) enum ActiveMotion {
    /// At rest.
    Nothing,
    /// Legs from vertex to vertex: the one under way, the time since its start, how many are to end
    /// before a window is tried; rates have changed since its start.
    Legs {
        leg: Option<Box<StopLeg>>,
        leg_t: f64,
        wait: usize,
        is_stale: bool,
    },
    /// A window that ends at rest, periods of it that have been handed out and that will be.
    Window {
        points: Vec<AxisVector>,
        is_end: bool,
        done: usize,
        commit: usize,
    },
}

/// A stretch that is being planned.
#[derive(Debug, Clone)]
pub(crate) struct PlannerState {
    pub(crate) limits: Limits,
    pub(crate) period_t: f64,
    pub(crate) joints: SharedJoints,
    /// The same as limits along a straight way.
    pub(crate) joint_rows: Option<JointRows>,
    pub(crate) corners: Corners,
    pub(crate) reference_path: ReferencePath,
    /// Positions handed out last, and where on the path the last one is.
    pub(crate) history: History,
    pub(crate) follower: Follower,
    pub(crate) progress: (usize, f64),
    pub(crate) active: ActiveMotion,
    pub(crate) grid: Option<Grid>,
    pub(crate) optimisers: Optimisers,
    pub(crate) bias: SearchBias,
    /// Legs to run when the next window is refused: the more, the more have been.
    pub(crate) legs: usize,
    /// Stopping at every vertex; `None` after rates have changed, until the next rest.
    pub(crate) baseline: Option<Baseline>,
    /// Periods handed out.
    pub(crate) clock: usize,
    pub(crate) is_over: bool,
}

impl PlannerState {
    /// At rest at `start`, nothing known of the path; period in seconds.
    pub(crate) fn new(limits: &Limits, period_t: f64, start: AxisVector, bias: SearchBias) -> Self {
        Self {
            limits: *limits,
            period_t,
            joints: None,
            joint_rows: None,
            corners: Corners::default(),
            reference_path: ReferencePath::new(start),
            history: History::new(start),
            follower: Follower::new(Reachable::start_of(0), 0),
            progress: (0, 0.0),
            active: ActiveMotion::Nothing,
            grid: None,
            optimisers: Optimisers::default(),
            bias,
            legs: 1,
            baseline: None,
            clock: 0,
            is_over: false,
        }
    }

    /// The same, before its first piece, for joints that are not the axes.
    pub(crate) fn with_joints(mut self, joints: SharedJoints) -> Self {
        self.joint_rows = joints
            .clone()
            .map(|joints| JointRows::new(joints, self.limits.path));
        self.joints = joints;
        self.reference_path = self
            .reference_path
            .with_joints(&self.limits, self.joint_rows.as_ref());
        self
    }

    /// The leg to the end of the first piece from `index` on that does not end here.
    pub(crate) fn leg_from(&self, from: AxisVector, index: usize) -> Option<StopLeg> {
        (index..self.reference_path.end())
            .take_while(|&index| self.reference_path.is_settled(index))
            .find_map(|index| {
                let machine = (&self.limits, self.joint_rows.as_ref());
                StopLeg::new(machine, from, index, self.reference_path.get(index)?)
            })
    }

    /// Time since the start of the stretch.
    pub(crate) fn clock_t(&self) -> f64 {
        self.periods_t(self.clock)
    }

    pub(crate) fn periods_t(&self, periods: usize) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "exact for any stretch")]
        let periods = periods as f64;
        periods * self.period_t
    }
}
