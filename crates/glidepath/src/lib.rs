//! The `glidepath` program as a library, so that tests and tools can use its parts: configuration,
//! reports and plots. Everything that computes motion lives in the crates below this one; this one
//! brings them together.
//!
//! ```text
//!   main ─▶ command      one file for each subcommand; every error becomes a failure, with its exit code
//!             │
//!             ├─▶ cli, config                        what the user wants, judged
//!             ├─▶ joints, jitter, bench, recording,
//!             │   play_time                          what commands share
//!             ├─▶ report, plot, setpoints            results as text, JSON, SVG and CSV
//!             └─▶ output, progress, exit             the terminal
//! ```
//!
//! Arrows point down only: a module knows no command, and no error of a module knows those of
//! others. Entry points are [`cli::Cli`] with [`command::main`] for the program, [`config::load`]
//! and
//! [`config::parse`] for a machine, [`plot::Plot`] for a picture.
//!
//! What always holds: results go to standard output, all else to standard error; `--json` prints
//! one object whatever happens; a configuration is either right in every value or refused with all
//! that is to be mended.
//!
//! ```
//! use glidepath::config;
//!
//! let machine = config::parse("built-in machine", config::EMBEDDED)?;
//! assert_eq!(machine.period_ns(), 4_000_000);
//! assert_eq!(machine.settings().tolerance_mm, 0.02);
//!
//! let error = config::parse("m.toml", "[axis.X]\nmax_speed = 100.0\n").unwrap_err();
//! let told = &error.diagnostics()[0];
//! assert_eq!(told.message, "unknown key `max_speed`");
//! assert_eq!(error.line_and_column(told), Some((2, 1)));
//! # Ok::<(), config::ConfigError>(())
//! ```

mod begun;
pub mod bench;
mod chords;
pub mod cli;
pub mod clock;
pub mod command;
pub mod config;
pub mod curve_file;
pub mod dense_runs;
pub mod drives;
pub mod exit;
pub mod file_error;
mod in_force_note;
pub mod interrupt;
pub mod jitter;
mod joints;
pub mod machine_options;
pub mod measured_points;
pub mod output;
pub mod output_file;
pub mod page;
mod part_file;
mod persistence;
pub mod picture;
mod plan_steps;
pub mod play_time;
pub mod plot;
mod position_offsets_note;
pub mod program_file;
pub mod program_text;
pub mod progress;
pub mod recording;
pub mod report;
pub mod sample;
pub mod service_manager;
pub mod setpoints;
mod shown_diagnostic;
pub mod text_diagnostic;
pub mod text_file;
mod waiting_note;
mod work_zero;
