//! Tests of programs as text: what they mean, and what is wrong with them. One binary: it links
//! once.

#![allow(
    clippy::expect_used,
    clippy::float_cmp,
    clippy::panic,
    clippy::unwrap_used,
    reason = "tests, which clippy does not see as such"
)]

mod carried;
mod compensated_arcs;
mod corpus;
mod corpus_refused;
mod damaged;
mod diagnostics;
mod dialect_program;
mod dialect_programs;
mod dialects;
mod fanuc;
mod fanuc_broken_corners;
mod fanuc_calls;
mod fanuc_corners;
mod fanuc_cycle_levels;
mod fanuc_cycles;
mod fanuc_face_cycles;
mod fanuc_feeds;
mod fanuc_heads;
mod fanuc_increments;
mod fanuc_lathe_holes;
mod fanuc_lathe_passes;
mod fanuc_lathe_variables;
mod fanuc_lathe_words;
mod fanuc_lathes;
mod fanuc_lengthening;
mod fanuc_lengths;
mod fanuc_macros;
mod fanuc_mill_words;
mod fanuc_mirror_switch;
mod fanuc_patterns;
mod fanuc_roll_over;
mod fanuc_rotation_start;
mod fanuc_threads;
mod five_axes;
mod flow;
mod gears;
mod lathe_cycles;
mod lathe_reference;
mod m_codes;
mod machining;
mod motion;
mod orientations;
mod plain_lines;
mod poles;
mod posts;
mod printers;
mod probing;
mod reference;
mod saved_state;
mod shop_programs;
mod siemens;
mod spindle_angle;
mod splines;
mod subroutine_files;
mod support;
mod tapping;
mod tilted_contours;
mod tilted_planes;
mod typed;
mod words_of_dialects;
mod words_page;
