//! A program as stretches between rests, each planned the way that is faster.
//!
//! ```text
//!                                    ┌▶ on_path ┐
//!  item ──Gathering──▶ short stretch ┤          ├▶ the faster one ────────────────▶ frames
//!         checks,                    └▶ in_tube ┘
//!         rests                      ┌▶ on_path ┐
//!                  ──▶ long stretch ─┤          ├▶ the faster one from place to place ▶ frames
//!                                    └▶ in_tube ┘
//!                  ──▶ rest ──────────────────────────────────────────────────────▶ frames
//! ```
//!
//! The motion rests where the program asks for it: exact stops, dwells, events of the machine, the
//! end. What lies between two rests is a stretch: it begins and ends at rest and on the period
//! grid, so how it is driven is nobody else's concern. A short one is planned as a whole by both
//! wings before its first frame is given out ([`contest`]). One that is longer than may be kept is
//! planned by both as it comes, and driven the way that is faster from one place that both pass
//! alike to the next ([`race`]). Which of them it is depends on its items alone.

mod contest;
mod engine;
mod gathering;
mod joint;
mod long_stretch;
mod numbers;
mod program_path;
mod race;
mod runner;
mod way;

pub(crate) use engine::StretchEngine;
