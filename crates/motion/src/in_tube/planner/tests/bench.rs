//! Cycle times against the optimum, and what planning costs: a long check, by hand.
//!
//! ```text
//! GLIDEPATH_BENCH=tests/data/bench cargo test --release -p glidepath-motion --lib in_tube::planner::tests::bench -- --nocapture
//! ```

use super::*;
use crate::in_tube::fallback::StopLeg;
use crate::in_tube::path::ReferencePath;

/// What is skipped unless somebody asks for it.
const LONG_CHECK: &str = "long checks of planning";

/// Six axes with limits of their own, which take all the work that is allowed, and would take more.
#[test]
fn no_period_takes_more_work_than_is_allowed() {
    let mut cost = Cost::default();
    planned(&random_case(154, false), &mut cost);
    assert!(cost.worst_work <= PLAN_WORK, "{}", cost.worst_work);
    assert!(
        cost.worst_work > PLAN_WORK - PLAN_WORK / 50,
        "{}",
        cost.worst_work
    );
}

/// Programs, and the time to be held against: the optimum inside the tolerance ("tube"), or along
/// the exact curve for the chorded ones, s.
const PROGRAMS: [(&str, bool, f64); 14] = [
    ("seed5_mill", false, 0.1805),
    ("square20_mill", false, 1.0745),
    ("star_mill", false, 2.1818),
    ("zigzag_mill", false, 2.8906),
    ("circle_g1_0.1_mill", false, 0.7325),
    ("circle_g1_0.01_mill", false, 0.7325),
    ("butterfly_g1_mill", false, 3.7625),
    ("seed5_seed", true, 0.0565),
    ("square20_seed", true, 0.9896),
    ("star_seed", true, 2.3211),
    ("zigzag_seed", true, 1.2125),
    ("circle_g1_0.1_seed", true, 0.7726),
    ("circle_g1_0.01_seed", true, 0.7726),
    ("butterfly_g1_seed", true, 4.2886),
];

/// Processor time of this thread, s: other load on the host does not count.
fn processor_t() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    #[expect(clippy::cast_precision_loss, reason = "microseconds matter")]
    let parts = [time.tv_sec, time.tv_nsec].map(|part| part as f64);
    parts[0] + 1e-9 * parts[1]
}

/// What planning a path has cost.
#[derive(Debug, Default, Clone, Copy)]
struct Cost {
    /// Processor time of all periods, and of the dearest one, s.
    spent_t: f64,
    worst_t: f64,
    /// Multiplications of the solvers for the dearest one.
    worst_work: usize,
}

impl Cost {
    /// That of another path.
    fn add(&mut self, path: &Self) {
        self.spent_t += path.spent_t;
        self.worst_t = self.worst_t.max(path.worst_t);
        self.worst_work = self.worst_work.max(path.worst_work);
    }
}

/// All periods of a path.
fn planned(case: &Case, cost: &mut Cost) -> Vec<Period> {
    let mut planner = case.planner();
    for reference in case.references() {
        planner.push(reference);
    }
    planner.finish();
    let mut periods = Vec::new();
    loop {
        let (start_t, start_work) = (processor_t(), planner.state.optimisers.work());
        let Some(period) = planner.next_period() else {
            return periods;
        };
        let taken_t = processor_t() - start_t;
        cost.spent_t += taken_t;
        cost.worst_t = cost.worst_t.max(taken_t);
        let work = planner.state.optimisers.work() - start_work;
        cost.worst_work = cost.worst_work.max(work);
        periods.push(period);
    }
}

fn read(path: &std::path::Path) -> Vec<AxisVector> {
    let text = std::fs::read_to_string(path).expect("a bench program");
    let mut points = vec![AxisVector::zeros()];
    for line in text.lines().filter(|line| line.starts_with("G1")) {
        let mut point = points[points.len() - 1];
        for word in line.split_whitespace() {
            let Some(axis) = "XYZ".find(&word[..1]) else {
                continue;
            };
            point[axis] = word[1..].parse().expect("a number");
        }
        points.push(point);
    }
    points
}

/// Greedy chords: every vertex left out within `allowed_mm` of its chord, in order.
fn merge(points: &[AxisVector], allowed_mm: f64) -> Vec<AxisVector> {
    let mut merged = vec![points[0]];
    let mut a = 0;
    while a + 1 < points.len() {
        let mut b = a + 1;
        while b + 1 < points.len() && b - a < 400 {
            let chord = points[b + 1] - points[a];
            let mut last = 0.0;
            let fits = points[a + 1..=b].iter().all(|point| {
                let offset = point - points[a];
                let x = offset.dot(&chord) / chord.norm();
                let distance = (offset - chord * (x / chord.norm())).norm();
                let is_in_order = x >= last && x <= chord.norm();
                last = x;
                distance <= allowed_mm && is_in_order
            });
            if !fits {
                break;
            }
            b += 1;
        }
        merged.push(points[b]);
        a = b;
    }
    merged
}

