//! The output of look-ahead: motion that nothing later changes, or two ways to drive a stretch.

use super::settled::Settled;

/// The output of look-ahead.
#[derive(Debug)]
pub(crate) enum PlannedMotion {
    One(Settled),
    /// A stretch from rest to rest, of which one way is to be chosen.
    Either {
        passing: Vec<Settled>,
        /// At rest after each of its blocks.
        stopping: Vec<Settled>,
        /// How much longer than its motions that takes, for its rests, s.
        rests_t: f64,
    },
}

impl PlannedMotion {
    /// The way that takes less time by S-curves.
    pub(crate) fn by_s_curves(self) -> Vec<Settled> {
        match self {
            Self::One(settled) => vec![settled],
            Self::Either {
                passing,
                stopping,
                rests_t,
            } => {
                let duration_t = |way: &[Settled]| way.iter().map(Settled::duration_t).sum::<f64>();
                if rests_t + duration_t(&stopping) < duration_t(&passing) {
                    stopping
                } else {
                    passing
                }
            }
        }
    }
}
