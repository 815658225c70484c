//! The table of results, cell by cell.

use std::fmt;

use super::bench::Checked;
use super::case::{Case, Fault, Situation};
use super::verdict::Verdict;

#[derive(Debug, Default)]
struct Row {
    /// Cases and bad ones, by situation.
    cells: [(u32, u32); Situation::ALL.len()],
    ratios: [f64; 3],
    deviation_mm: f64,
    rest_t: f64,
}

/// The results of the matrix.
#[derive(Debug)]
pub(super) struct Table {
    rows: Vec<(Fault, Row)>,
    problems: Vec<String>,
    repetitions: u32,
}

impl Default for Table {
    fn default() -> Self {
        Self {
            rows: Fault::ALL.map(|fault| (fault, Row::default())).into(),
            problems: Vec::new(),
            repetitions: 0,
        }
    }
}

impl Table {
    pub(super) fn add(&mut self, case: &Case, outcome: Checked<Verdict>) {
        let problems = match &outcome {
            Err(problem) => vec![problem.clone()],
            Ok(verdict) => verdict.violations.clone(),
        };
        let place = Situation::ALL
            .iter()
            .position(|situation| *situation == case.situation);
        let row = self.rows.iter_mut().find(|(fault, _)| *fault == case.fault);
        let (Some(place), Some((_, row))) = (place, row) else {
            return;
        };
        row.cells[place].0 += 1;
        row.cells[place].1 += u32::from(!problems.is_empty());
        if let Ok(verdict) = &outcome {
            for (worst, ratio) in row.ratios.iter_mut().zip(verdict.ratios) {
                *worst = worst.max(ratio);
            }
            row.deviation_mm = row.deviation_mm.max(verdict.deviation_mm);
            if !case.fault.may_complete() {
                row.rest_t = row.rest_t.max(verdict.rest_t.unwrap_or(0.0));
            }
        }
        let said = problems
            .iter()
            .map(|problem| format!("{case:?}: {problem}"));
        self.problems.extend(said);
    }

    /// A case is tried again.
    pub(super) const fn note_repetition(&mut self) {
        self.repetitions += 1;
    }

    /// What was found wrong, with the case.
    pub(super) fn problems(&self) -> &[String] {
        &self.problems
    }
}

/// For each fault: bad cases of all in each situation, the worst ratios to the limits, the largest
/// deviation, the longest time to rest of those faults that must stop the motion.
impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:20}", "bad/cases")?;
        for situation in Situation::ALL {
            write!(f, "{:>11}", format!("{situation:?}"))?;
        }
        writeln!(
            f,
            "{:>10}{:>10}{:>10}{:>10}{:>9}",
            "v", "a", "j", "dev mm", "rest s"
        )?;
        let (mut cases, mut bad) = (0, 0);
        for (fault, row) in &self.rows {
            write!(f, "{:20}", format!("{fault:?}"))?;
            for cell in row.cells {
                write!(f, "{:>11}", format!("{}/{}", cell.1, cell.0))?;
                cases += cell.0;
                bad += cell.1;
            }
            for ratio in row.ratios {
                write!(f, "{ratio:>10.7}")?;
            }
            writeln!(f, "{:>10.5}{:>9.3}", row.deviation_mm, row.rest_t)?;
        }
        let repetitions = self.repetitions;
        write!(f, "{cases} cases, {bad} bad; {repetitions} repeated")
    }
}
