//! The counts and sums over a program: moves, lengths, tolerances in force, rests around its
//! motion.

use glidepath_geometry::{AxisVector, ROTARY_ABC, Segment, feed_length};
use glidepath_program::{Item, ItemKind, PathMode};

/// Counts and sums over the items fed so far.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Amount {
    /// Moves, those that go nowhere included.
    pub(crate) moves: u64,
    /// Path of the moves with linear axes, mm.
    pub(crate) path_length_mm: f64,
    /// Path of the moves of rotary axes alone, degrees.
    pub(crate) turn_length_deg: f64,
    /// The least and the largest tolerance in force for a move that uses it (G64), mm; none without
    /// such moves.
    pub(crate) tolerances_mm: Option<[f64; 2]>,
    /// Some move has gone somewhere.
    has_moved: bool,
    /// Dwells before the first move and behind the last, s.
    pub(crate) rests_t: [f64; 2],
}

impl Amount {
    /// Adds an item, with the tolerance where it gives none.
    pub(crate) fn add(&mut self, item: &Item, configured_mm: f64) {
        match &item.kind {
            ItemKind::Move { segment, mode, .. } => {
                self.moves += 1;
                let length = segment.length();
                if length <= 0.0 {
                    return;
                }
                if is_turn(segment) {
                    self.turn_length_deg += length;
                } else {
                    self.path_length_mm += length;
                }
                if matches!(mode, PathMode::Continuous { .. }) {
                    let tolerance_mm = mode.tolerance_mm(configured_mm);
                    let [least, most] = self.tolerances_mm.unwrap_or([tolerance_mm; 2]);
                    self.tolerances_mm = Some([least.min(tolerance_mm), most.max(tolerance_mm)]);
                }
                self.has_moved = true;
                let [_, behind_t] = &mut self.rests_t;
                *behind_t = 0.0;
            }
            ItemKind::Dwell(dwell_t) => {
                let [before_t, behind_t] = &mut self.rests_t;
                *(if self.has_moved { behind_t } else { before_t }) += dwell_t;
            }
            ItemKind::Event(_) => {}
        }
    }
}

/// True if the feed length of a segment is in degrees: only rotary axes move.
fn is_turn(segment: &Segment) -> bool {
    let way = match segment {
        Segment::Line(line) => line.displacement(),
        Segment::Arc(_) => return false,
        Segment::Curve(curve) => curve.jet(0.5 * curve.length).d1,
    };
    let mut linear: AxisVector = way;
    for axis in ROTARY_ABC {
        linear[axis] = 0.0;
    }
    feed_length(&linear) < feed_length(&way)
}
