//! The texts that people are told about a machine: one for each state, fault and refusal.
//!
//! Whoever shows one of them (status, log, page, planner, consumers in other languages) takes its
//! words from here, so that one thing is never told in two ways. A text is a clause that stands in a
//! sentence: no capital, no full stop; what is to be done follows behind a semicolon. Commands stand
//! in backticks without instance and configuration, which only the process that shows them knows.

mod amount;
mod at_rest;
mod fault;
mod precondition;
mod printable;
mod refusal;
mod state;
mod superposition;

pub use at_rest::AtRest;
pub use fault::FaultReport;
pub use precondition::UnmetPrecondition;
pub(crate) use printable::in_one_line;
pub use printable::{is_printable, printable};
pub use refusal::refused;
pub use state::{CALLED_OFF, DISABLED, SWITCHED_OFF, StateChange, TOLD_TO_END, tells_end};
