//! The verdict of the auditor on what subscribers got.

use glidepath_audit::{
    Audit, AuditReport, AuditSettings, Passed, Sample, Violation, ViolationKind,
};
use glidepath_geometry::AxisVector;
use glidepath_link::Setpoint;
use glidepath_program::Item;
use glidepath_tests::{plan, settings};

use super::bench::Bench;
use super::script::{HOME, Programs};

/// What an audit, or several, found.
#[derive(Debug, Default)]
pub(super) struct Verdict {
    /// What must not be.
    pub(super) violations: Vec<String>,
    /// Worst velocity, acceleration, jerk over limit.
    pub(super) ratios: [f64; 3],
    pub(super) deviation_mm: f64,
    /// From the fault to the first rest after it.
    pub(super) rest_t: Option<f64>,
    /// Setpoints did not arrive here.
    pub(super) has_gap: bool,
    last_tick: u64,
    found: Vec<Violation>,
}

impl Verdict {
    fn new(report: &AuditReport, last_tick: u64) -> Self {
        Self {
            ratios: [
                report.max_velocity_ratio.ratio,
                report.max_acceleration_ratio.ratio,
                report.max_jerk_ratio.ratio,
            ],
            deviation_mm: report.max_deviation_mm,
            last_tick,
            has_gap: has_gap(report),
            found: report.violations.clone(),
            ..Self::default()
        }
    }

    /// Whether the motion had to reach the end of the program, or must not have.
    pub(super) fn that_must_be_complete(mut self, complete: bool) -> Self {
        let found = core::mem::take(&mut self.found);
        let is_pardoned =
            |violation: &Violation| !complete && violation.kind == ViolationKind::Incomplete;
        let news = found.iter().filter(|violation| !is_pardoned(violation));
        self.violations.extend(news.map(ToString::to_string));
        self
    }

    /// The setpoints just end, in the middle of the motion, and are judged up to there. How a servo
    /// then stops by itself is a matter of its own tests; here it must say that it did.
    pub(super) fn cut_off(mut self) -> Self {
        self.ratios = [0.0; 3];
        let last = self.last_tick;
        self.found.retain(|violation| violation.tick <= last);
        self.that_must_be_complete(false)
    }

    /// Both.
    pub(super) fn and(mut self, other: Self) -> Self {
        self.violations.extend(other.violations);
        for (worst, ratio) in self.ratios.iter_mut().zip(other.ratios) {
            *worst = worst.max(ratio);
        }
        self.deviation_mm = self.deviation_mm.max(other.deviation_mm);
        self.has_gap |= other.has_gap;
        self
    }
}

fn has_gap(report: &AuditReport) -> bool {
    let is_gap = |violation: &Violation| matches!(violation.kind, ViolationKind::Gap { .. });
    report.violations.iter().any(is_gap)
}

/// Judges the epoch of a case. `moment` is the number of the setpoint when it went wrong.
pub(super) fn judge(
    bench: &Bench<'_>,
    programs: &Programs,
    epoch: u64,
    moment: u64,
    largest_override: f64,
) -> Verdict {
    let setpoints = of_epoch(bench, epoch);
    let mut verdict = audit(&setpoints, &programs.items, largest_override);
    verdict.rest_t = time_to_rest(&setpoints, moment);
    verdict
}

/// Judges the way home.
pub(super) fn judge_home(bench: &Bench<'_>, epoch: u64) -> Verdict {
    let setpoints = of_epoch(bench, epoch);
    // Where the machine stood before says where the way had to begin.
    let before = bench.look(|heard| {
        let before = heard
            .setpoints
            .iter()
            .rev()
            .find(|setpoint| setpoint.epoch < epoch);
        before.map(|setpoint| AxisVector::from(setpoint.position))
    });
    let (_, items) = plan(HOME, before.unwrap_or_else(AxisVector::zeros));
    audit(&setpoints, &items, 1.0)
}

fn of_epoch(bench: &Bench<'_>, epoch: u64) -> Vec<Setpoint> {
    let is_of_epoch = |setpoint: &&Setpoint| setpoint.epoch == epoch;
    bench.look(|heard| {
        heard
            .setpoints
            .iter()
            .filter(is_of_epoch)
            .copied()
            .collect()
    })
}

/// Numbers of setpoints stand for ticks: missed ticks are no gaps, the path goes on where it was.
fn audit(setpoints: &[Setpoint], items: &[Item], largest_override: f64) -> Verdict {
    let settings = settings();
    let mut audit = Audit::new(&AuditSettings::from(&settings)).with_override(largest_override);
    for item in items {
        audit.program(item);
    }
    let mut passed = Passed::default();
    for setpoint in setpoints {
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
    let last_tick = setpoints.last().map_or(0, |setpoint| setpoint.number);
    Verdict::new(&audit.finish(), last_tick)
}

/// From the moment to the first three setpoints at the same place, s.
fn time_to_rest(setpoints: &[Setpoint], moment: u64) -> Option<f64> {
    let after: Vec<_> = setpoints
        .iter()
        .filter(|setpoint| setpoint.number >= moment)
        .collect();
    let place = |setpoint: &Setpoint| setpoint.position.map(f64::to_bits);
    let is_rest = |three: &[&Setpoint]| three.iter().all(|one| place(one) == place(three[0]));
    let periods = u32::try_from(after.windows(3).position(is_rest)?).ok()?;
    Some(f64::from(periods) * settings().period_t)
}
