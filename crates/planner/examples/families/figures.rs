//! What the auditor says of the figures of many motions, by the way in which they were planned.

use crate::figure::{Figure, Together};
use crate::plan::Way;
use crate::trial::Trial;

/// The figures of all ways.
#[derive(Debug, Default)]
pub(crate) struct FiguresByWay([Together; 3]);

impl FiguresByWay {
    pub(crate) fn add(&mut self, trial: &Trial) {
        for (together, way) in self.0.iter_mut().zip(Way::ALL) {
            together.add(&trial.plan(way).figure);
        }
    }

    /// Those of others, too.
    pub(crate) fn join(&mut self, others: &Self) {
        for (together, other) in self.0.iter_mut().zip(&others.0) {
            together.join(other);
        }
    }

    /// Whether a plan that is handed out breaks a rule; stops at every corner are for comparison alone.
    pub(crate) fn is_kept(&self) -> bool {
        let [optimal, fast, _] = &self.0;
        optimal.broken + fast.broken == 0
    }

    /// One line for every way, with a name before them.
    pub(crate) fn print(&self, name: &str) {
        for (together, way) in self.0.iter().zip(Way::ALL) {
            println!("{}", together.line(&format!("{name}{}", way.name())));
        }
    }
}

/// The head of [`columns`].
pub(crate) const HEAD: &str = "corners | rules broken optimal/fast/stop | outer side optimal/fast/stop | below depth, overshoot, outside, beside µm | reversals/programmed optimal | fast | event off µm";

/// The figure of a trial as columns of a table.
pub(crate) fn columns(corners: &str, trial: &Trial) -> String {
    let figures = Way::ALL.map(|way| &trial.plan(way).figure);
    let of = |figure: fn(&Figure) -> String| figures.map(figure).join("/");
    let reversals = |figure: &Figure| figure.reversals().map(|count| count.to_string()).join("/");
    let [optimal, fast, _] = figures;
    let distances = optimal.distances_um().map(|um| format!("{um:.2}"));
    format!(
        "{corners} | {} | {} | {} | {} | {} | {:.3}",
        of(|figure| figure.broken().len().to_string()),
        of(|figure| figure.outer_count().to_string()),
        distances.join(", "),
        reversals(optimal),
        reversals(fast),
        optimal.events().1
    )
}
