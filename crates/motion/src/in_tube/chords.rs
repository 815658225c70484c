//! The chords of a move: an arc, or a curve, is cut into straight pieces within a share of the tolerance.

use super::work_queue::Move;
use crate::on_path::chord_speed;
use glidepath_geometry::{Arc, AxisVector, Segment};
use glidepath_program::{Event, ProgramLine, Rate, Settings, tolerance_norm};

/// Share of the tolerance that chords of an arc may be away from it.
const FLATTENING_R: f64 = 0.05;
/// Largest turn from one chord of an arc to the next, rad: less than what is taken for a corner.
const LARGEST_TURN_RAD: f64 = 0.25;

/// Share of the tolerance that the chord of a period may be away from a curve. Windows plan with the positions at the
/// periods, and learn what chords cut off from one motion to the next; where that comes near the tolerance there is
/// little room left in which a motion is to be found. Without a bound they found none at tolerances of some
/// micrometres, and the motion stopped at the vertices of an arc; with .7, .85 and 1 in its place arcs of 1 to 10 mm
/// took up to 1 % longer.
const CHORD_R: f64 = 0.8;
/// Radius of a curve, in tolerances, from which on its own curvature counts: a smaller one is cut so much that the
/// motion bends less than it does. With a bound there, small letters and teeth of .15 mm took .6 to .8 % longer.
const LEAST_RADIUS_R: f64 = 50.0;

/// A move that is being cut into chords.
#[derive(Debug, Clone)]
pub(super) struct CutMove {
    of: Move,
    /// Where the chords made so far end.
    at: AxisVector,
    done: u32,
    count: u32,
    error_mm: f64,
    mm_per_deg: f64,
    most_v: f64,
}

#[derive(Debug, Clone)]
pub(super) struct FlatChord {
    pub(super) start: AxisVector,
    pub(super) end: AxisVector,
    pub(super) rate: Rate,
    pub(super) tolerance_mm: f64,
    /// What a degree of the rotary axes counts for, mm.
    pub(super) mm_per_deg: f64,
    /// Distance from the program, mm.
    pub(super) error_mm: f64,
    /// From the middle of the chord to the program.
    pub(super) sagitta_vector: AxisVector,
    /// The speed up to which the chords of periods stay near the program, mm/s.
    pub(super) most_v: f64,
    pub(super) line: ProgramLine,
    pub(super) events: Vec<Event>,
}

impl FlatChord {
    pub(super) fn length_mm(&self) -> f64 {
        tolerance_norm(&(self.end - self.start), self.mm_per_deg)
    }
}

impl CutMove {
    pub(super) fn new(of: Move, settings: &Settings) -> Self {
        let mm_per_deg = settings.direction.mm_per_deg(of.tolerance_mm);
        let (count, error_mm) = match &of.segment {
            Segment::Line(_) => (1, 0.0),
            Segment::Arc(arc) => cuts(arc, FLATTENING_R * of.tolerance_mm),
            Segment::Curve(curve) => {
                let second_k = tolerance_norm(&curve.bounds().d2, mm_per_deg);
                let allowed_mm = FLATTENING_R * of.tolerance_mm;
                let turn_rad = second_k * curve.length;
                let (count, error_mm) = chords_of((curve.length, second_k, turn_rad), allowed_mm);
                (count, error_mm + curve.error_mm)
            }
        };
        Self {
            at: of.segment.start(),
            most_v: most_speed(
                &of.segment,
                of.tolerance_mm - error_mm,
                mm_per_deg,
                settings,
            ),
            mm_per_deg,
            of,
            done: 0,
            count,
            error_mm,
        }
    }

