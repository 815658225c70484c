//! The state that a machine keeps over a restart, between its files and the reading of programs.
//!
//! Whoever reads a program begins with it ([`read`]); only the planner, which has the program
//! executed, writes it ([`state_store`]).

pub(crate) mod convert;
pub(crate) mod error;
pub(crate) mod input_log;
pub(crate) mod machine;
pub(crate) mod read;
mod seen;
pub(crate) mod state_store;
