//! From one way to the other where both are on the same part of the program: a quintic in time for
//! every axis.
//!
//! ```text
//!   from  ──●──╮                 It keeps the limits and the speeds of the program, is within the
//!              ╰─ · · · ─╮       tolerance of it, near every vertex that it passes, and never goes
//!   to                   ╰──●──  back.
//! ```

use super::program_path::{Place, ProgramPath};
use super::runner::Runner;
use glidepath_geometry::{AXES, AxisVector, feed_length, tolerance_norm};
use glidepath_program::{Frame, Limits};

/// Share of the limits and of the tolerance that a joint keeps to.
const LIMIT_R: f64 = 1.0 - 1e-6;
const TOLERANCE_R: f64 = 0.95;
/// The speed of a move counts as kept up to this factor.
const SPEED_R: f64 = 1.0 + 2e-4;
/// Frames before and behind a joint whose differences have a part of it.
pub(super) const SEAM: usize = 3;

/// A way over to the other way.
#[derive(Debug, Clone)]
pub(super) struct Joint {
    /// The frame of the one way that it follows, and that of the other way that follows it.
    pub(super) from: usize,
    pub(super) to: usize,
    /// The frames between, with path positions of the first way.
    pub(super) frames: Vec<Frame>,
    /// What is to be added to path positions of the other way to go on with those of the first.
    pub(super) shift_s: f64,
}

/// What a joint has to keep.
#[derive(Debug)]
pub(super) struct Bounds<'a> {
    pub(super) limits: &'a Limits,
    pub(super) period_t: f64,
    pub(super) program: &'a ProgramPath,
}

impl Joint {
    /// Periods by which frames of the other way come later than by its own count.
    pub(super) fn shift(&self) -> i64 {
        signed(self.from + self.frames.len() + 1) - signed(self.to)
    }

    /// The joint between two frames in so many periods, if it keeps everything.
    pub(super) fn between(
        ways: [&Runner; 2],
        (from, to): (usize, usize),
        periods: usize,
        bounds: &Bounds<'_>,
    ) -> Option<Self> {
        let ends = [ways[0].frame(from)?, ways[1].frame(to)?];
        let quintic = Quintic::new(ends, as_f64(periods) * bounds.period_t);
        if !quintic.keeps_jerk(bounds)
            || ways[0].events_before(from + 1) != ways[1].events_before(to)
        {
            return None;
        }
        let seams = [from + 1 - SEAM, to].map(|first| first..first + SEAM);
        let [before, after] = [0, 1].map(|way| {
            let frames = seams[way].clone().map(|number| ways[way].frame(number));
            frames.collect::<Option<Vec<_>>>()
        });
        let mut frames = quintic.frames(ends[0], periods, bounds)?;
        if !keeps_differences(&before?, &frames, &after?, bounds) {
            return None;
        }
        let places = [ways[0].place(from)?, ways[1].place(to)?];
        follow(&mut frames, ends, places, bounds)?;
        let way_s = places[1].at_s - places[0].at_s;
        Some(Self {
            from,
            to,
            frames,
            shift_s: ends[0].path_s + way_s - ends[1].path_s,
        })
    }
}

/// A motion with given states at its ends.
struct Quintic {
    /// By rising power of the share of its time.
    coefficients: [AxisVector; 6],
    duration_t: f64,
}

impl Quintic {
    fn new([from, to]: [&Frame; 2], duration_t: f64) -> Self {
        let t = duration_t;
        let [p, v, a] = [
            from.position,
            from.velocity * t,
            from.acceleration * (0.5 * t * t),
        ];
        let gap = to.position - p - v - a;
        let speed_gap = to.velocity * t - v - a * 2.0;
        let bend_gap = to.acceleration * (t * t) - a * 2.0;
        Self {
            coefficients: [
                p,
                v,
                a,
                gap * 10.0 - speed_gap * 4.0 + bend_gap * 0.5,
                gap * -15.0 + speed_gap * 7.0 - bend_gap,
                gap * 6.0 - speed_gap * 3.0 + bend_gap * 0.5,
            ],
            duration_t,
        }
    }

    /// Its derivative of an order 0…3 at a share of its time.
    fn at(&self, share: f64, order: i32) -> AxisVector {
        let mut sum = AxisVector::zeros();
        let mut factor_of_share = 1.0;
        for (power, coefficient) in (0..).zip(&self.coefficients) {
            if power < order {
                continue;
            }
            let falling: i32 = (0..order).map(|k| power - k).product();
            sum += *coefficient * (f64::from(falling) * factor_of_share);
            factor_of_share *= share;
        }
        sum / self.duration_t.powi(order)
    }

