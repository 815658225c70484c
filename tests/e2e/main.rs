//! End-to-end tests. One binary, and at most two tests at a time for each core (see `Instance`): they run at the speed
//! of the clock.
#![allow(
    clippy::unwrap_used,
    reason = "test code, which clippy does not see as such"
)]

mod at_rest;
mod attack;
mod chain;
mod drives;
mod faults;
mod grbl;
mod hal;
mod jobs;
mod jog;
mod left;
mod libraries;
mod life;
mod live;
mod load;
mod manual;
mod mirror;
mod onlookers;
mod operating;
mod operator;
mod paced;
mod part_positions;
mod probing;
mod programs;
mod recordings;
mod removed;
mod resume;
mod run;
mod service;
mod services;
mod streams;
mod subscribers;
mod telemetry;
mod threading;
mod told;
mod tolerance;
mod unanswered;
