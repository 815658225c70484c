//! The envelope of a curve of any length in bounded memory: smallest and largest value of every
//! stretch of time.
//!
//! Stretches start as single ticks. When there are too many, neighbours are joined two by two, so a
//! peak is never lost, however short it is.

/// Stretches kept at most; a plot has fewer pixels.
const CAPACITY: usize = 2048;

#[derive(Debug, Clone)]
pub(super) struct Envelope {
    stretches: Vec<Option<(f64, f64)>>,
    /// Ticks of one stretch, a power of two.
    ticks: u64,
    /// Largest magnitude so far.
    peak: f64,
}

impl Envelope {
    pub(super) const fn new() -> Self {
        Self {
            stretches: Vec::new(),
            ticks: 1,
            peak: 0.0,
        }
    }

    /// Takes the value at a tick. Ticks may be missing, but not go back.
    pub(super) fn push(&mut self, tick: u64, value: f64) {
        let index = loop {
            let index = usize::try_from(tick / self.ticks).unwrap_or(usize::MAX);
            if index < CAPACITY {
                break index;
            }
            self.halve();
        };
        if self.stretches.len() <= index {
            self.stretches.resize(index + 1, None);
        }
        if let Some(stretch) = self.stretches.get_mut(index) {
            *stretch = Some(stretch.map_or((value, value), |(low, high)| {
                (low.min(value), high.max(value))
            }));
        }
        self.peak = self.peak.max(value.abs());
    }

    pub(super) const fn peak(&self) -> f64 {
        self.peak
    }

    /// Whether any value was below zero.
    pub(super) fn is_ever_negative(&self) -> bool {
        let lows = self.stretches.iter().flatten().map(|(low, _)| *low);
        lows.fold(0.0, f64::min) < 0.0
    }

    /// Tick in the middle of each stretch, with its smallest and largest value; `None` where no
    /// value was taken.
    pub(super) fn stretches(&self) -> impl Iterator<Item = (f64, Option<(f64, f64)>)> {
        #[allow(clippy::cast_precision_loss, reason = "pixels, not arithmetic")]
        let middle = |i: usize| (i as f64 + 0.5) * self.ticks as f64 - 0.5;
        self.stretches
            .iter()
            .enumerate()
            .map(move |(i, stretch)| (middle(i), *stretch))
    }

    fn halve(&mut self) {
        self.ticks *= 2;
        self.stretches = self
            .stretches
            .chunks(2)
            .map(|pair| {
                pair.iter()
                    .flatten()
                    .copied()
                    .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
            })
            .collect();
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "values are kept, not computed")]
mod tests {
    use super::*;

    #[test]
    fn a_short_curve_is_kept_whole() {
        let mut envelope = Envelope::new();
        envelope.push(0, 1.0);
        envelope.push(2, -3.0);
        let all: Vec<_> = envelope.stretches().collect();
        assert_eq!(
            all,
            [
                (0.0, Some((1.0, 1.0))),
                (1.0, None),
                (2.0, Some((-3.0, -3.0)))
            ]
        );
    }

    #[test]
    fn a_long_curve_keeps_every_peak_in_bounded_memory() {
        let mut envelope = Envelope::new();
        for tick in 0..1_000_000 {
            envelope.push(tick, if tick == 765_432 { -7.0 } else { 1.0 });
        }
        assert!(envelope.stretches.len() <= CAPACITY && envelope.stretches.len() > CAPACITY / 4);
        let low: Vec<f64> = envelope
            .stretches()
            .filter(|(_, s)| s.is_some_and(|(low, _)| low == -7.0))
            .map(|(tick, _)| tick)
            .collect();
        assert_eq!(low.len(), 1);
        assert!((low[0] - 765_432.0).abs() <= envelope.ticks as f64);
        assert_eq!(envelope.peak(), 7.0);
    }
}
