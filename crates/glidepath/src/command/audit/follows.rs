//! The judge of a motion by its program: whether it follows it, and whether it is the motion that
//! is planned for it today.

use super::finding::{Finding, Findings};
use super::led::Led;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::plan_steps::PlanSteps;
use glidepath_audit::shape::{ShapeAudit, ShapeReport};
use glidepath_audit::{Audit, Passed, Sample, ViolationKind};
use glidepath_geometry::AxisVector;
use glidepath_link::{MachineState, Setpoint};
use glidepath_planner::{FileSource, ItemSource as _, Step, Supply};
use glidepath_program::ItemKind;
use std::path::Path;

/// How far the auditor is told the program ahead of the motion, mm of path.
const AHEAD_MM: f64 = 100.0;
/// A setpoint at a frame is the frame: rounding of what was added up, mm or degrees.
const SAME_MM: f64 = 1e-9;

/// The judge of a motion by its program.
pub(super) struct Follows {
    audit: Audit,
    shape: ShapeAudit,
    program: FileSource,
    told_s: f64,
    /// The positions of the plan, by sequence; none where they need not be those.
    plan: Option<Vec<AxisVector>>,
    passed: Passed,
    /// Program time of the setpoint before: a frame, and the part of a period past it.
    time: (u64, f64),
    has_moved: bool,
    is_over: bool,
    led: Led,
    findings: Findings,
}

impl Follows {
    /// The judge of a motion that begins at a place, at overrides up to a factor.
    pub(super) fn new(
        path: &Path,
        config: &MachineConfig,
        stands: AxisVector,
        overrides: (f64, f64),
    ) -> Result<Self, Failure> {
        let (least, most) = overrides;
        let source = || {
            let options = config.program_options(stands);
            FileSource::unchecked(path, options, &config.settings())
        };
        let settings = config.judged_at(&stands);
        // Another override plans other frames.
        #[allow(clippy::float_cmp, reason = "an override of 100 % is exactly 1")]
        let is_plain = least == 1.0 && most == 1.0;
        let plan = if is_plain {
            let mut steps = PlanSteps::on_all_cores(source, config, stands)?;
            let mut positions = Vec::new();
            loop {
                match steps.step()? {
                    Step::Frame => positions.push(steps.frame().position),
                    Step::Item | Step::Pending => {}
                    Step::End => break,
                }
            }
            Some(positions)
        } else {
            None
        };
        Ok(Self {
            audit: config.audit_at(&stands).with_override(most.max(1.0)),
            shape: ShapeAudit::new(&settings),
            // After a pass over all of it, which identifies it.
            program: FileSource::open(path, config.program_options(stands), &config.settings())?,
            told_s: 0.0,
            plan,
            passed: Passed::default(),
            time: (0, 0.0),
            has_moved: false,
            is_over: false,
            led: Led::default(),
            findings: Findings::default(),
        })
    }

    /// Identifies the program.
    pub(super) fn fingerprint(&self) -> u64 {
        self.program.fingerprint()
    }

    pub(super) const fn has_plan(&self) -> bool {
        self.plan.is_some()
    }

    /// The next setpoint of the program's epoch.
    pub(super) fn take(&mut self, setpoint: &Setpoint) {
        // Once the drives lead, the motion is over.
        self.is_over |= self.led.see(setpoint);
        if self.is_over {
            return;
        }
        let is_idle = setpoint.state() == Ok(MachineState::Idle);
        self.has_moved |= !is_idle;
        while self.told_s < setpoint.path_s + AHEAD_MM && self.tell() {}
        let sample = Sample {
            tick: setpoint.number,
            line: setpoint.line,
            position: setpoint.position.into(),
            reported: None,
            is_between_frames: setpoint.is_between_frames(),
        };
        for told in setpoint.events() {
            if let Ok(event) = told.event() {
                self.audit.event(event, told.offset_ns);
            }
        }
        let time = self.go_on(setpoint);
        let behind_mm = (!is_idle).then(|| self.passed.off_mm(time, &sample.position));
        if let Some(off_mm) = behind_mm.flatten() {
            // Back along the path, or onward again.
            self.audit.sample_away(&sample);
            if off_mm > self.audit.tolerance_mm() {
                self.deviates(setpoint, off_mm, "where the motion went before");
            }
        } else {
            self.audit.sample(&sample);
            self.shape.next(&sample.position, sample.line);
        }
        // What is done behind the program, by hand, is none of its business.
        self.is_over = is_idle && self.has_moved;
        let at = usize::try_from(setpoint.sequence).ok();
        let planned = self
            .plan
            .as_ref()
            .filter(|_| time.1 == 0.0 && !is_idle)
            .and_then(|plan| plan.get(at?));
        if let Some(planned) = planned {
            let off = AxisVector::from(setpoint.position) - planned;
            let off_mm = off.amax();
            if off_mm > SAME_MM {
                self.deviates(setpoint, off_mm, "the plan of the program");
            }
        }
    }

