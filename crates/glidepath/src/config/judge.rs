//! [`RawConfig`] to [`MachineConfig`]: every value in its range, all findings at once.

use super::finding::Finding;
use super::horizon;
use super::machine::{AxisConfig, InterpolatorConfig, MachineConfig, PathConfig, axis_share};
use super::program::ProgramConfig;
use super::raw::{Optional, RawAxis, RawConfig, RawInterpolator, RawLink, RawPath};
use glidepath_geometry::Axis;
use glidepath_program::{Effort, Smoothing};
use toml::Spanned;

/// Judges every value.
///
/// # Errors
/// All findings, in the order of the tables.
pub(super) fn judge(raw: RawConfig) -> Result<MachineConfig, Vec<Finding>> {
    let mut judge = Judge {
        findings: Vec::new(),
    };
    let axes_span = raw.axis.span();
    let axes: Vec<AxisConfig> = Axis::ALL
        .into_iter()
        .zip(raw.axis.into_inner().in_order())
        .filter_map(|(axis, raw)| Some(judge.axis(axis, &raw?)))
        .collect();
    if axes.is_empty() {
        judge.findings.push(Finding {
            key: "axis".to_owned(),
            message: "the machine has no axis".to_owned(),
            help: Some("add a table such as [axis.X]".to_owned()),
            span: Some(axes_span),
        });
    }
    let names: Vec<Axis> = axes.iter().map(|axis| axis.axis).collect();
    let mechanism = judge.mechanism(&raw.machine, &names);
    let joint_limits = judge.joints(&raw.joint, &mechanism);
    let axis_share = axis_share(&mechanism, &joint_limits, &axes);
    // Stops take as long as joints let them.
    let braking: Vec<AxisConfig> = axes
        .iter()
        .map(|axis| AxisConfig {
            max_acceleration: axis.max_acceleration * axis_share.acceleration,
            max_jerk: axis.max_jerk * axis_share.jerk,
            ..*axis
        })
        .collect();
    let interpolator = judge.interpolator(&raw.interpolator, &braking);
    let config = MachineConfig {
        mechanism,
        joint_limits,
        axis_share,
        axes,
        path: judge.path(raw.path),
        interpolator,
        preview: judge.preview(&raw.preview),
        instance: judge.instance(raw.link),
        program: ProgramConfig::judge(&mut judge, raw.program),
    };
    if judge.findings.is_empty() {
        Ok(config)
    } else {
        Err(judge.findings)
    }
}

/// What a number may be.
pub(super) struct Range {
    pub(super) min: f64,
    pub(super) max: f64,
    pub(super) unit: &'static str,
    /// How to choose a value.
    pub(super) help: &'static str,
}

pub(super) struct Judge {
    pub(super) findings: Vec<Finding>,
}

impl Judge {
    pub(super) fn number(&mut self, key: &str, value: &Spanned<f64>, range: &Range) -> f64 {
        let number = *value.as_ref();
        // Not a number is in no range.
        if !(range.min..=range.max).contains(&number) {
            let Range {
                min,
                max,
                unit,
                help,
            } = range;
            self.findings.push(Finding {
                key: key.to_owned(),
                message: format!("{key} = {number} {unit} is out of range"),
                help: Some(format!("give {min} to {max} {unit}: {help}")),
                span: Some(value.span()),
            });
        }
        number
    }

    pub(super) fn number_or(
        &mut self,
        key: &str,
        value: &Optional<f64>,
        range: &Range,
        default: f64,
    ) -> f64 {
        value
            .as_ref()
            .map_or(default, |value| self.number(key, value, range))
    }

    /// A whole number of any type that holds the range.
    fn whole<T: TryFrom<i64>>(
        &mut self,
        key: &str,
        value: &Spanned<i64>,
        (min, max): (i64, i64),
        help: &str,
    ) -> Option<T> {
        let number = *value.as_ref();
        let fitting = (min..=max)
            .contains(&number)
            .then(|| T::try_from(number).ok())
            .flatten();
        if fitting.is_none() {
            self.findings.push(Finding {
                key: key.to_owned(),
                message: format!("{key} = {number} is out of range"),
                help: Some(format!("give {min} to {max}: {help}")),
                span: Some(value.span()),
            });
        }
        fitting
    }

