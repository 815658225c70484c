//! The layout of samples on merged chords: which vertices are corners, which chords are lines, and where
//! the spline has its samples.
//!
//! ```text
//!   corner           smooth            smooth              corner
//!     ●━━━━━━━╌·╌·╌·╌·╌·╌○╌·╌·╌━━━━━━━━━╌·╌·╌○╌·╌·╌·╌━━━━━━━━━●
//!       line   spline          line in the middle       line
//!                              of a long chord
//! ```
//!
//! Every curve starts and ends on a line, with zero curvature. So a corner is always one of two
//! lines, and what replaces corners need not know of curves.
//!
//! Samples are dense near a vertex that turns much and spread by doubling: long spans next to short
//! ones are where a fit fails.

use super::marks::Change;
use super::output::Output;
use super::shares::ToleranceShares;
use super::thinning::MergedChord;
use super::vector::{add_scaled, between, dot, minus};
use super::window::{End, Window};
use crate::ruled;
use glidepath_program::Override;

/// Turns, in rad, above which a vertex is a corner: in any case, if the path is straight on one
/// side of it, and if it is on both sides. 100°, 30°, 15°.
const REVERSAL_RAD: f64 = 1.745_329_251_994_33;
const SHARP_RAD: f64 = core::f64::consts::FRAC_PI_6;
const GENTLE_RAD: f64 = core::f64::consts::FRAC_PI_6 / 2.0;
/// Turns to one side and then to the other, each above 55°, are a zigzag.
const ZIGZAG_RAD: f64 = 0.96;
/// A zigzag whose chords have at least this length, in tolerances, times the squared sine of half
/// the turn, is faster with its corners: the curve that is left of it in the tube bends too much.
/// Found by driving zigzags of 45° to 105° both ways; lengths and times of both go with the cube
/// root of each other, so that limits do not matter.
const ZIGZAG_R: f64 = 1.15;
/// Spacing of samples beside a vertex times the sine of half its turn, in tolerances. With more, the curve
/// may leave the tube between two of them; with less, there are more of them.
const BESIDE_VERTEX_R: f64 = 0.8;
/// The least sine that is divided by: of what is straight on, the other bounds set the spacing.
const LEAST_SINE: f64 = 1e-9;
/// How much longer a spacing may be than the one on the other side of its vertex, and how much longer a
/// part of a chord than a spacing that is taken from it: what is left is no shorter than half of that.
const GROWTH_R: f64 = 2.5;
const ROOM_R: f64 = 1.5;
/// A chord is bent if an arc over it that turns as much as the path does at its end leaves it by more than
/// the tolerance: the sagitta is an eighth of length times turn.
const BENT_R: f64 = 8.0;
/// Most of a long chord that the curves at either end may take: .4 of it stay a line.
const END_R: f64 = 0.3;
/// Lengths in tolerances: of a chord whose middle is a line if it bends, and if it does not; of the
/// curves beside such a line, at a feed that uses the limits; of a line beside a corner; the least spacing
/// of samples. At .02 mm they are 8 and 80 mm, 3 mm, .4 mm, .03 mm: the first, the third and the last
/// are those of a prototype, which had been tried on CAM programs at that tolerance.
const LONG_BENT_R: f64 = 400.0;
const LONG_R: f64 = 4000.0;
const BESIDE_LINE_R: f64 = 150.0;
const BESIDE_CORNER_R: f64 = 20.0;
const LEAST_SPACING_R: f64 = 1.5;
/// Most samples graded from one end of a chord.
const MOST_GRADED: usize = 24;

/// Makes lines and samples of chords, each as soon as the next is known.
#[derive(Debug, Clone)]
pub(super) struct SampleLayout<const D: usize> {
    shares: ToleranceShares,
    window: Window<D>,
    waiting: Option<(MergedChord<D>, Option<Change>)>,
    /// A curve leads to the start of the chord that waits.
    is_curved: bool,
    /// How much the path turns there, rad.
    turn_rad: f64,
    /// Where to: the difference of the directions.
    bend: [f64; D],
    /// Spacing of the samples before it.
    spacing_t: f64,
    /// Length of the chords before it.
    along_t: f64,
    /// The feed of the chord at hand, mm/s.
    feed_v: f64,
}

impl<const D: usize> SampleLayout<D> {
    pub(super) fn new(shares: ToleranceShares) -> Self {
        Self {
            window: Window::new(shares.clone()),
            shares,
            waiting: None,
            is_curved: false,
            turn_rad: 0.0,
            bend: [0.0; D],
            spacing_t: 0.0,
            along_t: 0.0,
            feed_v: 0.0,
        }
    }

