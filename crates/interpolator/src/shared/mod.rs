//! What both threads know: the configuration, what they pass each other, and the definitions that have to be the same for
//! both.
//!
//! * `config` is what a machine is configured to be, `m_code_waits` the part of it that says which M codes are waited for.
//! * `message` is what passes between the threads, and its rings; `fault` is why the motion was stopped.
//! * `rest` says what counts as rest and as the same position, `track_capacity` how many frames are owned.
//! * `tracker` computes motion from any state to rest or to a velocity. The real-time thread moves by it. The
//!   configuration is judged by it, too: how far a joint goes past its switch.
//!
//! It may know no other room.

pub(crate) mod config;
pub(crate) mod fault;
pub(crate) mod m_code_waits;
pub(crate) mod message;
pub(crate) mod rest;
pub(crate) mod track_capacity;
pub(crate) mod tracker;
