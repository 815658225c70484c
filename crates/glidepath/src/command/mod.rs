//! The subcommands, one file each.

mod acknowledge;
mod active_program;
mod attention;
mod audit;
mod begins_with;
mod bench;
mod calibrate;
mod changed;
mod check;
mod configuration;
mod differences;
mod doctor;
mod ending;
mod ethercat;
mod evidence;
mod executor;
mod failure;
mod failure_exit;
mod failure_origin;
mod failure_report;
mod feed;
mod fit;
mod fitting;
mod forecast;
mod going_on;
mod grbl;
mod home;
mod interpolator;
mod jitter;
mod jobs;
mod jog;
mod left_in_force;
mod live;
mod lost_planner;
mod mirror;
mod named_files;
mod offsets;
mod operator;
mod other_users;
mod persistent_offsets;
mod plan;
mod planner;
mod preview;
mod program_diagnostics;
mod program_note;
mod reading;
mod record;
mod replay;
mod rest;
mod run;
mod run_supervisor;
mod servo;
mod session;
mod setup;
mod subroutines;
mod telemetry;
mod text_lines;
mod thread_watch;
mod told;
mod tool_names;
mod watch;

use crate::cli::{Cli, CliCommand, Switch};
use crate::clock;
use crate::config::{self, MachineConfig};
use crate::exit::Exit;
use crate::machine_options::{self, MachineOptions};
use crate::output;
use crate::program_file::ProgramFile;
use failure::Failure;
use glidepath_link as link;
use serde_json::json;

/// Does what the command line asks for, and prints its result.
#[must_use]
pub fn main(cli: &Cli) -> Exit {
    let basic = cli.command.basic();
    let config = basic.and_then(|basic| basic.config.as_ref());
    let config = config.map(ProgramFile::name);
    machine_options::keep(MachineOptions::new(config, cli.command.instance()));
    let done = dispatch(&cli.command);
    let exit = done.unwrap_or_else(|failure| failure_report::report(&failure, &cli.command));
    match output::unwritten() {
        Some(cause) if exit == Exit::Done => {
            output::note(&format!("error: cannot write to standard output: {cause}"));
            Exit::Fault
        }
        _ => exit,
    }
}

/// Tells what is wrong with a command line, or what was asked about it.
#[must_use]
pub fn usage(error: &clap::Error) -> Exit {
    let as_json = std::env::args_os().any(|arg| arg == "--json");
    if as_json && error.use_stderr() {
        let text = error.to_string();
        let message = text.strip_prefix("error: ").unwrap_or(&text).trim_end();
        output::object(&json!({
            "error": message,
            "exit_code": Exit::Usage as u8,
            "findings": [],
        }));
        return Exit::Usage;
    }
    output::usage(error);
    if error.use_stderr() {
        Exit::Usage
    } else {
        Exit::Done
    }
}

