//! The outcome of a jog by steps: which axes did not go all the way, and whether the drives are
//! where the axes were told to be.

use super::panel::Panel;
use crate::command::ending;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use core::fmt::Write as _;
use core::time::Duration;
use glidepath_geometry::{AXES, Axis};
use glidepath_link::{Power, Status};
use serde_json::{Map, Value};
use std::time::Instant;

/// Between two looks at the drives.
const POLL: Duration = Duration::from_millis(10);
/// How long the drives may take to come to where they were told to be, once they are told to rest.
pub(in crate::command) const PATIENCE: Duration = Duration::from_millis(1_500);
/// Nearer than this a joint has followed, mm or degrees.
const FOLLOWED: f64 = 0.05;
/// Less than this is rounding, mm or degrees.
const ROUNDING: f64 = 1e-6;

/// An axis that did not go as far as it was asked to.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Short {
    axis: Axis,
    /// What was not moved of the step, mm or degrees.
    by: f64,
    /// It stands at the end of its travel.
    at_end: bool,
}

/// Where the drives are, seen from where they were told to be.
#[derive(Debug, Clone, PartialEq)]
enum Followed {
    /// There, or nobody says where they are.
    Yes,
    /// Joints, from 0, and how far each is away, mm or degrees.
    No(Vec<(usize, f64)>),
    /// They do not say where they are any more.
    Silent,
}

/// The outcome of a jog by steps.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::command) struct Arrival {
    short: Vec<Short>,
    followed: Followed,
    /// What ended it, if it was not at its end.
    ended_by: Option<String>,
}

impl Arrival {
    /// Waits until the drives are where the axes rest, or for too long. `asked` are the steps of the
    /// axes, from `start`; `None` where they were of joints.
    ///
    /// # Errors
    /// The interpolator is heard of no more.
    pub(super) fn of(
        panel: &mut Panel,
        config: &MachineConfig,
        (start, asked): (&[(Axis, f64)], Option<&[f64; AXES]>),
        interrupt: &Interrupt,
    ) -> Result<Self, Failure> {
        let waits_from = Instant::now();
        loop {
            let is_over = interrupt.is_set() || waits_from.elapsed() > PATIENCE;
            if Self::is_settled(panel.status()?, config) || is_over {
                break;
            }
            std::thread::sleep(POLL);
        }
        let mut arrival = Self::at(panel.status()?, config, (start, asked));
        arrival.ended_by = arrival.ended_by.filter(|_| !interrupt.is_set());
        Ok(arrival)
    }

    /// Whether the drives are where the axes rest, or will not come there any more.
    pub(in crate::command) fn is_settled(status: &Status, config: &MachineConfig) -> bool {
        followed(status, config.drives()) == Followed::Yes || ending::failure(status).is_some()
    }

    /// The outcome by a status of axes at rest, as in [`Self::of`].
    pub(in crate::command) fn at(
        status: &Status,
        config: &MachineConfig,
        (start, asked): (&[(Axis, f64)], Option<&[f64; AXES]>),
    ) -> Self {
        let end = positions(status, config);
        let short = asked.map_or_else(Vec::new, |asked| shorts(start, asked, &end, config));
        Self {
            ended_by: ended_by(status, &short),
            followed: followed(status, config.drives()),
            short,
        }
    }

    /// Done; a fault where the drives are elsewhere, or something ended the jog; short where an axis did not go
    /// as far as it was asked to.
    pub(in crate::command) fn exit(&self) -> Exit {
        if !self.have_followed() || self.ended_by.is_some() {
            Exit::Fault
        } else if self.short.is_empty() {
            Exit::Done
        } else {
            Exit::Short
        }
    }

    /// What was not moved of the steps, by axis.
    pub(super) fn not_moved(&self) -> Vec<(Axis, f64)> {
        self.short.iter().map(|it| (it.axis, it.by)).collect()
    }

    /// The axes that did not go further because their travel ends there.
    pub(super) fn at_end_of_travel(&self) -> Vec<String> {
        let at_end = self.short.iter().filter(|it| it.at_end);
        at_end.map(|it| it.axis.to_string()).collect()
    }

    /// What ended the jog before its end.
    pub(super) fn ended_by(&self) -> Option<&str> {
        self.ended_by.as_deref()
    }

    /// Whether the drives are where they were told to be, as far as anybody says.
    pub(super) fn have_followed(&self) -> bool {
        self.followed == Followed::Yes
    }

    /// How far joints are away that have not followed.
    pub(super) fn following_errors(&self) -> Map<String, Value> {
        let Followed::No(joints) = &self.followed else {
            return Map::new();
        };
        let errors = joints.iter();
        errors
            .map(|(joint, error)| (format!("J{joint}"), (*error).into()))
            .collect()
    }

