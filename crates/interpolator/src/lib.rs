//! The interpolator process: frames to setpoints, one per period.

mod differences;
mod program_time;
mod ramp;
mod rate;
#[cfg(test)]
mod testing;
mod track;
