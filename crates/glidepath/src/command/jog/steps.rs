//! A jog by steps: `glidepath jog X10 Y-5`.

use super::arrival::{Arrival, at_end_already};
use super::panel::Panel;
use crate::cli::JogArgs;
use crate::clock;
use crate::command::ending;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use crate::machine_options::complete;
use crate::output;
use crate::report::decimals;
use crate::waiting_note::WaitingNote;
use core::time::Duration;
use glidepath_geometry::{AXES, Axis};
use glidepath_link::{JogMode, MachineState, UnmetPrecondition};
use serde_json::{Map, Value, json};
use std::time::Instant;

/// Between two looks at the machine.
const POLL: Duration = Duration::from_millis(10);
/// How long the machine may take to set out.
const PATIENCE: Duration = Duration::from_secs(1);
/// How long an interpolator may take to hear that a step is let go, and to show it: some of its status records.
const HEARD: Duration = Duration::from_millis(100);

/// Moves the axes, and waits until they are at rest.
///
/// # Errors
/// The machine cannot be jogged now, or it does not move.
pub(super) fn jog(
    args: &JogArgs,
    config: &MachineConfig,
    instance: &str,
    mut panel: Panel,
) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let state = panel.state()?;
    let mut value = [0.0; AXES];
    for step in &args.steps {
        if !config.axis_names().contains(&step.axis) {
            return Err(refused(
                state.name(),
                format!("the machine has no axis {}", step.axis),
            ));
        }
        if let Some(slot) = value.get_mut(step.axis.index()) {
            *slot += step.distance;
        }
    }
    if let Some(precondition) = Panel::precondition(state) {
        return Err(refused(state.name(), precondition.text().to_owned()));
    }
    let start = panel.position();
    let is_homed = panel.status()?.homed == panel.status()?.joints;
    let means_axes = means_axes(args, config);
    if means_axes
        && is_homed
        && let Some(reason) = at_end_already(&start, &value, config)
    {
        let state = state.name();
        return Err(Failure::AtEndOfTravel { state, reason });
    }
    let most_v = args.feed.map_or(0.0, |feed| feed / 60.0);
    let (asked_ns, by_joint) = (clock::started_ns(), args.by_joint);
    panel
        .demands
        .ask(asked_ns, JogMode::Incremental, value, most_v, by_joint)?;
    set_out(&mut panel, &interrupt)?;
    let mut has_let_go = false;
    let mut note = WaitingNote::new("jog: the axes are on their way; Ctrl-C stops them".to_owned());
    // Held, the machine is slowing for as long as its last differences are not those of rest.
    while matches!(
        panel.state()?,
        MachineState::Jogging | MachineState::Holding | MachineState::Stopping
    ) {
        if interrupt.is_set() && !has_let_go {
            panel.demands.let_go()?;
            has_let_go = true;
        }
        note.look();
        std::thread::sleep(POLL);
    }
    let asked = means_axes.then_some(&value);
    let arrival = Arrival::of(&mut panel, config, (&start, asked), &interrupt)?;
    report(args, instance, &mut panel, (&start, &arrival))?;
    Ok(if interrupt.is_set() {
        Exit::Interrupted
    } else {
        arrival.exit()
    })
}

/// Whether the steps are those of the axes that they name: joints are counted, and those of a machine
/// that has the first axes one after the other are its axes.
fn means_axes(args: &JogArgs, config: &MachineConfig) -> bool {
    let axes = config.axis_names();
    !args.by_joint
        || axes
            .iter()
            .zip(0..)
            .all(|(axis, joint)| axis.index() == joint)
}

/// Waits until the step is begun, or done. Says it again meanwhile: the interpolator may just have learnt of this
/// client. That the machine moves is no sign: two clients that ask in the same instant both see it set out, and one of
/// them moves it.
pub(super) fn set_out(panel: &mut Panel, interrupt: &Interrupt) -> Result<(), Failure> {
    let started = Instant::now();
    while !panel.is_followed()? {
        let is_anothers = panel.state()? == MachineState::Jogging;
        if is_anothers || interrupt.is_set() || started.elapsed() > PATIENCE {
            return give_up(panel, is_anothers);
        }
        panel.demands.again()?;
        std::thread::sleep(POLL);
    }
    Ok(())
}

/// Lets go of a step that was not begun, and says why it was not.
///
/// # Errors
/// Why; none if the step was begun just before it was let go.
fn give_up(panel: &mut Panel, is_anothers: bool) -> Result<(), Failure> {
    let status = *panel.status()?;
    let state = panel.state()?;
    let given_up = Instant::now();
    let asked = panel.demands.asked();
    panel.demands.let_go()?;
    while given_up.elapsed() < HEARD {
        if asked.is_followed(panel.status()?) {
            return Ok(());
        }
        std::thread::sleep(POLL);
    }
    let reason = if is_anothers {
        UnmetPrecondition::ByHand.text().to_owned()
    } else {
        ending::failure(&status)
            .or_else(|| Panel::precondition(state).map(|it| it.text().to_owned()))
            .or_else(|| ending::why(&status))
            .unwrap_or_else(|| {
                "nothing moved: it is at the end of its travel or reach, or somebody else jogs"
                    .to_owned()
            })
    };
    Err(refused(state.name(), reason))
}

const fn refused(state: &'static str, reason: String) -> Failure {
    Failure::CommandRefused {
        command: "jog",
        state,
        reason,
    }
}

fn report(
    args: &JogArgs,
    instance: &str,
    panel: &mut Panel,
    (start, arrival): (&[(Axis, f64)], &Arrival),
) -> Result<(), Failure> {
    let state = panel.state()?.name();
    let end = panel.position();
    if args.operator.basic.json {
        output::object(&json!({
            "command": "jog",
            "instance": instance,
            "state": state,
            "start": object(start),
            "position": object(&end),
            "away": object(&panel.away()),
            "not_moved": object(&arrival.not_moved()),
            "at_end_of_travel": arrival.at_end_of_travel(),
            "ended_by": arrival.ended_by().map(complete),
            "have_followed": arrival.have_followed(),
            "following_error": arrival.following_errors(),
        }));
    } else {
        let position: Vec<String> = end
            .iter()
            .map(|(axis, value)| format!("{axis} {}", decimals(*value, 4)))
            .collect();
        output::result(&format!(
            "jog: {state} at {}\n{}",
            position.join("  "),
            arrival.text()
        ));
    }
    Ok(())
}

fn object(values: &[(Axis, f64)]) -> Map<String, Value> {
    let pairs = values.iter();
    pairs
        .map(|(axis, value)| (axis.to_string(), (*value).into()))
        .collect()
}
