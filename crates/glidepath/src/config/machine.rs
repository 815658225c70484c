//! The judged configuration of a machine: what the rest of the program works with.

use super::compensation::Compensation;
use super::probe::ProbeConfig;
use super::program::ProgramConfig;
use super::settings::{
    AxisConfig, BY_HAND, FeedbackConfig, InterpolatorConfig, JogConfig, MCodeRule, MOST_OF_AXES,
    PathConfig,
};
use super::spindle::SpindleConfig;
use glidepath_audit::diagnosis::Diagnosis;
use glidepath_audit::{AuditSettings, JointBounds};
use glidepath_gcode::{
    AxisTravel, Connections, Gears, LoopLimits, MCodes, Machine, Options, SpindleAxis, Threading,
};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_interpolator::{
    AdaptiveFeed, AnswerSource, JointHoming, MCodeWait, MCodeWaits, StopSettings, Superposition,
};
use glidepath_kinematics::{
    AxisShare, FiveAxis, JOINTS, JointLimit, JointLimits, JointWatch, Kinematics as _,
    LimitedMechanism, Mechanism,
};
use glidepath_link::Status;
use glidepath_motion::preview::AdvanceRetreat;
use glidepath_program::{Limits, Settings};
use std::path::PathBuf;
use std::sync::Arc;

/// A machine.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineConfig {
    /// How axes and joints belong together.
    pub mechanism: Mechanism,
    /// What each joint can do; no limits where every axis has a drive of its own.
    pub joint_limits: JointLimits,
    /// What joints leave of the axes' accelerations and jerks.
    pub axis_share: AxisShare,
    /// The axes in the order X Y Z A B C U V W, at least one.
    pub axes: Vec<AxisConfig>,
    /// The tolerance and how it is used.
    pub path: PathConfig,
    /// The real-time side.
    pub interpolator: InterpolatorConfig,
    /// How each joint comes home where the controller sees to that; `None` without a table.
    pub home_of_joints: [Option<JointHoming>; JOINTS],
    /// Axes with a second joint, in the order of those joints, and by how much the two may differ.
    pub gantries: Vec<(Axis, f64)>,
    /// What is taken out of where joints are told to be.
    pub compensation: Compensation,
    /// How it is moved by hand.
    pub jog: JogConfig,
    /// What the drives say.
    pub feedback: FeedbackConfig,
    /// The probe, if there is one.
    pub probe: Option<ProbeConfig>,
    /// The spindle, if programs can follow its angle, or turn it as an axis.
    pub spindle: Option<SpindleConfig>,
    /// The least and the highest spindle override that an operator may set, ratios.
    pub spindle_override: [f64; 2],
    /// The gears of the spindle, as programs choose them.
    pub gears: Arc<Gears>,
    /// What slows programs down besides the override, if anything does.
    pub adaptive_feed: Option<AdaptiveFeed>,
    /// What moves an axis in addition to programs, if anything does: its share of the axis' limits, and its range of
    /// the travel, are not in `axes`.
    pub superposition: Option<Superposition>,
    /// The preview by advance and retreat.
    pub preview: AdvanceRetreat,
    /// Name of the machine's shared memory; `None` if the file gives none.
    pub instance: Option<String>,
    /// How programs are read.
    pub program: ProgramConfig,
    /// M codes that the machine has of its own, and those that are waited for; of two rules for a
    /// code the first one counts.
    pub m_codes: Vec<MCodeRule>,
    /// What stops spindle and coolant together with the motion.
    pub stops: StopSettings,
    /// Folder of what is kept over a restart; `None`: nothing is.
    pub state_directory: Option<PathBuf>,
}

/// Share of the path tolerance that the pieces of a spline may be away from it.
const SPLINE_SHARE: f64 = 1e-3;

impl MachineConfig {
    /// Name used where neither the file nor the command line gives one.
    pub const DEFAULT_INSTANCE: &'static str = "default";

