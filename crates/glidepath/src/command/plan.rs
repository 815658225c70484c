//! `glidepath plan`: plans the motion of a program without waiting for the clock.

use super::fitting::{is_all_that_is_wrong, without_travel};
use super::{check, session};
use crate::cli::PlanArgs;
use crate::clock;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::interrupt::Interrupt;
use crate::joints::PlanWatch;
use crate::output;
use crate::plan_steps::PlanSteps;
use crate::progress::ProgressDisplay;
use crate::recording::Recording;
use crate::report::{DiagnosisReport, MotionReport, Planning, peak_rss_bytes, rough_time};
use crate::sample::TickSample;
use glidepath_audit::diagnosis::Diagnosis;
use glidepath_audit::{Audit, AuditSettings};
use glidepath_kinematics::{Kinematics as _, Mechanism};
use glidepath_planner::{FileSource, Refusal, Step};
use glidepath_program::{Frame, Item};
use std::path::Path;
use std::time::Duration;

/// From so much motion on its time is a better measure of how far planning is than the lines are, s.
const LONG_S: f64 = 1800.0;

/// Steps of the planner between two looks at the clock, at progress and Ctrl-C.
const STEPS_PER_TURN: usize = 64;

/// Plans a program, audits the motion, and writes the files asked for.
///
/// # Errors
/// The program is rejected, a file cannot be read or written, or the user interrupted.
pub(super) fn plan(args: &PlanArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let (accepted, refused) = match check::accepted(&args.file, config, args.basic.json) {
        Ok(accepted) => (Some(accepted), None),
        // A program is to be looked at also while its offset is not set yet.
        Err(failure) if args.plot.is_some() && leaves_the_travel(&failure) => (None, Some(failure)),
        Err(failure) => return Err(failure),
    };
    let lines = accepted.as_ref().map_or(0, |accepted| accepted.lines);
    let least_time_s = accepted.map_or(0.0, |accepted| accepted.least_time_s);
    if least_time_s > args.longest.as_secs_f64() {
        return Err(Failure::TooLong {
            program: args.file.name().display().to_string(),
            takes: rough_time(least_time_s),
            longest: rough_time(args.longest.as_secs_f64()),
        });
    }
    let wide = refused.as_ref().map(|_| without_travel(config));
    let config = wide.as_ref().unwrap_or(config);
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let guard = session::guard(Some(&args.file), &args.basic, config, args.overwrite);
    let (csv, plot) = (args.setpoints.as_deref(), args.plot.as_deref());
    let mut recording = Recording::create(config, csv, plot, &guard)?;
    let progress = if least_time_s < LONG_S {
        ProgressDisplay::lines(lines.into(), args.basic.json)
    } else {
        ProgressDisplay::motion(least_time_s, args.basic.json)
    };
    progress.doing("planning");
    let mut pass = Pass::on_all_cores(args.file.path(), config)?;
    while pass.turn(&mut recording)? {
        let statistics = pass.steps.statistics();
        if least_time_s < LONG_S {
            progress.at(statistics.lines);
        } else {
            #[allow(clippy::cast_precision_loss, reason = "for people")]
            progress.has_planned(statistics.frames as f64 * config.period_t());
        }
        if interrupt.is_set() {
            return Err(Failure::Interrupted);
        }
    }
    progress.finish();

    let mut report = pass.report(config);
    report.program = args.file.name().display().to_string();
    report.setpoints.clone_from(&args.setpoints);
    report.plot.clone_from(&args.plot);
    recording.told(&report, args.file.path());
    let name = title(args.file.name());
    if let Some(failure) = refused {
        recording.finish(&format!("{name}: outside of the travel"), &report.caption())?;
        let plot = args.plot.as_deref().unwrap_or(Path::new("")).display();
        output::note(&format!(
            "{plot} shows where it goes, outside of the travel as it is"
        ));
        return Err(failure);
    }
    recording.finish(&name, &report.caption())?;
    if args.basic.json {
        output::object(&report);
    } else {
        output::result(&(report.text() + &report.files()));
    }
    Ok(report.exit())
}

/// Whether a program was rejected for nothing but where it goes.
fn leaves_the_travel(failure: &Failure) -> bool {
    matches!(failure, Failure::Rejected { diagnostics, .. } if is_all_that_is_wrong(diagnostics))
}

/// The name of a program on its plot.
pub(super) fn title(path: &Path) -> String {
    path.file_name()
        .unwrap_or(path.as_os_str())
        .to_string_lossy()
        .into_owned()
}

/// One pass of the planner over a program.
pub(super) struct Pass {
    program: String,
    steps: PlanSteps,
    clock: fn() -> Duration,
    /// Time that the plan was waited for.
    planning: Duration,
    /// The steps of the last turn, and what they took and made.
    turn: Vec<Step>,
    items: Vec<Item>,
    frames: Vec<Frame>,
    audit: Audit,
    diagnosis: Diagnosis,
    joints: Option<PlanWatch>,
    mechanism: Mechanism,
    period_t: f64,
}

