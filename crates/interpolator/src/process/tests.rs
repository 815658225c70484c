//! Tests of a machine with drives, tick by tick: both threads' work, the servo library and a plant.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    clippy::indexing_slicing,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a test: what is exact is compared exactly"
)]

mod adaptive;
mod answers;
mod bench;
mod client;
mod compensation;
mod cross_compensation;
mod following;
mod gantry;
mod homing;
mod hostile;
mod injected_faults;
mod jobs;
mod jogging;
mod late_latches;
mod life_cycle;
mod m_code_waits;
mod matrix;
mod probing;
mod revolutions;
mod spindle_override;
mod stops;
mod superposition;
mod tapping;
mod threading;
mod unanswered;