    /// Program time of a setpoint. In a fault the epoch is over: the machine stands where it ended, which
    /// in general is between two frames, and setpoints tell the frame alone.
    fn go_on(&mut self, setpoint: &Setpoint) -> (u64, f64) {
        let stands = setpoint.state() == Ok(MachineState::Faulted);
        if !stands || setpoint.sequence != self.time.0 || setpoint.fraction > 0.0 {
            self.time = (setpoint.sequence, setpoint.fraction);
        }
        self.time
    }

    fn deviates(&mut self, setpoint: &Setpoint, off_mm: f64, from: &str) {
        self.findings.push(Finding {
            kind: "deviation",
            tick: setpoint.tick,
            line: setpoint.line,
            text: format!("{off_mm:.6} mm off {from}"),
        });
    }

    fn tell(&mut self) -> bool {
        let Supply::Item(item) = self.program.next_item() else {
            return false;
        };
        if let ItemKind::Move { segment, .. } = &item.kind {
            self.told_s += segment.length();
        }
        self.audit.program(&item);
        self.shape.program(&item);
        true
    }

    /// The verdict; `is_whole` if the motion went on to the end of the program. Gives the largest
    /// deviation, mm, too, and what there is to tell of the shape.
    pub(super) fn finish(mut self, is_whole: bool) -> (Findings, f64, ShapeReport) {
        while self.tell() {}
        let report = if is_whole {
            self.audit.finish()
        } else {
            self.audit.finish_early()
        };
        let mut findings = Findings::default();
        // First, since only the first violations are listed, and others may come before it.
        if report.max_deviation_mm > report.tolerance_mm * (1.0 + 1e-6) {
            findings.push(Finding {
                kind: "deviation",
                tick: report.max_deviation_tick,
                line: report.max_deviation_line,
                text: format!(
                    "at most {:.6} mm off the programmed path, where {:.6} are allowed",
                    report.max_deviation_mm, report.tolerance_mm
                ),
            });
        }
        findings.join(self.findings);
        let mut others = 0;
        for violation in &report.violations {
            let kind = match violation.kind {
                // Told by whoever looks at the axes.
                ViolationKind::Velocity { .. }
                | ViolationKind::Acceleration { .. }
                | ViolationKind::Jerk { .. }
                | ViolationKind::Travel { .. }
                | ViolationKind::Inconsistent { .. }
                | ViolationKind::NotFinite
                | ViolationKind::Gap { .. } => {
                    others += 1;
                    continue;
                }
                ViolationKind::Feed { .. }
                | ViolationKind::AlongPath { .. }
                | ViolationKind::AcrossPath { .. }
                | ViolationKind::PathJerk { .. } => "limit",
                ViolationKind::Incomplete | ViolationKind::Dwell { .. } => "program",
                _ => "deviation",
            };
            let text = violation.to_string();
            let (_, text) = text.split_once(": ").unwrap_or(("", &text));
            findings.push(Finding {
                kind,
                tick: violation.tick,
                line: violation.line,
                text: text.to_owned(),
            });
        }
        let listed = report.violations.len() as u64;
        // Those that are not listed are told as if they were of the program.
        findings.count +=
            report.violation_count.saturating_sub(listed) * u64::from(others < listed);
        (findings, report.max_deviation_mm, self.shape.finish())
    }
}