    /// For people, a line each; nothing where all went as asked.
    pub(in crate::command) fn text(&self) -> String {
        let mut text = String::new();
        // Writing to a String does not fail.
        for Short { axis, by, at_end } in &self.short {
            let why = if *at_end {
                "is at the end of its travel"
            } else {
                "stopped before the end of its step"
            };
            let unit = if axis.is_rotary() { "°" } else { "mm" };
            let _ = writeln!(text, "  {axis} {why}: {by:.4} {unit} of it was not moved");
        }
        if let Some(why) = &self.ended_by {
            let _ = writeln!(text, "  the jog has ended before its end: {why}");
        }
        match &self.followed {
            Followed::Yes => {}
            Followed::Silent => text.push_str(
                "  the drives do not say where they are: they may not have moved. `glidepath status` \
                 tells more\n",
            ),
            Followed::No(joints) => {
                let joints: Vec<String> = joints
                    .iter()
                    .map(|(joint, error)| format!("J{joint} is {error:.4} from there"))
                    .collect();
                let _ = writeln!(
                    text,
                    "  the drives have not followed: {}. `glidepath status` tells more",
                    joints.join(", ")
                );
            }
        }
        text
    }
}

/// Positions of the axes that the machine has.
pub(in crate::command) fn positions(status: &Status, config: &MachineConfig) -> Vec<(Axis, f64)> {
    let axes = config.axis_names().into_iter();
    axes.filter_map(|axis| Some((axis, *status.position.get(axis.index())?)))
        .collect()
}

/// What ended a jog before its end: whatever stopped the machine, or somebody where axes did not go
/// as far as they could.
fn ended_by(status: &Status, short: &[Short]) -> Option<String> {
    let stopped = short.iter().any(|it| !it.at_end);
    if stopped {
        ending::why(status)
    } else {
        ending::failure(status)
    }
}

/// Why nothing can move, if every axis that is asked to stands where its travel ends that way.
pub(in crate::command) fn at_end_already(
    start: &[(Axis, f64)],
    asked: &[f64; AXES],
    config: &MachineConfig,
) -> Option<String> {
    let step = |axis: Axis| asked.get(axis.index()).copied().unwrap_or(0.0);
    let meant = || start.iter().filter(|(axis, _)| step(*axis) != 0.0);
    let is_at_end = |(axis, at): &(Axis, f64)| {
        let of_axis = config.axes.iter().find(|of| of.axis == *axis);
        let travel = of_axis.and_then(|of| of.travel);
        travel.is_some_and(|(low, high)| {
            if step(*axis) < 0.0 {
                *at <= low + ROUNDING
            } else {
                *at >= high - ROUNDING
            }
        })
    };
    let all = meant().next().is_some() && meant().all(is_at_end);
    all.then(|| {
        let ends: Vec<String> = meant()
            .map(|(axis, at)| {
                let unit = if axis.is_rotary() { "°" } else { "mm" };
                format!("{axis} at {at:.4} {unit}")
            })
            .collect();
        format!("nothing moved: the travel ends there, {}", ends.join(", "))
    })
}

/// Whether an axis stands at an end of its travel.
pub(super) fn is_at_end(config: &MachineConfig, axis: Axis, value: f64) -> bool {
    let of_axis = config.axes.iter().find(|of| of.axis == axis);
    let travel = of_axis.and_then(|of| of.travel);
    travel.is_some_and(|(low, high)| value <= low + ROUNDING || value >= high - ROUNDING)
}

fn followed(status: &Status, joints: usize) -> Followed {
    if status.power() != Ok(Power::On) {
        return Followed::Yes;
    }
    if status.drives_are_silent() {
        return Followed::Silent;
    }
    let errors = status.following_error.iter().take(joints).enumerate();
    let away: Vec<(usize, f64)> = errors
        .filter(|(_, error)| error.abs() > FOLLOWED)
        .map(|(joint, error)| (joint, *error))
        .collect();
    if away.is_empty() {
        Followed::Yes
    } else {
        Followed::No(away)
    }
}