    /// The name of the mechanism, as `machine.kinematics` has it.
    #[must_use]
    pub const fn kinematics(&self) -> &'static str {
        match self.mechanism {
            Mechanism::Trivial(_) => "trivial",
            Mechanism::CoreXy(_) => "corexy",
            Mechanism::LinearDelta(_) => "linear-delta",
            Mechanism::RotaryDelta(_) => "rotary-delta",
            Mechanism::Scara(_) => "scara",
            Mechanism::FiveBar(_) => "five-bar",
            Mechanism::FiveAxis(_) => "five-axis",
            Mechanism::Hexapod(_) => "hexapod",
            Mechanism::Translational(_) => "translational-hexapod",
        }
    }

    /// Joints that are not axes.
    #[must_use]
    pub fn joints(&self) -> usize {
        match &self.mechanism {
            Mechanism::Trivial(_) => 0,
            mechanism => mechanism.joints(),
        }
    }

    /// The axis of each joint, where joints are axes: each has its own, and second ones follow.
    #[must_use]
    pub fn axis_of_joints(&self) -> Vec<Axis> {
        let second = self.gantries.iter().map(|(axis, _)| *axis);
        self.axis_names().into_iter().chain(second).collect()
    }

    /// The axes that do not know where they are, as a status tells of their joints. Where joints are not axes,
    /// every joint has to do with every axis.
    #[must_use]
    pub fn axes_not_homed(&self, status: &Status) -> Vec<Axis> {
        let lost = status.joints & !status.homed;
        let mut axes = self.axis_names();
        if self.joints() == 0 {
            let of_joints = self.axis_of_joints();
            let is_lost = |axis: &Axis| {
                let mut joints = of_joints.iter().enumerate();
                joints.any(|(joint, of)| of == axis && lost & (1 << joint) != 0)
            };
            axes.retain(is_lost);
        } else if lost == 0 {
            axes.clear();
        }
        axes
    }

    /// How many drives the machine has.
    #[must_use]
    pub fn drives(&self) -> usize {
        self.mechanism.joints() + self.gantries.len()
    }

    /// The judge of the joints' motion, where joints are not axes.
    #[must_use]
    pub fn joint_watch(&self) -> Option<JointWatch> {
        let is_trivial = matches!(self.mechanism, Mechanism::Trivial(_));
        (!is_trivial).then(|| JointWatch::new(self.mechanism, self.joint_limits, self.period_t()))
    }

    /// The joints that motion is planned for, where they are not axes.
    #[must_use]
    pub fn limited_mechanism(&self) -> Option<LimitedMechanism> {
        let is_trivial = matches!(self.mechanism, Mechanism::Trivial(_));
        (!is_trivial).then_some(LimitedMechanism {
            mechanism: self.mechanism,
            limits: self.joint_limits,
        })
    }

    /// Interpolation period in seconds.
    #[must_use]
    pub fn period_t(&self) -> f64 {
        f64::from(self.interpolator.period_us) / 1e6
    }

    /// Interpolation period in nanoseconds.
    #[must_use]
    pub fn period_ns(&self) -> u64 {
        u64::from(self.interpolator.period_us) * 1000
    }

    /// Lowest and highest position of every axis; infinite where there is no soft limit.
    #[must_use]
    pub fn travel(&self) -> (AxisVector, AxisVector) {
        let mut low = AxisVector::repeat(f64::NEG_INFINITY);
        let mut high = AxisVector::repeat(f64::INFINITY);
        for axis in &self.axes {
            if let Some((min, max)) = axis.travel {
                low[axis.axis.index()] = min;
                high[axis.axis.index()] = max;
            }
        }
        (low, high)
    }

    /// Limits over all nine axes, as far as joints leave them wherever the axes are, and their travel:
    /// what axes do whose joints nobody looks at. An axis the machine does not have is unlimited.
    #[must_use]
    pub fn limits(&self) -> Limits {
        self.limits_at(self.axis_share)
    }

    /// The same as the file has them: what no axis exceeds. Joints may leave less, place by place.
    #[must_use]
    pub fn axis_limits(&self) -> Limits {
        self.own_limits_or(MOST_OF_AXES)
    }

    /// The same, unlimited where the file gives none.
    #[must_use]
    pub fn own_limits(&self) -> Limits {
        self.own_limits_or([Limits::UNLIMITED; 3])
    }

    fn own_limits_or(&self, most: [f64; 3]) -> Limits {
        let mut limits = self.limits_at(AxisShare::FULL);
        for axis in &self.axes {
            let i = axis.axis.index();
            let own = [
                &mut limits.velocity,
                &mut limits.acceleration,
                &mut limits.jerk,
            ];
            for (k, limit) in own.into_iter().enumerate() {
                if !axis.has_own[k] {
                    limit[i] = most[k];
                }
            }
        }
        limits
    }

    fn limits_at(&self, share: AxisShare) -> Limits {
        let mut limits = Limits::uniform(Limits::UNLIMITED, Limits::UNLIMITED, Limits::UNLIMITED);
        for axis in &self.axes {
            let i = axis.axis.index();
            limits.velocity[i] = axis.max_velocity;
            limits.acceleration[i] = axis.max_acceleration * share.acceleration;
            limits.jerk[i] = axis.max_jerk * share.jerk;
        }
        limits.path = self.path.bounds;
        (limits.travel.lowest, limits.travel.highest) = self.travel();
        limits
    }

    /// What a plan is made with.
    #[must_use]
    pub fn settings(&self) -> Settings {
        Settings {
            limits: self.axis_limits(),
            tolerance_mm: self.path.tolerance_mm,
            direction: self.direction_tolerance(),
            smoothing: self.path.smoothing,
            corners: self.path.corners,
            period_t: self.period_t(),
            effort: self.path.effort,
        }
    }

    /// What a motion of the machine is judged by.
    #[must_use]
    pub fn judged(&self) -> AuditSettings {
        AuditSettings::from(&self.settings())
    }

    /// What joints are judged by, where they are not the axes.
    #[must_use]
    pub fn joint_bounds(&self) -> Option<Vec<JointBounds>> {
        let count = self.joints();
        let of_joint = |limit: &JointLimit| JointBounds {
            range: [limit.min_position, limit.max_position],
            rates: [limit.velocity, limit.acceleration, limit.jerk],
        };
        let limits = self.joint_limits.0.iter().take(count);
        (count > 0).then(|| limits.map(of_joint).collect())
    }

    /// A diagnosis of a motion that is judged so, told of the joints where they are not the axes.
    #[must_use]
    pub fn diagnosis(&self, judged: &AuditSettings) -> Diagnosis {
        let diagnosis = Diagnosis::new(judged);
        match self.joint_bounds() {
            Some(bounds) => diagnosis.with_joints(&bounds),
            None => diagnosis,
        }
    }

    /// The axes in the order X Y Z A B C U V W.
    #[must_use]
    pub fn axis_names(&self) -> Vec<Axis> {
        self.axes.iter().map(|axis| axis.axis).collect()
    }

    /// The mechanism, if it is one of five axes.
    pub(crate) const fn five_axis(&self) -> Option<FiveAxis> {
        match self.mechanism {
            Mechanism::FiveAxis(machine) => Some(machine),
            _ => None,
        }
    }

    /// How to read a program for this machine standing at `start` (mm, degrees).
    #[must_use]
    pub fn program_options(&self, start: AxisVector) -> Options {
        let machine = self
            .axes
            .iter()
            .fold(
                Machine::new(&self.axis_names()),
                |machine, axis| match axis.travel {
                    Some((min, max)) => machine.with_travel(axis.axis, AxisTravel { min, max }),
                    None => machine,
                },
            );
        let default_feed_mm_min = self.path.default_feed;
        let mut m_codes = MCodes::default();
        for rule in &self.m_codes {
            let MCodeRule { m_code_wait, at } = rule;
            m_codes.declare_waiting(m_code_wait.first, m_code_wait.last, *at);
        }
        let dialect = self.program.dialect.unwrap_or_default();
        self.gears.declare(dialect, &mut m_codes);
        Options {
            machine,
            default_feed_mm_min,
            start,
            offsets: self.program.offsets.clone(),
            tools: self.program.tools.clone(),
            variables: Arc::clone(&self.program.variables),
            subroutines: self.program.subroutines.clone(),
            dialect,
            question: self.program.question.clone(),
            fanuc: self.program.fanuc,
            siemens: self.program.siemens,
            five_axis: self.five_axis(),
            extruder: self.program.extruder,
            firmware: self.program.firmware,
            connections: self.program.connections,
            probing_v: self.probing_v(),
            threading: self
                .spindle
                .filter(|spindle| spindle.encoder)
                .map(|spindle| Threading {
                    limits: self.limits(),
                    period_t: self.period_t(),
                    rigid_tapping: spindle.rigid_tapping,
                    spindle_a: spindle.acceleration,
                    overtravel: spindle.overtravel,
                }),
            gears: Arc::clone(&self.gears),
            orients: self.spindle.is_some_and(|spindle| spindle.orientation),
            spindle_axis: self.spindle.and_then(|spindle| {
                Some(SpindleAxis {
                    axis: spindle.axis?,
                    limits: self.limits(),
                    rigid_tapping: spindle.rigid_tapping,
                })
            }),
            adaptive_feed: match self.adaptive_feed {
                None => glidepath_gcode::AdaptiveFeed::None,
                Some(feed) if feed.always => glidepath_gcode::AdaptiveFeed::Always,
                Some(_) => glidepath_gcode::AdaptiveFeed::Switched,
            },
            in_force: self.program.in_force.clone(),
            watch: self.program.watch.clone(),
            m_codes: Arc::new(m_codes),
            waits_for_speed: self.waits_for_speed(),
            tolerance_mm: self.path.tolerance_mm,
            direction: self.direction_tolerance(),
            unwinds_at_rapid: self.program.unwinds_at_rapid,
            spline_tolerance_mm: SPLINE_SHARE * self.path.tolerance_mm,
            tolerance_ratio: self.program.tolerance_ratio,
            loops: LoopLimits {
                may_run_unchecked: self.program.may_run_unchecked,
                ..LoopLimits::default()
            },
            ..Options::default()
        }
    }

    /// The highest feed at which the probe may be used, mm/s or °/s.
    pub(crate) fn probing_v(&self) -> Option<f64> {
        let limit = |axis: &AxisConfig| (axis.max_acceleration, axis.max_jerk);
        let limits: Vec<_> = self.axes.iter().map(limit).collect();
        let probe = self.probe.as_ref()?;
        Some(probe.highest_v(&limits, self.period_t()))
    }

    /// The M codes that are to be answered before the motion goes on.
    #[must_use]
    pub fn m_code_waits(&self) -> MCodeWaits {
        let input = (self.program.connections == Connections::Real).then_some(MCodeWait {
            first: 66,
            last: 66,
            answer: AnswerSource::Planner,
            within: None,
            is_late: false,
        });
        let rules: Vec<MCodeWait> = input
            .into_iter()
            .chain(self.m_codes.iter().map(|rule| rule.m_code_wait))
            .chain(self.asks_for_tools().then_some(BY_HAND))
            .collect();
        MCodeWaits::new(&rules).unwrap_or_default()
    }

    /// Whether nobody is named who changes tools: a person does then, and says so.
    #[must_use]
    pub fn asks_for_tools(&self) -> bool {
        let is_of = |rule: &MCodeRule| {
            (rule.m_code_wait.first..=rule.m_code_wait.last).contains(&BY_HAND.first)
        };
        !self.m_codes.iter().any(is_of)
    }

    /// Whether programs wait for the spindle to turn as fast as it was told to.
    fn waits_for_speed(&self) -> bool {
        let is_speed = |rule: &MCodeRule| {
            let codes = rule.m_code_wait.first..=rule.m_code_wait.last;
            rule.m_code_wait.answer == AnswerSource::SpindleAtSpeed
                && [3, 4].iter().any(|code| codes.contains(code))
        };
        self.m_codes.iter().any(is_speed)
    }

    /// Whether `glidepath abort` raises the tool axis: not where the spindle is an axis, whose taps are moves like others.
    pub(crate) fn lifts_after_abort(&self) -> bool {
        self.jog.lift > 0.0 && self.spindle.is_none_or(|spindle| spindle.axis.is_none())
    }

    /// Where a program begins that is read now: where the machine stands, or at home.
    #[must_use]
    pub fn start(&self) -> AxisVector {
        self.program.stands.unwrap_or_else(|| self.home())
    }

    /// Where a machine stands at the start of a program when nothing else is known: at zero, or at
    /// the nearest point of an axis' travel.
    #[must_use]
    pub fn home(&self) -> AxisVector {
        let mut home = AxisVector::zeros();
        for axis in &self.axes {
            if let Some((min, max)) = axis.travel {
                home[axis.axis.index()] = 0.0_f64.clamp(min, max);
            }
        }
        home
    }
}
