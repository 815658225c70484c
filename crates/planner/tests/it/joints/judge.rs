//! The verdict on a plan: by the auditor, and the joints by differences of where closed forms say that they are.

use super::closed_forms;
use super::machines::Machine;
use super::programs::axes;
use super::tool::tool_axis;
use glidepath_audit::{Audit, AuditReport, AuditSettings, JointBounds};
use glidepath_gcode::{AxisTravel, Machine as ProgramMachine, Options};
use glidepath_geometry::AxisVector;
use glidepath_planner::{Output, Pipeline, ProgramSource};
use glidepath_program::{Override, Settings};
use std::collections::BTreeMap;

/// A limit counts as kept up to this factor.
const SLACK: f64 = 1.0 + 1e-6;

/// How a plan is made: with which settings, and under which override from which frame on.
#[derive(Clone, Copy)]
pub(crate) struct Way {
    pub(crate) settings: Settings,
    pub(crate) change: Option<(u64, Override)>,
}

/// What became of a program.
pub(crate) struct Verdict {
    /// What is wrong with the motion.
    pub(crate) faults: Vec<String>,
    /// Why the program was not planned to its end, if it was not.
    pub(crate) refusal: Option<String>,
    /// How long it takes, s.
    pub(crate) cycle_t: f64,
    /// How many frames each line has.
    pub(crate) frames_of_line: BTreeMap<u32, u32>,
    /// Jerk and unrest that the program does not ask for.
    pub(crate) tremors: Vec<String>,
}

/// The joints of a motion, and the most that they use of velocity, acceleration and jerk, 1 for all of it.
struct Joints<'a> {
    machine: &'a Machine,
    period_t: f64,
    /// The last three places, newest first.
    past: [Vec<f64>; 3],
    most: [f64; 3],
    is_inside: bool,
}

impl<'a> Joints<'a> {
    fn new(machine: &'a Machine, period_t: f64, start: &AxisVector) -> Self {
        let at = closed_forms::joints(&machine.mechanism, start);
        Self {
            machine,
            period_t,
            past: [at.clone(), at.clone(), at],
            most: [0.0; 3],
            is_inside: true,
        }
    }

    fn take(&mut self, position: &AxisVector) -> Vec<f64> {
        let now = closed_forms::joints(&self.machine.mechanism, position);
        let [a, b, c] = &self.past;
        for (k, JointBounds { range, rates }) in self.machine.joints.iter().enumerate() {
            let (at, a, b, c) = (now[k], a[k], b[k], c[k]);
            // What is not a number is outside, too.
            self.is_inside &= at >= range[0] && at <= range[1];
            let differences = [at - a, at - 2.0 * a + b, at - 3.0 * a + 3.0 * b - c];
            let mut divisor = 1.0;
            // Each place is rounded, a few units in its last place.
            let mut rounding = 4.0 * f64::EPSILON * at.abs().max(1.0);
            for (order, difference) in differences.into_iter().enumerate() {
                divisor *= self.period_t;
                let used = (difference.abs() - rounding).max(0.0) / divisor / rates[order];
                self.most[order] = self.most[order].max(used);
                rounding *= 2.0;
            }
        }
        self.past.rotate_right(1);
        self.past[0].clone_from(&now);
        now
    }
}

pub(crate) fn options(machine: &Machine) -> Options {
    let reader = ProgramMachine::new(&axes(machine));
    let reader = machine
        .travel
        .iter()
        .fold(reader, |reader, (axis, min, max)| {
            reader.with_travel(
                *axis,
                AxisTravel {
                    min: *min,
                    max: *max,
                },
            )
        });
    Options {
        machine: reader,
        start: machine.home,
        ..Options::default()
    }
}

/// Plans a program and judges it.
pub(crate) fn judged(machine: &Machine, text: &str, way: &Way) -> Verdict {
    let settings = way.settings;
    let source = ProgramSource::new(text.as_bytes(), options(machine));
    let mut pipeline =
        Pipeline::new(source, settings, machine.home).with_joints(Some(machine.limited()));
    let most = way.change.map_or(1.0, |(_, wanted)| wanted.feed_r.max(1.0));
    let mut audit = Audit::new(&AuditSettings::from(&settings))
        .with_override(most)
        .with_tool(tool_axis(&machine.mechanism))
        .with_joints(machine.joints.clone());
    let mut joints = Joints::new(machine, settings.period_t, &machine.home);
    let (mut frames, mut last, mut refusal) = (0, machine.home, None);
    let mut frames_of_line = BTreeMap::new();
    loop {
        match pipeline.advance() {
            Ok(Output::Item(item)) => audit.program(&item),
            Ok(Output::Frame(frame)) => {
                last = frame.position;
                let at = joints.take(&last);
                audit.joints(frame.sequence, frame.line, &at);
                audit.frame(&frame);
                frames += 1;
                *frames_of_line.entry(frame.line).or_default() += 1;
                if let Some((_, wanted)) = way.change.filter(|(at, _)| *at == frames) {
                    pipeline.follow_override(wanted);
                }
            }
            Ok(Output::Pending) => {}
            Ok(Output::End) => break,
            Err(error) => refusal = Some(error.to_string()),
        }
    }
    // At rest from there on.
    for _ in 0..3 {
        joints.take(&last);
    }
    let report = if refusal.is_some() {
        audit.finish_early()
    } else {
        audit.finish()
    };
    Verdict {
        faults: faults(&joints, &report, refusal.is_none()),
        refusal,
        cycle_t: report.cycle_time_s,
        frames_of_line,
        tremors: report.tremors.iter().map(ToString::to_string).collect(),
    }
}

fn faults(joints: &Joints<'_>, report: &AuditReport, is_whole: bool) -> Vec<String> {
    let found = report.violations.iter().map(ToString::to_string);
    let mut faults: Vec<String> = found.collect();
    if joints.most.iter().any(|used| *used > SLACK) {
        faults.push(format!("joints use {:?} of their limits", joints.most));
    }
    if !joints.is_inside {
        faults.push("a joint is outside of its range".to_owned());
    }
    if is_whole && !report.is_complete {
        faults.push("the motion ends before the program".to_owned());
    }
    faults
}
