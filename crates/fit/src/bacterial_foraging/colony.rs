//! Bacterial foraging: a search for a minimum of a function of many variables, without derivatives.
//!
//! Every bacterium is a point. It *tumbles* into a random direction and takes a step; if that was
//! for the better it *swims* on, some steps at most. After some rounds of this (chemotaxis) the
//! half with the smaller sum of values splits in place of the other half, and steps become shorter
//! (reproduction); after some of those, each bacterium but the best may be put down anew near the
//! best point so far (elimination and dispersal).
//!
//! Every evaluation is one whole value; of a problem whose gradient is known, steps by that take far
//! fewer. It is kept for comparison with what was published, and for knots, where least squares make a
//! value whose gradient nobody has written down.

use super::random::Random;

/// Numbers of a search.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Colony {
    /// Even, at least two.
    pub(crate) bacteria: usize,
    pub(crate) chemotaxis: u32,
    pub(crate) swims: u32,
    pub(crate) reproductions: u32,
    pub(crate) dispersals: u32,
    pub(crate) dispersal_chance: f64,
    /// Length of the first steps.
    pub(crate) step: f64,
    /// Factor of the length at every reproduction.
    pub(crate) shrink: f64,
}

impl Colony {
    pub(crate) const fn iterations(&self) -> u32 {
        self.chemotaxis * self.reproductions * self.dispersals
    }
}

/// What a search found.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Outcome {
    pub(crate) best: Vec<f64>,
    pub(crate) evaluations: u64,
    /// Best value after every iteration.
    pub(crate) history: Vec<f64>,
}

#[derive(Clone)]
struct Bacterium {
    at: Vec<f64>,
    value: f64,
    /// Sum of the values of this generation, so that who was good all along comes before who came to be
    /// good last.
    health: f64,
}

struct ForagingRun<'a> {
    colony: Colony,
    random: Random,
    value: &'a mut dyn FnMut(&[f64]) -> f64,
    outcome: Outcome,
    least: f64,
    step: f64,
    trial: Vec<f64>,
    direction: Vec<f64>,
}

/// Searches from `start`. A value of −∞ ends the search at once. `progress` is told the share of
/// the iterations done.
pub(crate) fn forage(
    start: &[f64],
    colony: Colony,
    seed: u64,
    value: &mut dyn FnMut(&[f64]) -> f64,
    progress: &mut dyn FnMut(f64),
) -> Outcome {
    let least = value(start);
    let mut search = ForagingRun {
        colony,
        random: Random::new(seed),
        value,
        outcome: Outcome {
            best: start.to_vec(),
            evaluations: 1,
            history: Vec::new(),
        },
        least,
        step: colony.step,
        trial: start.to_vec(),
        direction: vec![0.0; start.len()],
    };
    search.run(progress);
    search.outcome
}

impl ForagingRun<'_> {
    fn run(&mut self, progress: &mut dyn FnMut(f64)) {
        let first = Bacterium {
            at: self.outcome.best.clone(),
            value: self.least,
            health: 0.0,
        };
        let mut bacteria = vec![first];
        while bacteria.len() < self.colony.bacteria {
            bacteria.push(self.anew());
        }
        for _ in 0..self.colony.dispersals {
            self.step = self.colony.step;
            for _ in 0..self.colony.reproductions {
                for _ in 0..self.colony.chemotaxis {
                    for bacterium in &mut bacteria {
                        self.tumble(bacterium);
                        if self.least == f64::NEG_INFINITY {
                            return;
                        }
                    }
                    self.outcome.history.push(self.least);
                    let done = self.outcome.history.len() as f64;
                    progress(done / f64::from(self.colony.iterations()));
                }
                reproduce(&mut bacteria);
                self.step *= self.colony.shrink;
            }
            self.disperse(&mut bacteria);
        }
    }

    fn evaluate(&mut self) -> f64 {
        self.outcome.evaluations += 1;
        let value = (self.value)(&self.trial);
        if value < self.least {
            self.least = value;
            self.outcome.best.copy_from_slice(&self.trial);
        }
        value
    }

    /// A bacterium one step from the best point.
    fn anew(&mut self) -> Bacterium {
        self.random.direction(&mut self.direction);
        for ((trial, best), d) in self
            .trial
            .iter_mut()
            .zip(&self.outcome.best)
            .zip(&self.direction)
        {
            *trial = best + self.colony.step * d;
        }
        let value = self.evaluate();
        Bacterium {
            at: self.trial.clone(),
            value,
            health: 0.0,
        }
    }

    /// One step in a random direction, and on as long as it helps.
    fn tumble(&mut self, bacterium: &mut Bacterium) {
        self.random.direction(&mut self.direction);
        for _ in 0..=self.colony.swims {
            for ((trial, at), d) in self
                .trial
                .iter_mut()
                .zip(&bacterium.at)
                .zip(&self.direction)
            {
                *trial = at + self.step * d;
            }
            let value = self.evaluate();
            // Ties keep the old place.
            if value >= bacterium.value || value.is_nan() {
                break;
            }
            bacterium.value = value;
            bacterium.at.copy_from_slice(&self.trial);
        }
        bacterium.health += bacterium.value;
    }

    fn disperse(&mut self, bacteria: &mut [Bacterium]) {
        let least = |a: &(usize, f64), b: &(usize, f64)| a.1.total_cmp(&b.1);
        let values = bacteria.iter().map(|b| b.value).enumerate();
        let elite = values.min_by(least).map_or(0, |(index, _)| index);
        for (index, bacterium) in bacteria.iter_mut().enumerate() {
            if self.random.unit() < self.colony.dispersal_chance && index != elite {
                *bacterium = self.anew();
            }
        }
    }
}

/// The healthier half splits in place of the other.
fn reproduce(bacteria: &mut [Bacterium]) {
    bacteria.sort_by(|a, b| a.health.total_cmp(&b.health));
    let half = bacteria.len() / 2;
    let (healthy, rest) = bacteria.split_at_mut(half);
    for (weak, strong) in rest.iter_mut().zip(healthy.iter()) {
        weak.clone_from(strong);
    }
    bacteria.iter_mut().for_each(|b| b.health = 0.0);
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLONY: Colony = Colony {
        bacteria: 10,
        chemotaxis: 20,
        swims: 4,
        reproductions: 3,
        dispersals: 2,
        dispersal_chance: 0.25,
        step: 0.5,
        shrink: 0.7,
    };

    fn bowl(at: &[f64]) -> f64 {
        at.iter().map(|x| (x - 1.0) * (x - 1.0)).sum()
    }

    #[test]
    fn it_descends_never_climbs_and_repeats_itself() {
        let run = |seed| forage(&[5.0, -3.0, 2.0], COLONY, seed, &mut bowl, &mut |_| {});
        let outcome = run(7);
        assert!(bowl(&outcome.best) < 0.1, "{outcome:?}");
        assert_eq!(outcome.history.len(), 120);
        assert!(outcome.history.windows(2).all(|pair| pair[1] <= pair[0]));
        assert_eq!(outcome, run(7));
        assert_ne!(outcome.best, run(8).best);
    }
}
