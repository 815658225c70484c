//! Look-ahead: the speeds between runs, and the motion that nothing later changes.

mod joined_runs;
mod planned;
mod scheduler;
mod settled;
mod stop_at_each;

pub(crate) use planned::PlannedMotion;
pub(crate) use scheduler::Scheduler;
pub(crate) use settled::Settled;