    /// One of the named values; the first is the default.
    pub(super) fn choice<T: Copy>(
        &mut self,
        key: &str,
        value: Optional<String>,
        known: &[(&str, T)],
    ) -> T {
        let default = known[0].1;
        let Some(value) = value else { return default };
        let found = known
            .iter()
            .find(|(name, _)| *name == value.as_ref().as_str());
        if found.is_none() {
            let list: Vec<String> = known
                .iter()
                .map(|(name, _)| format!("\"{name}\""))
                .collect();
            self.findings.push(Finding {
                key: key.to_owned(),
                message: format!("{key} = \"{}\" is not known", value.as_ref()),
                help: Some(format!("give {}", list.join(" or "))),
                span: Some(value.span()),
            });
        }
        found.map_or(default, |(_, value)| *value)
    }

    fn axis(&mut self, axis: Axis, raw: &Spanned<RawAxis>) -> AxisConfig {
        let table = raw.as_ref();
        let unit = Units::of(axis);
        let mut limit = |name: &str, value: &Spanned<f64>, unit: &'static str, max: f64| {
            let help = "a limit of the drive, in any direction of motion";
            self.number(
                &format!("axis.{axis}.{name}"),
                value,
                &Range {
                    min: 1e-3,
                    max,
                    unit,
                    help,
                },
            )
        };
        let max_velocity = limit("max_velocity", &table.max_velocity, unit.velocity, 1e5);
        let max_acceleration = limit(
            "max_acceleration",
            &table.max_acceleration,
            unit.acceleration,
            1e7,
        );
        let max_jerk = limit("max_jerk", &table.max_jerk, unit.jerk, 1e10);
        let travel = self.travel(axis, raw);
        AxisConfig {
            axis,
            travel,
            max_velocity,
            max_acceleration,
            max_jerk,
        }
    }

    fn travel(&mut self, axis: Axis, raw: &Spanned<RawAxis>) -> Option<(f64, f64)> {
        let unit = Units::of(axis).position;
        let table = raw.as_ref();
        let range = Range {
            min: -1e6,
            max: 1e6,
            unit,
            help: "the soft limit in machine coordinates",
        };
        let mut end = |name: &str, value: &Optional<f64>| {
            value
                .as_ref()
                .map(|value| self.number(&format!("axis.{axis}.{name}"), value, &range))
        };
        let min = end("min_position", &table.min_position);
        let max = end("max_position", &table.max_position);
        match (min, max) {
            (Some(min), Some(max)) if min < max => Some((min, max)),
            (None, None) if axis.is_rotary() => None,
            (Some(min), Some(max)) => {
                self.findings.push(Finding {
                    key: format!("axis.{axis}.max_position"),
                    message: format!(
                        "axis {axis} has no travel: min_position = {min} {unit} is not below \
                         max_position = {max} {unit}"
                    ),
                    help: Some("exchange the two, or mend the wrong one".to_owned()),
                    span: table.max_position.as_ref().map(Spanned::span),
                });
                None
            }
            (min, _) => {
                let missing = if min.is_none() {
                    "min_position"
                } else {
                    "max_position"
                };
                self.findings.push(Finding {
                    key: format!("axis.{axis}.{missing}"),
                    message: format!("the key `{missing}` of axis {axis} is missing"),
                    help: Some(format!(
                        "add `{missing} = …` ({unit}) to [axis.{axis}]; only a rotary axis may have \
                         no soft limits, and then neither of the two"
                    )),
                    span: Some(raw.span()),
                });
                None
            }
        }
    }

    fn path(&mut self, raw: RawPath) -> PathConfig {
        let tolerance = Range {
            min: 1e-5,
            max: 10.0,
            unit: "mm",
            help: "how far the motion may leave the programmed path",
        };
        let feed = Range {
            min: 1e-3,
            max: 1e7,
            unit: "mm/min",
            help: "the feedrate where the program has no F",
        };
        PathConfig {
            bounds: self.bounds(&raw),
            tolerance_mm: self.number_or("path.tolerance", &raw.tolerance, &tolerance, 0.02),
            smoothing: self.choice(
                "path.smoothing",
                raw.smoothing,
                &[
                    ("auto", Smoothing::default()),
                    ("sextic", Smoothing::Sextic),
                    ("bezier-pair", Smoothing::BezierPair),
                    ("exact-stop", Smoothing::ExactStop),
                ],
            ),
            effort: self.choice(
                "path.effort",
                raw.effort,
                &[("optimal", Effort::Optimal), ("fast", Effort::Fast)],
            ),
            default_feed: raw
                .default_feed
                .map(|value| self.number("path.default_feed", &value, &feed)),
        }
    }

    fn interpolator(&mut self, raw: &RawInterpolator, axes: &[AxisConfig]) -> InterpolatorConfig {
        let range = Range {
            min: 0.05,
            max: 60.0,
            unit: "s",
            help: "longer outlasts slower input, shorter answers an override sooner",
        };
        let period_us = raw.period_us.as_ref().map_or(Some(4000), |value| {
            self.whole(
                "interpolator.period_us",
                value,
                (250, 20_000),
                "µs between two setpoints",
            )
        });
        let priority = raw.priority.as_ref().map_or(Some(80), |value| {
            self.whole(
                "interpolator.priority",
                value,
                (1, 99),
                "the SCHED_FIFO priority",
            )
        });
        let cpu = raw.cpu.as_ref().and_then(|value| {
            self.whole(
                "interpolator.cpu",
                value,
                (0, 1023),
                "the number of a CPU of this host",
            )
        });
        let missed = raw.max_missed_ticks.as_ref().map_or(Some(10), |value| {
            let help = "ticks missed within a second before the motion stops with a fault";
            self.whole("interpolator.max_missed_ticks", value, (0, 1_000_000), help)
        });
        let horizon_t = horizon::default_t(axes);
        let horizon_t = self.number_or("interpolator.horizon_s", &raw.horizon_s, &range, horizon_t);
        let config = InterpolatorConfig {
            // A value that does not fit was found already: the configuration is refused.
            period_us: period_us.unwrap_or(4000),
            priority: priority.unwrap_or(80),
            cpu,
            max_missed_ticks: missed.unwrap_or(10),
            horizon_t,
        };
        // Only numbers that are good by themselves can be judged together.
        if self.findings.is_empty()
            && let Some(mut finding) = horizon::finding(&config, axes)
        {
            let (horizon, period) = (raw.horizon_s.as_ref(), raw.period_us.as_ref());
            let span = horizon
                .map(Spanned::span)
                .filter(|_| finding.key.ends_with("horizon_s"));
            finding.span = span.or_else(|| period.map(Spanned::span));
            self.findings.push(finding);
        }
        config
    }

    fn instance(&mut self, raw: RawLink) -> Option<String> {
        let instance = raw.instance?;
        let span = instance.span();
        let name = instance.into_inner();
        if !is_instance_name(&name) {
            self.findings.push(Finding {
                key: "link.instance".to_owned(),
                message: format!("link.instance = \"{name}\" cannot name a machine"),
                help: Some(INSTANCE_RULE.to_owned()),
                span: Some(span),
            });
        }
        Some(name)
    }
}

/// What [`is_instance_name`] accepts, in words.
pub const INSTANCE_RULE: &str =
    "give 1 to 32 letters a-z, digits, `-` or `_`, for example \"mill-1\"";

/// True for a name that can become part of file names in shared memory.
#[must_use]
pub fn is_instance_name(name: &str) -> bool {
    (1..=32).contains(&name.len())
        && name
            .bytes()
            .all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b"-_".contains(&b))
}

struct Units {
    position: &'static str,
    velocity: &'static str,
    acceleration: &'static str,
    jerk: &'static str,
}

impl Units {
    const fn of(axis: Axis) -> Self {
        if axis.is_rotary() {
            Self {
                position: "°",
                velocity: "°/s",
                acceleration: "°/s²",
                jerk: "°/s³",
            }
        } else {
            Self {
                position: "mm",
                velocity: "mm/s",
                acceleration: "mm/s²",
                jerk: "mm/s³",
            }
        }
    }
}
