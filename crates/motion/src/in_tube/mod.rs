//! The in-tube engine: everything around the window planner, which turns a path with a tolerance
//! into the state of every axis at every period.
//!
//! ```text
//!  item ──Works───▶ works ──Flattener──▶ pieces, rests ──▶ one TubePlanner for each stretch ──▶ frames
//!        checks,     arcs to chords,                     between two rests
//!        rests       dense chords merged
//! ```
//!
//! * **Stretches.** The motion rests where the program asks for it: exact stops, dwells, events of the
//!   machine, the end. What lies between two rests is one stretch, rapids and feeds alike, each at its
//!   own speed and within the tolerance of the path. A stretch starts and ends on the period grid, so
//!   the last state of one and the first of the next are the same frame.
//! * **Exact path (G61)** leaves no tolerance to optimise in. Such moves are driven by the on-path engine,
//!   with an exact stop where the mode changes.
//! * **Curves** are driven by the on-path engine, too, which follows them without chords, with a law that is
//!   optimised along them: with what is among a curve's neighbours from the rest before it, if that is
//!   near ([`works`]). A window sees nothing but the chords, and is slower along many of them.
//! * **Work when asked.** [`InTubeEngine::push`] only checks and keeps an item. A frame that is asked
//!   for takes as many pieces as it needs, one by one, so an arc of a thousand turns or a run of a
//!   million blocks is never in memory as a whole, and the frames cannot depend on the chunks in which
//!   items arrive.

mod engine;
mod fallback;
mod flattening;
mod ledger;
mod merging;
mod path;
mod period;
mod planner;
mod verify;
mod window;
mod works;

pub(crate) use engine::InTubeEngine;
