//! The table `[probe]`, and how fast a probe may be used.

use glidepath_interpolator::ProbeInput;

/// The probe of a machine: where it is connected, and how far it gives way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProbeConfig {
    /// Its input.
    pub input: ProbeInput,
    /// How far the machine may go on after the contact, mm or degrees.
    pub overtravel_mm: f64,
}

/// Periods between a contact and the first setpoint that slows for it: the sample, the way here, the
/// tick, and the way to the drives.
const REACTION_PERIODS: f64 = 4.0;
/// A stop in the middle of a run-up takes that much of one from a steady speed.
const RUN_UP: f64 = 2.0;
/// Steps of the search for a speed: to a part in a billion.
const STEPS: u32 = 40;

impl ProbeConfig {
    /// The highest speed from which every axis stops within the overtravel, mm/s or °/s. `limits` are
    /// their accelerations and jerks.
    ///
    /// ```text
    ///   overtravel ≥ v · 4 T + 2 d(v),   d(v) = v √(v / J)            if v ≤ A² / J
    ///                                         = v / 2 (v / A + A / J)   else
    /// ```
    #[must_use]
    pub fn highest_v(&self, limits: &[(f64, f64)], period_t: f64) -> f64 {
        let goes = |v: f64| REACTION_PERIODS * period_t * v + RUN_UP * way_to_stop(limits, v);
        let (mut low, mut high) = (0.0, self.overtravel_mm / (REACTION_PERIODS * period_t));
        for _ in 0..STEPS {
            let middle = f64::midpoint(low, high);
            if goes(middle) <= self.overtravel_mm {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }
}

/// The longest that an axis needs to stop from a speed, with its whole jerk.
fn way_to_stop(limits: &[(f64, f64)], v: f64) -> f64 {
    let way = |&(a, j): &(f64, f64)| {
        if v <= a * a / j {
            v * (v / j).sqrt()
        } else {
            0.5 * v * (v / a + a / j)
        }
    };
    limits.iter().map(way).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_highest_speed_uses_the_overtravel_up() {
        let limits = [(2_000.0, 40_000.0)];
        for overtravel_mm in [0.05, 0.3, 2.0, 20.0] {
            let input = ProbeInput {
                protects: false,
                number: 0,
                high: true,
            };
            let probe = ProbeConfig {
                input,
                overtravel_mm,
            };
            let v = probe.highest_v(&limits, 0.004);
            let goes = 0.016 * v + 2.0 * way_to_stop(&limits, v);
            assert!((goes - overtravel_mm).abs() < 1e-6, "{v}: {goes}");
        }
        // With the jerk J up and down it takes 2 √(v / J), at half of the speed on average.
        assert!((way_to_stop(&limits, 25.0) - 25.0 * 0.025).abs() < 1e-12);
    }
}
