//! The state of the interpreter from block to block, part by part.

pub(crate) mod contour_plane;
pub(crate) mod coolant;
pub(crate) mod course;
pub(crate) mod extruder;
pub(crate) mod fanuc_modal;
pub(crate) mod fanuc_offsets;
pub(crate) mod frame;
pub(crate) mod in_force;
pub(crate) mod modal;
pub(crate) mod offsets;
pub(crate) mod open_corner;
pub(crate) mod open_line;
pub(crate) mod open_plane;
pub(crate) mod open_spline;
pub(crate) mod open_tap;
pub(crate) mod pole;
pub(crate) mod printer;
pub(crate) mod probe_result;
pub(crate) mod program_state;
pub(crate) mod saved_states;
pub(crate) mod soft_limits;
pub(crate) mod spindle;
pub(crate) mod sticky_words;
pub(crate) mod thread_setup;
pub(crate) mod tip;
pub(crate) mod words_in_force;
