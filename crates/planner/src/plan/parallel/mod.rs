//! The parallel plan: planning ahead of time, on all cores.
//!
//! ```text
//!              ┌─ worker: PartPlanner ─┐
//!  reader ─────┼─ worker: PartPlanner ─┼────▶ ParallelPipeline ─▶ caller
//!  (source,    └─ worker: PartPlanner ─┘      (Joiner)
//!   Cutter)        parts, in order
//! ```
//!
//! A program is cut where the machine rests whatever follows ([`glidepath_motion::parts`]); the
//! parts are planned by as many threads as there are cores, and joined in order.
//!
//! * **The same steps.** Items and frames come in the order, and with the bits, that a
//!   [`crate::Pipeline`] gives. How many threads there are does not show in them.
//! * **Bounded memory.** What was planned and not taken is bounded for all parts together
//!   ([`bounds`]), and so are the items between reader and workers. A part need not be
//!   in memory as a whole: it flows from its worker to the caller like a program without rests.
//! * **No standstill.** Parts are taken up in order, and the plan of the first one that is not
//!   taken yet always has room of its own. Items wait for nothing but their worker: those of the
//!   first part are all with it, or it is the part that is being read.

mod allowance;
mod bounds;
mod message;
mod pipeline;
mod reader;
mod threads;
mod worker;

pub use pipeline::ParallelPipeline;
