//! A program planned in all ways.

use crate::arguments::Setup;
use crate::plan::{self, Plan, Together, Way};
use crate::walls;
use serde_json::{Value, json};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Periods by which a plan may be longer than another without being slower: both end on the grid.
const GRID_PERIODS: f64 = 1.5;

/// The plans of a program: optimal, fast, with stops.
#[derive(Debug)]
pub(crate) struct Trial {
    plans: [Plan; 3],
    period_t: f64,
}

impl Trial {
    /// Plans the program; what is wrong with it or with the planner is told.
    pub(crate) fn run(text: &[u8], setup: &Setup) -> Result<Self, String> {
        let items = plan::items(text)?;
        let plan = |way: Way| {
            let mut settings = setup.machine.settings(way.effort(), setup);
            if setup.has_walls {
                settings.limits.travel = walls::walls(&items);
            }
            let items = plan::with_mode(&items, way, setup.given_mm);
            // A program that makes the planner panic is to be told like any other.
            let planned = catch_unwind(AssertUnwindSafe(|| plan::plan(&items, settings)));
            match planned {
                Ok(Ok(plan)) => Ok(plan),
                Ok(Err(error)) => Err(format!("{}: {error}", way.name())),
                Err(_) => Err(format!("{}: the planner panicked", way.name())),
            }
        };
        Ok(Self {
            plans: [plan(Way::Optimal)?, plan(Way::Fast)?, plan(Way::Stop)?],
            period_t: setup.period_t,
        })
    }

    pub(crate) const fn plan(&self, way: Way) -> &Plan {
        &self.plans[way as usize]
    }

    pub(crate) fn time_t(&self, way: Way) -> f64 {
        self.plan(way).time_t()
    }

    /// The time of one way over that of another.
    pub(crate) fn ratio(&self, way: Way, over: Way) -> f64 {
        self.time_t(way) / self.time_t(over)
    }

    /// True if one way takes longer than another, by more than the grid explains.
    pub(crate) fn is_slower(&self, way: Way, than: Way) -> bool {
        self.time_t(way) > self.time_t(than) + GRID_PERIODS * self.period_t
    }

    /// The figures of smoothness where the feed binds.
    pub(crate) fn at_feed(&self, way: Way) -> Option<Together> {
        Together::of(&self.plan(way).smoothness.at_feed)
    }

    /// The figures of smoothness of all of it.
    pub(crate) fn whole(&self, way: Way) -> Option<Together> {
        Together::of(&self.plan(way).smoothness.whole)
    }

    /// True if no plan that is handed out breaks a limit, a tolerance or a rule of the figure.
    pub(crate) fn is_kept(&self) -> bool {
        let efforts = [Way::Optimal, Way::Fast].map(|way| self.plan(way));
        let is_kept = |plan: &&Plan| plan.figure.broken().is_empty();
        efforts.iter().all(is_kept) && Way::ALL.iter().all(|&way| self.plan(way).violations() == 0)
    }

    /// What is to be told of the program: violations, broken rules, places on the outer side, and rivals that are faster.
    pub(crate) fn problems(&self) -> Vec<String> {
        let mut problems = Vec::new();
        for way in Way::ALL {
            let plan = self.plan(way);
            if plan.violations() > 0 {
                let first = plan.report.violations.first();
                let first = first.map_or_else(|| "incomplete".to_owned(), ToString::to_string);
                let count = plan.violations();
                problems.push(format!("{}: {count} violations, {first}", way.name()));
            }
            for broken in plan.figure.broken() {
                problems.push(format!("{}: {broken}", way.name()));
            }
            if let Some(outer) = plan.figure.first_outer() {
                let count = plan.figure.outer_count();
                problems.push(format!("{}: outer side {count} times, {outer}", way.name()));
            }
        }
        for rival in [Way::Fast, Way::Stop] {
            if self.is_slower(Way::Optimal, rival) {
                problems.push(format!(
                    "optimal {:.3} s, {} {:.3} s ({:.4})",
                    self.time_t(Way::Optimal),
                    rival.name(),
                    self.time_t(rival),
                    self.ratio(Way::Optimal, rival)
                ));
            }
        }
        problems
    }

    /// Everything, for a program that reads it.
    pub(crate) fn json(&self) -> Value {
        let ways = Way::ALL.map(|way| {
            let plan = self.plan(way);
            let smoothness = |together: Option<Together>| {
                together.map(|figures| {
                    json!({
                        "rms_jerk": figures.jerk_j,
                        "acceleration_above_30_hz": figures.ringing_a,
                        "reversals": figures.reversals,
                        "mean_deviation_mm": figures.deviation_mm,
                    })
                })
            };
            let figures = json!({
                "time_s": plan.time_t(),
                "violations": plan.violations(),
                "tremors": plan.tremors(),
                "first_tremors": plan.report.tremors.iter().take(3).map(ToString::to_string).collect::<Vec<_>>(),
                "figure": plan.figure.json(),
                "max_deviation_mm": plan.report.max_deviation_mm,
                "smoothness": smoothness(self.whole(way)),
                "smoothness_at_feed": smoothness(self.at_feed(way)),
                "cpu_s": plan.spent.as_secs_f64(),
                "cpu_share": plan.load_r(),
                "longest_call_s": plan.longest.as_secs_f64(),
            });
            (way.name().to_owned(), figures)
        });
        Value::Object(ways.into_iter().collect())
    }
}
