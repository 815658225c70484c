//! What a program begins with on a machine, for whoever reads it beside the machine: what is kept, and what the
//! planner's service has in force.

use super::left_in_force::as_machine_tells;
use super::operator::{auxiliary, read_status};
use super::session;
use crate::config::MachineConfig;
use crate::in_force_note::{Served, served};
use crate::persistence::convert::axis_words;
use crate::persistence::error::StateError;
use crate::persistence::read::{read, set_up};
use glidepath_gcode::InForce;
use glidepath_geometry::AxisVector;
use glidepath_link::{ActiveProgram, Auxiliary, EndOfEpoch, LinkConfig, MachineState, Operator};
use glidepath_persistence::PersistentState;

/// What a machine was found to begin programs with.
#[derive(Debug, Default)]
pub(super) struct BeginsWith {
    /// What is kept.
    pub(super) kept: Option<PersistentState>,
    /// What somebody has to know of it.
    pub(super) notes: Vec<String>,
}

/// Puts what a program begins with on its machine into a configuration.
///
/// # Errors
/// What is kept cannot be read, or belongs to another machine. What is in force counts all the same.
pub(super) fn begin_on_machine(config: &mut MachineConfig) -> Result<BeginsWith, StateError> {
    let instance = session::named_instance(config);
    let link = session::link(&instance, config);
    begin_as_told(
        config,
        (&instance, &link),
        || auxiliary(&link),
        || stands(&link),
    )
}

/// The same where it is known already what the machine tells, and where it stands.
///
/// # Errors
/// The errors of [`begin_on_machine`].
pub(super) fn begin_as_told(
    config: &mut MachineConfig,
    (instance, link): (&str, &LinkConfig),
    told_now: impl FnOnce() -> Option<Auxiliary>,
    stands_now: impl FnOnce() -> Option<AxisVector>,
) -> Result<BeginsWith, StateError> {
    let served = served(link, config);
    (config.program.in_force, config.program.stands) = (None, None);
    let mut begins = BeginsWith::default();
    let in_force = match served {
        Served::Nothing => None,
        Served::OtherMachine => {
            begins.notes.push(format!(
                "the planner's service of {instance} drives another machine than this configuration: what is in \
                 force there does not count here"
            ));
            None
        }
        Served::State(in_force) => Some(match told_now() {
            Some(told) => as_machine_tells(&in_force, &told),
            None => *in_force,
        }),
    };
    config.program.in_force.clone_from(&in_force);
    let kept = read(config);
    if let Ok(Some(kept)) = &kept {
        begins.notes.extend(set_up(config, kept));
    }
    if let Some(in_force) = in_force {
        config.program.stands = stands_now();
        let mut text = told(&in_force);
        if config.program.stands.is_some() {
            text += "; it begins where the machine stands";
        }
        begins.notes.push(text);
        if config.state_directory.is_none() {
            config.program.offsets = in_force.work_offsets();
            config.program.tools = in_force.tools().cloned().or(config.program.tools.take());
        }
    }
    begins.kept = kept?;
    Ok(begins)
}

/// Where the machine stands; nothing while it moves, or if it does not tell.
fn stands(link: &LinkConfig) -> Option<AxisVector> {
    let operator = Operator::find(link).ok()?;
    let status = read_status(&operator, link).ok()?;
    let rests = status.state() == Ok(MachineState::Idle);
    rests.then(|| AxisVector::from(status.position))
}

/// Where a program begins that is read now beside the planner's service: where the machine stands, if it rests.
pub(super) fn begins_now(config: &MachineConfig) -> Option<AxisVector> {
    let link = session::link(&session::named_instance(config), config);
    let is_served = matches!(served(&link, config), Served::State(_));
    is_served.then(|| stands(&link)).flatten()
}

/// Where the machine stood when the program of this fingerprint began, or without one the program that is under way;
/// nothing where it executes another one.
pub(super) fn program_start(config: &MachineConfig, program: Option<u64>) -> Option<AxisVector> {
    let link = session::link(&session::named_instance(config), config);
    let operator = Operator::find(&link).ok()?;
    let status = read_status(&operator, &link).ok()?;
    let is_meant = match program {
        Some(program) => status.program == program,
        None => status.end_of_epoch() == Ok(EndOfEpoch::Open),
    };
    is_meant.then(|| AxisVector::from(status.program_start))
}

/// How many times its tolerance a program uses that runs, or ran last, if it is the one that is meant. `None` if its
/// planner has left no note.
pub(super) fn ratio_begun_with(
    link: &LinkConfig,
    is_meant: impl FnOnce(&ActiveProgram) -> bool,
) -> Option<f64> {
    // A note that cannot be read says nothing.
    let note = ActiveProgram::read(link).ok().flatten()?;
    is_meant(&note).then_some(note.tolerance_ratio)
}

/// Has a program planned with the tolerance that it began with, as its planner has noted. What is kept of it counts
/// more.
pub(super) fn begun_with_ratio(config: &mut MachineConfig, link: &LinkConfig, program: u64) {
    if let Some(ratio) = ratio_begun_with(link, |note| note.fingerprint == program) {
        config.use_tolerance_ratio(ratio);
    }
}

/// What is in force, in the words of a program.
fn told(in_force: &InForce) -> String {
    let mut text = format!(
        "read as it would be run now: the planner's service has {} in force",
        in_force.words()
    );
    let beside = in_force.position_offsets();
    for (what, by) in [
        ("shift of G92 or G52", beside.shift),
        ("tool length", beside.tool),
    ] {
        let words = axis_words(&by.map(|by| (by * 1e4).round() / 1e4).into());
        if !words.is_empty() {
            text.push_str(&format!(", {what} {words}"));
        }
    }
    text
}
