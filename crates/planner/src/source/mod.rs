//! The sources of items: whatever a program is, and wherever it comes from, item by item.
//!
//! * `item_source` is the trait of all of them, and what they give.
//! * `program` is a text, `file` a file of any kind (`curve` and `nurbs` with their `file_moves`), `pipe` a pipe, and `sent`
//!   the lines that a sender sends as they come. `unchanged_file` and `fingerprint` see to it that it is one program to
//!   its end.
//! * `start_line` begins a program in its middle, and `resume` where it was left; `restoring` is what has to be told then
//!   of spindle, coolant and tools.
//! * What a program shares with whoever supervises its run, the `run_channels`: its `changes` to the machine's set-up, its
//!   `remarks` to people, and the `input_arbiter`, where it asks inputs and the probe.
//!
//! It may know `run`. How items are planned, and who executes them, it knows nothing of.

pub(crate) mod changes;
pub(crate) mod curve;
pub(crate) mod file;
pub(crate) mod file_moves;
pub(crate) mod fingerprint;
pub(crate) mod input_arbiter;
pub(crate) mod item_source;
pub(crate) mod nurbs;
pub(crate) mod pipe;
pub(crate) mod program;
pub(crate) mod remarks;
pub(crate) mod restoring;
pub(crate) mod resume;
pub(crate) mod run_channels;
pub(crate) mod sent;
pub(crate) mod start_line;
pub(crate) mod unchanged_file;
