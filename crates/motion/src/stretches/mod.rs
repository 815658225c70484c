//! The stretches of a program, between its rests: each is planned the way that is faster.
//!
//! ```text
//!                                    ┌▶ on_path ┐
//!  item ──Gathering──▶ short stretch ┤          ├▶ the faster one ──▶ frames
//!         checks,                    └▶ in_tube ┘
//!         rests    ──▶ long stretch ───▶ in_tube, or on_path ───────▶ frames
//!                  ──▶ rest ────────────────────────────────────────▶ frames
//! ```
//!
//! The motion rests where the program asks for it: exact stops, dwells, events of the machine, the
//! end. What lies between two rests is a stretch: it begins and ends at rest and on the period
//! grid, so how it is driven is nobody else's concern. A short one is planned as a whole by both
//! engines before its first frame is given out ([`candidate_selection`]). One that is longer than may be kept is
//! planned as it comes: in the tube, unless its arcs are tight ([`tight_arcs`]) and its beginning is faster along the
//! path. Which of them it is depends on its items alone.

mod candidate_selection;
mod engine;
mod engine_run;
mod entry;
mod gathering;
mod tight_arcs;

pub(crate) use engine::StretchEngine;
pub use gathering::MOST_MOVES_AT_ONCE;
