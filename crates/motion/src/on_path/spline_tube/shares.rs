//! The shares of the tolerance: what it is spent on, merging, the fit, and the chord error of one period.

use super::held_radius::HeldRadius;
use super::thinning::MergedChord;
use super::vector::minus;
use core::ops::Range;
use glidepath_program::{Settings, Travel};

/// Share of the tolerance that merging may use. With more, more chords become one, but the fit has less
/// room; it is to be more than the last digit of coordinates is worth, whose noise it takes out.
const MERGE_SHARE_R: f64 = 0.05;

/// Most of the tolerance that is left for the chord error of one period. A period that needs more has its
/// speed limited by the chord error instead.
const CHORD_SHARE_R: f64 = 0.25;

/// Share of what is allowed that the weights aim at: samples come out on either side of it, and between
/// them the curve is further off than at them. In a prototype .9 and 20 solves together drove a zigzag
/// in 4.57 s, .8 and six in 4.86.
const TARGET_R: f64 = 0.8;

/// How long a curve beside a line may take at the feed, in times that an axis needs for the tolerance with all of its
/// jerk. Beside a line it would otherwise swing from one side of the tube to the other, ever longer: a wave in a wall
/// that the feed gains nothing by.
const BESIDE_LINE_TIMES: f64 = 12.0;

/// Longest wavelength that is smoothed away, in tolerances: 25 mm at .02. It is the least weight a sample
/// may have whatever its spacing, or long straight runs would be tied to nothing.
const LONGEST_R: f64 = 1250.0;

/// The tube a curve has to stay in.
#[derive(Debug, Clone)]
pub(super) struct ToleranceShares {
    /// The tolerance of the program, everything together, mm.
    pub(super) tolerance_mm: f64,
    /// What a degree of the rotary axes counts for, mm.
    pub(super) mm_per_deg: f64,
    /// What merging may use of it.
    pub(super) merge_mm: f64,
    /// What the fit may use, and what it aims at.
    pub(super) allowed_mm: f64,
    pub(super) target_mm: f64,
    pub(super) longest_mm: f64,
    /// How long a curve beside a line may take at the feed, s.
    pub(super) beside_line_t: f64,
    /// How near their radius curves are kept.
    pub(super) held_radius: HeldRadius,
    /// The axes that measure the feed.
    pub(super) feed_axes: Range<usize>,
    /// Where the curve ends whatever the tolerance is.
    pub(super) travel: Travel,
}

impl ToleranceShares {
    pub(super) fn new(tolerance_mm: f64, settings: &Settings, feed_axes: Range<usize>) -> Self {
        // The chord of one period is a·T²/8 away from a curve that takes all of an axis' limit.
        let period_t = settings.period_t;
        let sharpest_a = feed_axes
            .clone()
            .map(|i| settings.limits.acceleration[i])
            .fold(0.0, f64::max);
        let chord_mm = (sharpest_a * period_t * period_t / 8.0).min(CHORD_SHARE_R * tolerance_mm);
        let weakest_j = (feed_axes.clone())
            .map(|i| settings.limits.jerk[i])
            .fold(f64::INFINITY, f64::min);
        let merge_mm = MERGE_SHARE_R * tolerance_mm;
        let allowed_mm = tolerance_mm - merge_mm - chord_mm;
        Self {
            tolerance_mm,
            mm_per_deg: settings.direction.mm_per_deg(tolerance_mm),
            merge_mm,
            allowed_mm,
            target_mm: TARGET_R * allowed_mm,
            longest_mm: LONGEST_R * tolerance_mm,
            beside_line_t: BESIDE_LINE_TIMES * (tolerance_mm / weakest_j).cbrt(),
            held_radius: HeldRadius::new(tolerance_mm, &settings.limits, feed_axes.clone()),
            feed_axes,
            travel: settings.limits.travel,
        }
    }

    /// How much faster the way along a chord grows than the part of it that measures the feed.
    pub(super) fn per_feed<const D: usize>(&self, chord: &MergedChord<D>) -> f64 {
        let way = minus(&chord.end, &chord.start);
        let axes = self.feed_axes.clone().filter(|&i| i < D);
        let fed_square: f64 = axes.map(|i| way[i] * way[i]).sum();
        chord.length_t / fed_square.sqrt()
    }
}
