//! The plan: from the items of a source to frames, one after the other.
//!
//! * `pipeline` joins a source and the planner of motion, `step` by step; `planning` is all that the frames to come depend
//!   on, `history` copies of it to plan again from, and `blocks` counts which block they belong to.
//! * `parallel` does the same on all cores, for whoever needs a whole plan; `ahead` does it in a thread of its own, for
//!   whoever publishes it.
//! * `joint_bounds` are the joints of a mechanism, as the planner of motion asks for them.
//!
//! It may know `source` and `run`. It is the same whether a machine is there or not, and no process is spoken to.

pub(crate) mod ahead;
pub(crate) mod blocks;
pub(crate) mod history;
pub(crate) mod joint_bounds;
pub(crate) mod parallel;
pub(crate) mod pipeline;
pub(crate) mod planning;
pub(crate) mod step;
