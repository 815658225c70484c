//! The programmed path, as far as it can be seen beside the motion.

use super::track::{MotionTrace, TrackPoint};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Item, ItemKind};

/// Turn of a chord of an arc, radians: off by a thousandth of the radius.
const CHORD_RAD: f64 = 0.09;
/// Chords of another curve.
const CURVE_CHORDS: f64 = 8.0;

/// The path of feed moves, in bounded memory.
#[derive(Debug, Default)]
pub(super) struct ProgramTrace(MotionTrace);

impl ProgramTrace {
    /// The next item of the program.
    pub(super) fn push(&mut self, item: &Item) {
        let ItemKind::Move { segment, rate, .. } = &item.kind else {
            return;
        };
        let rapid = rate.is_rapid();
        if self.0.points().is_empty() {
            self.point(&segment.start(), rapid);
        }
        let chords = match segment {
            Segment::Line(_) => 1.0,
            Segment::Arc(arc) => (arc.sweep_rad.abs() / CHORD_RAD).ceil().clamp(1.0, 1e4),
            Segment::Curve(_) => CURVE_CHORDS,
        };
        let length = segment.length();
        let mut chord = 1.0;
        while chord < chords {
            self.point(&segment.jet(length * chord / chords).position, rapid);
            chord += 1.0;
        }
        self.point(&segment.end(), rapid);
    }

    fn point(&mut self, position: &AxisVector, rapid: bool) {
        self.0.push(TrackPoint {
            at: [position[0], position[1], position[2]],
            feed_v: 0.0,
            rapid,
            bound: None,
        });
    }

    /// Its points.
    pub(super) fn points(&self) -> &[TrackPoint] {
        self.0.points()
    }
}
