//! The resumption of a program in the middle: after its planner died, or after an abort.
//!
//! The interpolator knows where it stands: the block, how far it has come on it, and the position.
//! The program is read from its beginning again, without motion, up to that block; the path that
//! it programs from there on is searched for the point where the machine stands; and what follows
//! that point is handed on.
//!
//! ```text
//!            block 7                 8           9
//!   ─────────┬───────────────●───────┬───────────┬──────
//!            │◄── travelled ►│ machine
//!            read, not run   └─ what is run: the rest of 7, 8, 9, …
//! ```
//!
//! The machine need not stand on the programmed path: on a curve that replaces a corner, or on a
//! chord that replaces several, it is off by up to the tolerance. From there it goes straight to
//! the end of the block, and comes to rest there, so that no second curve adds to that distance.
//!
//! A path may pass a point more than once (a full circle begins where it ends). Of the points near
//! enough, the one is taken that is as far from the beginning of the block as the machine has
//! travelled on it, or next to that.
//!
//! The interpolator tells a block up to a period late, so that a machine whose block is an event or a dwell may be on
//! the move behind it already. Whatever the block is, the first move begins where the machine stands.
//!
//! What waits is not done before it is answered: an M code, or a program stop, at which the program was
//! left without its answer is told again, and waited for again.
//!
//! What the program asked of inputs and of the probe up to there is answered as it was answered then
//! ([`ItemSource::settle`]); a probing move that was left on its way goes on looking.

mod first_move;
mod left_item;
mod open_probe;
mod outputs;
mod point;
mod remainder;
mod remaining_segment;
mod search;
mod told_codes;

pub use point::ResumePoint;
pub use remainder::Remainder;

#[cfg(test)]
mod tests;
