//! Homing by the controller: joints are moved, each for itself, until their switches or index pulses
//! say where they are.
//!
//! ```text
//!  ports thread                                                   real-time thread
//!  Home ─► sequencer: groups ─► search: one joint, phase by phase ─ JointsOrder ─► mover: trackers
//!             ▲                    ▲ edges by their time stamps                        │
//!             └────────────────────┴──────────── report: which joints rest ◄──────────┘
//! ```
//!
//! What is looked for is decided where feedback arrives, with the precision of its time stamps; how
//! the joints get there is the real-time thread's, inside their limits. Every order names the
//! furthest place that it may lead to: if nobody says anything more, the joints come to rest there.
//!
//! All of it is done in what the drives count. What a joint's position is called changes once, when
//! its whole group is at rest at its home.

mod index;
mod search;
mod sequencer;

pub(crate) use index::{IndexSeen, Kept};
pub(crate) use search::Seen;
pub(crate) use sequencer::{HomingInputs, HomingSequencer, Outcome, Pair};
