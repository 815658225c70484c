//! A supervisor of planner and interpolator: it feeds the one with what the other gives, tick by
//! tick.

use std::path::Path;

use glidepath_audit::{Audit, AuditReport, AuditSettings, Passed, Sample};
use glidepath_gcode::Options;
use glidepath_geometry::AxisVector;
use glidepath_interpolator::{Config, Stepped, stepped};
use glidepath_kinematics::{AxisRates, LimitedMechanism};
use glidepath_link::{Command, MachineState, Setpoint, SetpointFrame};
use glidepath_planner::{Output, Pipeline, ProgramSource};
use glidepath_program::{Effort, Item, Limits, Override, Settings, Smoothing};
use glidepath_tests::settings;

use crate::times;

const PERIOD_NS: u64 = 4_000_000;
/// Frames published ahead.
pub(crate) const HORIZON: u64 = 150;
/// Ticks until the planner knows of an override.
const NEWS: usize = 5;

/// The benchmark programs.
pub(crate) const BENCH: [&str; 14] = [
    "seed5_seed",
    "seed5_mill",
    "square20_seed",
    "square20_mill",
    "star_seed",
    "star_mill",
    "zigzag_seed",
    "zigzag_mill",
    "circle_g1_0.1_seed",
    "circle_g1_0.1_mill",
    "circle_g1_0.01_seed",
    "circle_g1_0.01_mill",
    "butterfly_g1_seed",
    "butterfly_g1_mill",
];

/// Ways to plan them.
pub(crate) const EFFORTS: [Effort; 2] = [Effort::Fast, Effort::Optimal];

/// All of them, in both ways; dense ones take long to plan near-optimally in a debug build, so they
/// are left to the long form.
pub(crate) fn jobs() -> impl Iterator<Item = (&'static str, Effort)> {
    let both = |name| EFFORTS.map(|effort| (name, effort));
    let is_short = |name: &str| BENCH.iter().position(|n| *n == name) < Some(8);
    BENCH
        .into_iter()
        .flat_map(both)
        .filter(move |(name, effort)| *effort == Effort::Fast || is_short(name) || times() > 1)
}

fn on_the_mill(effort: Effort) -> Settings {
    Settings {
        effort,
        smoothing: Smoothing::Auto,
        corners: glidepath_program::Corners::default(),
        ..settings()
    }
}

/// A program and the machine it is for.
#[derive(Debug, Clone)]
pub(crate) struct Job {
    text: String,
    pub(crate) settings: Settings,
    /// Where joints are not the axes, these, and what axes may do by hand.
    joints: Option<(LimitedMechanism, AxisRates)>,
    start: AxisVector,
}

impl Job {
    pub(crate) fn bench(name: &str, effort: Effort) -> Self {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/data/bench");
        let file = Path::new(folder).join(format!("{name}.ngc"));
        let mut settings = on_the_mill(effort);
        if name.ends_with("_seed") {
            settings.limits = Limits::uniform(100.0, 10_000.0, 1e6);
            settings.tolerance_mm = 0.05;
        }
        Self {
            text: std::fs::read_to_string(file).unwrap(),
            settings,
            joints: None,
            start: AxisVector::zeros(),
        }
    }

    /// A program for the mill, with effort "optimal".
    pub(crate) fn text(text: String) -> Self {
        Self {
            text,
            settings: on_the_mill(Effort::Optimal),
            joints: None,
            start: AxisVector::zeros(),
        }
    }

    /// A program for a machine whose joints are not its axes, from where it stands.
    pub(crate) fn of_joints(
        text: &str,
        limits: Limits,
        joints: (LimitedMechanism, AxisRates),
        (start, effort): (AxisVector, Effort),
    ) -> Self {
        let settings = Settings {
            limits,
            ..on_the_mill(effort)
        };
        Self {
            text: text.to_owned(),
            settings,
            joints: Some(joints),
            start,
        }
    }

    fn pipeline(&self) -> Pipeline<ProgramSource<&[u8]>> {
        let start = self.start;
        let options = Options {
            start,
            ..Options::default()
        };
        let source = ProgramSource::new(self.text.as_bytes(), options);
        Pipeline::new(source, self.settings, start)
            .with_joints(self.joints.map(|(joints, _)| joints))
    }

    /// Periods of a plan at an override.
    pub(crate) fn planned_periods(&self, wanted: Override) -> u64 {
        let mut pipeline = self.pipeline();
        pipeline.follow_override(wanted);
        let mut last = 0;
        while let Some(frame) = pipeline.next_frame().unwrap() {
            last = frame.sequence;
        }
        last
    }

    /// The plan of the whole program, as it is without an override.
    pub(crate) fn planned(&self) -> Planned {
        let (mut pipeline, mut planned) = (self.pipeline(), Planned::default());
        while planned.take(&mut pipeline) {}
        planned
    }

