//! `[home.J0]`: how the controller brings a joint home; and axes with two joints.

use super::values::{Judge, Range};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::raw::{Optional, RawAxis, RawHome};
use crate::config::settings::{AxisConfig, HomingBy};
use core::ops::Range as Bytes;
use glidepath_geometry::Axis;
use glidepath_interpolator::{IndexPulse, JointBounds, JointHoming};
use glidepath_kinematics::{JOINTS, Mechanism};
use std::collections::BTreeMap;
use toml::Spanned;

/// What the tables are judged by.
pub(super) struct HomeSurroundings<'a> {
    pub(super) mechanism: &'a Mechanism,
    pub(super) axes: &'a [AxisConfig],
    /// Axes with a second joint.
    pub(super) gantries: &'a [(Axis, f64)],
    pub(super) homing: HomingBy,
    pub(super) period_t: f64,
}

/// The tables as they are written.
pub(super) type RawHomes = BTreeMap<Spanned<String>, Spanned<RawHome>>;

impl Judge {
    /// The axes with a second joint, in the order of the axes.
    pub(super) fn gantries<'a>(
        &mut self,
        axes: impl Iterator<Item = (Axis, &'a RawAxis)>,
        mechanism: &Mechanism,
        homing: HomingBy,
    ) -> Vec<(Axis, f64)> {
        let mut gantries = Vec::new();
        for (axis, raw) in axes {
            let Some(value) = &raw.gantry_difference else {
                continue;
            };
            let range = Range {
                min: 1e-6,
                max: 1e3,
                unit: if axis.is_rotary() { "°" } else { "mm" },
                help: "what the two may be apart without harm; the way that squares them included",
            };
            let key = format!("axis.{axis}.gantry_difference");
            gantries.push((axis, self.number(&key, value, &range)));
            let why = match (mechanism, homing) {
                (Mechanism::Trivial(_), HomingBy::Drive) => {
                    "two joints of an axis are squared by the controller, not each by its drive"
                }
                (Mechanism::Trivial(_), _) if gantries.len() <= 4 => continue,
                (Mechanism::Trivial(_), _) => "at most four axes have a second joint",
                _ => "only an axis with a drive of its own can have a second one",
            };
            self.diagnostics.push(ConfigDiagnostic {
                key,
                message: why.to_owned(),
                help: Some(
                    "homing = \"controller\" in [feedback], and kinematics = \"trivial\""
                        .to_owned(),
                ),
                span: Some(value.span()),
            });
        }
        gantries
    }

    /// How each joint comes home.
    pub(super) fn homes(
        &mut self,
        raw: &RawHomes,
        around: &HomeSurroundings<'_>,
    ) -> [Option<JointHoming>; JOINTS] {
        let own = around.axes.iter().map(|axis| axis.axis);
        let second = around.gantries.iter().map(|(axis, _)| *axis);
        let of_joint: Vec<Axis> = own.chain(second).take(JOINTS).collect();
        let is_trivial = matches!(around.mechanism, Mechanism::Trivial(_));
        let mut homes = [None; JOINTS];
        for (name, table) in raw {
            let joint = name.as_ref().strip_prefix('J');
            let joint = joint.and_then(|number| number.parse::<usize>().ok());
            let axis = joint
                .and_then(|joint| of_joint.get(joint))
                .filter(|_| is_trivial);
            let axis = axis.and_then(|axis| around.axes.iter().find(|a| a.axis == *axis));
            let (Some(joint), Some(axis)) = (joint, axis) else {
                let last = of_joint.len().saturating_sub(1);
                let help = if is_trivial {
                    format!("the joints are J0 to J{last}, in the order of the axes")
                } else {
                    "machines whose joints are not their axes come home by their drives".to_owned()
                };
                self.refuse_home(
                    name.as_ref(),
                    "there is no such joint to bring home",
                    help,
                    Some(name.span()),
                );
                continue;
            };
            let homing = self.home(name.as_ref(), table.as_ref(), axis);
            homes[joint] = Some(homing);
            if around.homing == HomingBy::Controller {
                self.check_home(name.as_ref(), &homing, axis, around, table.span());
            }
        }
        if around.homing == HomingBy::Controller {
            self.check_homes(&homes, &of_joint, is_trivial, around);
        }
        homes
    }

