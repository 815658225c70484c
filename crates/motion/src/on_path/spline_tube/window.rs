//! The window of the tube spline: samples in, certified spans out.
//!
//! ```text
//!   committed │ frozen │            free                 │ to come
//!   ──────────┼────────┼─────────────────────────────────┼─ ─ ─
//!             t₀       t₃                                t_m
//! ```
//!
//! When the window is full of samples, the spline over it is fitted, certified, and its first half
//! put out. The three control points that the last committed span shares with what follows stay as
//! they are, so the whole curve has a continuous second derivative. Weights are kept; the knots
//! beyond t₃ are set to the feet of the samples, or the parameter would drift away from length.
//!
//! The weight of a sample rises where the curve leaves the tube and falls where it is well inside,
//! a few times before the certificate is asked for. Where that fails the weights near the worst
//! place are raised more, and then [`super::resort`] is taken.

use super::fit::{Spline, span_of};
use super::knots::{DEGREE, bezier, greville};
use super::output::Output;
use super::sample::Sample;
use super::shares::ToleranceShares;
use super::vector::{add_scaled, between, minus, norm};
use core::f64::consts::{PI, TAU};
use glidepath_program::Travel;

/// How a curve starts or ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    /// On a line, with zero curvature.
    Line,
    /// At a stop.
    Stop,
}

/// Samples in a window, before any are put between. With 32 the look-ahead is half as long, but in a
/// prototype one of three programs took longer (2.43 s, with 64 it was 2.1 to 2.4), and more was driven
/// along straight lines.
pub(super) const WINDOW: usize = 64;
/// Most samples in a window.
pub(super) const MOST_SAMPLES: usize = 2 * WINDOW;
/// Solves before the certificate is asked for, and in a window that was refined. In a prototype four were
/// enough for real programs, but not for noise: a zigzag of 5 µm took .454 s (three quarters of a window
/// put out), with six or eight (half of it) .305; 20 gained 3 % on a butterfly, and nothing clear else.
const SOLVES: u32 = 6;
const SOLVES_REFINED: u32 = 4;
/// Solves more that a certificate that fails may cost.
const MORE_SOLVES: u32 = 6;
/// Solves more where the curve is in the tube as far as it is put out, and not right behind that.
const SOLVES_BEYOND: u32 = 2;
/// First weight: so stiff that the first curve keeps near the samples. A weight w is followed by waves
/// longer than 2π/w^(1/6): four spacings, twice this number.
const FIRST_STIFFNESS: f64 = 2.0;
/// Weights stay between the sixth powers of these over the spacing: between waves of sixty spacings and of
/// a tenth of one. The sixth power of 60 is 5e10: beside more the penalty would have no digits left.
const LEAST_WEIGHT: f64 = 0.1;
const MOST_WEIGHT: f64 = 60.0;
/// How much a weight may change at once.
const LEAST_FACTOR: f64 = 0.03;
const MOST_FACTOR: f64 = 100.0;
/// How much more weights are raised out of the tube once the certificate has failed, and beside the worst
/// chord: between samples the curve may be out where all of them are in.
const BOOST: f64 = 3.0;
const WORST_BOOST: f64 = 4.0;
/// Feet of samples become knots of the next window if they are so far apart, in spacings: long spans next
/// to short ones are where a fit fails.
const APART_R: f64 = 0.4;
/// How far behind the one before a foot is put that was not, in spacings.
const BEHIND_R: f64 = 1e-3;

/// The window.
#[derive(Debug, Clone)]
pub(super) struct Window<const D: usize> {
    pub(super) shares: ToleranceShares,
    pub(super) samples: Vec<Sample<D>>,
    /// Knots t₋₃ … t_m, each once.
    pub(super) knots: Vec<f64>,
    pub(super) spline: Spline<D>,
    /// Control points kept from the window before.
    pub(super) kept: usize,
    pub(super) start: End,
    /// The first control points belong to spans already put out.
    pub(super) is_frozen: bool,
    /// How far along the first chord the match is, 0…1.
    pub(super) passed_u: f64,
    /// The sample at the start of the chord that the spans put out end on.
    pub(super) chord: usize,
    pub(super) errors_mm: Vec<f64>,
    /// How fast samples that are added are passed at the feed.
    pub(super) feed_v: f64,
    /// Lowest and highest position of the axes.
    travel: [[f64; D]; 2],
}

impl<const D: usize> Window<D> {
    pub(super) fn new(shares: ToleranceShares) -> Self {
        let Travel { lowest, highest } = &shares.travel;
        Self {
            travel: [lowest, highest].map(|end| core::array::from_fn(|i| end[i])),
            shares,
            samples: Vec::with_capacity(MOST_SAMPLES + 2),
            knots: Vec::with_capacity(MOST_SAMPLES + 2 * DEGREE),
            spline: Spline::new(),
            kept: 0,
            start: End::Line,
            is_frozen: false,
            passed_u: 0.0,
            chord: 0,
            errors_mm: Vec::new(),
            feed_v: 0.0,
        }
    }

