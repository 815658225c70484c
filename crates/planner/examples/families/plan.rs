//! A program planned in one way, judged and measured.

use crate::figure::Figure;
use std::time::Duration;

use glidepath_audit::diagnosis::Diagnosis;
use glidepath_audit::smoothness::{Figures, SmoothnessReport};
use glidepath_audit::{Audit, AuditReport, AuditSettings};
use glidepath_gcode::{Connections, Options, Program};
use glidepath_geometry::AxisVector;
use glidepath_motion::{PlanError, Planner};
use glidepath_program::{Effort, Item, ItemKind, PathMode, Settings};

/// Ways in which a program is planned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Way {
    Optimal,
    Fast,
    /// At rest at every corner.
    Stop,
}

impl Way {
    pub(crate) const ALL: [Self; 3] = [Self::Optimal, Self::Fast, Self::Stop];

    pub(crate) const fn effort(self) -> Effort {
        match self {
            Self::Optimal => Effort::Optimal,
            Self::Fast | Self::Stop => Effort::Fast,
        }
    }

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Optimal => "optimal",
            Self::Fast => "fast",
            Self::Stop => "stop",
        }
    }
}

/// What became of a program.
#[derive(Debug, Clone)]
pub(crate) struct Plan {
    pub(crate) report: AuditReport,
    pub(crate) smoothness: SmoothnessReport,
    pub(crate) figure: Figure,
    /// Processor time of planning alone.
    pub(crate) spent: Duration,
    /// Processor time of the call of the planner that took longest: of one item or one period.
    pub(crate) longest: Duration,
}

/// The items of a program.
pub(crate) fn items(text: &[u8]) -> Result<Vec<Item>, String> {
    let options = Options {
        connections: Connections::Simulated,
        ..Options::default()
    };
    let items = Program::new(text, options);
    items
        .map(|item| {
            item.map_err(|diagnostic| format!("line {}: {}", diagnostic.line, diagnostic.message))
        })
        .collect()
}

/// The items as they are planned: with the tolerance given, where one is, in place of their own, and
/// with a stop behind every move if that is the way.
pub(crate) fn with_mode(items: &[Item], way: Way, tolerance_mm: Option<f64>) -> Vec<Item> {
    let mut items = items.to_vec();
    for item in &mut items {
        if let ItemKind::Move { mode, .. } = &mut item.kind {
            if way == Way::Stop {
                *mode = PathMode::ExactStop;
            } else if let PathMode::Continuous { tolerance_mm: own } = mode
                && tolerance_mm.is_some()
            {
                *own = tolerance_mm;
            }
        }
    }
    items
}

/// Processor time of the thread so far.
fn processor_time() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::new(
        time.tv_sec.unsigned_abs(),
        u32::try_from(time.tv_nsec).unwrap_or(0),
    )
}

/// The planner, its judges, and the time it took.
struct Bench {
    planner: Planner,
    audit: Audit,
    diagnosis: Diagnosis,
    spent: Duration,
    longest: Duration,
}

impl Bench {
    fn timed<T>(&mut self, call: impl FnOnce(&mut Planner) -> T) -> T {
        let start = processor_time();
        let result = call(&mut self.planner);
        let took = processor_time().saturating_sub(start);
        self.spent += took;
        self.longest = self.longest.max(took);
        result
    }

    fn drain(&mut self) -> Result<(), PlanError> {
        while self.timed(Planner::make_frame)? {
            self.audit.frame(self.planner.frame());
            self.diagnosis.frame(self.planner.frame());
        }
        Ok(())
    }
}

/// Plans items and judges the motion.
pub(crate) fn plan(items: &[Item], settings: Settings) -> Result<Plan, PlanError> {
    let judged_by = AuditSettings::from(&settings);
    let mut bench = Bench {
        planner: Planner::new(settings, AxisVector::zeros()),
        audit: Audit::new(&judged_by),
        diagnosis: Diagnosis::new(&judged_by),
        spent: Duration::ZERO,
        longest: Duration::ZERO,
    };
    for item in items {
        bench.audit.program(item);
        bench.diagnosis.program(item);
        bench.timed(|planner| planner.push(item))?;
        bench.drain()?;
    }
    bench.timed(Planner::finish);
    bench.drain()?;
    let (report, told) = (bench.audit.finish(), bench.diagnosis.finish());
    Ok(Plan {
        figure: Figure::new(items, settings.period_t, &report, told.shape),
        report,
        smoothness: told.smoothness,
        spent: bench.spent,
        longest: bench.longest,
    })
}

impl Plan {
    /// The time of the motion, s.
    pub(crate) const fn time_t(&self) -> f64 {
        self.report.cycle_time_s
    }

    /// What the auditor holds against it; a motion that ends early counts as a violation.
    pub(crate) fn violations(&self) -> u64 {
        self.report
            .violation_count
            .max(u64::from(!self.report.is_complete))
    }

    /// Motion that the program does not ask for, inside all limits.
    pub(crate) const fn tremors(&self) -> u64 {
        self.report.tremor_count
    }

    /// Processor time of planning, as a share of the time of the motion.
    pub(crate) fn load_r(&self) -> f64 {
        self.spent.as_secs_f64() / self.time_t().max(1e-9)
    }
}

/// Figures of all axes together.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Together {
    /// Rms jerk, mm/s³.
    pub(crate) jerk_j: f64,
    /// Rms acceleration above 30 Hz, mm/s².
    pub(crate) ringing_a: f64,
    pub(crate) reversals: u64,
    /// Mean deviation, mm.
    pub(crate) deviation_mm: f64,
}

impl Together {
    /// None where there are no periods.
    pub(crate) fn of(figures: &Figures) -> Option<Self> {
        let norm = |of: &[f64]| of.iter().map(|value| value * value).sum::<f64>().sqrt();
        (figures.periods > 0).then(|| Self {
            jerk_j: norm(&figures.rms_jerk_j),
            ringing_a: norm(&figures.ringing_a),
            reversals: figures.reversals.iter().sum(),
            deviation_mm: figures.mean_deviation_mm,
        })
    }
}