#[test]
fn bench() {
    let Some(folder) = std::env::var_os("GLIDEPATH_BENCH") else {
        glidepath_testing::skip(LONG_CHECK, "GLIDEPATH_BENCH is not set");
        return;
    };
    let only = std::env::var("GLIDEPATH_BENCH_ONLY").unwrap_or_default();
    let folder = std::path::Path::new(&folder);
    println!(
        "program                 T      of optimum  dev/tol   jerk    CPU %  worst ms  M mult.  clean"
    );
    for (name, is_light, optimum_t) in PROGRAMS {
        if !name.contains(&only) {
            continue;
        }
        let points = read(&folder.join(format!("{name}.ngc")));
        let mut case = Case::mill(points);
        if is_light {
            case.limits = Limits::uniform(100.0, 10_000.0, 1e6);
            case.tolerance_mm = 0.05;
            case.feed_v = 5000.0 / 60.0;
        }
        let mut merged = Case {
            points: merge(&case.points, 0.1 * case.tolerance_mm),
            ..case.clone()
        };
        if merged.points.len() < case.points.len() {
            merged.tolerance_mm *= 0.9;
        }
        let mut cost = Cost::default();
        let periods = planned(&merged, &mut cost);
        let report = case.audit(&periods);
        let time = periods.len() as f64 * case.period_t;
        println!(
            "{name:20} {time:7.3} {:9.3} {:12.3} {:10.6} {:6.1} {:8.1} {:8.1}   {}",
            time / optimum_t,
            report.max_deviation_mm / case.tolerance_mm,
            report.max_jerk_ratio.ratio,
            100.0 * cost.spent_t / time,
            1e3 * cost.worst_t,
            millions(cost.worst_work),
            report.is_clean() && report.is_complete,
        );
        if !report.is_clean() {
            println!(
                "  {:?}",
                &report.violations[..report.violations.len().min(3)]
            );
        }
    }
}

fn millions(work: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "of a window")]
    let work = work as f64;
    1e-6 * work
}

/// The time of stopping at every vertex, s.
pub(crate) fn exact_stop_t(case: &Case) -> f64 {
    let mut reference_path = ReferencePath::new(case.points[0]);
    for reference in case.references() {
        reference_path.push(reference);
    }
    reference_path.finish();
    (0..reference_path.end())
        .filter_map(|index| {
            let piece = reference_path.get(index)?;
            StopLeg::new((&case.limits, None), piece.start, index, piece)
        })
        .map(|leg| leg.duration_t())
        .sum()
}

/// Seeds from "1000" (the first so many) or "270..280" (from, to).
fn seeds(text: &str) -> Option<core::ops::Range<u64>> {
    let (first, end) = text.split_once("..").unwrap_or(("0", text));
    Some(first.parse().ok()?..end.parse().ok()?)
}

/// Many random paths, by hand: `GLIDEPATH_RANDOM_PATHS=1000`, or some:
/// `GLIDEPATH_RANDOM_PATHS=270..280`, both profiles or one: `GLIDEPATH_RANDOM_PROFILE=mill`.
/// `GLIDEPATH_RANDOM_EACH` prints each.
#[test]
fn random_paths() {
    let chosen = std::env::var("GLIDEPATH_RANDOM_PATHS").ok();
    let Some(seeds) = chosen.as_deref().and_then(seeds) else {
        return glidepath_testing::skip(LONG_CHECK, "GLIDEPATH_RANDOM_PATHS is not set");
    };
    let profile = std::env::var("GLIDEPATH_RANDOM_PROFILE").unwrap_or_default();
    let prints_each = std::env::var_os("GLIDEPATH_RANDOM_EACH").is_some();
    for is_light in [false, true] {
        let name = if is_light { "seed" } else { "mill" };
        if !name.contains(&profile) {
            continue;
        }
        let (mut cost, mut moved, mut worst_ratio) = (Cost::default(), 0.0, 0.0_f64);
        let (mut ratios, mut dearest) = (Vec::new(), 0);
        for seed in seeds.clone() {
            let case = random_case(seed, is_light);
            let mut of_path = Cost::default();
            let periods = planned(&case, &mut of_path);
            if of_path.worst_work > cost.worst_work {
                dearest = seed;
            }
            cost.add(&of_path);
            let report = case.audit(&periods);
            let time = periods.len() as f64 * case.period_t;
            let stop_t = exact_stop_t(&case);
            let ratio = (time - case.period_t).max(0.0) / stop_t;
            moved += time;
            ratios.push(time / stop_t);
            if prints_each {
                println!(
                    "{name} {seed}: {} periods, {ratio:.4} of exact stop, {:.1} ms, {:.1} million",
                    periods.len(),
                    1e3 * of_path.worst_t,
                    millions(of_path.worst_work),
                );
            }
            worst_ratio = worst_ratio.max(ratio);
            if !report.is_clean() || !report.is_complete || ratio > 1.0 {
                println!(
                    "{name} {seed}: {time:.3} s, stops {stop_t:.3} s, {:?}",
                    &report.violations[..report.violations.len().min(2)]
                );
            }
        }
        ratios.sort_by(f64::total_cmp);
        println!(
            "{name}: median {:.3}, worst {worst_ratio:.3} of exact stop; CPU {:.1} %, worst period {:.1} ms, {:.1} million multiplications (seed {dearest})",
            ratios[ratios.len() / 2],
            100.0 * cost.spent_t / moved,
            1e3 * cost.worst_t,
            millions(cost.worst_work),
        );
    }
}