    /// The same as [`Self::supervised`], of a program that was planned once for many runs. No run may change an
    /// override.
    pub(crate) fn supervised_as_planned<R>(
        &self,
        planned: &Planned,
        work: impl FnOnce(&mut Supervisor<'_, '_, '_>) -> R,
    ) -> R {
        self.supervised(|supervisor| {
            supervisor.planned = planned.clone();
            work(supervisor)
        })
    }

    /// Runs the program under a supervisor, which `work` tells what to do.
    pub(crate) fn supervised<R>(&self, work: impl FnOnce(&mut Supervisor<'_, '_, '_>) -> R) -> R {
        let mut config = Config {
            start_position: self.start,
            ..Config::new(self.settings.limits, PERIOD_NS)
        };
        if let Some((joints, by_hand)) = &self.joints {
            config.mechanism = joints.mechanism;
            config.joint_limits = joints.limits;
            config.hand_limits.acceleration = by_hand.acceleration;
            config.hand_limits.jerk = by_hand.jerk;
        }
        stepped(&config, |stepped| {
            work(&mut Supervisor {
                stepped,
                pipeline: self.pipeline(),
                planned: Planned::default(),
                sent: 0,
                setpoints: Vec::new(),
                comes_every: 1,
                wanted: Override::NONE,
                news: None,
            })
        })
    }
}

/// What the planner has given out of a program so far.
#[derive(Clone, Default)]
pub(crate) struct Planned {
    pub(crate) frames: Vec<SetpointFrame>,
    items: Vec<Item>,
    ended: bool,
}

impl Planned {
    /// Takes what the planner gives out next. Whether there is more.
    fn take(&mut self, pipeline: &mut Pipeline<ProgramSource<&[u8]>>) -> bool {
        match pipeline.advance().unwrap() {
            Output::Frame(frame) => self.frames.push(SetpointFrame {
                block: pipeline.block(),
                ..SetpointFrame::from_frame(&frame, 1, PERIOD_NS)
            }),
            Output::Item(item) => self.items.push(item),
            Output::Pending => {}
            Output::End => self.ended = true,
        }
        !self.ended
    }
}

/// A program under way.
pub(crate) struct Supervisor<'s, 'i, 'p> {
    stepped: &'s mut Stepped<'i>,
    pipeline: Pipeline<ProgramSource<&'p [u8]>>,
    pub(crate) planned: Planned,
    sent: usize,
    pub(crate) setpoints: Vec<Setpoint>,
    /// Ticks from one time that frames come to the next: more than one where the planner is late.
    pub(crate) comes_every: usize,
    wanted: Override,
    news: Option<usize>,
}

impl Supervisor<'_, '_, '_> {
    pub(crate) fn command(&mut self, command: Command) {
        assert!(self.stepped.command(command));
        match command {
            Command::FeedOverride(ratio) if ratio.abs() > 0.0 => self.wanted.feed_r = ratio.abs(),
            Command::RapidOverride(ratio) if ratio > 0.0 => self.wanted.rapid_r = ratio,
            _ => return,
        }
        self.news = Some(NEWS);
    }

    pub(crate) fn tick(&mut self) -> Setpoint {
        match &mut self.news {
            Some(0) => {
                self.pipeline.follow_override(self.wanted);
                self.news = None;
            }
            Some(ticks) => *ticks -= 1,
            None => {}
        }
        let executed = self
            .setpoints
            .last()
            .map_or(0, |setpoint| setpoint.sequence);
        if self.setpoints.len().is_multiple_of(self.comes_every) {
            self.publish(executed + HORIZON);
        }
        let setpoint = self.stepped.tick();
        self.setpoints.push(setpoint);
        setpoint
    }

    /// Publishes frames up to a sequence.
    fn publish(&mut self, limit: u64) {
        loop {
            if let Some(frame) = self.planned.frames.get(self.sent) {
                if frame.sequence >= limit || !self.stepped.offer(frame) {
                    return;
                }
                self.sent += 1;
            } else if self.planned.ended {
                return;
            } else {
                self.planned.take(&mut self.pipeline);
            }
        }
    }

    pub(crate) fn is(&self, state: MachineState) -> bool {
        self.setpoints
            .last()
            .is_some_and(|s| s.state() == Ok(state))
    }

    /// Whether the program was executed.
    pub(crate) fn is_over(&self) -> bool {
        self.is(MachineState::Idle) && self.setpoints.last().is_some_and(|s| s.epoch > 0)
    }

    /// Plays to the end, or for so many ticks.
    pub(crate) fn play(&mut self, ticks: usize) {
        for _ in 0..ticks {
            if self.is_over() {
                return;
            }
            self.tick();
        }
    }

    /// The auditor's report of everything since the beginning.
    pub(crate) fn audit(&self, settings: &Settings, largest_override: f64) -> AuditReport {
        let mut audit = Audit::new(&AuditSettings::from(settings)).with_override(largest_override);
        for item in &self.planned.items {
            audit.program(item);
        }
        let mut passed = Passed::default();
        for setpoint in &self.setpoints {
            let sample = Sample {
                tick: setpoint.number,
                line: setpoint.line,
                position: AxisVector::from(setpoint.position),
                reported: None,
                is_between_frames: setpoint.is_between_frames(),
            };
            let time = (setpoint.sequence, setpoint.fraction);
            match passed.off_mm(time, &sample.position) {
                // Back along the path, or onward again: where it was before.
                Some(off_mm) if off_mm <= audit.tolerance_mm() => audit.sample_away(&sample),
                _ => audit.sample(&sample),
            }
        }
        audit.finish()
    }
}

/// Nothing may be broken, neither limits nor tolerance, whatever time has done meanwhile.
pub(crate) fn assert_limits(report: &AuditReport) {
    for worst in [
        report.max_velocity_ratio,
        report.max_acceleration_ratio,
        report.max_jerk_ratio,
    ] {
        assert!(worst.ratio <= 1.0 + 1e-6, "{worst:?}");
    }
    assert!(report.violations.is_empty(), "{:#?}", report.violations);
}
