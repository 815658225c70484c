//! The state that a machine keeps over a restart, between its files and the reading of programs.
//!
//! Whoever reads a program begins with it ([`read`]); only the planner, which has the program
//! executed, writes it ([`keeper`]).

pub(crate) mod answers;
pub(crate) mod convert;
pub(crate) mod error;
pub(crate) mod keeper;
pub(crate) mod machine;
pub(crate) mod read;
mod seen;