    /// Jerk is a parabola: its ends and its middle tell nearly all of it.
    fn keeps_jerk(&self, bounds: &Bounds<'_>) -> bool {
        [0.0, 0.5, 1.0]
            .into_iter()
            .all(|share| keeps(&self.at(share, 3), &bounds.limits.jerk, 1.0))
    }

    /// Its frames, if it keeps the limits at each of them.
    fn frames(&self, from: &Frame, periods: usize, bounds: &Bounds<'_>) -> Option<Vec<Frame>> {
        let limits = bounds.limits;
        let frame = |k: usize| {
            let share = as_f64(k) / as_f64(periods);
            let [position, velocity, acceleration, jerk] =
                [0, 1, 2, 3].map(|order| self.at(share, order));
            let is_kept = keeps(&velocity, &limits.velocity, 1.0)
                && keeps(&acceleration, &limits.acceleration, 1.0)
                && keeps(&jerk, &limits.jerk, 1.0);
            is_kept.then(|| Frame {
                event: None,
                path_v: feed_length(&velocity),
                position,
                velocity,
                acceleration,
                ..*from
            })
        };
        (1..periods).map(frame).collect()
    }
}

/// True if no axis has more than a multiple of its limit.
fn keeps(of: &AxisVector, most: &AxisVector, factor: f64) -> bool {
    (0..AXES).all(|i| of[i].abs() <= most[i] * factor * LIMIT_R)
}

/// Puts the frames of a joint to their places on the program, if they follow it.
fn follow(
    frames: &mut [Frame],
    [from, to]: [&Frame; 2],
    [begin, end]: [&Place; 2],
    bounds: &Bounds<'_>,
) -> Option<()> {
    let bulge_mm =
        |frame: &Frame| frame.acceleration.norm() * bounds.period_t * bounds.period_t / 8.0;
    let mut last = *begin;
    let mut chords = vec![(begin.at_s, from.position)];
    for frame in &mut *frames {
        let most_s = 2.0 * frame.path_v * bounds.period_t + 4.0 * last.tolerance_mm;
        let place = bounds.program.place_after(&last, most_s, &frame.position)?;
        let is_kept = place.at_s > last.at_s
            && frame.path_v <= place.top_v * SPEED_R
            && place.off_mm + bulge_mm(frame) <= TOLERANCE_R * place.tolerance_mm;
        if !is_kept {
            return None;
        }
        frame.path_s = from.path_s + (place.at_s - begin.at_s);
        chords.push((place.at_s, frame.position));
        last = place;
    }
    chords.push((end.at_s, to.position));
    if end.at_s <= last.at_s {
        return None;
    }
    let most_mm = frames.iter().map(bulge_mm).fold(0.0, f64::max);
    let vertices = bounds.program.vertices_between(begin, end)?;
    let mut chords = chords.windows(2).peekable();
    for (at_s, vertex, tolerance_mm) in vertices {
        while chords.next_if(|chord| chord[1].0 < at_s).is_some() {}
        let chord = chords.peek()?;
        let (start, along) = (chord[0].1, chord[1].1 - chord[0].1);
        let share = ((vertex - start).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        let off_mm = tolerance_norm(&(vertex - start - along * share));
        if off_mm + most_mm > TOLERANCE_R * tolerance_mm {
            return None;
        }
    }
    Some(())
}

/// True if differences of positions keep the limits where a joint begins and ends.
fn keeps_differences(
    before: &[&Frame],
    frames: &[Frame],
    after: &[&Frame],
    bounds: &Bounds<'_>,
) -> bool {
    let all: Vec<_> = before
        .iter()
        .copied()
        .chain(frames)
        .chain(after.iter().copied())
        .map(|frame| frame.position)
        .collect();
    let t = bounds.period_t;
    let limits = bounds.limits;
    all.windows(4).all(|p| {
        keeps(&(p[1] - p[0]), &limits.velocity, t)
            && keeps(&(p[2] - p[1] * 2.0 + p[0]), &limits.acceleration, t * t)
            && keeps(
                &(p[3] - (p[2] - p[1]) * 3.0 - p[0]),
                &limits.jerk,
                t * t * t,
            )
    })
}

fn as_f64(count: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "hundreds")]
    let count = count as f64;
    count
}

/// A number of frames, to be counted with shifts.
pub(super) fn signed(frames: usize) -> i64 {
    i64::try_from(frames).unwrap_or(i64::MAX)
}
