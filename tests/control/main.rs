//! Tests of what an operator does to the motion of real programs, tick by tick: planner and
//! interpolator as libraries, without threads, clock or shared memory, so that every run of a test
//! is the same.
//!
//! A sample runs by default. `GLIDEPATH_CONTROL=200 cargo test --release -p glidepath-tests --test
//! control -- --nocapture` runs so many times as much, and prints how soon a hold begins.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    clippy::print_stderr,
    reason = "test code, which clippy does not see as such; bits are compared on purpose, figures are \
              for people"
)]

mod bursts;
mod mechanisms;
mod overrides;
mod random;
mod reaction;
mod supervisor;
mod untouched;

/// How many times as much as by default the tests do.
fn times() -> usize {
    std::env::var("GLIDEPATH_CONTROL").map_or(1, |text| text.parse().unwrap())
}