    pub(super) fn next(&mut self) -> Option<FlatChord> {
        if self.done >= self.count {
            return None;
        }
        let segment = &self.of.segment;
        let at = |done: f64| {
            let share = done / f64::from(self.count);
            segment.jet(segment.length() * share).position
        };
        let start = self.at;
        let end = if self.done + 1 == self.count {
            segment.end()
        } else {
            at(f64::from(self.done + 1))
        };
        let sagitta_vector = if matches!(segment, Segment::Line(_)) {
            AxisVector::zeros()
        } else {
            at(f64::from(self.done) + 0.5) - (start + end) * 0.5
        };
        self.at = end;
        self.done += 1;
        Some(FlatChord {
            start,
            end,
            sagitta_vector,
            rate: self.of.rate,
            tolerance_mm: self.of.tolerance_mm,
            error_mm: self.error_mm,
            mm_per_deg: self.mm_per_deg,
            most_v: self.most_v,
            line: self.of.line,
            events: core::mem::take(&mut self.of.events),
        })
    }
}

/// The speed up to which the chord of a period is away from a segment by [`CHORD_R`] of a tolerance, mm/s; infinite
/// for a line, and for what is cut more than it bends.
fn most_speed(segment: &Segment, tolerance_mm: f64, mm_per_deg: f64, settings: &Settings) -> f64 {
    // The height of a chord grows with the square of the speed; at this one it is the tolerance.
    let whole_v = chord_speed(segment, tolerance_mm, mm_per_deg, settings);
    let chord_mm = whole_v * settings.period_t;
    let radius_mm = chord_mm * chord_mm / (8.0 * tolerance_mm);
    if radius_mm < LEAST_RADIUS_R * tolerance_mm {
        return f64::INFINITY;
    }
    CHORD_R.sqrt() * whole_v
}

/// How many chords an arc is cut into, and how far they are from it at most: |q″|·h²/8 for chords
/// of length h, between points of equal path position.
fn cuts(arc: &Arc, allowed_mm: f64) -> (u32, f64) {
    let length_s = arc.length();
    let radius_mm = arc.start_radius().max(arc.end_radius());
    let drift = (arc.end_radius() - arc.start_radius()).abs() / length_s;
    let omega = arc.sweep_rad.abs() / length_s;
    let second_k = radius_mm * omega * omega + 2.0 * drift * omega;
    chords_of((length_s, second_k, arc.sweep_rad.abs()), allowed_mm)
}

/// The same from length, largest second derivative and turn.
fn chords_of((length_s, second_k, turn_rad): (f64, f64, f64), allowed_mm: f64) -> (u32, f64) {
    let by_error = length_s * (second_k / (8.0 * allowed_mm)).sqrt();
    let by_turn = turn_rad / LARGEST_TURN_RAD;
    let count = by_error.max(by_turn).ceil().clamp(1.0, 4e9);
    let chord_s = length_s / count;
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped"
    )]
    let number = count as u32;
    (number, second_k * chord_s * chord_s / 8.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_geometry::Plane;
    use glidepath_program::{Corners, Effort, Limits, Smoothing};

    #[test]
    fn the_chord_of_a_period_is_as_high_as_its_share_of_the_tolerance() {
        let settings = Settings {
            limits: Limits::uniform(200.0, 2000.0, 40_000.0),
            tolerance_mm: 0.02,
            direction: glidepath_program::DirectionTolerance::default(),
            smoothing: Smoothing::Auto,
            corners: Corners::default(),
            period_t: 0.004,
            effort: Effort::Optimal,
        };
        let radius_mm = 3.0;
        let mut start = AxisVector::zeros();
        start[0] = radius_mm;
        let arc = Segment::Arc(Arc {
            start,
            end: start,
            plane: Plane::Xy,
            center: [0.0, 0.0],
            sweep_rad: core::f64::consts::TAU,
        });
        let speed_v = most_speed(&arc, 0.001, 1.0, &settings);
        let half_rad = 0.5 * speed_v * settings.period_t / radius_mm;
        let height_r = radius_mm * (1.0 - half_rad.cos()) / 0.001;
        assert!((height_r - 0.8).abs() < 1e-3, "{height_r}");
        // A line, and an arc of 30 tolerances.
        let line = Segment::line(start, AxisVector::zeros());
        assert!(most_speed(&line, 0.001, 1.0, &settings).is_infinite());
        assert!(most_speed(&arc, 0.1, 1.0, &settings).is_infinite());
    }
}
