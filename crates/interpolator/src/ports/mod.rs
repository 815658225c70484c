//! The ports thread: everything that talks to other processes, and what is judged of what they say.
//!
//! * `turn` is one turn of the thread: it owns the ports, and all that follows.
//! * Coming in: `frame_validation` judges frames, `commands` commands (`job` has the part of them that is about a planner's
//!   job), `demand_reader` demands for jogs, `acknowledgements` answers to events; `feedback` is what the drives say, and
//!   `homing` looks in it for where joints are.
//! * Going out: `status`, with `block_starts` for the way within a block, and `told_by_hand`, its texts about motion by
//!   hand; `auxiliary`, the record that spindle and coolant obey, with `code_words` and `tool_change`.
//!
//! It may know `shared`, and neither the real-time thread nor who starts both: what the threads want of each other passes
//! the rings of `shared::message`. It may allocate, log and wait.

pub(crate) mod acknowledgements;
pub(crate) mod auxiliary;
pub(crate) mod block_starts;
pub(crate) mod code_words;
pub(crate) mod commands;
pub(crate) mod demand_reader;
pub(crate) mod feedback;
pub(crate) mod frame_validation;
pub(crate) mod homing;
pub(crate) mod job;
pub(crate) mod status;
pub(crate) mod told_by_hand;
pub(crate) mod tool_change;
pub(crate) mod turn;
