//! The executor of the planner's service: lines and files of operators, with modal state kept
//! between.

mod bench;
mod file;
mod file_job;
mod lines;
mod resumption;
mod runner;
mod settle;
mod state;
mod stop;

pub(super) use state::Workshop;
