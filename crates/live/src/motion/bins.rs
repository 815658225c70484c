//! Columns against time in bounded memory: a bin holds one sample, then two, then four.

use super::bytes::Bytes;
use super::sample::{AxisScale, MotionSample};

/// Bins at most; when there are as many, every two become one.
const CAPACITY: usize = 131_072;
/// A number of 16 bits reaches this far beyond a limit.
const REACH: f64 = 1.25;

/// Least and largest of a quantity, in 16 bits.
type Range = [i16; 2];

#[derive(Debug, Clone, Copy)]
struct Bin {
    feed: [f32; 2],
    programmed: f32,
    deviation: f32,
    tolerance: f32,
    path: f32,
    line: u32,
    code: u8,
    /// How many samples more have this code than others.
    majority: u32,
}

/// One axis.
#[derive(Debug)]
struct AxisColumns {
    scale: AxisScale,
    positions: Vec<f32>,
    ranges: [Vec<Range>; 3],
    /// The last position, and its last differences of first and second order.
    last: [f64; 3],
}

#[derive(Debug)]
pub(super) struct Bins {
    period_t: f64,
    axes: Vec<AxisColumns>,
    bins: Vec<Bin>,
    /// Samples of a bin, and those of the last one.
    per: u64,
    filled: u64,
    samples: u64,
}

impl AxisColumns {
    /// Velocity, acceleration and jerk of the period that ends here, in 16 bits.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "clamped to 16 bits; the page draws pixels"
    )]
    fn step(&mut self, position: f64, period_t: f64, is_first: bool) -> [i16; 3] {
        let [before, first, second] = self.last;
        let before = if is_first { position } else { before };
        let new_first = position - before;
        let new_second = new_first - first;
        let third = new_second - second;
        self.last = [position, new_first, new_second];
        let mut power = 1.0;
        let mut out = [0; 3];
        let differences = [new_first, new_second, third];
        for ((out, difference), limit) in out.iter_mut().zip(differences).zip(self.scale.limits) {
            power *= period_t;
            let ratio = difference / (power * limit * REACH);
            *out = (ratio * f64::from(i16::MAX))
                .round()
                .clamp(f64::from(i16::MIN), f64::from(i16::MAX)) as i16;
        }
        out
    }

    fn merge(&mut self) {
        halve(&mut self.positions, |_, later| later);
        for ranges in &mut self.ranges {
            halve(ranges, |a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        }
    }
}

impl Bin {
    #[allow(
        clippy::cast_possible_truncation,
        reason = "the page draws single precision"
    )]
    fn of(sample: &MotionSample) -> Self {
        Self {
            feed: [sample.feed_v as f32; 2],
            programmed: sample.programmed_v as f32,
            deviation: sample.deviation_mm as f32,
            tolerance: sample.tolerance_mm as f32,
            path: sample.path_mm as f32,
            line: sample.line,
            code: sample.code(),
            majority: 1,
        }
    }

    fn join(self, later: Self) -> Self {
        let (code, majority) = if self.code == later.code {
            (self.code, self.majority + later.majority)
        } else if self.majority >= later.majority {
            (self.code, self.majority - later.majority)
        } else {
            (later.code, later.majority - self.majority)
        };
        Self {
            feed: [
                self.feed[0].min(later.feed[0]),
                self.feed[1].max(later.feed[1]),
            ],
            programmed: self.programmed.max(later.programmed),
            deviation: self.deviation.max(later.deviation),
            tolerance: self.tolerance.min(later.tolerance),
            path: later.path,
            line: self.line,
            code,
            majority,
        }
    }
}

/// Makes one of every two.
fn halve<T: Copy>(values: &mut Vec<T>, join: impl Fn(T, T) -> T) {
    let joined: Vec<T> = values
        .chunks(2)
        .filter_map(|pair| match pair {
            [a, b] => Some(join(*a, *b)),
            [a] => Some(*a),
            _ => None,
        })
        .collect();
    *values = joined;
}

impl Bins {
    pub(super) fn new(axes: &[AxisScale], period_t: f64) -> Self {
        let axes = axes.iter().map(|scale| AxisColumns {
            scale: *scale,
            positions: Vec::new(),
            ranges: [const { Vec::new() }; 3],
            last: [0.0; 3],
        });
        Self {
            period_t,
            axes: axes.collect(),
            bins: Vec::new(),
            per: 1,
            filled: 0,
            samples: 0,
        }
    }

    pub(super) const fn samples(&self) -> u64 {
        self.samples
    }

    #[allow(
        clippy::cast_possible_truncation,
        reason = "the page draws single precision"
    )]
    pub(super) fn push(&mut self, sample: &MotionSample) {
        let is_first = self.samples == 0;
        let opens = self.bins.is_empty() || self.filled == self.per;
        let bin = Bin::of(sample);
        for axis in &mut self.axes {
            let position = sample.position.get(axis.scale.index).copied();
            let position = position.unwrap_or_default();
            let differences = axis.step(position, self.period_t, is_first);
            if opens {
                axis.positions.push(position as f32);
            } else if let Some(last) = axis.positions.last_mut() {
                *last = position as f32;
            }
            for (ranges, value) in axis.ranges.iter_mut().zip(differences) {
                match ranges.last_mut() {
                    Some(range) if !opens => {
                        *range = [range[0].min(value), range[1].max(value)];
                    }
                    _ => ranges.push([value; 2]),
                }
            }
        }
        match self.bins.last_mut() {
            Some(last) if !opens => *last = last.join(bin),
            _ => self.bins.push(bin),
        }
        self.filled = if opens { 1 } else { self.filled + 1 };
        self.samples += 1;
        if self.bins.len() == CAPACITY && self.filled == self.per {
            self.axes.iter_mut().for_each(AxisColumns::merge);
            halve(&mut self.bins, Bin::join);
            self.per *= 2;
            self.filled = self.per;
        }
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_precision_loss,
        reason = "bins are fewer than the capacity, and counts below 2^53 are exact"
    )]
    pub(super) fn write(&self, bytes: &mut Bytes) {
        bytes.word(self.axes.len() as u32);
        bytes.word(self.bins.len() as u32);
        bytes.word(self.per as u32);
        bytes.double(self.period_t);
        bytes.double(self.samples as f64);
        for axis in &self.axes {
            bytes.column(axis.positions.iter().map(|value| value.to_le_bytes()));
            for ranges in &axis.ranges {
                bytes.column(ranges.iter().map(|range| range[0].to_le_bytes()));
                bytes.column(ranges.iter().map(|range| range[1].to_le_bytes()));
            }
        }
        let bins = &self.bins;
        for of in [
            |bin: &Bin| bin.feed[0],
            |bin: &Bin| bin.feed[1],
            |bin: &Bin| bin.programmed,
            |bin: &Bin| bin.deviation,
            |bin: &Bin| bin.tolerance,
            |bin: &Bin| bin.path,
        ] {
            bytes.column(bins.iter().map(|bin| of(bin).to_le_bytes()));
        }
        bytes.column(bins.iter().map(|bin| bin.line.to_le_bytes()));
        bytes.column(bins.iter().map(|bin| [bin.code]));
    }
}
