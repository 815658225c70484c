//! The command, as it is typed.

mod arms;
mod calibrate;
mod command_line;
mod command_options;
mod config_command;
mod config_stages;
mod configuration;
mod fit;
mod hostile_curves;
mod hostile_numbers;
mod hostile_text;
mod joint_bench;
mod joints;
mod kept_state;
mod keys;
mod long_plans;
mod manual_words;
mod migration;
mod mistaken_files;
mod nurbs;
mod nutating;
mod outputs;
mod pipes;
mod plot;
mod preview;
mod reference;
mod setup;
mod spindle_axis;
mod straight;
mod subroutines;
mod superposition;
#[path = "../support/mod.rs"]
mod support;
mod told_commands;
mod travel;
mod unchecked_loops;
