//! The traditional preview: every tick of a motion whose speed follows the curvature.

use crate::preview::{Demand, Method, Minimum, Probe, Region};

/// The slowest advance, relative to the feedrate: at a cusp the allowed speed is zero, and the
/// reading would never pass it.
const SLOWEST: f64 = 1e-3;

/// Reads the curve tick by tick: at each, the speed the curvature allows, and one step of it by
/// first-order Taylor expansion of u(s). A region is a run of ticks that are too sharp for the
/// feedrate, its minimum the sharpest of them.
#[derive(Debug, Clone, Copy, Default)]
pub struct Traditional;

impl Method for Traditional {
    fn name(&self) -> &'static str {
        "traditional"
    }

    fn regions(&self, probe: &mut Probe<'_>, demand: &Demand) -> Vec<Region> {
        let critical_mm = demand.critical_radius_mm();
        let (first, last) = probe.path().curve().domain();
        let longest = (last - first) * demand.feed_v * demand.period_t / probe.path().length();
        let mut regions: Vec<Region> = Vec::new();
        let mut inside = false;
        let mut u = first;
        loop {
            let reading = probe.at(u);
            let cap_v = demand.cap_v(reading.radius_mm);
            let sensitive = reading.radius_mm < critical_mm;
            if sensitive {
                let minimum = Minimum {
                    u,
                    radius_mm: reading.radius_mm,
                    cap_v,
                };
                match regions.last_mut().filter(|_| inside) {
                    Some(region) => {
                        region.to_u = u;
                        let least = &mut region.minima[0];
                        if minimum.radius_mm < least.radius_mm {
                            *least = minimum;
                        }
                    }
                    None => regions.push(Region {
                        from_u: u,
                        to_u: u,
                        minima: vec![minimum],
                    }),
                }
            }
            inside = sensitive;
            if u >= last {
                return regions;
            }
            let v = cap_v.max(SLOWEST * demand.feed_v);
            let step = v * demand.period_t / reading.speed;
            // Next to a standstill the expansion knows no bound; no step is longer than a mean one.
            let bounded = if reading.speed > 0.0 {
                step.min(longest * 1e3)
            } else {
                longest
            };
            u = (u + bounded).min(last);
        }
    }
}
