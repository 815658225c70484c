//! The meaning: from blocks to moves and events in machine coordinates.
//!
//! ```text
//! Program ── line by line, with jumps and calls (flow, dialect) ──► Block
//!    │                                                                │
//!    └── Interpreter ◄── block_order: in the order RS274/NGC prescribes
//!           │   auxiliary: feed, spindle, tools, inputs and outputs, offsets
//!           │   motion: axis words, straight moves, arcs, splines, probing
//!           │   canned_cycle, lathe_cycle: one block, many moves
//!           └── compensation: beside the contour, by the tool's radius ──► items
//! ```
//!
//! What is in force from block to block is in [`state`], which knows nothing of the interpreter;
//! [`interpreter::Interpreter`] has all of it, and every other module adds to it what one kind of
//! code does.

pub(crate) mod auxiliary;
pub(crate) mod awaited_codes;
pub(crate) mod block_order;
pub(crate) mod block_words;
pub(crate) mod canned_cycle;
mod carry_over;
pub(crate) mod compensation;
mod cycle_check;
mod cycle_levels;
mod cycle_places;
pub(crate) mod cycle_words;
pub(crate) mod dialect;
mod execute_line;
mod fanuc_thread;
mod fine_boring;
pub(crate) mod flow;
mod helix_share;
pub(crate) mod interpreter;
pub(crate) mod lathe_cycle;
pub(crate) mod line_origin;
pub(crate) mod motion;
pub(crate) mod parameters;
mod power_on;
mod probing;
pub(crate) mod program;
mod program_end;
mod program_view;
mod reading;
mod refused_block;
mod remark;
pub(crate) mod scope;
mod start_state;
pub(crate) mod state;
mod state_names;
mod tapping_cycle;
mod thread_cycle;
pub(crate) mod whole_or_nothing;
