//! The speeds between runs, and what of the motion nothing later changes.

mod joined_runs;
mod scheduler;
mod settled;
mod stop_at_each;

pub(crate) use scheduler::Scheduler;
pub(crate) use settled::Settled;