impl Pass {
    /// A pass that plans on all cores; what the plan was waited for is told as wall time.
    pub(super) fn on_all_cores(path: &Path, config: &MachineConfig) -> Result<Self, Failure> {
        let steps = PlanSteps::on_all_cores(|| source(path, config), config, config.start());
        let steps = steps.map_err(|refusal| cannot_read(path, refusal))?;
        Ok(Self::new(path, config, steps, clock::elapsed))
    }

    /// A pass that plans in the calling thread, and tells its processor time.
    pub(super) fn on_one_core(path: &Path, config: &MachineConfig) -> Result<Self, Failure> {
        let source = source(path, config).map_err(|refusal| cannot_read(path, refusal))?;
        let steps = PlanSteps::on_one_core(source, config, config.start());
        Ok(Self::new(path, config, steps, clock::processor))
    }

    fn new(path: &Path, config: &MachineConfig, steps: PlanSteps, clock: fn() -> Duration) -> Self {
        let settings = config.settings();
        let judged = AuditSettings::from(&settings);
        Self {
            program: path.display().to_string(),
            steps,
            clock,
            planning: Duration::ZERO,
            turn: Vec::with_capacity(STEPS_PER_TURN),
            items: Vec::with_capacity(STEPS_PER_TURN),
            frames: Vec::with_capacity(STEPS_PER_TURN),
            audit: audit(config),
            diagnosis: config.diagnosis(&judged),
            joints: PlanWatch::new(path, config),
            mechanism: config.mechanism,
            period_t: settings.period_t,
        }
    }

    /// Takes some steps; false at the end.
    pub(super) fn turn(&mut self, recording: &mut Recording) -> Result<bool, Failure> {
        let before = (self.clock)();
        let goes_on = self.plan_some();
        self.planning += (self.clock)().saturating_sub(before);
        let (mut items, mut frames) = (self.items.iter(), self.frames.iter());
        for step in &self.turn {
            if *step == Step::Item
                && let Some(item) = items.next()
            {
                self.audit.program(item);
                self.diagnosis.program(item);
                recording.program(item);
            } else if let Some(frame) = frames.next() {
                self.audit.frame(frame);
                if self.joints.is_some()
                    && let Ok(joints) = self.mechanism.inverse(&frame.position)
                {
                    self.audit
                        .joints(frame.sequence, frame.line, joints.as_slice());
                    self.diagnosis.joints(joints.as_slice());
                }
                let binding = self.diagnosis.frame(frame);
                if let Some(joints) = &mut self.joints {
                    joints
                        .take(frame)
                        .map_err(|refusal| Failure::refused(&self.program, refusal, false))?;
                }
                if recording.is_wanted() {
                    // Out of reach is told by the watch; machines without one reach everything.
                    let joints = self.mechanism.inverse(&frame.position).unwrap_or_default();
                    let sample = TickSample::planned(frame, self.period_t, joints);
                    recording.push(&sample.diagnosed(binding, &self.diagnosis))?;
                }
            }
        }
        Ok(goes_on?)
    }

    /// The next items and frames; false at the end.
    fn plan_some(&mut self) -> Result<bool, Refusal> {
        self.turn.clear();
        self.items.clear();
        self.frames.clear();
        for _ in 0..STEPS_PER_TURN {
            let step = self.steps.step()?;
            match step {
                Step::Item => self.items.push(*self.steps.item()),
                // Not `push`, which copies twice.
                Step::Frame => self
                    .frames
                    .extend_from_slice(core::slice::from_ref(self.steps.frame())),
                // A file is never without its next item.
                Step::Pending => continue,
                Step::End => return Ok(false),
            }
            self.turn.push(step);
        }
        Ok(true)
    }

    pub(super) fn report(self, config: &MachineConfig) -> MotionReport {
        let statistics = self.steps.statistics();
        let planning = Planning {
            lines: statistics.lines,
            segments: statistics.segments,
            plan_wall_s: self.planning.as_secs_f64(),
            peak_rss_bytes: peak_rss_bytes(),
        };
        let mut report = MotionReport::new(&planning, &self.audit.finish(), config);
        report.max_joint_line_error = self.joints.map(|joints| joints.line_error());
        report.diagnosis = Some(DiagnosisReport::new(&self.diagnosis.finish(), config));
        report
    }
}

/// An audit of a plan for a machine, its joints and all.
fn audit(config: &MachineConfig) -> Audit {
    let audit = config.audit_at(&config.start());
    match config.joint_bounds() {
        Some(bounds) => audit.with_joints(bounds),
        None => audit,
    }
}

/// The items of a file that was checked.
fn source(path: &Path, config: &MachineConfig) -> Result<FileSource, Refusal> {
    let options = config.program_options(config.start());
    FileSource::unchecked(path, options, &config.settings())
}

fn cannot_read(path: &Path, refusal: Refusal) -> Failure {
    match refusal {
        Refusal::Read(error) => Failure::File(FileError::open(path)(error)),
        refusal => Failure::Refused(refusal),
    }
}