    /// The next chord, and what its first block changes.
    pub(super) fn push(&mut self, next: MergedChord<D>, change: Option<Change>, out: &mut Output) {
        if let Some((chord, mark)) = self.waiting.take() {
            let (turn_rad, bend) = turn(&chord, &next);
            let is_corner = self.is_corner(turn_rad, chord.length_t, next.length_t)
                || self.is_zigzag((turn_rad, &bend), chord.length_t.min(next.length_t));
            self.bend = bend;
            let spacing_t = (!is_corner).then(|| self.spacing(turn_rad, next.length_t));
            self.drive(&chord, mark, spacing_t, turn_rad, out);
        }
        self.waiting = Some((next, change));
    }

    /// No more chords: the path ends with a corner.
    pub(super) fn finish(&mut self, out: &mut Output) {
        if let Some((chord, mark)) = self.waiting.take() {
            self.drive(&chord, mark, None, 0.0, out);
        }
    }

    /// Whether a vertex between chords of these lengths is kept as a corner: it turns back, or a
    /// curve that bends evenly along the shorter chord leaves the tube; or it turns much, and one
    /// that bends along the longer chord does.
    fn is_corner(&self, turn_rad: f64, before_t: f64, after_t: f64) -> bool {
        let sagitta_mm = |length_t: f64| 0.5 * length_t * (0.25 * turn_rad).tan();
        let least_rad = if sagitta_mm(before_t.min(after_t)) > self.shares.tolerance_mm {
            GENTLE_RAD
        } else if sagitta_mm(before_t.max(after_t)) > self.shares.tolerance_mm {
            SHARP_RAD
        } else {
            REVERSAL_RAD
        };
        turn_rad > least_rad
    }

    /// Whether a vertex, after another that turned to the other side, is kept as a corner.
    fn is_zigzag(&self, (turn_rad, bend): (f64, &[f64; D]), shorter_t: f64) -> bool {
        let less_rad = turn_rad.min(self.turn_rad);
        let sine = (0.5 * less_rad).sin();
        less_rad > ZIGZAG_RAD
            && dot(bend, &self.bend) < 0.0
            && shorter_t * sine * sine > ZIGZAG_R * self.shares.tolerance_mm
    }

    /// The spacing of samples beside a vertex, at most 2.5 times that of the samples on its other
    /// side.
    fn spacing(&self, turn_rad: f64, other_t: f64) -> f64 {
        let sine = (0.5 * turn_rad).sin().max(LEAST_SINE);
        let wanted_t = BESIDE_VERTEX_R * self.shares.tolerance_mm / sine;
        wanted_t
            .min(GROWTH_R * other_t)
            .max(LEAST_SPACING_R * self.shares.tolerance_mm)
    }

    /// Lays out a chord; at its end is a corner, or a curve goes on with samples so far apart.
    fn drive(
        &mut self,
        chord: &MergedChord<D>,
        change: Option<Change>,
        end_spacing_t: Option<f64>,
        end_turn_rad: f64,
        out: &mut Output,
    ) {
        let length_t = chord.length_t;
        if let Some(change) = &change {
            self.feed_v = change.rate.under(Override::NONE);
        }
        self.window.feed_v = self.feed_v * self.shares.per_feed(chord);
        self.mark(chord, change, out);
        let start_spacing_t = self
            .is_curved
            .then(|| self.spacing(self.turn_rad, self.spacing_t));
        let bend_rad = self.turn_rad.max(end_turn_rad);
        let tolerance_mm = self.shares.tolerance_mm;
        let is_bent = length_t * bend_rad > BENT_R * tolerance_mm;
        let most_beside_t = (self.window.feed_v * self.shares.beside_line_t)
            .max(BESIDE_CORNER_R * tolerance_mm)
            .min(BESIDE_LINE_R * tolerance_mm);
        // Where the curves beside a line are shorter than BESIDE_LINE_R, a bent chord is long sooner, by as much.
        // A curve that turns as the path does would leave a line that one can lay a ruler to.
        let before_ruled_t = chord
            .before_ruled_t()
            .filter(|_| length_t * bend_rad > BENT_R * ruled::TURNED_MM);
        let is_long = before_ruled_t.is_some()
            || length_t > LONG_R * tolerance_mm
            || (is_bent && length_t > LONG_BENT_R / BESIDE_LINE_R * most_beside_t);
        let beside_t = if is_long {
            let most_t = (END_R * length_t).min(most_beside_t);
            before_ruled_t.map_or(most_t, |before_t| before_t.min(most_t))
        } else {
            length_t - (0.5 * length_t).min(BESIDE_CORNER_R * tolerance_mm)
        };
        // Beside a corner is always a line, for what rounds corners knows lines alone.
        let is_all_curve = start_spacing_t.is_some() && end_spacing_t.is_some() && !is_long;
        let curve_end_t = match start_spacing_t {
            _ if is_all_curve => length_t,
            Some(_) => beside_t,
            None => 0.0,
        };
        let curve_start_t = match end_spacing_t {
            Some(_) if !is_all_curve => length_t - beside_t,
            _ => length_t,
        };
        if is_all_curve {
            let spacings_t = (start_spacing_t.unwrap_or(0.0), end_spacing_t.unwrap_or(0.0));
            self.grade(chord, (0.0, length_t), spacings_t, out);
        } else {
            if let Some(spacing_t) = start_spacing_t {
                // A line's end fixes three control points on the chord: they need three spans there.
                let third_t = curve_end_t / 3.0;
                self.grade(
                    chord,
                    (0.0, curve_end_t),
                    (spacing_t.min(third_t), third_t),
                    out,
                );
                self.window.finish(End::Line, out);
            }
            self.line(chord, (curve_end_t, curve_start_t), out);
            if let Some(spacing_t) = end_spacing_t {
                let third_t = (length_t - curve_start_t) / 3.0;
                let start = between(&chord.start, &chord.end, curve_start_t / length_t);
                self.window
                    .start(start, self.along_t + curve_start_t, End::Line);
                let spacings_t = (third_t, spacing_t.min(third_t));
                self.grade(chord, (curve_start_t, length_t), spacings_t, out);
            }
        }
        self.is_curved = end_spacing_t.is_some();
        self.turn_rad = end_turn_rad;
        self.along_t += length_t;
    }