    fn home(&mut self, name: &str, raw: &RawHome, axis: &AxisConfig) -> JointHoming {
        let key = |last: &str| format!("home.{name}.{last}");
        let of = |min: f64, max: f64, unit: &'static str, help: &'static str| Range {
            min,
            max,
            unit,
            help,
        };
        let velocity = of(-1e5, 1e5, "mm/s or °/s", "its sign is the direction");
        let place = of(-1e6, 1e6, "mm or °", "a position of the joint");
        let way = of(1e-3, 1e6, "mm or °", "the way that there is");
        let finally = of(1e-3, 1e5, "mm/s or °/s", "the way home");
        let mut number = |last: &str, value: &Optional<f64>, range: &Range, default: f64| {
            self.number_or(&key(last), value, range, default)
        };
        let search_v = number("search_velocity", &raw.search_velocity, &velocity, 0.0);
        let latch_v = number("latch_velocity", &raw.latch_velocity, &velocity, 0.0);
        let final_v = number(
            "final_velocity",
            &raw.final_velocity,
            &finally,
            axis.max_velocity,
        );
        let offset = number("offset", &raw.offset, &place, 0.0);
        let home = number("position", &raw.position, &place, 0.0);
        let search_travel = number("search_travel", &raw.search_travel, &way, 0.0);
        let clearance = number("clearance", &raw.clearance, &way, 0.0);
        let index = self.index(name, raw);
        let sequence = raw.sequence.as_ref().and_then(|value| {
            self.whole(
                &key("sequence"),
                value,
                (-100, 100),
                "groups go home in rising order",
            )
        });
        JointHoming {
            search_v,
            latch_v,
            final_v,
            index,
            offset,
            home,
            absolute: self.choice(
                &key("absolute"),
                raw.absolute.clone(),
                &[("no", None), ("stay", Some(false)), ("move", Some(true))],
            ),
            sequence: sequence.unwrap_or(0),
            is_shared: raw.shared,
            is_volatile: raw.volatile,
            ignores_limits: raw.ignore_limits,
            search_travel,
            clearance,
        }
    }

    /// Who keeps where the index pulse of a joint is.
    fn index(&mut self, name: &str, raw: &RawHome) -> Option<IndexPulse> {
        let key = |last: &str| format!("home.{name}.{last}");
        let input = raw.index_input.as_ref().and_then(|value| {
            let help = "the digital input of the index pulse";
            self.whole(&key("index_input"), value, (0, 63), help)
        });
        let kept = [("none", false), ("drive", true)];
        let by_drive = self.choice(&key("index"), raw.index.clone(), &kept);
        if let (Some(value), true) = (&raw.index_input, by_drive) {
            let help =
                "leave index_input out: the drive is asked, and no input is latched".to_owned();
            let message = format!("{name} has its index pulse by an input, and by its drive");
            self.refuse_home(name, &message, help, Some(value.span()));
        }
        by_drive
            .then_some(IndexPulse::Drive)
            .or(input.map(IndexPulse::Input))
    }

    fn check_home(
        &mut self,
        name: &str,
        homing: &JointHoming,
        axis: &AxisConfig,
        around: &HomeSurroundings<'_>,
        span: Bytes<usize>,
    ) {
        let bounds = JointBounds {
            velocity: axis.max_velocity,
            acceleration: axis.max_acceleration,
            jerk: axis.max_jerk,
        };
        // Where a limit is not known, what the joint can do is not known either.
        let limits = format!("axis.{}", axis.axis);
        let own = format!("home.{name}");
        let is_known = !self.has_found(&[limits.as_str(), own.as_str(), "interpolator.period_us"]);
        if let Err(error) = homing.check(&bounds, around.period_t)
            && is_known
        {
            let help = "see the table of velocities: glidepath config --explain home";
            self.refuse_home(
                name,
                &format!("{name} cannot come home: {error}"),
                help.to_owned(),
                Some(span.clone()),
            );
        }
        let (low, high) = axis.travel.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let cross = around.mechanism.cross();
        let by = if cross.is_some_and(|cross| cross.left(axis.axis).is_some()) {
            ", which is what [squareness] and [straightness] leave of the travel; or the axis more travel, if it has"
        } else {
            ""
        };
        let moves = homing.absolute != Some(false);
        if moves && !(low..=high).contains(&homing.home) {
            self.refuse_home(
                name,
                &format!(
                    "the home of {name}, {}, is outside of the travel",
                    homing.home
                ),
                format!("give a position of {low} to {high}{by}"),
                Some(span),
            );
        }
    }

    /// What the joints ask of each other.
    fn check_homes(
        &mut self,
        homes: &[Option<JointHoming>; JOINTS],
        of_joint: &[Axis],
        is_trivial: bool,
        around: &HomeSurroundings<'_>,
    ) {
        if !is_trivial {
            let help = "homing = \"drive\": each drive finds its home by itself";
            self.refuse_home(
                "J0",
                "the controller brings joints home only where each axis has a drive of its own",
                help.to_owned(),
                None,
            );
            return;
        }
        for (joint, (home, axis)) in homes.iter().zip(of_joint).enumerate() {
            let name = format!("J{joint}");
            let Some(home) = home else {
                let help = format!("how joint {name}, of axis {axis}, comes home");
                self.refuse_home(
                    &name,
                    &format!("the table [home.{name}] is missing"),
                    help,
                    None,
                );
                continue;
            };
            let first = of_joint.iter().position(|other| other == axis);
            let first = first.filter(|first| *first != joint && joint >= around.axes.len());
            let first = first.and_then(|first| homes.get(first).copied().flatten());
            if first.is_some_and(|first| first.sequence != home.sequence || home.sequence >= 0) {
                let help = "the same negative number for both, so that they go home together";
                self.refuse_home(
                    &name,
                    &format!(
                        "{name} is the second joint of axis {axis}, and does not go with the first"
                    ),
                    format!("sequence: {help}"),
                    None,
                );
            }
        }
    }

    fn refuse_home(&mut self, name: &str, message: &str, help: String, span: Option<Bytes<usize>>) {
        self.diagnostics.push(ConfigDiagnostic {
            key: format!("home.{name}"),
            message: message.to_owned(),
            help: Some(help),
            span,
        });
    }
}
