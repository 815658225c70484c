//! What a jog by steps came to: which axes did not go all the way, and whether the drives are where
//! the axes were told to be.

use super::panel::Panel;
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
const PATIENCE: Duration = Duration::from_millis(1_500);
/// Nearer than this a joint has followed, mm or degrees.
const FOLLOWED: f64 = 0.05;
/// Drives that have said nothing for so long are not known to have followed.
const SILENT_NS: u64 = 500_000_000;
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

/// What a jog by steps came to.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Arrival {
    short: Vec<Short>,
    followed: Followed,
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
        let followed = loop {
            let followed = followed(panel.status()?, config.drives());
            let is_over = interrupt.is_set() || waits_from.elapsed() > PATIENCE;
            if followed == Followed::Yes || is_over {
                break followed;
            }
            std::thread::sleep(POLL);
        };
        let end = panel.position();
        let short = asked.map_or_else(Vec::new, |asked| shorts(start, asked, &end, config));
        Ok(Self { short, followed })
    }

    /// Done; a fault where the drives are elsewhere.
    pub(super) fn exit(&self) -> Exit {
        if self.have_followed() {
            Exit::Done
        } else {
            Exit::Fault
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
    pub(super) fn text(&self) -> String {
        let mut text = String::new();
        // Writing to a String does not fail.
        for Short { axis, by, at_end } in &self.short {
            let why = if *at_end {
                "is at the end of its travel"
            } else {
                "stopped before the end of its step"
            };
            let _ = writeln!(text, "  {axis} {why}: {by:.4} of it was not moved");
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
    if status.feedback_age_ns > SILENT_NS {
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
            }
        };
        assert_eq!(told([high + 7.0, -4.0]).text(), "");
        let at_end = told([high, -4.0]);
        assert_eq!(at_end.not_moved(), [(x, 7.0)]);
        assert_eq!(at_end.at_end_of_travel(), ["X"]);
        assert!(is_at_end(&config, x, high) && !is_at_end(&config, x, high - 1.0));
        assert_eq!(
            at_end.text(),
            "  X is at the end of its travel: 7.0000 of it was not moved\n"
        );
        let stopped = told([high, -1.0]);
        assert!(stopped.text().contains("Y stopped before"));
        assert_eq!(stopped.at_end_of_travel(), ["X"]);
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