    /// Starts a curve at a point, `along_t` along the merged chords.
    pub(super) fn start(&mut self, point: [f64; D], along_t: f64, start: End) {
        self.samples.clear();
        self.samples.push(Sample {
            point,
            along_t,
            spacing_t: 0.0,
            foot_t: 0.0,
            weight: 0.0,
            feed_v: self.feed_v,
            error_mm: 0.0,
        });
        self.restart(start);
    }

    /// Forgets the curve, not the samples: another starts at the first of them.
    pub(super) fn restart(&mut self, start: End) {
        self.knots.clear();
        self.knots.resize(DEGREE + 1, 0.0);
        self.kept = 0;
        self.passed_u = 0.0;
        self.start = start;
        self.is_frozen = false;
        let mut t = 0.0;
        if let Some(first) = self.samples.first_mut() {
            first.foot_t = 0.0;
        }
        for sample in self.samples.iter_mut().skip(1) {
            t += sample.spacing_t;
            sample.foot_t = t;
            sample.weight = first_weight(sample.spacing_t);
            self.knots.push(t);
        }
    }

    /// Knots and a first guess of the control points; the number of spans to put out.
    pub(super) fn prepare(&mut self, end: Option<End>) -> usize {
        let last = self.samples.len() - 1;
        let end_t = self.knots.last().copied().unwrap_or(0.0);
        self.samples[last].foot_t = end_t;
        for j in 1..=last {
            let (before_t, spacing_t) = (self.samples[j - 1].foot_t, self.samples[j].spacing_t);
            let foot_t = &mut self.samples[j].foot_t;
            if *foot_t <= before_t {
                *foot_t = before_t + BEHIND_R * spacing_t;
            }
        }
        let spline = &mut self.spline;
        spline.knots.clear();
        spline.knots.extend_from_slice(&self.knots);
        spline.knots.extend([end_t; DEGREE]);
        let count = spline.spans() + DEGREE;
        spline.control.truncate(self.kept);
        let mut j = 0;
        for i in spline.control.len()..count {
            // The polyline at the abscissa of each control point, which is exact on straight lines.
            let t = greville(&spline.knots, i);
            while j + 2 < self.samples.len() && t > self.samples[j + 1].foot_t {
                j += 1;
            }
            let (a, b) = (&self.samples[j], &self.samples[j + 1]);
            let share = ((t - a.foot_t) / (b.foot_t - a.foot_t)).clamp(0.0, 1.0);
            spline.control.push(between(&a.point, &b.point, share));
        }
        self.lay_ends(end);
        self.spline.prepare(&self.samples);
        let spans = self.spline.spans();
        // Three spans stay at least: the next window keeps their knots.
        let half = (spans / 2).min(spans.saturating_sub(DEGREE)).max(1);
        if end.is_some() { spans } else { half }
    }

    /// Puts the control points at the ends where they have to be.
    fn lay_ends(&mut self, end: Option<End>) {
        let Self {
            samples, spline, ..
        } = self;
        let count = spline.control.len();
        let end_t = spline.knots[spline.knots.len() - 1];
        if let (Some(end), [.., before, last]) = (end, samples.as_slice()) {
            let direction = unit(&before.point, &last.point);
            for i in count.saturating_sub(fixed_points(end))..count {
                let back_t = greville(&spline.knots, i) - end_t;
                spline.control[i] = add_scaled(&last.point, back_t, &direction);
            }
        }
        if let (false, [first, after, ..]) = (self.is_frozen, samples.as_slice()) {
            let direction = unit(&first.point, &after.point);
            for i in 0..fixed_points(self.start).min(count) {
                let ahead_t = greville(&spline.knots, i) - spline.knots[DEGREE];
                spline.control[i] = add_scaled(&first.point, ahead_t, &direction);
            }
        }
    }

    /// Fits and certifies the first spans: `None` if they are in the tube, else the sample at the
    /// end of the worst chord.
    pub(super) fn fit(
        &mut self,
        end: Option<End>,
        spans: usize,
        is_refined: bool,
    ) -> Option<usize> {
        let fixed = (
            if self.is_frozen {
                DEGREE
            } else {
                fixed_points(self.start)
            },
            end.map_or(0, fixed_points),
        );
        let solves = if is_refined { SOLVES_REFINED } else { SOLVES };
        for solve in 1.. {
            self.spline.solve(&mut self.samples, fixed, &self.travel);
            // The weights have so many solves to themselves; then each curve is judged.
            let mut worst = None;
            if solve >= solves {
                let verdict = self.spline.certify(
                    &self.samples,
                    spans,
                    self.passed_u,
                    (&self.shares.feed_axes, self.shares.mm_per_deg),
                    &mut self.errors_mm,
                );
                let is_in_tube = verdict.worst_mm <= self.shares.allowed_mm;
                // What the next window has to keep should be in the tube, too, but is not worth a resort.
                let beyond = self.worst_beyond(end, spans);
                if is_in_tube && (beyond.is_none() || solve >= solves + SOLVES_BEYOND) {
                    (self.chord, self.passed_u) = (verdict.chord, verdict.passed_u);
                    return None;
                }
                if solve >= solves + MORE_SOLVES {
                    return Some(verdict.worst_sample);
                }
                worst = if is_in_tube {
                    beyond
                } else {
                    Some(verdict.worst_sample)
                };
            }
            self.weigh(worst);
        }
        None
    }

