//! Geometry and time free in the tube around the path.
//!
//! Everything around the planner of a stretch ([`planner`]), which turns a path with a tolerance
//! into the state of every axis at every period.
//!
//! ```text
//!  item ──WorkQueue──▶ work ──Flattener──▶ pieces, rests ──▶ one TubePlanner for each stretch ──▶ frames
//!        checks         arcs to chords,                     in the tube
//!                       dense chords merged
//! ```
//!
//! * **Stretches.** An engine is given one stretch, from a rest of the program to the next
//!   ([`crate::stretches`]), rapids and feeds alike, each at its own speed and within the tolerance
//!   of the path. It starts and ends on the period grid.
//! * **Exact path (G61)** leaves no tolerance to optimise in. Such moves are driven by the on-path
//!   engine, with an exact stop where the mode changes.
//! * **Curves** are driven by the on-path engine, too, which follows them without chords, with a
//!   time parametrisation that is optimised along them: with what is among a curve's neighbours
//!   from the rest before it, if that is near ([`work_queue`]). A window sees nothing but the chords,
//!   and is slower along many of them.
//! * **Work when asked.** [`InTubeEngine::push`] only checks and keeps an item. A frame that is
//!   asked for takes as many pieces as it needs, one by one, so an arc of a thousand turns or a run
//!   of a million blocks is never in memory as a whole, and the frames cannot depend on the chunks
//!   in which items arrive.
//!
//! | file or folder | what it holds |
//! |---|---|
//! | `work_queue`, `chords`, `flattening`, `merging` | moves to straight pieces, within known distances |
//! | `path` | these pieces, as the tube the motion has to stay in |
//! | `planner` | what moves the machine next: a leg, a window, or what is left of the last window |
//! | `window` | one window: the convex problems, their rows and their solver |
//! | `verify` | the check that every motion passes before it is handed out |
//! | `fallback` | the plan that always works, and the baseline that windows are held against |
//! | `ledger` | what the pieces have to do with the program: lines, rates, events |
//!
//! [`crate::on_path`] is used for one thing: what leaves no tube to optimise in, exact path and
//! curves of the program, is handed to an engine of that kind from one rest to the next
//! ([`engine`]). It is no fallback for windows that are not found; that is a leg straight to the
//! next vertex.

mod chords;
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
mod work_queue;

pub(crate) use engine::InTubeEngine;
pub(crate) use window::SearchBias;