fn shorts(
    start: &[(Axis, f64)],
    asked: &[f64; AXES],
    end: &[(Axis, f64)],
    config: &MachineConfig,
) -> Vec<Short> {
    let axes = start.iter().zip(end);
    axes.filter_map(|((axis, from), (_, to))| {
        let step = asked.get(axis.index()).copied().unwrap_or(0.0);
        let by = from + step - to;
        let of_axis = config.axes.iter().find(|of| of.axis == *axis);
        let (low, high) = of_axis.and_then(|of| of.travel)?;
        let at = if step < 0.0 { low } else { high };
        (by.abs() > ROUNDING && step != 0.0).then_some(Short {
            axis: *axis,
            by,
            at_end: (to - at).abs() <= ROUNDING,
        })
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_link::{FaultCause, MachineState, Text};

    #[test]
    fn what_was_not_moved_is_told_by_axis_and_why() {
        let config = crate::config::load(None).unwrap();
        let (x, y) = (Axis::X, Axis::Y);
        let (_, high) = config.axes[0].travel.unwrap();
        let mut asked = [0.0; AXES];
        (asked[0], asked[1]) = (10.0, -4.0);
        let start = [(x, high - 3.0), (y, 0.0)];
        let told = |end: [f64; 2]| {
            let end = [(x, end[0]), (y, end[1])];
            let short = shorts(&start, &asked, &end, &config);
            Arrival {
                short,
                followed: Followed::Yes,
                ended_by: None,
            }
        };
        assert_eq!(told([high + 7.0, -4.0]).text(), "");
        assert_eq!(told([high + 7.0, -4.0]).exit(), Exit::Done);
        let at_end = told([high, -4.0]);
        assert_eq!(at_end.not_moved(), [(x, 7.0)]);
        assert_eq!(at_end.exit(), Exit::Short);
        assert_eq!(at_end.at_end_of_travel(), ["X"]);
        assert!(is_at_end(&config, x, high) && !is_at_end(&config, x, high - 1.0));
        assert_eq!(
            at_end.text(),
            "  X is at the end of its travel: 7.0000 mm of it was not moved\n"
        );
        let stopped = told([high, -1.0]);
        assert!(stopped.text().contains("Y stopped before"));
        assert_eq!(stopped.at_end_of_travel(), ["X"]);
    }

    #[test]
    fn whoever_ended_a_jog_is_named_and_it_is_no_success() {
        let mut status: Status = bytemuck::Zeroable::zeroed();
        (status.state, status.power) = (MachineState::Idle.code(), Power::On.code());
        status.last_error = Text::new("a hold ended the jog");
        let short = |at_end| Short {
            axis: Axis::X,
            by: 3.0,
            at_end,
        };
        assert_eq!(ended_by(&status, &[]), None, "it was at its end");
        assert_eq!(ended_by(&status, &[short(true)]), None, "nor did it matter");
        let arrival = |status: &Status, short: Vec<Short>| Arrival {
            ended_by: ended_by(status, &short),
            short,
            followed: Followed::Yes,
        };
        let held = arrival(&status, vec![short(false)]);
        assert_eq!(held.ended_by(), Some("a hold ended the jog"));
        assert_eq!(held.exit(), Exit::Fault);
        assert!(
            held.text()
                .ends_with("before its end: a hold ended the jog\n")
        );
        // At its end or not: the machine is at fault.
        status.state = MachineState::Faulted.code();
        status.fault = FaultCause::FeedbackLost.code();
        let faulted = arrival(&status, Vec::new());
        assert_eq!(faulted.exit(), Exit::Fault);
        assert!(faulted.text().contains(FaultCause::FeedbackLost.text()));
    }

    #[test]
    fn an_axis_at_the_end_of_its_travel_is_told_before_anything_is_asked() {
        let config = crate::config::load(None).unwrap();
        let (_, high) = config.axes[0].travel.unwrap();
        let mut asked = [0.0; AXES];
        asked[0] = 1.0;
        let told = |x: f64, asked: &[f64; AXES]| {
            at_end_already(&[(Axis::X, x), (Axis::Y, 0.0)], asked, &config)
        };
        let why = told(high, &asked).unwrap();
        assert!(why.contains("X at ") && why.ends_with(" mm"), "{why}");
        assert_eq!(told(high - 1.0, &asked), None);
        assert_eq!(told(high, &[0.0; AXES]), None);
        asked[0] = -1.0;
        assert_eq!(told(high, &asked), None, "inwards");
        (asked[0], asked[1]) = (1.0, 1.0);
        assert_eq!(told(high, &asked), None, "another axis can go");
    }

    #[test]
    fn drives_that_are_elsewhere_or_silent_are_no_arrival() {
        let mut status: Status = bytemuck::Zeroable::zeroed();
        status.following_error[0] = 24.2;
        assert_eq!(followed(&status, 3), Followed::Yes, "simulated");
        status.power = Power::On.code();
        let away = Arrival {
            short: Vec::new(),
            followed: followed(&status, 3),
            ended_by: None,
        };
        assert!(!away.have_followed());
        assert_eq!(away.exit(), Exit::Fault);
        assert!(
            away.text().contains("J0 is 24.2000 from there"),
            "{}",
            away.text()
        );
        status.feedback_age_ns = 600_000_000;
        assert_eq!(followed(&status, 3), Followed::Silent);
        (status.feedback_age_ns, status.following_error[0]) = (4_000_000, 0.01);
        assert_eq!(followed(&status, 3), Followed::Yes);
    }
}