    /// The worst sample out of the tube on the spans behind those that are put out, whose control
    /// points the next window has to keep: it can hardly mend what they leave it.
    fn worst_beyond(&self, end: Option<End>, spans: usize) -> Option<usize> {
        let knots = &self.spline.knots;
        let (None, Some(&to_t)) = (end, knots.get(spans + 2 * DEGREE)) else {
            return None;
        };
        let from_t = knots[spans + DEGREE];
        let first = self
            .samples
            .partition_point(|sample| sample.foot_t <= from_t);
        let samples = self.samples.iter().enumerate().skip(first);
        let beyond = samples.take_while(|(_, sample)| sample.foot_t <= to_t);
        let worst = beyond.max_by(|(_, a), (_, b)| a.error_mm.total_cmp(&b.error_mm))?;
        (worst.1.error_mm > self.shares.allowed_mm).then_some(worst.0)
    }

    /// Raises the weights where the curve is too far away, lowers them where it is near; once the
    /// certificate has failed only raises, most of all beside the worst chord.
    fn weigh(&mut self, worst: Option<usize>) {
        let boost = if worst.is_some() { BOOST } else { 1.0 };
        // The weight that is followed by waves of that length and more ([`FIRST_STIFFNESS`]).
        let longest = (TAU / self.shares.longest_mm).powi(6);
        let mut span = 0;
        for sample in self.samples.iter_mut().skip(1) {
            let ratio = sample.error_mm / self.shares.target_mm;
            // Where weights change together an offset is in inverse proportion to them
            // ([`super::held_radius`]). The power 1.5 goes beyond what that asks for.
            let wanted = ratio * ratio.sqrt();
            let per_length6 = sample.spacing_t.powi(-6);
            let mut least = longest.max(LEAST_WEIGHT.powi(6) * per_length6);
            let factor = if ratio > 1.0 {
                (boost * wanted).min(MOST_FACTOR)
            } else if worst.is_some() {
                1.0
            } else {
                wanted.max(LEAST_FACTOR)
            };
            if factor < 1.0 {
                span = span_of(&self.spline.knots, sample.foot_t, span);
                let held_radius = &self.shares.held_radius;
                least =
                    least.max(held_radius.least_weight(&self.spline, span, (sample, per_length6)));
            }
            let most = MOST_WEIGHT.powi(6) * per_length6;
            sample.weight = (sample.weight * factor).max(least).min(most);
        }
        if let Some(worst) = worst {
            let last = (worst + 1).min(self.samples.len() - 1);
            for sample in &mut self.samples[worst.max(2) - 1..=last] {
                sample.weight *= WORST_BOOST;
            }
        }
    }

    /// Puts out the first spans.
    pub(super) fn put_out(&self, spans: usize, out: &mut Output) {
        let mut j = 1;
        for span in 0..spans {
            let Some(control) = bezier(&self.spline.knots, &self.spline.control, span) else {
                return;
            };
            let (from_t, to_t) = (self.spline.knots[span + 3], self.spline.knots[span + 4]);
            let samples = &self.samples;
            let foot = |along_t: f64| {
                while j + 1 < samples.len() && samples[j].along_t < along_t {
                    j += 1;
                }
                let (a, b) = (&samples[j - 1], &samples[j]);
                let share = (along_t - a.along_t) / (b.along_t - a.along_t);
                let foot_t = a.foot_t + share * (b.foot_t - a.foot_t);
                (foot_t - from_t) / (to_t - from_t)
            };
            out.span(&control, self.errors_mm[span], foot);
        }
    }

    /// Leaves the first spans behind.
    pub(super) fn shift(&mut self, spans: usize) {
        self.samples.drain(..self.chord);
        self.spline.control.drain(..spans);
        self.knots.drain(..spans);
        self.is_frozen = true;
        self.kept = DEGREE;
        self.knots.truncate(2 * DEGREE + 1);
        let mut t = self.knots.last().copied().unwrap_or(0.0);
        for sample in &self.samples[1..] {
            if sample.foot_t > t + APART_R * sample.spacing_t {
                t = sample.foot_t;
                self.knots.push(t);
            }
        }
        if let (Some(end_t), Some(last)) = (self.knots.last_mut(), self.samples.last())
            && last.foot_t > *end_t
        {
            *end_t = last.foot_t;
        }
    }
}

/// Control points that an end fixes.
const fn fixed_points(end: End) -> usize {
    match end {
        End::Line => 3,
        End::Stop => 1,
    }
}

pub(super) fn first_weight(spacing_t: f64) -> f64 {
    (PI / (FIRST_STIFFNESS * spacing_t)).powi(6)
}

fn unit<const D: usize>(from: &[f64; D], to: &[f64; D]) -> [f64; D] {
    let step = minus(to, from);
    let length = norm(&step);
    step.map(|x| x / length)
}
