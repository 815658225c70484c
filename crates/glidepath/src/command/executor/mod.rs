//! The executor of the planner's service: lines and files of operators, with modal state kept
//! between.

mod commit_state;
mod file;
mod file_job;
mod lines;
mod reset;
mod resumption;
mod run_context;
mod runner;
mod state;
mod stop;

pub(super) use state::JobExecutor;
