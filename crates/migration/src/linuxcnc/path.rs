//! The conversion of what concerns the path: the tolerance and the period.

use super::Machine;
use crate::draft::float;
use crate::inputs::{At, Fate};

/// The tolerances there are here, mm.
const TOLERANCES: core::ops::RangeInclusive<f64> = 1e-5..=10.0;

const NO_BOUND: &str = "G64 without P may leave the path by any amount there; here the deviation has \
                        a bound, mm: 0.02 is usual";

impl Machine {
    /// `[path]` and the period.
    pub(crate) fn path(&mut self) {
        let by_code = self.startup();
        self.tolerance(by_code);
        if let Some(at) = self.inputs.find("TRAJ", "MAX_LINEAR_JERK") {
            let note = "a limit along the path there; here max_jerk of each axis, which is better, or \
                        path.max_jerk, which selects effort \"fast\"";
            self.inputs.decide(at, Fate::Changed, note);
        }
        if let Some(at) = self.inputs.find("EMCMOT", "SERVO_PERIOD") {
            let note = "the rate of its control loop; here setpoints come every \
                        interpolator.period_us, which is to be chosen with the drives: 4000 by default";
            self.draft.remark(
                "interpolator",
                &format!("period_us = 4000 is the default; {note}"),
            );
            self.inputs.decide(at, Fate::Changed, note);
        }
    }

    /// The tolerance: that of G64 without P, and that which programs begin with.
    fn tolerance(&mut self, by_code: Option<(At, f64)>) {
        let found = self.inputs.number("RS274NGC", "G64_DEFAULT_TOLERANCE");
        let default = found.as_ref().map(|(at, _)| *at);
        let usable = found.and_then(|(at, value)| {
            let value = value.ok()? * self.units.linear_mm?;
            usable_tolerance(value).then_some((at, value))
        });
        let note = match (usable, by_code) {
            (Some(_), Some(_)) => {
                "path.tolerance: the stricter one of G64_DEFAULT_TOLERANCE and G64 P"
            }
            (Some(_), None) => {
                "path.tolerance: how far the motion may leave the path, all included"
            }
            (None, Some(_)) => "G64 without P has path.tolerance here, which is that of G64 P",
            (None, None) => NO_BOUND,
        };
        let strictest = [usable, by_code].into_iter().flatten();
        match strictest.min_by(|one, other| one.1.total_cmp(&other.1)) {
            Some((at, value)) => {
                let from = self.inputs.name(at);
                self.draft.known("path", "tolerance", float(value), &from);
            }
            None if default.is_some() => self.draft.choose("path", "tolerance", NO_BOUND),
            None => self
                .draft
                .remark("path", "tolerance = 0.02 is the default, mm"),
        }
        if let Some(at) = default {
            let fate = if usable.is_some() && by_code.is_none() {
                Fate::Converted
            } else {
                Fate::Changed
            };
            self.inputs.decide(at, fate, note);
        }
    }
}

/// Whether a tolerance can be one here.
pub(super) fn usable_tolerance(mm: f64) -> bool {
    TOLERANCES.contains(&mm)
}
