//! Histograms for people: few bins, on a logarithmic scale.

/// A range of times and how many fell into it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bin {
    /// Lower end, µs; belongs to the bin.
    pub low_us: f64,
    /// Upper end, µs; does not.
    pub high_us: f64,
    /// How many.
    pub count: u64,
}

/// Ends of bins within a decade, for a terminal.
pub const COARSE: &[f64] = &[1.0, 2.0, 5.0];
/// Ends of bins within a decade, for a plot. Whole from 10 µs on, so that whole µs do not leave
/// every other bin empty.
pub const FINE: &[f64] = &[1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0];

/// Sorts times (µs, number) into bins whose ends are `ends` · 10ᵏ µs, k ≥ 0; the first begins at 0.
/// Empty bins at either side are left out.
pub fn rebin(times: impl IntoIterator<Item = (f64, u64)>, ends: &[f64]) -> Vec<Bin> {
    let mut bins: Vec<Bin> = Vec::new();
    let mut high_us = (0..8)
        .flat_map(|k| ends.iter().map(move |end| end * 10_f64.powi(k)))
        // Below 10 µs whole µs only.
        .filter(|end| *end >= 10.0 || end.fract() == 0.0)
        .chain([f64::INFINITY]);
    let mut times: Vec<(f64, u64)> = times.into_iter().collect();
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (us, count) in times {
        while bins.last().is_none_or(|bin| us >= bin.high_us) {
            let low_us = bins.last().map_or(0.0, |bin| bin.high_us);
            let high_us = high_us.next().unwrap_or(f64::INFINITY);
            bins.push(Bin {
                low_us,
                high_us,
                count: 0,
            });
        }
        if let Some(bin) = bins.last_mut() {
            bin.count += count;
        }
    }
    let empty = bins.iter().take_while(|bin| bin.count == 0).count();
    bins.drain(..empty);
    bins
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn times_fall_into_their_bins() {
        let bins = rebin([(20.0, 1), (4.9, 2), (19.99, 3), (5.0, 4)], COARSE);
        let seen: Vec<_> = bins
            .iter()
            .map(|b| (b.low_us, b.high_us, b.count))
            .collect();
        assert_eq!(
            seen,
            [
                (2.0, 5.0, 2),
                (5.0, 10.0, 4),
                (10.0, 20.0, 3),
                (20.0, 50.0, 1)
            ]
        );
        assert!(rebin([], FINE).is_empty());
    }

    proptest! {
        #[test]
        fn nothing_is_lost(times in prop::collection::vec((0.0..1e10_f64, 1_u64..9), 1..50)) {
            for ends in [COARSE, FINE] {
                let bins = rebin(times.iter().copied(), ends);
                let counted: u64 = bins.iter().map(|bin| bin.count).sum();
                prop_assert_eq!(counted, times.iter().map(|(_, n)| n).sum::<u64>());
                for pair in bins.windows(2) {
                    prop_assert!((pair[0].high_us - pair[1].low_us).abs() < 1e-9);
                }
            }
        }
    }
}
