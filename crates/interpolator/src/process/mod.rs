//! The process: what starts both threads, keeps them on their common grid, and ends them.
//!
//! * `run` is an interpolator with threads and clock: start-up, real time, what is reported at the end; `loops` are what
//!   its two threads do, turn by turn.
//! * `stepped` and `served` are driven by hand instead, tick by tick: without ports, and with them.
//!
//! It may know every other room, and none knows it. So whatever is decided in a tick or a turn is the same with threads and
//! without, and the tests of a whole machine, which are here, need no clock.

pub(crate) mod loops;
pub(crate) mod run;
pub(crate) mod served;
pub(crate) mod stepped;

#[cfg(test)]
mod tests;
