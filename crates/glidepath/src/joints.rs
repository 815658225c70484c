//! The judgement of a program by the joints, where they are not the axes.
//!
//! Along the path: reach, singularities and ranges of the joints, at places at most [`STEP`]
//! apart, so that `check` needs no plan. Over the plan: velocity, acceleration and jerk of every
//! joint, too, by finite differences at the period. Speeds, accelerations and jerks of the axes
//! were kept where joints can follow when the plan was made; should a
//! program ask more of a joint all the same, it is refused before anything moves.

use crate::config::MachineConfig;
use crate::plan_steps::PlanSteps;
use glidepath_gcode::{Diagnostic, DiagnosticCode, ReadingWatch};
use glidepath_geometry::{Axis, AxisVector, Segment};
use glidepath_kinematics::{
    JointFault, JointWatch, Kinematics as _, KinematicsError, Mechanism, Quantity,
};
use glidepath_planner::{FileSource, ItemSource, Refusal, Supply};
use glidepath_program::{Effort, Frame, ItemKind};
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

/// Largest change of any axis between two places that are looked at, mm or degrees. The joints of
/// mechanisms of usual size bend by less than a tenth of a micrometre over that.
const STEP: f64 = 0.25;

/// Judges a program along its path. `told` hears the lines read.
///
/// # Errors
/// The file cannot be read.
pub(crate) fn check_path(
    path: &Path,
    config: &MachineConfig,
    told: &mut dyn FnMut(u64),
) -> Result<Option<Diagnostic>, Refusal> {
    let Some(watch) = config.joint_watch() else {
        return Ok(None);
    };
    let options = config.program_options(config.start());
    let mut source = FileSource::unchecked(path, options, &config.settings())?;
    let home = config.start();
    if let Err(fault) = watch.stand(&home) {
        return Ok(Some(diagnostic(
            path,
            1,
            &fault,
            (&home, &config.axis_names()),
        )));
    }
    // A file that changed since it was checked is found out when it is planned.
    while let Supply::Item(item) = source.next_item() {
        let ItemKind::Move { segment, .. } = &item.kind else {
            continue;
        };
        told(source.lines_read());
        if let Err((fault, place)) = walk(segment, &watch) {
            return Ok(Some(diagnostic(
                path,
                item.line,
                &fault,
                (&place, &config.axis_names()),
            )));
        }
    }
    Ok(None)
}

/// Goes along a segment, up to the first place where the machine may not be.
fn walk(segment: &Segment, watch: &JointWatch) -> Result<(), (JointFault, AxisVector)> {
    let length = segment.length();
    // The fastest axis per unit of path position, which rotary axes may be many times over.
    let fastest = (0..=8)
        .map(|i| segment.jet(length * f64::from(i) / 8.0).d1.amax())
        .fold(1.0, f64::max);
    let steps = (length * fastest / STEP).ceil().max(1.0);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive, and saturating"
    )]
    let steps = steps as u32;
    for step in 1..=steps {
        let s = length * f64::from(step) / f64::from(steps);
        let place = segment.jet(s).position;
        watch.stand(&place).map_err(|fault| (fault, place))?;
    }
    Ok(())
}

/// Judges a plan while it is made.
#[derive(Debug)]
pub(crate) struct PlanWatch {
    watch: JointWatch,
    path: PathBuf,
    mechanism: Mechanism,
    axes: Vec<Axis>,
    last: Option<AxisVector>,
    most_error: f64,
}

impl PlanWatch {
    /// For a machine whose joints are not its axes.
    pub(crate) fn new(path: &Path, config: &MachineConfig) -> Option<Self> {
        config.joint_watch().map(|watch| Self {
            watch,
            path: path.to_owned(),
            mechanism: config.mechanism,
            axes: config.axis_names(),
            last: None,
            most_error: 0.0,
        })
    }

