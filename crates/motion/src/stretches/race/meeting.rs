//! Places that both ways pass alike.

use super::state::{Race, TUBE};
use crate::stretches::joint::{Bounds, Joint, SEAM};
use std::ops::Range;

/// Times that are tried for a joint, s, the smoothest first.
const JOINTS_T: [f64; 4] = [0.16, 0.112, 0.08, 0.048];

/// A place that both ways pass alike.
#[derive(Debug)]
pub(super) struct Meeting {
    /// When the other way passes it, in its frames.
    pub(super) passed: f64,
    /// From the one way to the other.
    pub(super) joint: Joint,
}

impl Meeting {
    /// When a way passes it, in frames of the way.
    pub(super) fn passed_by(&self, way: usize) -> f64 {
        if way == TUBE {
            #[expect(clippy::cast_precision_loss, reason = "exact for any stretch")]
            let from = self.joint.from as f64;
            from
        } else {
            self.passed
        }
    }
}

impl Race {
    /// A joint from a frame of one way to the other way, if there is one: as far as both come on
    /// average.
    pub(super) fn meeting(
        &self,
        [one, other]: [usize; 2],
        from: usize,
        known: &[Range<usize>; 2],
    ) -> Option<Meeting> {
        let bounds = Bounds {
            limits: &self.settings.limits,
            period_t: self.settings.period_t,
            program: &self.program,
        };
        let ways = [&self.ways[one], &self.ways[other]];
        let at_s = ways[0].place(from)?.at_s;
        let passed = ways[1].passes(at_s, &known[other])?;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the number of a frame"
        )]
        let whole = |number: f64| number as usize;
        let speed_v = 0.5 * (ways[0].frame(from)?.path_v + ways[1].frame(whole(passed))?.path_v);
        let joint = JOINTS_T.into_iter().find_map(|t| {
            let periods = self.periods(t);
            #[expect(clippy::cast_precision_loss, reason = "hundreds")]
            let way_s = speed_v * periods as f64 * self.settings.period_t;
            let to = whole(ways[1].passes(at_s + way_s, &known[other])?);
            let is_known = from + SEAM < known[one].end && to + SEAM < known[other].end;
            is_known
                .then(|| Joint::between(ways, (from, to), periods, &bounds))
                .flatten()
        })?;
        Some(Meeting { passed, joint })
    }
}
