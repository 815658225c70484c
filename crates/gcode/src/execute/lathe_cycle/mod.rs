//! Lathe cycles along a profile: G70, G71, G71.1, G71.2, G72, G72.1, G72.2.
//!
//! | | |
//! |---|---|
//! | G70 Q X Z D E P | finishes: P passes along the profile, the last one E away from it, the first one (P − 1)/P of the way from E to D |
//! | G71 Q X Z D I R | turns: passes along Z, each I deeper than the one before, up to D from the profile; retreats by R |
//! | G72 Q X Z D I R | faces: the same with passes along X |
//! | G71.1 G72.1, G71.2 G72.2 | without the pockets of the profile, the pockets alone |
//!
//! The profile stands in subroutine Q ([`profile`]). X and Z say where the cycle starts, where they
//! are left out it starts where the tool is: outside the stock, on the side it is to be cut from.
//! D, E and R are zero if they are left out (R: 0.5), I and P are 1.
//!
//! ```text
//!   O100 sub … endsub    G71 Q100            O100 call, its blocks drawn
//!   ───────────────────► rapid to X Z ─────► LatheProfile ─► pieces ─► offset ─► passes ─► moves
//!                                            (Z and X)       (a and b: pass_axes)
//! ```
//!
//! The subroutine is called as by `O100 call`, with loops and parameters, but its blocks move
//! nothing: [`LatheProfile`](profile::LatheProfile) collects what they describe. When it ends the
//! passes are made, all in program coordinates, and given out as if the block of the cycle had
//! moved so.
//!
//! Passes are those of LinuxCNC 2.9. Other than there:
//!
//! * the contour at a distance nowhere comes nearer than that to any part of the profile
//!   ([`offset`]);
//! * a start on the side of the workpiece is refused, and a start above the profile is left
//!   sideways before the tool goes down;
//! * between finishing passes the tool rises where the straight way back leads through the part;
//! * codes in the profile that would give its words another meaning are refused, not skipped.

pub(crate) mod begin;
pub(crate) mod contour_passes;
pub(crate) mod edge_break;
mod moves;
pub(crate) mod offset;
pub(crate) mod open;
pub(crate) mod pass_axes;
pub(crate) mod passes;
pub(crate) mod profile;
pub(crate) mod read;
mod repeating;
#[cfg(test)]
mod tests;