    /// Takes the next frame.
    ///
    /// # Errors
    /// The joints cannot do it.
    pub(crate) fn take(&mut self, frame: &Frame) -> Result<(), Refusal> {
        self.watch.take(&frame.position).map_err(|fault| {
            let place = (&frame.position, self.axes.as_slice());
            refusal(diagnostic(&self.path, frame.line, &fault, place))
        })?;
        if let Some(last) = self.last.replace(frame.position) {
            let middle = (last + frame.position) / 2.0;
            let joints = [&last, &middle, &frame.position]
                .map(|place| self.mechanism.inverse(place).unwrap_or_default());
            let error = (joints[0] + joints[2]) / 2.0 - joints[1];
            self.most_error = self.most_error.max(error.amax());
        }
        Ok(())
    }

    /// How far joints that go straight from setpoint to setpoint are from where they should be
    /// half-way between them, at most, mm or degrees.
    pub(crate) const fn line_error(&self) -> f64 {
        self.most_error
    }
}

/// Frames between two notices of how far a plan was judged.
const FRAMES_PER_NOTICE: u64 = 256;

/// Plans a file from a position along its path, and judges the plan. `told` hears the lines read.
///
/// Where geometry is planned with the time, too, that takes a part of the time of the motion, for which
/// nobody should have to wait before it begins. It need not be done twice: a window that joints cannot
/// follow is not driven, and what is driven instead goes along the path.
///
/// # Errors
/// All that is wrong with the file, or what its joints cannot do.
pub(crate) fn check_plan(
    path: &Path,
    config: &MachineConfig,
    start: AxisVector,
    told: &mut dyn FnMut(u64),
) -> Result<(), Refusal> {
    let Some(mut watch) = config.joint_watch() else {
        return Ok(());
    };
    let mut along_path = config.clone();
    along_path.path.effort = Effort::Fast;
    let config = &along_path;
    let settings = config.settings();
    let source = || FileSource::open(path, config.program_options(start), &settings);
    let mut steps = PlanSteps::on_all_cores(source, config, start)?;
    while let Some(frame) = steps.next_frame()? {
        if config
            .program
            .watch
            .as_ref()
            .is_some_and(ReadingWatch::is_to_end)
        {
            return Err(std::io::Error::from(std::io::ErrorKind::Interrupted).into());
        }
        if frame.sequence.is_multiple_of(FRAMES_PER_NOTICE) {
            told(steps.statistics().lines);
        }
        watch.take(&frame.position).map_err(|fault| {
            let axes = config.axis_names();
            refusal(diagnostic(
                path,
                frame.line,
                &fault,
                (&frame.position, &axes),
            ))
        })?;
    }
    Ok(())
}

fn refusal(diagnostic: Diagnostic) -> Refusal {
    Refusal::Program {
        diagnostics: vec![diagnostic],
        unlisted: 0,
    }
}

/// What is wrong at a position of the machine.
fn diagnostic(
    path: &Path,
    line: u32,
    fault: &JointFault,
    (place, axes): (&AxisVector, &[Axis]),
) -> Diagnostic {
    let help = match fault {
        JointFault::Position(KinematicsError::Unreachable { .. }) => {
            "keep the program inside the machine's workspace"
        }
        JointFault::Position(_) => "place the work elsewhere, or turn the tool less",
        JointFault::Limit(violation) => match violation.quantity {
            Quantity::Lowest | Quantity::Highest => {
                "place the work elsewhere, or mend the joint's range in the configuration"
            }
            Quantity::Velocity | Quantity::Acceleration | Quantity::Jerk => {
                "give a lower feedrate, or lower limits of the axes in the configuration"
            }
        },
    };
    let text = line_of(path, line);
    let whole = 0..text.trim_end().len();
    let at: Vec<String> = axes
        .iter()
        .map(|axis| format!("{axis}{:.3}", place[axis.index()]))
        .collect();
    Diagnostic {
        line,
        ..Diagnostic::in_text(
            &text,
            whole,
            DiagnosticCode::Joint,
            format!("{fault}, at {}", at.join(" ")),
            help.to_owned(),
        )
    }
}

/// A line of a file for display; empty if it cannot be read.
fn line_of(path: &Path, line: u32) -> String {
    let nth = usize::try_from(line.saturating_sub(1)).unwrap_or(usize::MAX);
    let text = File::open(path).ok().and_then(|file| {
        let mut lines = BufReader::new(file).split(b'\n');
        lines.nth(nth)?.ok()
    });
    text.map(|bytes| String::from_utf8_lossy(&bytes).into_owned())
        .unwrap_or_default()
}