    /// Tells where the blocks of a chord start.
    fn mark(&self, chord: &MergedChord<D>, mut change: Option<Change>, out: &mut Output) {
        for &(from_u, line) in &chord.blocks {
            let from_t = self.along_t + from_u * chord.length_t;
            out.marks.push(from_t, line, change.take());
        }
    }

    /// The part of a chord that is a line.
    fn line(&self, chord: &MergedChord<D>, (from_t, to_t): (f64, f64), out: &mut Output) {
        let at = |t: f64| between(&chord.start, &chord.end, t / chord.length_t);
        let continues = [from_t > 0.0, to_t < chord.length_t];
        let start = if continues[0] {
            at(from_t)
        } else {
            chord.start
        };
        let end = if continues[1] { at(to_t) } else { chord.end };
        let along_t = (self.along_t + from_t, self.along_t + to_t);
        out.line((&start, &end), along_t, chord.error_mm, continues);
    }

    /// Samples on a part of a chord, not at its start but at its end, their spacing growing by two
    /// from those wanted at its ends.
    fn grade(
        &mut self,
        chord: &MergedChord<D>,
        (from_t, to_t): (f64, f64),
        (mut low_t, mut high_t): (f64, f64),
        out: &mut Output,
    ) {
        let (mut from_start, mut from_end) = ([0.0; MOST_GRADED], [0.0; MOST_GRADED]);
        let (mut starts, mut ends) = (0, 0);
        let (mut x_t, mut y_t) = (from_t, to_t);
        loop {
            let room_t = y_t - x_t;
            // From the finer end, so that spacings meet in the middle about as large.
            if low_t <= high_t && ROOM_R * low_t < room_t && starts < MOST_GRADED {
                x_t += low_t;
                from_start[starts] = x_t;
                starts += 1;
                low_t *= 2.0;
            } else if low_t > high_t && ROOM_R * high_t < room_t && ends < MOST_GRADED {
                y_t -= high_t;
                from_end[ends] = y_t;
                ends += 1;
                high_t *= 2.0;
            } else {
                break;
            }
        }
        let places = from_start[..starts]
            .iter()
            .chain(from_end[..ends].iter().rev())
            .chain([&to_t]);
        let mut before_t = from_t;
        for &t in places {
            let is_end = t >= chord.length_t;
            let point = if is_end {
                chord.end
            } else {
                between(&chord.start, &chord.end, t / chord.length_t)
            };
            self.spacing_t = t - before_t;
            self.window
                .add(point, (self.along_t + t, self.spacing_t), out);
            before_t = t;
        }
    }
}

/// How much the path turns between two chords, rad, and the difference of their directions.
fn turn<const D: usize>(from: &MergedChord<D>, to: &MergedChord<D>) -> (f64, [f64; D]) {
    let first = minus(&from.end, &from.start).map(|x| x / from.length_t);
    let second = minus(&to.end, &to.start).map(|x| x / to.length_t);
    let sum = add_scaled(&first, 1.0, &second);
    let difference = minus(&second, &first);
    let half_rad = dot(&difference, &difference)
        .sqrt()
        .atan2(dot(&sum, &sum).sqrt());
    (2.0 * half_rad, difference)
}
