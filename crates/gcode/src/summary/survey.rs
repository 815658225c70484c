//! The survey of a program's path: its sharpest corner, and its time at the feedrate as if there
//! were no acceleration.

use crate::summary::pole_turns::PoleTurns;
use glidepath_geometry::{AxisVector, Segment, feed_length};
use glidepath_program::{Item, ItemKind};

/// A corner of the path: where two feed moves meet at an angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Line of the move behind it.
    pub line: u32,
    /// Machine coordinates.
    pub at: AxisVector,
    /// By how much the direction changes, degrees: 180 is a reversal.
    pub angle_deg: f64,
}

/// The survey of a program's path.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Survey {
    /// The sharpest corner between two feed moves; `None` without any.
    pub corner: Option<Corner>,
    /// Time of the straight feed moves at their feedrate, as if there were no acceleration, s.
    pub straight_time_s: f64,
    /// Time of the arcs at their feedrate, as if there were no acceleration, s.
    pub arc_time_s: f64,
    /// Turns of C at the pole in the cut.
    pub pole_turns: PoleTurns,
    /// The cosine of the angle at `corner`.
    least_cosine: f64,
    /// Direction at the end of the last feed move.
    last: Option<AxisVector>,
}

impl Survey {
    /// Takes the next item of the program into account.
    pub fn add(&mut self, item: &Item) {
        match &item.kind {
            ItemKind::Move { segment, rate, .. } => {
                let Some(feed_v) = rate.feed_v() else {
                    self.last = None;
                    return;
                };
                let length = segment.length();
                let seconds = length / feed_v;
                match segment {
                    Segment::Arc(_) | Segment::Curve(_) => self.arc_time_s += seconds,
                    _ => self.straight_time_s += seconds,
                }
                self.corner(item.line, segment, length);
            }
            ItemKind::Event(event) if !event.is_at_rest() => {}
            // After a rest, as after a rapid move, the next corner is none.
            _ => self.last = None,
        }
    }

    fn corner(&mut self, line: u32, segment: &Segment, length: f64) {
        let (start, end) = match segment {
            Segment::Line(line) => {
                let direction = direction(line.displacement() / length);
                (direction, direction)
            }
            _ => {
                let segment = segment.prepared();
                let [start, end] = [0.0, length].map(|s| direction(segment.jet(s).d1));
                (start, end)
            }
        };
        if let (Some(last), Some(start)) = (self.last, start) {
            let cosine = last.dot(&start).clamp(-1.0, 1.0);
            // Hardly any is the sharpest so far, and an angle costs more than all the rest.
            let may_be = self.corner.is_none() || cosine < self.least_cosine;
            let angle_deg = if may_be {
                cosine.acos().to_degrees()
            } else {
                0.0
            };
            if self
                .corner
                .is_none_or(|corner| angle_deg > corner.angle_deg)
            {
                self.least_cosine = cosine;
                self.corner = Some(Corner {
                    line,
                    at: segment.start(),
                    angle_deg,
                });
            }
        }
        self.last = end;
    }
}

/// The direction of the tool's path, in which linear axes alone count.
#[inline]
fn direction(mut d1: AxisVector) -> Option<AxisVector> {
    for axis in 3..6 {
        d1[axis] = 0.0;
    }
    let length = feed_length(&d1);
    (length > 0.0).then(|| d1 / length)
}
