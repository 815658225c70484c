//! The `glidepath` program as a library, so that tests and tools can use its parts: configuration,
//! reports and plots. Everything that computes motion lives in the crates below this one.

pub mod bench;
pub mod cli;
pub mod clock;
pub mod command;
pub mod config;
pub mod curve_file;
pub mod dense_runs;
pub mod exit;
pub mod file_error;
pub mod interrupt;
pub mod jitter;
mod joints;
pub mod output;
pub mod plot;
pub mod program_text;
pub mod progress;
pub mod recording;
pub mod report;
pub mod sample;
pub mod service_manager;
pub mod setpoints;
