//! Cutter radius compensation: G41, G42, G40.
//!
//! The program describes the contour of the part; the centre of the tool has to run beside it, a
//! tool radius to the left (G41) or to the right (G42). Every line or arc of the contour becomes an
//! *offset element*: a parallel line, or an arc about the same centre. What happens where two of
//! them join depends on the corner of the contour between them:
//!
//! ```text
//!   convex: the tool rolls round the corner         concave: both elements end where they meet
//!
//!        ___________                                        │     ║
//!     ──────────────╮ ╲                                     │     ║
//!     ══════════════╗  │  tool                              │     ║
//!        contour    ║  │                              ──────┘     ║   tool
//!                   ║  │                              ════════════╝   contour
//! ```
//!
//! * *Smooth* (the offset elements already meet): joined.
//! * *Convex*: an arc about the corner at the feedrate of the block after it; in front of a rapid
//!   move a straight one. Two lines that turn by so little that their extensions meet within
//!   [`MITRE_MM`](outer_corner::MITRE_MM) of the arc are extended instead, so that dense chords do not
//!   get an arc each. On a FANUC the way round is made of straight lines ([`outer_corner`]).
//! * *Concave*: both are cut off where they meet. If they do not, the tool does not fit, and the
//!   block is refused: it would cut into the contour.
//!
//! An element is given out only when the next one is known, so one move is always held back, and
//! with it the events and the moves outside the plane that come after it. The first move (*entry*)
//! goes straight to the place beside its end and must be longer than the tool radius; an entry arc
//! keeps the tangent of the contour at its end. G40 gives out what was held back, and the next
//! straight move leads from there to its programmed end. These rules are those of LinuxCNC, except
//! that it joins corners below 0.05 rad without regard to the contour. On a FANUC (start-up of type A)
//! and a SINUMERIK (NORM) the entry goes straight to the place beside the beginning of the second move,
//! whichever way the contour turns there, and may be as short as it likes.
//!
//! In G18 a turning tool is programmed by its tip; its orientation says where the tip is, seen from
//! the centre of the tool radius, and every point given out is shifted by that.

mod codes;
pub(crate) mod element;
mod entry;
mod moves;
mod outer_corner;
pub(crate) mod path;
mod tilted;
