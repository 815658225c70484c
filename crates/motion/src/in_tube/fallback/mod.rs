//! What always works: straight to the next vertex and to rest there. It is driven where no window
//! is found, and every window is held against it.

mod baseline;
mod stop_leg;

pub(crate) use baseline::{Baseline, TRUST_PERIODS, arrival_t};
pub(crate) use stop_leg::StopLeg;
