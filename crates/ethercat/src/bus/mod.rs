//! A bus on its way into operation: one file for each state, each made of the one before.
//!
//! ```text
//! Init ──into_pre_op──► PreOp ──into_safe_op──► SafeOp ──into_op──► Op
//!  who is there          parameters, mapping     inputs, clocks     cycles
//! ```

mod aside;
mod bus_time;
mod clocks;
mod group;
mod history_mail;
mod init;
mod mailbox;
mod mapping;
mod offsets;
mod op;
mod others;
mod parameters;
mod pre_op;
mod probe_mail;
mod probes;
mod safe_op;
mod state;
mod tree;
mod watchdog;
mod windows;

pub use init::Init;
pub use op::{Op, Reception};
pub use pre_op::PreOp;
pub use safe_op::SafeOp;
pub use watchdog::OutputWatchdog;