fn dispatch(command: &CliCommand) -> Result<Exit, Failure> {
    let config = || machine(command);
    // However long the configuration, the tool table or the program takes to be read.
    let asked_ns = clock::started_ns();
    match command {
        CliCommand::Offsets(command) => offsets::offsets(command, &config()?),
        CliCommand::Config(args) => configuration::configuration(args),
        CliCommand::Run(args) => run::run(args, &config()?),
        CliCommand::Plan(args) => plan::plan(args, &config()?),
        CliCommand::Check(args) => check::check(args, &config()?),
        CliCommand::Interpolator(args) => interpolator::interpolator(args, &config()?),
        CliCommand::Planner(args) => planner::planner(args, &config()?, asked_ns),
        CliCommand::RunFile(args) => jobs::run_file(args, &config()?, asked_ns),
        CliCommand::Mdi(args) => jobs::mdi(args, &config()?, asked_ns),
        CliCommand::Ethercat(args) => ethercat::ethercat(args, &config()?),
        CliCommand::Servo(args) => servo::servo(args, &config()?),
        CliCommand::Feed(args) => feed::feed(args, &config()?, asked_ns),
        CliCommand::Status(args) if args.watch => watch::watch(args, &config()?),
        CliCommand::Status(args) => operator::status(&args.operator, &config()?),
        CliCommand::Live(args) => live::live(args, &config()?),
        CliCommand::Grbl(args) => grbl::grbl(args, &config()?),
        CliCommand::Record(args) => record::record(args, &config()?),
        CliCommand::Replay(args) => replay::replay(args, &config()?),
        CliCommand::Telemetry(args) => telemetry::telemetry(args, &config()?),
        CliCommand::Mirror(args) => mirror::mirror(args, &config()?),
        CliCommand::Audit(args) => audit::audit(args, &config()?),
        CliCommand::Hold(args) => rest::hold(args, &config()?),
        CliCommand::Resume(args) => {
            operator::command(args, &config()?, "resume", link::Command::Resume)
        }
        CliCommand::Step(args) => operator::command(args, &config()?, "step", link::Command::Step),
        CliCommand::StopAtBlockEnd(args) => {
            let command = link::Command::StopAtEndOfBlock;
            operator::command(args, &config()?, "stop-at-block-end", command)
        }
        CliCommand::Reverse(args) => {
            operator::command(args, &config()?, "reverse", link::Command::Reverse)
        }
        CliCommand::Forward(args) => {
            operator::command(args, &config()?, "forward", link::Command::Forward)
        }
        CliCommand::Fit(args) => fit::fit(args, &config()?),
        CliCommand::Preview(args) => preview::preview(args, &config()?),
        CliCommand::SingleBlock(args) => {
            let command = link::Command::SingleBlock(args.switch == Switch::On);
            operator::command(&args.operator, &config()?, "single-block", command)
        }
        CliCommand::Acknowledge(args) => acknowledge::acknowledge(args, &config()?),
        CliCommand::Abort(args) => rest::abort(args, &config()?),
        CliCommand::Reset(args) => {
            operator::command(args, &config()?, "reset", link::Command::Reset)
        }
        CliCommand::Enable(args) => operator::enable(args, &config()?),
        CliCommand::Disable(args) => rest::disable(args, &config()?),
        CliCommand::Home(args) => home::home(args, &config()?),
        CliCommand::Unhome(args) => {
            operator::joints(args, &config()?, "unhome", link::Command::Unhome)
        }
        CliCommand::SetPosition(args) => {
            let (joint, position) = (args.joint, args.position);
            let command = link::Command::SetPosition { joint, position };
            operator::command(&args.operator, &config()?, "set-position", command)
        }
        CliCommand::Override(args) => operator::overrides(args, &config()?),
        CliCommand::Jog(args) => jog::jog(args, &config()?),
        CliCommand::Return(args) => rest::return_to_path(args, &config()?),
        CliCommand::Bench(args) => bench::bench(args, &config()?),
        CliCommand::Setup(args) => setup::setup(args),
        CliCommand::Calibrate(args) => calibrate::calibrate(args, &config()?),
        CliCommand::Doctor(args) => Ok(doctor::doctor(args, &config()?)),
        CliCommand::Jitter(args) => jitter::jitter(args, &config()?),
    }
}

/// The machine a command works for: its configuration, with what the command line overrides.
fn machine(command: &CliCommand) -> Result<MachineConfig, Failure> {
    let file = command.basic().and_then(|basic| basic.config.as_ref());
    let mut config = match file {
        Some(file) => {
            file.keep(config::MOST_BYTES)?;
            config::load_kept(file.name(), file.path())?
        }
        None => config::load(None)?,
    };
    if let Some(args) = command.path() {
        config.path.effort = args.effort.unwrap_or(config.path.effort);
        config.path.tolerance_mm = args.tolerance.unwrap_or(config.path.tolerance_mm);
    }
    if let Some(instance) = command.instance() {
        config.instance = Some(instance.to_owned());
    }
    reading::settle(command, &mut config)?;
    Ok(config)
}
