//! The parts of a program, which begin and end at rest: each is planned by itself, and the plans
//! are joined again.
//!
//! ```text
//!            ┌─ items ─▶ PartPlanner ─ steps ─┐
//!  Cutter ───┼─ items ─▶ PartPlanner ─ steps ─┼─▶ Joiner ─▶ frames
//!            └─ items ─▶ PartPlanner ─ steps ─┘
//! ```
//!
//! The frames are those of one [`crate::Planner`] for the whole program, to the bit: numbers and
//! path positions go on from part to part in the [`Joiner`], in the order and with the roundings
//! that the planner has. Parts may be planned at the same time, by as many threads as there are.
//!
//! A part ends at an item after which the machine rests whatever follows (a dwell, an event at
//! rest; in the tube also an exact stop), and with a move that leads exactly to where the program
//! is, so that where the next one begins is known without planning. The next part begins with a
//! move that is long enough to be made. Nothing that an engine remembers reaches across such a rest,
//! but for two things of the engine on the path (that there were curves, and that other axes than
//! X, Y, Z moved): from there on its programs are not cut.

mod cutter;
mod joiner;
mod part_planner;
mod part_step;

pub use cutter::{Cutter, Placed};
pub use joiner::Joiner;
pub use part_planner::PartPlanner;
pub use part_step::PartStep;
